/* SPDX-License-Identifier: GPL-3.0-or-later */
/* /v1/inclined/modes: modes and dynamic tension of a taut elastic inclined cable (Grinfogel
 * 1984). */
#include <math.h>
#include <stdlib.h>

#include "endpoints/common/plausibility.h"
#include "endpoints/common/suspended_cable.h"
#include "endpoints/inclined/answer.h"

/* Beyond it an expansion in epsilon errs by more than about a hundredth: 0.15 epsilon^2. */
#define EPSILON_REACH 0.3
/* A cable that its own tension stretches by more: the elastic statics shift frequencies by half
 * of it. */
#define STRETCH_REACH 0.002

/* ---- the answer ---- */

static void write_statics(json_writer *json, const inclined_request *r)
{
    const strum_inclined_statics *s = &r->at_rest;
    const double length = r->length_m, tension = r->tension;
    json_key(json, "statics");
    json_open_object(json);
    json_put_number(json, "epsilon", r->cable.epsilon);
    if (isfinite(s->stiffness)) {
        json_put_number(json, "lambda_squared", r->cable.lambda_squared);
        json_put_number(json, "stiffness_to_tension", s->stiffness);
    }
    json_put_number(json, "mass_ratio", r->cable.mass_ratio);
    json_put_number(json, "s_a", s->s_a);
    json_put_number(json, "tension_bottom", s->tension_bottom);
    json_put_number(json, "tension_top", s->tension_top);
    json_put_number(json, "angle_bottom_deg", s->angle_bottom * 180 / M_PI);
    json_put_number(json, "angle_top_deg", s->angle_top * 180 / M_PI);
    json_put_number(json, "curvature_bottom", s->curvature_bottom);
    json_put_number(json, "curvature_top", s->curvature_top);
    json_put_number(json, "chord_to_length", s->chord);
    json_put_number(json, "sag_to_length", s->sag);
    json_put_number(json, "phase_integral", s->phase);
    if (tension > 0) {
        json_put_number(json, "s_a_m", s->s_a * length);
        json_put_number(json, "tension_N", tension);
        json_put_number(json, "horizontal_tension_N", tension * cos(r->cable.inclination));
        json_put_number(json, "tension_bottom_N", s->tension_bottom * tension);
        json_put_number(json, "tension_top_N", s->tension_top * tension);
        json_put_number(json, "chord_m", s->chord * length);
        json_put_number(json, "span_m", s->chord * length * cos(r->cable.inclination));
        json_put_number(json, "rise_m", s->chord * length * sin(r->cable.inclination));
        json_put_number(json, "sag_m", s->sag * length);
        if (isfinite(s->stiffness))
            json_put_number(json, "axial_stiffness_N", s->stiffness * tension);
    }
    if (r->span_m > 0)
        json_put_number(json, "unstretched_length_m", length);
    if (r->solutions > 0)
        json_put_integer(json, "solutions", r->solutions);
    if (r->solutions > 1)
        json_put_number(json, "other_unstretched_length_m", r->other_length_m);
    json_close_object(json);
}

static void write_crossover(json_writer *json, const inclined_request *r)
{
    strum_crossover c;
    if (strum_inclined_crossover(&r->cable, &c) != STRUM_OK)
        return;
    json_key(json, "crossover");
    json_open_object(json);
    json_put_integer(json, "number", c.number);
    json_put_string(json, "kind", c.gap > 0 ? "veering" : "crossing");
    json_put_number(json, "lambda_squared", c.lambda_squared);
    json_put_number(json, "kl_over_pi", 2 * c.number);
    json_put_number(json, "hybrid_from_lambda_squared", c.low);
    if (isfinite(c.high))
        json_put_number(json, "hybrid_to_lambda_squared", c.high);
    json_put_flag(json, "inside", c.inside);
    json_put_number(json, "least_gap_over_pi", c.gap / M_PI);
    json_close_object(json);
}

static void write_mode(json_writer *json, const inclined_request *r,
                       const strum_inclined_mode *mode)
{
    static const char *const families[] = {"transverse", "longitudinal", "hybrid"};
    const double slope = r->cable.epsilon * cos(r->cable.inclination);
    inclined_write_frequency(json, r, mode->kl);
    json_put_string(json, "family", families[mode->family]);
    json_put_number(json, "longitudinal_energy", mode->longitudinal_energy);
    json_put_string(json, "symmetry", symmetry_names[mode->symmetry]);
    json_put_number(json, "symmetric_share", fmin(fmax(mode->symmetric_share, 0), 1));
    json_put_flag(json, "hybrid_region", mode->hybrid_region);
    json_put_number(json, "tension_amplification", mode->tension_amplification);
    if (r->tension > 0)
        json_put_number(json, "tension_per_displacement_N_per_m",
                        mode->tension_amplification * r->tension / (slope * r->length_m));
}

static void write_shape(json_writer *json, const inclined_request *r,
                        const strum_inclined_point *shape)
{
    json_key(json, "shape");
    json_open_array(json);
    for (int64_t i = 0; i < r->shape_points; i++) {
        json_open_object(json);
        json_put_number(json, "s", shape[i].s);
        if (r->tension > 0)
            json_put_number(json, "s_m", shape[i].s * r->length_m);
        json_put_number(json, "transverse", shape[i].transverse);
        json_put_number(json, "longitudinal", shape[i].longitudinal);
        json_put_number(json, "tension", shape[i].tension);
        if (r->tension > 0)
            json_put_number(json, "tension_N_per_m",
                            shape[i].tension * r->tension / r->length_m);
        json_close_object(json);
    }
    json_close_array(json);
}

static strum_status write_modes(json_writer *json, const inclined_request *r,
                                const strum_inclined *modes, const answer *a)
{
    const size_t points = (size_t)r->shape_points;
    strum_inclined_point *shape = points > 0 ? calloc(points, sizeof *shape) : NULL;
    strum_status status = points > 0 && shape == NULL ? STRUM_ERR_MEMORY : STRUM_OK;
    json_key(json, "modes");
    json_open_array(json);
    for (size_t k = 0; k < strum_inclined_count(modes) && status == STRUM_OK; k++) {
        strum_inclined_mode mode;
        status = strum_inclined_get(modes, k, &mode);
        if (status != STRUM_OK)
            break;
        json_open_object(json);
        json_put_integer(json, "mode", (int64_t)k + 1);
        write_mode(json, r, &mode);
        if (points > 0)
            status = strum_inclined_shape(modes, k, NULL, points, shape);
        if (points > 0 && status == STRUM_OK)
            write_shape(json, r, shape);
        json_close_object(json);
        if (answer_cancelled(a))
            status = STRUM_ERR_CANCELLED;
    }
    json_close_array(json);
    free(shape);
    if (points > 0)
        json_put_string(json, "normalisation",
                        "the largest value along the cable of the dominant displacement "
                        "component is 1 (the first such point where tied); tension per unit "
                        "displacement: in T_a for a displacement in L");
    return status;
}

/* ---- comparison ---- */

/* One model beside full. (21) and (11) have no longitudinal modes: their k-th mode stands
 * beside the k-th that is not one. */
static void write_beside(json_writer *json, const inclined_request *r, int model,
                         const strum_inclined_mode *mode, const strum_inclined_mode *full)
{
    json_key(json, inclined_models[model]);
    json_open_object(json);
    inclined_write_frequency(json, r, mode->kl);
    if (model != FULL)
        json_put_number(json, "difference", mode->kl / full->kl - 1);
    json_put_number(json, "tension_amplification", mode->tension_amplification);
    if (model != FULL && full->tension_amplification > 0)
        json_put_number(json, "tension_difference",
                        mode->tension_amplification / full->tension_amplification - 1);
    json_close_object(json);
}

/* Mode k by every model that was solved; closed forms by their own count. */
static strum_status write_row(json_writer *json, const inclined_request *r,
                              strum_inclined *const *solved, size_t k, size_t *transverse)
{
    strum_inclined_mode full, mode;
    strum_status status = strum_inclined_get(solved[FULL], k, &full);
    const bool along = status == STRUM_OK && full.longitudinal_energy > 0.5;
    json_open_object(json);
    json_put_integer(json, "mode", (int64_t)k + 1);
    for (int model = 0; model < MODELS && status == STRUM_OK; model++) {
        const bool closed = model == ASYMPTOTIC || model == IRVINE;
        if (solved[model] == NULL || (closed && along))
            continue;
        status = strum_inclined_get(solved[model], closed ? *transverse : k, &mode);
        if (status == STRUM_OK)
            write_beside(json, r, model, &mode, &full);
    }
    *transverse += !along;
    json_close_object(json);
    return status;
}

static strum_status write_comparison(json_writer *json, const inclined_request *r,
                                     strum_inclined *const *solved)
{
    strum_status status = STRUM_OK;
    size_t transverse = 0;
    json_key(json, "comparison");
    json_open_array(json);
    for (size_t k = 0; k < (size_t)r->modes && status == STRUM_OK; k++)
        status = write_row(json, r, solved, k, &transverse);
    json_close_array(json);
    return status;
}

/* ---- warnings ---- */

static void warn_of_input(const inclined_request *r, answer *a)
{
    const double stiffness = r->at_rest.stiffness;
    if (r->tension > 0)
        cable_warn_weight(r->weight_N_per_m, r->mass_kg_per_m, r->added_mass_kg_per_m,
                          INCLINED_GRAVITY, a);
    if (!r->cable.elastic_statics && stiffness * STRETCH_REACH < 1)
        answer_warn(a,
                    "the static tension stretches this cable by %.2g %%, which statics "
                    "inextensible leaves out; statics elastic, and finite elements, do not: "
                    "frequencies differ by about half of it",
                    100 / stiffness);
    warn_strain(fmax(r->at_rest.tension_bottom, r->at_rest.tension_top) / stiffness, a);
    warn_end_angle(1, r->at_rest.angle_bottom * 180 / M_PI, a);
    warn_end_angle(2, r->at_rest.angle_top * 180 / M_PI, a);
    if (r->tension > 0) {
        const double steel = STEEL_SPECIFIC_STIFFNESS * r->mass_kg_per_m;
        const double slope = r->cable.epsilon * cos(r->cable.inclination);
        if (r->inextensible)
            warn_inextensible(steel / r->tension * slope * slope, steel, a);
        warn_added_mass(r->added_mass_kg_per_m, r->mass_kg_per_m, slope / 2, a);
    }
}

/* `last`: the highest frequency of the answer. */
static void warn_of_model(const inclined_request *r, double last, answer *a)
{
    strum_crossover c;
    const double along = sqrt(r->at_rest.stiffness / r->cable.mass_ratio);
    if (r->model == FULL)
        return;
    if (r->cable.epsilon > EPSILON_REACH)
        answer_warn(
            a,
            "epsilon %.3g is beyond the reach of model %s: its frequencies err by about "
            "0.03 to 0.15 epsilon squared, here up to %.2g %%",
            r->cable.epsilon, inclined_models[r->model], 15 * pow(r->cable.epsilon, 2));
    if (r->model != AIRY && along < last)
        answer_warn(
            a,
            "longitudinal modes begin near kl_over_pi %.3g, and model %s has none: from "
            "there on its modes are numbered otherwise than those of the cable",
            along, inclined_models[r->model]);
    if (r->model == IRVINE && strum_inclined_crossover(&r->cable, &c) == STRUM_OK && c.inside)
        answer_warn(
            a,
            "this cable is inside the hybrid region of crossover %d, where model irvine "
            "leaves out the coupling of the two modes: an error in kl_over_pi of up to "
            "about %.2g",
            c.number, c.gap / 2 / M_PI);
}

/* ---- */

static strum_status solve(const inclined_request *r, strum_inclined **solved,
                          const strum_options *options, strum_error *error, answer *a)
{
    for (int model = 0; model < MODELS && r->plane != INCLINED_OUT_OF_PLANE; model++) {
        if (!r->compare && model != r->model)
            continue;
        const strum_inclined_params params = inclined_params(r, model);
        const strum_status status =
            strum_inclined_solve(&params, options, &solved[model], error);
        if (status == STRUM_ERR_METHOD && model != r->model)
            answer_warn(a, "model %s is not compared: %s", inclined_models[model],
                        error->reason);
        else if (status != STRUM_OK)
            return status;
    }
    return STRUM_OK;
}

static strum_status write_verification(json_writer *json, const strum_inclined *modes,
                                       const strum_options *options, strum_error *error)
{
    strum_verification v;
    const strum_status status = strum_inclined_verify(modes, options, &v, error);
    if (status != STRUM_OK)
        return status;
    put_verification(json, &v);
    return STRUM_OK;
}

static const char *theory_of(const inclined_request *r)
{
    static const char *const theories[] = {
        "linear dynamics about the static catenary (Grinfogel 1984, equations 1-5, errata "
        "mended), force Galerkin method",
        "4 x 4 determinant of slow (Airy) and fast (WKB) solutions (Grinfogel 1984, chapter 2, "
        "errata mended)",
        "asymptotic frequencies, shapes and tension (Grinfogel 1984, equations 21, 34, 37, 38, "
        "errata mended)",
        "shallow elastic cable (Irvine and Caughey 1974; Grinfogel 1984, equations 11 and 20)"};
    return theories[r->model];
}

static strum_status write_result(const inclined_request *r, strum_inclined *const *solved,
                                 const strum_options *options, strum_error *error, answer *a)
{
    json_writer *json = a->result;
    const strum_inclined *modes = solved[r->model];
    strum_inclined_mode last;
    if (r->plane == INCLINED_OUT_OF_PLANE) {
        warn_of_input(r, a);
        write_statics(json, r);
        return inclined_write_out_of_plane(json, r, options, error);
    }
    strum_status status = strum_inclined_get(modes, strum_inclined_count(modes) - 1, &last);
    if (status != STRUM_OK)
        return status;
    warn_of_input(r, a);
    warn_of_model(r, last.kl / M_PI, a);
    write_statics(json, r);
    write_crossover(json, r);
    if (strum_inclined_spurious(modes) > 0)
        json_put_number(json, "spurious_kl_over_pi", strum_inclined_spurious(modes) / M_PI);
    status = write_modes(json, r, modes, a);
    if (status == STRUM_OK && r->compare)
        status = write_comparison(json, r, solved);
    if (status == STRUM_OK && r->verify)
        status = write_verification(json, modes, options, error);
    if (status == STRUM_OK && r->plane == INCLINED_BOTH)
        status = inclined_write_out_of_plane(json, r, options, error);
    return status;
}

static bool answer_modes(const void *data, answer *a)
{
    const inclined_request *r = data;
    const strum_options options = answer_options(a);
    strum_inclined *solved[MODELS] = {NULL};
    strum_error error = {0};
    a->theory =
        r->plane == INCLINED_OUT_OF_PLANE
            ? "linear dynamics out of the plane about the static catenary, Galerkin's method"
            : theory_of(r);
    strum_status status = solve(r, solved, &options, &error, a);
    json_open_object(a->result);
    if (status == STRUM_OK)
        status = write_result(r, solved, &options, &error, a);
    json_close_object(a->result);
    for (int model = 0; model < MODELS; model++)
        strum_inclined_free(solved[model]);
    if (status != STRUM_OK)
        cable_refuse(&error, status, a->problem);
    return status == STRUM_OK;
}

const endpoint inclined_modes = {
    .path = "/v1/inclined/modes",
    .title = "Modes and dynamic tension of a taut elastic inclined cable",
    .request = &inclined_schema,
    .query = true,
    .prepare = inclined_prepare,
    .answer_bytes = inclined_answer_bytes,
    .cost_us = inclined_cost_us,
    .answer = answer_modes,
};
