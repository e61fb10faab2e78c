/* SPDX-License-Identifier: GPL-3.0-or-later */
/* /v1/inclined/modes, the request: its fields, what follows from them, and what it costs. */
#include "endpoints/inclined/request.h"

#include <float.h>
#include <math.h>

#include "endpoints/common/suspended_cable.h"

static const char *const planes[] = {"in_plane", "out_of_plane", "both", NULL};
static const char *const statics_choices[] = {"inextensible", "elastic", NULL};
const char *const inclined_models[] = {"full", "airy", "asymptotic", "irvine", NULL};
static const char *const expansions[] = {"midspan", "tangent", NULL};

#define SHAPE_POINTS_MAX 1000
static const field fields[] = {
    {FIELD_AT(FIELD_NUMBER, inclined_request, epsilon), .unit = "1", .min = STRUM_EPSILON_MIN,
     .max = STRUM_EPSILON_MAX,
     .help = "W0 L/T_a: weight over the tension where the cable is parallel to its chord"},
    {FIELD_AT(FIELD_NUMBER, inclined_request, mass_ratio), .unit = "1",
     .min = STRUM_MASS_RATIO_MIN, .max = 1, .flags = FIELD_DEFAULT, .fallback = 1,
     .help = "h = m/M: mass without over mass with added mass"},
    {FIELD_AT(FIELD_NUMBER, inclined_request, length_m), .unit = "m", .min = 0, .max = 1e7,
     .flags = FIELD_OPEN_MIN, .help = "length along the cable, unstretched"},
    {FIELD_AT(FIELD_NUMBER, inclined_request, tension_N), .unit = "N", .min = 0, .max = 1e12,
     .flags = FIELD_OPEN_MIN,
     .help = "T_a: static tension where the cable is parallel to its chord"},
    {FIELD_AT(FIELD_NUMBER, inclined_request, horizontal_tension_N), .unit = "N", .min = 0,
     .max = 1e12, .flags = FIELD_OPEN_MIN,
     .help = "horizontal component of the static tension"},
    {FIELD_AT(FIELD_NUMBER, inclined_request, mass_kg_per_m), .unit = "kg/m", .min = 0,
     .max = 1e6, .flags = FIELD_OPEN_MIN, .help = "mass per length, without added mass"},
    {FIELD_AT(FIELD_NUMBER, inclined_request, weight_N_per_m), .unit = "N/m", .min = 0,
     .max = 1e8, .flags = FIELD_OPEN_MIN,
     .help = "weight per length; default mass times 9.80665, less in water"},
    {FIELD_AT(FIELD_NUMBER, inclined_request, added_mass_kg_per_m), .unit = "kg/m", .min = 0,
     .max = 1e6, .flags = FIELD_DEFAULT,
     .help = "mass of fluid that moves with the cable, normal to it"},
    {FIELD_AT(FIELD_NUMBER, inclined_request, inclination_deg), .unit = "deg", .min = 0,
     .max = STRUM_INCLINATION_MAX_DEG,
     .help = "phi_a: angle of the chord to the horizontal; 0 is a level cable"},
    {FIELD_AT(FIELD_NUMBER, inclined_request, lambda_squared), .unit = "1",
     .min = STRUM_LAMBDA_SQUARED_MIN, .max = STRUM_LAMBDA_SQUARED_MAX,
     .help = "EA epsilon^2 cos^2(phi_a)/T_a: stiffness against that of the sag"},
    {FIELD_AT(FIELD_NUMBER, inclined_request, axial_stiffness_N), .unit = "N", .min = 0,
     .max = 1e15, .flags = FIELD_OPEN_MIN, .help = "EA of the cable; with a cable in metres"},
    {FIELD_AT(FIELD_FLAG, inclined_request, inextensible),
     .help = "true: infinitely stiff, instead of lambda_squared or axial_stiffness_N"},
    {FIELD_AT(FIELD_CHOICE, inclined_request, statics), .choices = statics_choices,
     .flags = FIELD_DEFAULT,
     .help = "equilibrium: inextensible, as the report, or the exact elastic catenary"},
    {FIELD_AT(FIELD_INTEGER, inclined_request, modes), .min = 1, .max = STRUM_MODES_MAX,
     .flags = FIELD_DEFAULT, .fallback = 6, .help = "modes from the lowest frequency"},
    {FIELD_AT(FIELD_CHOICE, inclined_request, model), .choices = inclined_models,
     .flags = FIELD_DEFAULT,
     .help = "full: equations (1)-(5) to 1e-12; airy: the 4 x 4 determinant of chapter 2; "
             "asymptotic: equation (21); irvine: equation (11)"},
    {FIELD_AT(FIELD_CHOICE, inclined_request, airy_expansion), .choices = expansions,
     .flags = FIELD_DEFAULT,
     .help = "of the Airy functions' argument: about midspan, (17)-(18), or tangent where the "
             "cable is parallel to its chord, as in the report's tables"},
    {FIELD_AT(FIELD_INTEGER, inclined_request, shape_points), .min = 0, .max = SHAPE_POINTS_MAX,
     .flags = FIELD_DEFAULT,
     .help = "points of each mode shape, equally spaced along the cable, ends included; 0: "
             "none, else at least 2"},
    {FIELD_AT(FIELD_FLAG, inclined_request, compare), .flags = FIELD_DEFAULT,
     .help = "put all four models side by side, with differences from full"},
    {FIELD_AT(FIELD_FLAG, inclined_request, verify), .flags = FIELD_DEFAULT,
     .help = "check the answer by a second, independent method"},
    {FIELD_AT(FIELD_NUMBER, inclined_request, span_m), .unit = "m", .min = 0, .max = 1e6,
     .flags = FIELD_OPEN_MIN,
     .help = "horizontal distance of the supports, in place of inclination_deg"},
    {FIELD_AT(FIELD_NUMBER, inclined_request, rise_m), .unit = "m", .min = 0, .max = 1e6,
     .flags = FIELD_DEFAULT, .help = "height of end 2, the upper one, above end 1"},
    {FIELD_AT(FIELD_NUMBER, inclined_request, stretched_length_m), .unit = "m", .min = 0,
     .max = 1e7, .flags = FIELD_OPEN_MIN,
     .help = "length of the hanging cable, longer than the chord; length_m is without load"},
    {FIELD_AT(FIELD_NUMBER, inclined_request, tension_end_1_N), .unit = "N", .min = 0,
     .max = 1e12, .flags = FIELD_OPEN_MIN,
     .help = "tension at the lower end; two shapes have it, see branch"},
    {FIELD_AT(FIELD_NUMBER, inclined_request, tension_end_2_N), .unit = "N", .min = 0,
     .max = 1e12, .flags = FIELD_OPEN_MIN,
     .help = "tension at the upper end; two shapes have it, see branch"},
    {FIELD_AT(FIELD_NUMBER, inclined_request, tension_parallel_to_chord_N), .unit = "N",
     .min = 0, .max = 1e12, .flags = FIELD_OPEN_MIN,
     .help = "tension_N of a cable that is given by span and rise"},
    {FIELD_AT(FIELD_NUMBER, inclined_request, catenary_parameter_m), .unit = "m", .min = 0,
     .max = 1e9, .flags = FIELD_OPEN_MIN, .help = "horizontal tension over weight per length"},
    {FIELD_AT(FIELD_NUMBER, inclined_request, sag_mid_m), .unit = "m", .min = 0, .max = 1e6,
     .flags = FIELD_OPEN_MIN, .help = "vertical distance of chord and cable at half the span"},
    {FIELD_AT(FIELD_NUMBER, inclined_request, sag_max_m), .unit = "m", .min = 0, .max = 1e6,
     .flags = FIELD_OPEN_MIN, .help = "largest vertical distance of chord and cable"},
    {FIELD_AT(FIELD_NUMBER, inclined_request, depth_below_end_1_m), .unit = "m", .min = 0,
     .max = 1e6, .flags = FIELD_OPEN_MIN,
     .help = "of the lowest point, where it lies between the ends"},
    ROUND_FIELDS(inclined_request, round),
    {FIELD_AT(FIELD_CHOICE, inclined_request, branch), .choices = cable_branches,
     .help =
         "of the two shapes with one tension at an end: taut, the shorter (default), or slack"},
    {FIELD_AT(FIELD_CHOICE, inclined_request, plane), .choices = planes,
     .help = "which motion to solve; in_plane where it is left out"},
    {.kind = FIELD_END}};

/* clang-format off */
#define MASSES "[weight_N_per_m] [added_mass_kg_per_m] [diameter_m] [material_density_kg_per_m3] " \
    "[fluid_density_kg_per_m3] [added_mass_coefficient]"
static const char *const cable_groups[] = {
    "epsilon inclination_deg [mass_ratio]",
    "length_m [mass_kg_per_m] tension_N inclination_deg " MASSES,
    "length_m [mass_kg_per_m] horizontal_tension_N inclination_deg " MASSES,
    "span_m [rise_m] length_m [mass_kg_per_m] " MASSES,
    "span_m [rise_m] stretched_length_m [mass_kg_per_m] " MASSES,
    "span_m [rise_m] horizontal_tension_N [mass_kg_per_m] " MASSES,
    "span_m [rise_m] tension_end_1_N [branch] [mass_kg_per_m] " MASSES,
    "span_m [rise_m] tension_end_2_N [branch] [mass_kg_per_m] " MASSES,
    "span_m [rise_m] tension_parallel_to_chord_N [mass_kg_per_m] " MASSES,
    "span_m [rise_m] catenary_parameter_m [mass_kg_per_m] " MASSES,
    "span_m [rise_m] sag_mid_m [mass_kg_per_m] " MASSES,
    "span_m [rise_m] sag_max_m [mass_kg_per_m] " MASSES,
    "span_m [rise_m] depth_below_end_1_m [mass_kg_per_m] " MASSES,
    NULL};
/* clang-format on */
static const char *const stiffness_groups[] = {
    "lambda_squared [inextensible]", "axial_stiffness_N [inextensible]", "inextensible", NULL};
static const field_groups groups[] = {
    {"cable", false, cable_groups}, {"stiffness", false, stiffness_groups}, {0}};

const schema inclined_schema = {.name = "inclined_modes_request",
                                .fields = fields,
                                .groups = groups,
                                .size = sizeof(inclined_request)};

/* ---- the cable ---- */

static void complete_metres(inclined_request *r, problem *p)
{
    const schema *s = &inclined_schema;
    const round_masses masses = {INCLINED_GRAVITY,
                                 &r->mass_kg_per_m,
                                 &r->weight_N_per_m,
                                 &r->added_mass_kg_per_m,
                                 FIELD_GIVEN(s, r, mass_kg_per_m),
                                 FIELD_GIVEN(s, r, weight_N_per_m)};
    if (round_complete(&r->round, &masses, p) && p->status == 0) {
        FIELD_GIVE(s, r, mass_kg_per_m);
        FIELD_GIVE(s, r, weight_N_per_m);
    }
    if (p->status == 0 && !FIELD_GIVEN(s, r, mass_kg_per_m))
        problem_add(p, "/mass_kg_per_m",
                    "missing: the cable by length_m needs it, or diameter_m with "
                    "material_density_kg_per_m3");
    if (p->status != 0)
        return;
    if (!FIELD_GIVEN(&inclined_schema, r, weight_N_per_m)) {
        r->weight_N_per_m = r->mass_kg_per_m * INCLINED_GRAVITY;
        FIELD_GIVE(&inclined_schema, r, weight_N_per_m);
    }
    if (FIELD_GIVEN(&inclined_schema, r, span_m))
        inclined_span(r, p);
    else
        r->tension = FIELD_GIVEN(&inclined_schema, r, tension_N)
                         ? r->tension_N
                         : r->horizontal_tension_N / cos(r->cable.inclination);
    if (!(r->tension > 0)) /* refused */
        return;
    const double mass = r->mass_kg_per_m + r->added_mass_kg_per_m;
    r->cable.epsilon = r->weight_N_per_m * r->length_m / r->tension;
    r->cable.mass_ratio = r->mass_kg_per_m / mass;
    r->rad_per_s = sqrt(r->tension / mass) / r->length_m;
    if (!isnormal(r->tension / mass)) /* beyond the doubles where its root is not */
        r->rad_per_s = sqrt(r->tension) / sqrt(mass) / r->length_m;
}

/* The answer has frequencies up to some 1e5 times this, and their periods. */
static void check_unit_of_frequency(const inclined_request *r, problem *p)
{
    if (r->rad_per_s > 1e-300 && r->rad_per_s < 1e300)
        return;
    problem_set(p, 422, "frequencies in rad/s would be beyond the range of numbers");
    problem_add(p, "/mass_kg_per_m",
                "sqrt(tension/mass)/length is %.3g rad/s, beyond 1e-300 to 1e300",
                r->rad_per_s);
}

/* Lambda squared of a cable in metres; what overflows is too stiff, not infinitely so. */
static double stiffness_of(const inclined_request *r)
{
    return fmin(r->axial_stiffness_N / r->tension *
                    pow(r->cable.epsilon * cos(r->cable.inclination), 2),
                DBL_MAX);
}

static void find_stiffness(inclined_request *r, bool metres, problem *p)
{
    const bool stiffness = FIELD_GIVEN(&inclined_schema, r, axial_stiffness_N);
    const bool lambda = FIELD_GIVEN(&inclined_schema, r, lambda_squared);
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
                              : lambda        ? r->lambda_squared
                                              : stiffness_of(r);
}

/* The field to lay an error of the cable at: what a group of metres makes of it is the
 * tension's, but for what another field alone decides. */
static const char *field_at_fault(const inclined_request *r, int argument)
{
    if (r->tension == 0)
        return "/epsilon";
    if (argument == STRUM_INCLINED_ARG_LAMBDA_SQUARED)
        return "/axial_stiffness_N";
    if (argument == STRUM_INCLINED_ARG_MASS_RATIO)
        return "/added_mass_kg_per_m";
    if (FIELD_GIVEN(&inclined_schema, r, span_m))
        return inclined_figure_pointer(r);
    return FIELD_GIVEN(&inclined_schema, r, tension_N) ? "/tension_N" : "/horizontal_tension_N";
}

void inclined_prepare(void *data, schema_arena *arena, problem *p)
{
    (void)arena;
    inclined_request *r = data;
    if (r->shape_points == 1)
        problem_add(p, "/shape_points",
                    "must be 0 or at least 2, so that both ends are among them");
    const bool metres =
        FIELD_GIVEN(&inclined_schema, r, length_m) || FIELD_GIVEN(&inclined_schema, r, span_m);
    r->cable = (strum_inclined_cable){.epsilon = r->epsilon,
                                      .inclination = r->inclination_deg * M_PI / 180,
                                      .mass_ratio = r->mass_ratio,
                                      .elastic_statics = r->statics == 1};
    if (metres)
        complete_metres(r, p);
    if (r->compare && r->plane == INCLINED_OUT_OF_PLANE)
        problem_add(p, "/compare", "the models differ in the plane only");
    find_stiffness(r, metres, p);
    if (p->status == 0 && metres)
        check_unit_of_frequency(r, p);
    if (p->status != 0)
        return;
    strum_error error = {0};
    const strum_status status = strum_inclined_statics_find(&r->cable, &r->at_rest, &error);
    if (status != STRUM_OK) {
        cable_refuse(&error, status, p);
        problem_add(p, field_at_fault(r, error.argument), "%s", error.reason);
    } else if ((r->model == AIRY || r->model == ASYMPTOTIC) &&
               r->cable.epsilon > STRUM_EXPANSION_EPSILON_MAX) {
        problem_set(p, 422, "model %s does not reach this cable", inclined_models[r->model]);
        problem_add(p, "/model",
                    "%s expands in powers of epsilon, here %.3g: above %g model full answers",
                    inclined_models[r->model], r->cable.epsilon, STRUM_EXPANSION_EPSILON_MAX);
    }
}

static strum_inclined_model model_of(const inclined_request *r, int model)
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

strum_inclined_params inclined_params(const inclined_request *r, int model)
{
    return (strum_inclined_params){.cable = r->cable,
                                   .model = model_of(r, model),
                                   .count = (size_t)r->modes,
                                   .statics = &r->at_rest};
}

double inclined_answer_bytes(const void *data, const char **pointer)
{
    static const size_t keys =
        sizeof "{\"s\":,\"transverse\":,\"longitudinal\":,\"tension\":},";
    const inclined_request *r = data;
    const double numbers =
        4 + (r->tension > 0 ? 3 : 0); /* s_m, tension_N_per_m with their keys */
    *pointer = "/shape_points";
    return (double)r->modes * (double)r->shape_points *
           ((double)keys + numbers * ANSWER_NUMBER_BYTES) *
           (r->plane == INCLINED_OUT_OF_PLANE ? 0.4 : 1);
}

double inclined_cost_us(const void *data)
{
    const inclined_request *r = data;
    /* measured, tests/bench/costs: what the core's estimates are to be multiplied by */
    static const double share[MODELS] = {
        [FULL] = 1.2, [AIRY] = 2.3, [ASYMPTOTIC] = 0.3, [IRVINE] = 0.3};
    const double level = r->cable.inclination == 0 ? 0.5 : 0;
    double work =
        20 + (r->compare ? 180 : 0) + (double)r->modes * (30 + 2.6 * (double)r->shape_points);
    if (r->plane != INCLINED_IN_PLANE)
        work += inclined_out_of_plane_us(r);
    for (int model = 0; model < MODELS && r->plane != INCLINED_OUT_OF_PLANE; model++)
        if (r->compare || model == r->model) {
            const strum_inclined_params params = inclined_params(r, model);
            const double second = r->verify && model == r->model ? 3 : 0;
            work += strum_inclined_work(&params) * (share[model] + level + second);
        }
    return work;
}
