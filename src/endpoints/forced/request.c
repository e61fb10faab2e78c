/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The request of /v1/forced/tension. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "endpoints/forced/request.h"

#define FREQUENCIES_MAX 10000

typedef struct harmonic {
    field_set given;
    int64_t multiple;
    double tangential, normal, out_of_plane, phase_deg;
} harmonic;

static const field harmonic_fields[] = {
    {FIELD_AT(FIELD_INTEGER, harmonic, multiple), .min = 1, .max = 100, .flags = FIELD_REQUIRED,
     .help = "multiple of the forcing frequency"},
    {FIELD_AT(FIELD_NUMBER, harmonic, tangential), .unit = "1", .min = -1e3, .max = 1e3,
     .flags = FIELD_DEFAULT, .help = "amplitude along the tangent at end 2, in a"},
    {FIELD_AT(FIELD_NUMBER, harmonic, normal), .unit = "1", .min = -1e3, .max = 1e3,
     .flags = FIELD_DEFAULT, .help = "amplitude normal to the cable at end 2, in plane, in a"},
    {FIELD_AT(FIELD_NUMBER, harmonic, out_of_plane), .unit = "1", .min = -1e3, .max = 1e3,
     .flags = FIELD_DEFAULT, .help = "amplitude out of plane, in a"},
    {FIELD_AT(FIELD_NUMBER, harmonic, phase_deg), .unit = "deg", .min = -360, .max = 360,
     .flags = FIELD_DEFAULT,
     .help = "phase: the motion is amplitude cos(multiple omega t + phase)"},
    {.kind = FIELD_END}};
static const schema harmonic_schema = {
    .name = "harmonic", .fields = harmonic_fields, .size = sizeof(harmonic)};

#define AMPLITUDE(member, unit_, help_)                                                        \
    {                                                                                          \
        FIELD_AT(FIELD_NUMBER, forced_request, member), .unit = (unit_), .min = -1e6,          \
                                                        .max = 1e6, .help = (help_)            \
    }
#define RATIO_MAX    1e5
#define PROFILES_MAX 100
#define PROFILES_ROW(name_, unit_member, unit_, most, flags_, help_)                           \
    {                                                                                          \
        FREQUENCY_ROW(FIELD_NUMBERS, forced_request, name_, asked_profiles.unit_member, unit_, \
                      0, most, flags_, help_),                                                 \
            .min_items = 1, .max_items = PROFILES_MAX                                          \
    }

static const field fields[] = {
    CABLE_FIELDS,
    AMPLITUDE(tangential_displacement, "1",
              "amplitude of end 2 along the tangent there, in a; 0.01 when no motion is given"),
    AMPLITUDE(normal_displacement, "1",
              "amplitude of end 2 normal to the cable, in plane, in a"),
    AMPLITUDE(out_of_plane_displacement, "1", "amplitude of end 2 out of plane, in a"),
    AMPLITUDE(tangential_displacement_m, "m", "amplitude of end 2 along the tangent there"),
    AMPLITUDE(normal_displacement_m, "m", "amplitude of end 2 normal to the cable, in plane"),
    AMPLITUDE(out_of_plane_displacement_m, "m", "amplitude of end 2 out of plane"),
    {FIELD_AT(FIELD_OBJECTS, forced_request, harmonics), .schema = &harmonic_schema,
     .min_items = 1, .max_items = FORCED_HARMONICS_MAX,
     .help = "any periodic motion of end 2, as a sum of harmonics"},
    {FIELD_AT(FIELD_NUMBERS, forced_request, frequency_ratios), .unit = "1", .min = 0,
     .max = RATIO_MAX, .min_items = 1, .max_items = FREQUENCIES_MAX,
     .help = "forcing frequencies in sqrt(g/a); 0 is the static answer"},
    {FIELD_AT(FIELD_NUMBER, forced_request, frequency_ratio_min), .unit = "1", .min = 0,
     .max = RATIO_MAX, .help = "first forcing frequency of the curve, in sqrt(g/a)"},
    {FIELD_AT(FIELD_NUMBER, forced_request, frequency_ratio_max), .unit = "1", .min = 0,
     .max = RATIO_MAX, .flags = FIELD_OPEN_MIN, .help = "last forcing frequency of the curve"},
    FREQUENCIES_FIELDS(forced_request, frequencies, FREQUENCIES_MAX),
    FREQUENCY_RANGE_FIELDS(forced_request, range),
    {FIELD_AT(FIELD_INTEGER, forced_request, points), .min = 2, .max = FREQUENCIES_MAX,
     .flags = FIELD_DEFAULT, .fallback = 201,
     .help = "equally spaced frequencies of the curve, ends included"},
    {FIELD_AT(FIELD_NUMBERS, forced_request, profiles_at), .unit = "1", .min = 0,
     .max = RATIO_MAX, .max_items = PROFILES_MAX,
     .help = "forcing frequencies whose motion and tension along the cable are wanted"},
    PROFILES_ROW("profiles_at_Hz", hertz, "Hz", FREQUENCY_MOST / 10, 0, "profiles_at, in Hz"),
    PROFILES_ROW("profiles_at_rad_per_s", rad_per_s, "rad/s", FREQUENCY_MOST, 0,
                 "profiles_at, in rad/s"),
    PROFILES_ROW("profiles_at_s", seconds, "s", PERIOD_MOST, FIELD_OPEN_MIN,
                 "profiles_at, by periods"),
    {FIELD_AT(FIELD_INTEGER, forced_request, profile_points), .min = 2, .max = 2000,
     .flags = FIELD_DEFAULT, .fallback = 33,
     .help = "points of each profile, equally spaced in chi, ends included"},
    {FIELD_AT(FIELD_NUMBERS, forced_request, profile_chi), .unit = "1", .min = -STRUM_CHI_MAX,
     .max = STRUM_CHI_MAX, .min_items = 1, .max_items = 2000,
     .help = "places of the profiles' points instead, between chi_1 and chi_2"},
    {FIELD_AT(FIELD_FLAG, forced_request, verify), .flags = FIELD_DEFAULT,
     .help = "check the answer by a second, independent method"},
    {.kind = FIELD_END}};

static const char *const motion_groups[] = {
    "[tangential_displacement] [normal_displacement] [out_of_plane_displacement]",
    "[tangential_displacement_m] [normal_displacement_m] [out_of_plane_displacement_m] +span_m",
    "harmonics", NULL};
static const char *const frequency_groups[] = {
    "frequency_ratios", "frequency_ratio_min frequency_ratio_max [points]",
    FREQUENCIES_GROUPS(" +span_m"), FREQUENCY_RANGE_GROUPS("[points] +span_m"), NULL};
static const char *const profiles_groups[] = {"profiles_at", "profiles_at_Hz +span_m",
                                              "profiles_at_rad_per_s +span_m",
                                              "profiles_at_s +span_m", NULL};
static const char *const profile_groups[] = {"[profile_points]", "profile_chi", NULL};
static const field_groups groups[] = {{CABLE_GEOMETRY_GROUPS},
                                      {CABLE_ELASTICITY_GROUPS},
                                      {"motion", true, motion_groups},
                                      {"forcing frequency", false, frequency_groups},
                                      {"profile frequencies", true, profiles_groups},
                                      {"profile places", true, profile_groups},
                                      {0}};

const schema forced_request_schema = {.name = "forced_tension_request",
                                      .fields = fields,
                                      .groups = groups,
                                      .size = sizeof(forced_request)};

/* Amplitudes that were left out are 0; with none at all the report's tangential 0.01 moves the
 * end. */
static void complete_motion(forced_request *r)
{
    const schema *s = &forced_request_schema;
    const bool metres = FIELD_GIVEN(s, r, tangential_displacement_m) ||
                        FIELD_GIVEN(s, r, normal_displacement_m) ||
                        FIELD_GIVEN(s, r, out_of_plane_displacement_m);
    if (forced_periodic(r)) {
        const harmonic *h = r->harmonics.items;
        for (size_t i = 0; i < r->harmonics.count; i++, h++) {
            const double _Complex turn = cexp(CMPLX(0, h->phase_deg * M_PI / 180));
            r->motions[i] = (strum_end_motion){h->tangential * turn, h->normal * turn,
                                               h->out_of_plane * turn};
            r->multiples[i] = (int)h->multiple;
        }
        r->motion_count = (int)r->harmonics.count;
        return;
    }
    r->motion_count = r->multiples[0] = 1;
    if (metres) {
        r->motions[0] = (strum_end_motion){r->tangential_displacement_m / r->in.a_m,
                                           r->normal_displacement_m / r->in.a_m,
                                           r->out_of_plane_displacement_m / r->in.a_m};
        return;
    }
    if (!FIELD_GIVEN(s, r, tangential_displacement) &&
        !FIELD_GIVEN(s, r, normal_displacement) &&
        !FIELD_GIVEN(s, r, out_of_plane_displacement))
        r->tangential_displacement = 0.01;
    FIELD_GIVE(s, r, tangential_displacement);
    FIELD_GIVE(s, r, normal_displacement);
    FIELD_GIVE(s, r, out_of_plane_displacement);
    r->motions[0] = (strum_end_motion){r->tangential_displacement, r->normal_displacement,
                                       r->out_of_plane_displacement};
}

double forced_frequency_at(const forced_request *r, int i)
{
    if (r->listed.count > 0)
        return r->listed.items[i];
    const double share = (double)i / (double)(r->points - 1);
    return r->curve_ends[0] * (1 - share) + r->curve_ends[1] * share;
}

int forced_frequency_count(const forced_request *r)
{
    return (int)(r->listed.count > 0 ? (int64_t)r->listed.count : r->points);
}

static const char *profiles_field(const forced_request *r)
{
    return r->asked_profiles.hertz.count > 0       ? "/profiles_at_Hz"
           : r->asked_profiles.rad_per_s.count > 0 ? "/profiles_at_rad_per_s"
           : r->asked_profiles.seconds.count > 0   ? "/profiles_at_s"
                                                   : "/profiles_at";
}

static const char *curve_field(const forced_request *r)
{
    const char *list = frequencies_pointer(&r->frequencies),
               *range = frequency_range_pointer(&r->range);
    return list != NULL                    ? list
           : range != NULL                 ? range
           : r->frequency_ratios.count > 0 ? "/frequency_ratios"
                                           : "/frequency_ratio_max";
}

const char *forced_highest_field(const forced_request *r)
{
    double profiles = 0;
    for (size_t i = 0; i < r->profiles.count; i++)
        profiles = fmax(profiles, r->profiles.items[i]);
    return profiles > r->curve_max ? profiles_field(r) : curve_field(r);
}

/* A list in rad/s as ratios to the cable's unit, within their range. */
static void scale_list(const forced_request *r, numbers_value *list, const char *pointer,
                       problem *p)
{
    for (size_t i = 0; i < list->count; i++) {
        list->items[i] /= r->in.rad_per_s;
        if (list->items[i] <= RATIO_MAX)
            continue;
        problem_add(p, pointer,
                    "%.4g times sqrt(g/a), which is %.4g rad/s here: at most %g times it",
                    list->items[i], r->in.rad_per_s, RATIO_MAX);
        return;
    }
}

/* Frequency ratios of curve and profiles, from whichever unit; the cable is known. */
static void find_frequencies(forced_request *r, schema_arena *arena, problem *p)
{
    r->listed = r->frequency_ratios;
    r->profiles = r->profiles_at;
    r->curve_ends[0] = r->frequency_ratio_min;
    r->curve_ends[1] = r->frequency_ratio_max;
    const bool profiles = frequencies_pointer(&r->asked_profiles) != NULL;
    if (profiles && !frequencies_read(&r->asked_profiles, arena, &r->profiles))
        problem_out_of_memory(p);
    else if (profiles)
        scale_list(r, &r->profiles, profiles_field(r), p);
    if (frequencies_pointer(&r->frequencies) != NULL) {
        if (!frequencies_read(&r->frequencies, arena, &r->listed))
            problem_out_of_memory(p);
        else
            scale_list(r, &r->listed, curve_field(r), p);
    } else if (frequency_range_pointer(&r->range) != NULL) {
        frequency_range_read(&r->range, r->curve_ends);
        numbers_value ends = {r->curve_ends, 2};
        scale_list(r, &ends, curve_field(r), p);
    }
}

/* Ends in their order, whatever their unit. */
static void check_range(const forced_request *r, problem *p)
{
    double ends[2] = {r->frequency_ratio_min, r->frequency_ratio_max};
    const char *range = frequency_range_pointer(&r->range);
    if (r->frequency_ratios.count > 0 || frequencies_pointer(&r->frequencies) != NULL)
        return;
    if (range != NULL)
        frequency_range_read(&r->range, ends);
    if (!(ends[0] < ends[1]))
        problem_add(p, curve_field(r), "must be greater than %s",
                    range == NULL              ? "frequency_ratio_min"
                    : r->range.hertz_max > 0   ? "frequency_min_Hz"
                    : r->range.seconds_max > 0 ? "period_min_s"
                                               : "angular_frequency_min_rad_per_s");
}

void forced_prepare(void *data, schema_arena *arena, problem *p)
{
    forced_request *r = data;
    cable_prepare(&forced_request_schema, &r->in, p);
    check_range(r, p);
    if (p->status == 0)
        find_frequencies(r, arena, p);
    for (size_t i = 0; p->status == 0 && i < r->profile_chi.count; i++)
        if (fabs(r->profile_chi.items[i] - r->in.catenary.chi_m) >
            r->in.catenary.mu * (1 + 1e-12)) {
            char pointer[40];
            (void)snprintf(pointer, sizeof pointer, "/profile_chi/%zu", i);
            problem_add(p, pointer, "lies beyond the ends, chi_1 = %.17g and chi_2 = %.17g",
                        r->in.catenary.chi_m - r->in.catenary.mu,
                        r->in.catenary.chi_m + r->in.catenary.mu);
        }
    if (p->status != 0)
        return;
    complete_motion(r);
    int multiple = 1;
    for (int i = 0; i < r->motion_count; i++) {
        r->in_plane |= r->motions[i].tangential != 0 || r->motions[i].normal != 0;
        r->out_of_plane |= r->motions[i].out_of_plane != 0;
        multiple = r->multiples[i] > multiple ? r->multiples[i] : multiple;
    }
    r->in_plane |= !r->out_of_plane;
    r->curve_min = INFINITY;
    for (int i = 0; i < forced_frequency_count(r); i++) {
        r->curve_min = fmin(r->curve_min, forced_frequency_at(r, i));
        r->curve_max = fmax(r->curve_max, forced_frequency_at(r, i));
    }
    r->highest = r->curve_max;
    for (size_t i = 0; i < r->profiles.count; i++)
        r->highest = fmax(r->highest, r->profiles.items[i]);
    r->highest *= multiple;
}

/* Of curve and profiles: the larger of the two decides. */
double forced_answer_bytes(const void *data, const char **pointer)
{
    static const size_t curve_keys =
        sizeof "{\"frequency_ratio\":,\"max_dynamic_tension\":,\"at_chi\":},";
    static const size_t point_keys =
        sizeof "{\"chi\":,\"xi\":,\"tangential\":,\"normal\":,\"out_of_plane\":,\"tension\":},";
    const forced_request *r = data;
    const bool phases = cable_damped(&r->in) && r->harmonics.count == 0;
    const double each = phases ? 3 : 1; /* a phase with its key */
    const double numbers = 2 + (r->in.a_m > 0 ? 3 : 0) + (r->in_plane ? 3 * each : 0) +
                           (r->out_of_plane ? each : 0);
    const double points =
        r->profile_chi.count > 0 ? (double)r->profile_chi.count : (double)r->profile_points;
    /* as if no natural frequency were among them, where a profile has no points */
    const double profiles = (double)r->profiles.count * points *
                            ((double)point_keys + numbers * ANSWER_NUMBER_BYTES);
    const double curve =
        forced_frequency_count(r) * ((double)curve_keys + 2 * ANSWER_NUMBER_BYTES);
    *pointer = profiles > curve      ? profiles_field(r)
               : r->listed.count > 0 ? curve_field(r)
                                     : "/points";
    return profiles + curve;
}

/* About how many modes of a plane lie below a frequency w in sqrt(g/a): the phase of waves across
 * the cable, and of those along an elastic one, over pi. With c = cosh chi, in units of a,
 *     wave number across = w sqrt(m_n (1 + kappa_n c) c),
 *     wave number along  = w sqrt(m_t kappa_t) c. */
static double modes_below(const strum_cable *cable, strum_plane plane, double w)
{
    enum { STEPS = 16 }; /* of the trapezoidal rule */
    double sum = 0;
    for (int i = 0; i <= STEPS; i++) {
        const double c = cosh(cable->chi_m + cable->mu * (2.0 * i / STEPS - 1));
        const double across = sqrt(cable->mass_n * (1 + cable->kappa_n * c) * c);
        const double along =
            plane == STRUM_IN_PLANE ? sqrt(cable->mass_t * cable->kappa_t) * c : 0;
        sum += (i == 0 || i == STEPS ? 0.5 : 1) * (across + along);
    }
    return w / M_PI * sum * 2 * cable->mu / STEPS;
}

/* Coefficients here and in the other endpoints: measured, tests/bench/costs. */
/* Modes below the highest frequency, in the planes that are asked for. */
static double modes_to_solve(const forced_request *r)
{
    double modes = 0;
    if (r->in_plane)
        modes += modes_below(&r->in.cable, STRUM_IN_PLANE, r->highest);
    if (r->out_of_plane)
        modes += modes_below(&r->in.cable, STRUM_OUT_OF_PLANE, r->highest);
    return modes;
}

/* Measured: 3.5 MB for few modes, 24 MB for those below a frequency ratio of 300. */
double forced_solve_bytes(const void *data)
{
    const forced_request *r = data;
    const double modes = modes_to_solve(r);
    return 4e6 + 200 * modes * modes + 300 * forced_frequency_count(r);
}

double forced_cost_us(const void *data)
{
    const forced_request *r = data;
    const double frequencies = forced_frequency_count(r) + (double)r->profiles.count;
    const double responses = frequencies * r->motion_count;
    const double points = (double)r->profiles.count * r->motion_count *
                          (double)(r->profile_points + (int64_t)r->profile_chi.count);
    const bool direct = cable_damped(&r->in) && r->in.eta_tangential != r->in.eta_normal;
    const double modes = modes_to_solve(r);
    double work = 340 + modes * (330 + modes * (16 + 0.25 * modes)) + 6 * points;
    if (direct) /* a system of equations for each response; the resonances by a pencil */
        work += 700 * responses + 28 * modes * modes * modes;
    else
        work += 10 * responses;
    return work + (r->verify ? 50 * responses + modes * (380 + 31 * modes) : 0);
}
