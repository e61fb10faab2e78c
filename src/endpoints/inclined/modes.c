/* SPDX-License-Identifier: GPL-3.0-or-later */
/* /v1/inclined/modes: modes and dynamic tension of a taut elastic inclined cable (Grinfogel
 * 1984). */
#include <math.h>
#include <stdlib.h>

#include <strum/inclined.h>

#include "endpoints/common/suspended_cable.h"

static const char *const statics_choices[] = {"inextensible", "elastic", NULL};
enum { FULL, AIRY, ASYMPTOTIC, IRVINE, MODELS };
static const char *const models[] = {"full", "airy", "asymptotic", "irvine", NULL};
static const char *const expansions[] = {"midspan", "tangent", NULL};

#define SHAPE_POINTS_MAX 1000
#define GRAVITY          9.80665
/* Beyond it an expansion in epsilon errs by more than about a hundredth: 0.15 epsilon^2. */
#define EPSILON_REACH 0.3
/* A cable that its own tension stretches by more: the elastic statics shift frequencies by half
 * of it. */
#define STRETCH_REACH 0.01

typedef struct request {
    field_set given;
    double epsilon, mass_ratio, inclination_deg, lambda_squared;
    double length_m, mass_kg_per_m, added_mass_kg_per_m, weight_N_per_m;
    double tension_N, horizontal_tension_N, axial_stiffness_N;
    bool inextensible, compare, verify;
    int statics, model, airy_expansion;
    int64_t modes, shape_points;

    /* from here on: computed by prepare */
    strum_inclined cable;
    double tension;   /* T_a in N; 0 for a dimensionless request */
    double rad_per_s; /* of kL = 1; 0 for a dimensionless request */
} request;

static const field fields[] = {
    {FIELD_AT(FIELD_NUMBER, request, epsilon), .unit = "1", .min = STRUM_EPSILON_MIN,
     .max = STRUM_EPSILON_MAX,
     .help = "W0 L/T_a: weight over the tension where the cable is parallel to its chord"},
    {FIELD_AT(FIELD_NUMBER, request, mass_ratio), .unit = "1", .min = STRUM_MASS_RATIO_MIN,
     .max = 1, .flags = FIELD_DEFAULT, .fallback = 1,
     .help = "h = m/M: mass without over mass with added mass"},
    {FIELD_AT(FIELD_NUMBER, request, length_m), .unit = "m", .min = 0, .max = 1e7,
     .flags = FIELD_OPEN_MIN, .help = "length along the cable, unstretched"},
    {FIELD_AT(FIELD_NUMBER, request, tension_N), .unit = "N", .min = 0, .max = 1e12,
     .flags = FIELD_OPEN_MIN,
     .help = "T_a: static tension where the cable is parallel to its chord"},
    {FIELD_AT(FIELD_NUMBER, request, horizontal_tension_N), .unit = "N", .min = 0, .max = 1e12,
     .flags = FIELD_OPEN_MIN, .help = "horizontal component of the static tension"},
    {FIELD_AT(FIELD_NUMBER, request, mass_kg_per_m), .unit = "kg/m", .min = 0, .max = 1e6,
     .flags = FIELD_OPEN_MIN, .help = "mass per length, without added mass"},
    {FIELD_AT(FIELD_NUMBER, request, weight_N_per_m), .unit = "N/m", .min = 0, .max = 1e8,
     .flags = FIELD_OPEN_MIN,
     .help = "weight per length; default mass times 9.80665, less in water"},
    {FIELD_AT(FIELD_NUMBER, request, added_mass_kg_per_m), .unit = "kg/m", .min = 0, .max = 1e6,
     .flags = FIELD_DEFAULT, .help = "mass of fluid that moves with the cable, normal to it"},
    {FIELD_AT(FIELD_NUMBER, request, inclination_deg), .unit = "deg", .min = 0,
     .max = STRUM_INCLINATION_MAX_DEG, .flags = FIELD_REQUIRED,
     .help = "phi_a: angle of the chord to the horizontal; 0 is a level cable"},
    {FIELD_AT(FIELD_NUMBER, request, lambda_squared), .unit = "1",
     .min = STRUM_LAMBDA_SQUARED_MIN, .max = STRUM_LAMBDA_SQUARED_MAX,
     .help = "EA epsilon^2 cos^2(phi_a)/T_a: stiffness against that of the sag"},
    {FIELD_AT(FIELD_NUMBER, request, axial_stiffness_N), .unit = "N", .min = 0, .max = 1e15,
     .flags = FIELD_OPEN_MIN, .help = "EA of the cable; with a cable in metres"},
    {FIELD_AT(FIELD_FLAG, request, inextensible),
     .help = "true: infinitely stiff, instead of lambda_squared or axial_stiffness_N"},
    {FIELD_AT(FIELD_CHOICE, request, statics), .choices = statics_choices,
     .flags = FIELD_DEFAULT,
     .help = "equilibrium: inextensible, as the report, or the exact elastic catenary"},
    {FIELD_AT(FIELD_INTEGER, request, modes), .min = 1, .max = STRUM_MODES_MAX,
     .flags = FIELD_DEFAULT, .fallback = 6, .help = "modes from the lowest frequency"},
    {FIELD_AT(FIELD_CHOICE, request, model), .choices = models, .flags = FIELD_DEFAULT,
     .help = "full: equations (1)-(5) to 1e-12; airy: the 4 x 4 determinant of chapter 2; "
             "asymptotic: equation (21); irvine: equation (11)"},
    {FIELD_AT(FIELD_CHOICE, request, airy_expansion), .choices = expansions,
     .flags = FIELD_DEFAULT,
     .help = "of the Airy functions' argument: about midspan, (17)-(18), or tangent where the "
             "cable is parallel to its chord, as in the report's tables"},
    {FIELD_AT(FIELD_INTEGER, request, shape_points), .min = 0, .max = SHAPE_POINTS_MAX,
     .flags = FIELD_DEFAULT,
     .help = "points of each mode shape, equally spaced along the cable, ends included; 0: "
             "none, else at least 2"},
    {FIELD_AT(FIELD_FLAG, request, compare), .flags = FIELD_DEFAULT,
     .help = "put all four models side by side, with differences from full"},
    {FIELD_AT(FIELD_FLAG, request, verify), .flags = FIELD_DEFAULT,
     .help = "check the answer by a second, independent method"},
    {.kind = FIELD_END}};

static const char *const cable_groups[] = {
    "epsilon [mass_ratio]",
    "length_m mass_kg_per_m tension_N [weight_N_per_m] [added_mass_kg_per_m]",
    "length_m mass_kg_per_m horizontal_tension_N [weight_N_per_m] [added_mass_kg_per_m]", NULL};
static const char *const stiffness_groups[] = {
    "lambda_squared [inextensible]", "axial_stiffness_N [inextensible]", "inextensible", NULL};
static const field_groups groups[] = {
    {"cable", false, cable_groups}, {"stiffness", false, stiffness_groups}, {0}};

static const schema request_schema = {.name = "inclined_modes_request",
                                      .fields = fields,
                                      .groups = groups,
                                      .size = sizeof(request)};

/* ---- the cable ---- */

static void complete_metres(request *r)
{
    if (!field_given(&request_schema, r, "weight_N_per_m")) {
        r->weight_N_per_m = r->mass_kg_per_m * GRAVITY;
        field_give(&request_schema, r, "weight_N_per_m");
    }
    r->tension = field_given(&request_schema, r, "tension_N")
                     ? r->tension_N
                     : r->horizontal_tension_N / cos(r->cable.inclination);
    const double mass = r->mass_kg_per_m + r->added_mass_kg_per_m;
    r->cable.epsilon = r->weight_N_per_m * r->length_m / r->tension;
    r->cable.mass_ratio = r->mass_kg_per_m / mass;
    r->rad_per_s = sqrt(r->tension / mass) / r->length_m;
}

static void find_stiffness(request *r, bool metres, problem *p)
{
    const bool stiffness = field_given(&request_schema, r, "axial_stiffness_N");
    const bool lambda = field_given(&request_schema, r, "lambda_squared");
    if (r->inextensible && (stiffness || lambda))
        problem_add(p, "/inextensible", "cannot be true beside %s",
                    lambda ? "lambda_squared" : "axial_stiffness_N");
    if (!r->inextensible && !stiffness && !lambda)
        problem_add(p, "/inextensible",
                    "is false: give lambda_squared or axial_stiffness_N instead");
    if (stiffness && !metres)
        problem_add(p, "/axial_stiffness_N",
                    "needs a cable in metres; give lambda_squared beside epsilon");
    r->cable.lambda_squared = r->inextensible ? INFINITY
                              : lambda
                                  ? r->lambda_squared
                                  : r->axial_stiffness_N / r->tension *
                                        pow(r->cable.epsilon * cos(r->cable.inclination), 2);
}

/* The field to lay a fault of the cable at: what a group of metres makes of it is checked in
 * this order, and epsilon first of all. */
static const char *culprit(const request *r)
{
    const strum_inclined *c = &r->cable;
    const double lambda = c->lambda_squared;
    if (r->tension == 0)
        return "/epsilon";
    if (c->epsilon >= STRUM_EPSILON_MIN && c->epsilon <= STRUM_EPSILON_MAX) {
        if (!(lambda >= STRUM_LAMBDA_SQUARED_MIN) ||
            (lambda > STRUM_LAMBDA_SQUARED_MAX && isfinite(lambda)))
            return "/axial_stiffness_N";
        if (c->mass_ratio < STRUM_MASS_RATIO_MIN)
            return "/added_mass_kg_per_m";
    }
    return field_given(&request_schema, r, "tension_N") ? "/tension_N"
                                                        : "/horizontal_tension_N";
}

static void prepare(void *data, schema_arena *arena, problem *p)
{
    (void)arena;
    request *r = data;
    if (r->shape_points == 1)
        problem_add(p, "/shape_points",
                    "must be 0 or at least 2, so that both ends are among them");
    const bool metres = field_given(&request_schema, r, "length_m");
    r->cable = (strum_inclined){.epsilon = r->epsilon,
                                .inclination = r->inclination_deg * M_PI / 180,
                                .mass_ratio = r->mass_ratio,
                                .elastic_statics = r->statics == 1};
    if (metres)
        complete_metres(r);
    find_stiffness(r, metres, p);
    if (p->status != 0)
        return;
    strum_inclined_statics statics;
    strum_error fault = {0};
    const strum_status status = strum_inclined_statics_find(&r->cable, &statics, &fault);
    if (status != STRUM_OK) {
        cable_refuse(&fault, status, p);
        problem_add(p, culprit(r), "%s", fault.reason);
    } else if ((r->model == AIRY || r->model == ASYMPTOTIC) &&
               r->cable.epsilon > STRUM_EXPANSION_EPSILON_MAX) {
        problem_set(p, 422, "model %s does not reach this cable", models[r->model]);
        problem_add(p, "/model",
                    "%s expands in powers of epsilon, here %.3g: above %g model full answers",
                    models[r->model], r->cable.epsilon, STRUM_EXPANSION_EPSILON_MAX);
    }
}

static strum_inclined_model model_of(const request *r, int model)
{
    switch (model) {
    case FULL:
        return STRUM_INCLINED_FULL;
    case AIRY:
        return r->airy_expansion == 0 ? STRUM_INCLINED_AIRY : STRUM_INCLINED_AIRY_TANGENT;
    case ASYMPTOTIC:
        return STRUM_INCLINED_ASYMPTOTIC;
    default:
        return STRUM_INCLINED_IRVINE;
    }
}

static double cost_us(const void *data)
{
    const request *r = data;
    double work = 0.2 * (double)r->shape_points * (double)r->modes;
    for (int model = 0; model < MODELS; model++)
        if (r->compare || model == r->model)
            work += strum_inclined_work(&r->cable, model_of(r, model), (int)r->modes) *
                    (r->verify && model == r->model ? 3 : 1);
    return work;
}

/* ---- the answer ---- */

static void write_statics(json_writer *json, const request *r, const strum_inclined_statics *s)
{
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
    json_close_object(json);
}

static void write_crossover(json_writer *json, const request *r)
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

static void write_frequency(json_writer *json, const request *r, double kl)
{
    json_put_number(json, "kl_over_pi", kl / M_PI);
    if (r->rad_per_s > 0) {
        const double angular = kl * r->rad_per_s;
        json_put_number(json, "angular_frequency_rad_per_s", angular);
        json_put_number(json, "frequency_Hz", angular / (2 * M_PI));
        json_put_number(json, "period_s", 2 * M_PI / angular);
    }
}

static void write_mode(json_writer *json, const request *r, const strum_inclined_mode *mode)
{
    static const char *const families[] = {"transverse", "longitudinal", "hybrid"};
    static const char *const symmetries[] = {"none", "symmetric", "antisymmetric"};
    const double slope = r->cable.epsilon * cos(r->cable.inclination);
    write_frequency(json, r, mode->kl);
    json_put_string(json, "family", families[mode->family]);
    json_put_number(json, "longitudinal_energy", mode->longitudinal_energy);
    json_put_string(json, "symmetry", symmetries[mode->symmetry]);
    json_put_number(json, "symmetric_share", fmin(fmax(mode->symmetric_share, 0), 1));
    json_put_flag(json, "hybrid_region", mode->hybrid_region);
    json_put_number(json, "tension_amplification", mode->tension_amplification);
    if (r->tension > 0)
        json_put_number(json, "tension_per_displacement_N_per_m",
                        mode->tension_amplification * r->tension / (slope * r->length_m));
}

static void write_shape(json_writer *json, const request *r, const strum_inclined_point *shape)
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

static strum_status write_modes(json_writer *json, const request *r,
                                const strum_inclined_modes *modes)
{
    const int points = (int)r->shape_points;
    strum_inclined_point *shape = points > 0 ? calloc((size_t)points, sizeof *shape) : NULL;
    strum_status status = points > 0 && shape == NULL ? STRUM_ERR_MEMORY : STRUM_OK;
    json_key(json, "modes");
    json_open_array(json);
    for (int k = 0; k < strum_inclined_count(modes) && status == STRUM_OK; k++) {
        json_open_object(json);
        json_put_integer(json, "mode", k + 1);
        write_mode(json, r, strum_inclined_mode_at(modes, k));
        if (points > 0)
            status = strum_inclined_shape(modes, k, points, shape);
        if (points > 0 && status == STRUM_OK)
            write_shape(json, r, shape);
        json_close_object(json);
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
static void write_beside(json_writer *json, const request *r, int model,
                         const strum_inclined_mode *mode, const strum_inclined_mode *full)
{
    json_key(json, models[model]);
    json_open_object(json);
    write_frequency(json, r, mode->kl);
    if (model != FULL)
        json_put_number(json, "difference", mode->kl / full->kl - 1);
    json_put_number(json, "tension_amplification", mode->tension_amplification);
    if (model != FULL && full->tension_amplification > 0)
        json_put_number(json, "tension_difference",
                        mode->tension_amplification / full->tension_amplification - 1);
    json_close_object(json);
}

static void write_comparison(json_writer *json, const request *r,
                             strum_inclined_modes *const *solved)
{
    int transverse = 0;
    json_key(json, "comparison");
    json_open_array(json);
    for (int k = 0; k < (int)r->modes; k++) {
        const strum_inclined_mode *full = strum_inclined_mode_at(solved[FULL], k);
        const bool along = full->longitudinal_energy > 0.5;
        json_open_object(json);
        json_put_integer(json, "mode", k + 1);
        for (int model = 0; model < MODELS; model++) {
            const bool closed = model == ASYMPTOTIC || model == IRVINE;
            if (solved[model] == NULL || (closed && along))
                continue;
            write_beside(json, r, model,
                         strum_inclined_mode_at(solved[model], closed ? transverse : k), full);
        }
        transverse += !along;
        json_close_object(json);
    }
    json_close_array(json);
}

/* ---- warnings ---- */

static void warn_of_input(const request *r, const strum_inclined_statics *s, answer *a)
{
    if (r->tension > 0)
        cable_warn_weight(r->weight_N_per_m, r->mass_kg_per_m, r->added_mass_kg_per_m, GRAVITY,
                          a);
    if (!r->cable.elastic_statics && s->stiffness * STRETCH_REACH < 1)
        answer_warn(a,
                    "the static tension stretches this cable by %.2g %%, which statics "
                    "inextensible leaves out; statics elastic does not",
                    100 / s->stiffness);
}

static void warn_of_model(const request *r, const strum_inclined_modes *modes,
                          const strum_inclined_statics *s, answer *a)
{
    strum_crossover c;
    const double last =
        strum_inclined_mode_at(modes, strum_inclined_count(modes) - 1)->kl / M_PI;
    const double along = sqrt(s->stiffness / r->cable.mass_ratio);
    if (r->model == FULL)
        return;
    if (r->cable.epsilon > EPSILON_REACH)
        answer_warn(
            a,
            "epsilon %.3g is beyond the reach of model %s: its frequencies err by about "
            "0.03 to 0.15 epsilon squared, here up to %.2g %%",
            r->cable.epsilon, models[r->model], 15 * pow(r->cable.epsilon, 2));
    if (r->model != AIRY && along < last)
        answer_warn(
            a,
            "longitudinal modes begin near kl_over_pi %.3g, and model %s has none: from "
            "there on its modes are numbered otherwise than those of the cable",
            along, models[r->model]);
    if (r->model == IRVINE && strum_inclined_crossover(&r->cable, &c) == STRUM_OK && c.inside)
        answer_warn(
            a,
            "this cable is inside the hybrid region of crossover %d, where model irvine "
            "leaves out the coupling of the two modes: an error in kl_over_pi of up to "
            "about %.2g",
            c.number, c.gap / 2 / M_PI);
}

/* ---- */

static strum_status solve(const request *r, strum_inclined_modes **solved, strum_error *fault,
                          answer *a)
{
    for (int model = 0; model < MODELS; model++) {
        if (!r->compare && model != r->model)
            continue;
        const strum_status status = strum_inclined_solve(&r->cable, model_of(r, model),
                                                         (int)r->modes, &solved[model], fault);
        if (status == STRUM_ERR_METHOD && model != r->model)
            answer_warn(a, "model %s is not compared: %s", models[model], fault->reason);
        else if (status != STRUM_OK)
            return status;
    }
    return STRUM_OK;
}

static strum_status write_verification(json_writer *json, const strum_inclined_modes *modes,
                                       strum_error *fault)
{
    strum_verification v;
    const strum_status status = strum_inclined_verify(modes, &v, fault);
    if (status != STRUM_OK)
        return status;
    json_key(json, "verification");
    json_open_object(json);
    json_put_string(json, "method", v.method);
    json_put_number(json, "max_relative_difference", v.max_relative_difference);
    json_put_integer(json, "modes_expected", v.modes_expected);
    json_put_integer(json, "modes_found", v.modes_found);
    json_put_number(json, "max_residual", v.max_residual);
    json_close_object(json);
    return STRUM_OK;
}

static const char *theory_of(const request *r)
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

static bool answer_modes(const void *data, answer *a)
{
    const request *r = data;
    json_writer *json = a->result;
    strum_inclined_modes *solved[MODELS] = {NULL};
    strum_inclined_statics statics;
    strum_error fault = {0};
    a->theory = theory_of(r);
    strum_status status = strum_inclined_statics_find(&r->cable, &statics, &fault);
    if (status == STRUM_OK)
        status = solve(r, solved, &fault, a);
    json_open_object(json);
    if (status == STRUM_OK) {
        const strum_inclined_modes *modes = solved[r->model];
        warn_of_input(r, &statics, a);
        warn_of_model(r, modes, &statics, a);
        write_statics(json, r, &statics);
        write_crossover(json, r);
        if (strum_inclined_spurious(modes) > 0)
            json_put_number(json, "spurious_kl_over_pi", strum_inclined_spurious(modes) / M_PI);
        status = write_modes(json, r, modes);
        if (r->compare)
            write_comparison(json, r, solved);
        if (status == STRUM_OK && r->verify)
            status = write_verification(json, modes, &fault);
    }
    json_close_object(json);
    for (int model = 0; model < MODELS; model++)
        strum_inclined_free(&solved[model]);
    if (status != STRUM_OK)
        cable_refuse(&fault, status, a->problem);
    return status == STRUM_OK;
}

const endpoint inclined_modes = {
    .path = "/v1/inclined/modes",
    .title = "In-plane modes and dynamic tension of a taut elastic inclined cable",
    .request = &request_schema,
    .query = true,
    .prepare = prepare,
    .cost_us = cost_us,
    .answer = answer_modes,
};
