/* SPDX-License-Identifier: GPL-3.0-or-later */
/* /v1/catenary/frequencies: natural frequencies and shapes of a suspended cable (Gale 1976). */
#include <math.h>
#include <stdlib.h>

#include "endpoints/catenary/comparison.h"
#include "endpoints/common/plausibility.h"

enum { PLANE_IN, PLANE_OUT, PLANE_BOTH };
static const char *const planes[] = {"in_plane", "out_of_plane", "both", NULL};
enum { METHOD_GALERKIN, METHOD_SERIES, METHOD_RAYLEIGH };
static const char *const methods[] = {"galerkin", "series", "rayleigh", NULL};

#define SHAPE_POINTS_MAX 1000

typedef struct request {
    cable_input in;
    int plane, method;
    int64_t modes, shape_points;
    bool compare, verify;
} request;

static const field fields[] = {CABLE_FIELDS,
                               {FIELD_AT(FIELD_CHOICE, request, plane), .choices = planes,
                                .flags = FIELD_DEFAULT, .fallback = PLANE_BOTH,
                                .help = "which motion to solve"},
                               {FIELD_AT(FIELD_INTEGER, request, modes), .min = 1,
                                .max = STRUM_MODES_MAX, .flags = FIELD_DEFAULT, .fallback = 6,
                                .help = "modes of each plane, from the lowest frequency"},
                               {FIELD_AT(FIELD_CHOICE, request, method), .choices = methods,
                                .flags = FIELD_DEFAULT, .fallback = METHOD_GALERKIN,
                                .help = "galerkin: Galerkin's method to 1e-12; series: the "
                                        "report's own power series, for inextensible undamped "
                                        "cables within |xi| < 4; rayleigh: the report's "
                                        "estimate of out-of-plane mode 1"},
                               {FIELD_AT(FIELD_INTEGER, request, shape_points), .min = 0,
                                .max = SHAPE_POINTS_MAX, .flags = FIELD_DEFAULT,
                                .help = "points of each mode shape, equally spaced in chi, "
                                        "ends included; 0: none, else at least 2"},
                               {FIELD_AT(FIELD_FLAG, request, compare), .flags = FIELD_DEFAULT,
                                .help = "put the handbook's frequencies (shallow cable, taut "
                                        "string) beside the answer"},
                               {FIELD_AT(FIELD_FLAG, request, verify), .flags = FIELD_DEFAULT,
                                .help = "check the answer by a second, independent method"},
                               {.kind = FIELD_END}};

static const field_groups groups[] = {{CABLE_GEOMETRY_GROUPS}, {CABLE_ELASTICITY_GROUPS}, {0}};

static const schema request_schema = {.name = "catenary_frequencies_request",
                                      .fields = fields,
                                      .groups = groups,
                                      .size = sizeof(request)};

static bool asks(const request *r, strum_plane plane)
{
    return r->plane == PLANE_BOTH ||
           r->plane == (plane == STRUM_IN_PLANE ? PLANE_IN : PLANE_OUT);
}

static void prepare(void *data, schema_arena *arena, problem *p)
{
    (void)arena;
    request *r = data;
    if (r->shape_points == 1)
        problem_add(p, "/shape_points",
                    "must be 0 or at least 2, so that both ends are among them");
    if (r->method == METHOD_RAYLEIGH && r->plane == PLANE_IN)
        problem_add(p, "/plane", "rayleigh estimates out-of-plane mode 1 only");
    if (r->method != METHOD_GALERKIN && cable_damped(&r->in))
        problem_add(p, "/method", "%s has no damping; give eta_tangential and eta_normal 0",
                    methods[r->method]);
    if (r->method != METHOD_GALERKIN && r->shape_points > 0)
        problem_add(p, "/shape_points", "method galerkin gives mode shapes, %s does not",
                    methods[r->method]);
    if (r->method == METHOD_RAYLEIGH && r->compare)
        problem_add(p, "/compare", "goes with the methods galerkin and series");
    if (r->compare && cable_damped(&r->in))
        problem_add(p, "/compare",
                    "the handbook's formulas have no damping; give eta_tangential and "
                    "eta_normal 0");
    cable_prepare(&request_schema, &r->in, p);
    for (int plane = 0; plane < 2 && p->status == 0 && r->method == METHOD_SERIES; plane++) {
        strum_error fault = {0};
        if (!asks(r, (strum_plane)plane) ||
            strum_series_applies(&r->in.cable, (strum_plane)plane, &fault) == STRUM_OK)
            continue;
        problem_set(p, 422, "%s", fault.reason);
        problem_add(p, "/method", "%s", fault.reason);
    }
}

static double plane_cost_us(const request *r, strum_plane plane)
{
    const strum_cable *cable = &r->in.cable;
    const int modes = (int)r->modes;
    const double series =
        r->method == METHOD_SERIES
            ? 1.5 * strum_series_work(&(strum_series_params){*cable, plane, modes, true})
        : r->verify ? 0.25 * verification_series_work(&r->in, plane, modes)
                    : 0;
    const double galerkin = r->method == METHOD_GALERKIN || r->verify
                                ? strum_modes_work(&(strum_modes_params){
                                      *cable, plane, modes, r->shape_points > 0 || r->verify})
                                : 0;
    /* Unequal damping makes a quadratic pencil; the second method has a larger one. */
    const bool pencil = plane == STRUM_IN_PLANE && r->in.eta_tangential != r->in.eta_normal;
    const double share = 0.8 + (pencil ? 1.4 : 0) + (r->verify ? 1.5 : 0);
    return series + share * galerkin + (r->verify ? 200 * modes : 0) +
           (cable->kappa_t > 0 ? 50 + 0.2 * galerkin : 0) +
           (double)(modes * r->shape_points) * 4;
}

static double cost_us(const void *data)
{
    const request *r = data;
    if (r->method == METHOD_RAYLEIGH)
        return 10;
    double work = r->compare ? 120 : 60;
    for (int plane = 0; plane < 2; plane++)
        if (asks(r, (strum_plane)plane))
            work += plane_cost_us(r, (strum_plane)plane);
    return work;
}

/* Of the mode shapes: modes times points. */
static double answer_bytes(const void *data, const char **pointer)
{
    static const size_t in_plane =
        sizeof "{\"chi\":,\"xi\":,\"tangential\":,\"normal\":,\"tension\":},";
    static const size_t out_of_plane = sizeof "{\"chi\":,\"xi\":,\"out_of_plane\":},";
    const request *r = data;
    const double shared =
        2 + (r->in.a_m > 0 ? 3 : 0); /* numbers; x_m and y_m with their keys */
    const double values = cable_damped(&r->in) ? 3 : 1; /* {"re":, "im":} */
    double point = 0;
    *pointer = "/shape_points";
    if (asks(r, STRUM_IN_PLANE))
        point += (double)in_plane + (shared + 3 * values) * ANSWER_NUMBER_BYTES;
    if (asks(r, STRUM_OUT_OF_PLANE))
        point += (double)out_of_plane + (shared + values) * ANSWER_NUMBER_BYTES;
    return (double)r->modes * (double)r->shape_points * point;
}

/* Real where the cable is undamped, {"re", "im"} where it is damped. */
static void put_value(json_writer *json, const char *key, double _Complex value, bool damped)
{
    if (damped)
        json_put_complex(json, key, value);
    else
        json_put_number(json, key, creal(value));
}

static void write_shape(json_writer *json, const cable_input *in, strum_plane plane,
                        const strum_shape_point *shape, int points)
{
    const bool damped = cable_damped(in);
    json_key(json, "shape");
    json_open_array(json);
    for (int i = 0; i < points; i++) {
        const strum_shape_point *at = &shape[i];
        json_open_object(json);
        json_put_number(json, "chi", at->chi);
        json_put_number(json, "xi", strum_xi_of_chi(at->chi));
        if (in->a_m > 0) {
            double x, y;
            strum_catenary_point(&in->catenary, at->chi, &x, &y);
            json_put_number(json, "x_m", x * in->a_m);
            json_put_number(json, "y_m", y * in->a_m);
        }
        if (plane == STRUM_OUT_OF_PLANE) {
            put_value(json, "out_of_plane", at->normal, damped);
        } else {
            put_value(json, "tangential", at->tangential, damped);
            put_value(json, "normal", at->normal, damped);
            put_value(json, "tension", at->tension, damped);
        }
        json_close_object(json);
    }
    json_close_array(json);
}

static bool write_modes(json_writer *json, const request *r, strum_plane plane,
                        const plane_modes *found, answer *a)
{
    problem *p = a->problem;
    const int points = (int)r->shape_points;
    strum_shape_point *shape = points > 0 ? calloc((size_t)points, sizeof *shape) : NULL;
    if (points > 0 && shape == NULL) {
        problem_out_of_memory(p);
        return false;
    }
    strum_status status = STRUM_OK;
    json_key(json, plane_keys[plane]);
    json_open_array(json);
    for (int k = 0; k < found->count && status == STRUM_OK; k++) {
        const strum_mode *mode = &found->modes[k];
        json_open_object(json);
        json_put_integer(json, "mode", k + 1);
        cable_write_rates(json, &r->in, CMPLX(-mode->decay, mode->frequency));
        json_put_string(json, "symmetry", symmetry_names[mode->symmetry]);
        if (points > 0) {
            status = strum_modes_shape(found->spectrum, (size_t)k, NULL, (size_t)points, shape);
            if (status == STRUM_OK)
                write_shape(json, &r->in, plane, shape, points);
        }
        json_close_object(json);
        if (answer_cancelled(a))
            status = STRUM_ERR_CANCELLED;
    }
    json_close_array(json);
    free(shape);
    if (status != STRUM_OK)
        cable_refuse(&(strum_error){0}, status, p);
    return status == STRUM_OK;
}

static void write_overdamped(json_writer *json, const request *r, const plane_modes found[2])
{
    if (!cable_damped(&r->in))
        return;
    json_key(json, "overdamped");
    json_open_object(json);
    for (int plane = 0; plane < 2; plane++) {
        if (found[plane].count == 0)
            continue;
        const double *decays;
        const int count = (int)strum_modes_overdamped(found[plane].spectrum, &decays);
        json_key(json, plane_keys[plane]);
        json_open_array(json);
        for (int i = 0; i < count; i++) {
            json_open_object(json);
            cable_write_rates(json, &r->in, -decays[i]);
            json_close_object(json);
        }
        json_close_array(json);
    }
    json_close_object(json);
}

static void write_series(json_writer *json, const plane_modes found[2])
{
    json_key(json, "series");
    json_open_object(json);
    for (int plane = 0; plane < 2; plane++) {
        if (found[plane].count == 0)
            continue;
        const strum_series_report *report = &found[plane].series;
        json_key(json, plane_keys[plane]);
        json_open_object(json);
        json_put_integer(json, "terms", report->terms);
        if (report->matching_xi > 0)
            json_put_number(json, "matching_xi", report->matching_xi);
        json_put_integer(json, "mantissa_bits", report->mantissa_bits);
        json_put_integer(json, "evaluations", report->evaluations);
        json_put_number(json, "estimated_error", report->error);
        json_close_object(json);
    }
    json_close_object(json);
}

static bool answer_rayleigh(const request *r, answer *a)
{
    json_writer *json = a->result;
    strum_error fault = {0};
    double estimate;
    strum_status status = strum_rayleigh_out_of_plane(&r->in.catenary, &estimate, &fault);
    strum_modes *exact = NULL;
    strum_mode first = {0};
    const strum_options options = answer_options(a);
    if (status == STRUM_OK && r->verify)
        status =
            strum_modes_solve(&(strum_modes_params){r->in.cable, STRUM_OUT_OF_PLANE, 1, false},
                              &options, &exact, &fault);
    if (status == STRUM_OK && exact != NULL)
        status = strum_modes_get(exact, 0, &first);
    if (status != STRUM_OK) {
        cable_refuse(&fault, status, a->problem);
        return false;
    }
    a->theory = "rigid-body estimate about the chord (Gale 1976, appendix B-5)";
    if (r->modes > 1)
        answer_warn(a, "rayleigh estimates out-of-plane mode 1 only");
    cable_warn(&r->in, a);
    estimate /= sqrt(r->in.cable.mass_n);
    json_open_object(json);
    cable_write_geometry(json, &r->in);
    json_key(json, plane_keys[STRUM_OUT_OF_PLANE]);
    json_open_array(json);
    json_open_object(json);
    json_put_integer(json, "mode", 1);
    cable_write_rates(json, &r->in, CMPLX(0, estimate));
    json_put_string(json, "symmetry", r->in.cable.chi_m == 0 ? "symmetric" : "none");
    json_close_object(json);
    json_close_array(json);
    if (exact != NULL) {
        const double difference = fabs(estimate / first.frequency - 1);
        put_verification(
            json, &(strum_verification){.method = "displacement Galerkin (exact to 1e-12)",
                                        .max_relative_difference = difference,
                                        .modes_expected = 1,
                                        .modes_found = 1,
                                        .max_residual = difference});
        strum_modes_free(exact);
    }
    json_close_object(json);
    return true;
}

static strum_status solve_plane(const request *r, strum_plane plane,
                                const strum_options *options, plane_modes *found,
                                strum_error *fault)
{
    const int count = (int)r->modes;
    strum_status status;
    if (r->method == METHOD_SERIES) {
        status = strum_series_solve(&(strum_series_params){r->in.cable, plane, count, true},
                                    options, found->modes, &found->series, fault);
    } else {
        status = strum_modes_solve(
            &(strum_modes_params){r->in.cable, plane, count, r->shape_points > 0 || r->verify},
            options, &found->spectrum, fault);
        for (int i = 0; i < count && status == STRUM_OK; i++)
            status = strum_modes_get(found->spectrum, (size_t)i, &found->modes[i]);
    }
    found->count = status == STRUM_OK ? count : 0;
    return status;
}

static const char *theory(const request *r)
{
    if (r->method == METHOD_SERIES)
        return "linear dynamics about the inextensible catenary, power series about xi = 0 and "
               "xi = 2 (Gale 1976, 2.42-2.74, 2.44-2.110)";
    return r->in.elastic_profile
               ? "linear dynamics about the exact elastic catenary, Galerkin's method"
               : "linear dynamics about the inextensible catenary (Gale 1976, 2.29-2.44), "
                 "Galerkin's method";
}

static bool answer_modes(const void *data, answer *a)
{
    const request *r = data;
    if (r->method == METHOD_RAYLEIGH)
        return answer_rayleigh(r, a);
    plane_modes found[2] = {0};
    const strum_options options = answer_options(a);
    strum_error fault = {0};
    strum_status status = STRUM_OK;
    for (int plane = 0; plane < 2 && status == STRUM_OK; plane++)
        if (asks(r, (strum_plane)plane))
            status = solve_plane(r, (strum_plane)plane, &options, &found[plane], &fault);
    bool good = status == STRUM_OK;
    if (!good) {
        cable_refuse(&fault, status, a->problem);
        /* out of range is what damping leaves of the modes; the rest grows with their number */
        const char *pointer = r->method == METHOD_SERIES                 ? "/method"
                              : status != STRUM_ERR_RANGE                ? "/modes"
                              : r->in.eta_normal >= r->in.eta_tangential ? "/eta_normal"
                                                                         : "/eta_tangential";
        if (status == STRUM_ERR_RANGE || status == STRUM_ERR_ACCURACY)
            problem_add(a->problem, pointer, "%s", fault.reason);
    }
    a->theory = theory(r);
    cable_warn(&r->in, a);
    warn_suspended(&r->in, a);
    if (asks(r, STRUM_IN_PLANE)) {
        warn_without_stretch(&r->in, a);
        warn_added_mass(r->in.added_mass_kg_per_m, r->in.mass_kg_per_m, turn_of(&r->in), a);
    }
    json_writer *json = a->result;
    json_open_object(json);
    cable_write_geometry(json, &r->in);
    for (int plane = 0; plane < 2 && good; plane++)
        if (found[plane].count > 0)
            good = write_modes(json, r, (strum_plane)plane, &found[plane], a);
    if (good)
        write_overdamped(json, r, found);
    if (good && r->shape_points > 0)
        json_put_string(
            json, "normalisation",
            "the largest value along the cable of the dominant displacement component is 1 "
            "(the first such point where tied)");
    if (good && r->method == METHOD_SERIES)
        write_series(json, found);
    if (good && r->compare) {
        write_comparison(json, &r->in, found);
        if (asks(r, STRUM_IN_PLANE))
            warn_of_crossover(strum_catenary_sag(&r->in.catenary) / r->in.catenary.span, a);
    }
    if (good && r->verify)
        good = write_verification(json, &r->in, found, a);
    json_close_object(json);
    strum_modes_free(found[0].spectrum);
    strum_modes_free(found[1].spectrum);
    return good;
}

const endpoint catenary_frequencies = {
    .path = "/v1/catenary/frequencies",
    .title =
        "Natural frequencies and mode shapes of a suspended cable, in plane and out of plane",
    .request = &request_schema,
    .query = true,
    .prepare = prepare,
    .answer_bytes = answer_bytes,
    .cost_us = cost_us,
    .answer = answer_modes,
};
