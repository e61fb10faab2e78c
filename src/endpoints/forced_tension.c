/* SPDX-License-Identifier: GPL-3.0-or-later */
/* /v1/forced/tension: dynamic tension of a suspended cable whose end 2 moves (Gale 1976,
 * chapter 2.5). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <strum/forced.h>

#include "endpoints/cable.h"

#define FREQUENCIES_MAX 10000
#define HARMONICS_MAX   16
/* Frequencies of a curve that `verify` recomputes, besides all profiles. */
#define VERIFIED_MAX 8

typedef struct harmonic {
    field_set given;
    int64_t multiple;
    double tangential, normal, out_of_plane, phase_deg;
} harmonic;

typedef struct request {
    cable_input in;
    double tangential_displacement, normal_displacement, out_of_plane_displacement;
    double tangential_displacement_m, normal_displacement_m, out_of_plane_displacement_m;
    objects_value harmonics;
    numbers_value frequency_ratios, profiles_at, profile_chi;
    double frequency_ratio_min, frequency_ratio_max;
    int64_t points, profile_points;
    bool verify;

    /* computed by prepare */
    strum_end_motion motions[HARMONICS_MAX];
    int multiples[HARMONICS_MAX], motion_count;
    double highest; /* frequency ratio, times the highest multiple */
    bool in_plane, out_of_plane;
} request;

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
        FIELD_AT(FIELD_NUMBER, request, member), .unit = (unit_), .min = -1e6, .max = 1e6,     \
                                                 .help = (help_)                               \
    }
#define RATIO_MAX 1e5

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
    {FIELD_AT(FIELD_OBJECTS, request, harmonics), .schema = &harmonic_schema, .min_items = 1,
     .max_items = HARMONICS_MAX, .help = "any periodic motion of end 2, as a sum of harmonics"},
    {FIELD_AT(FIELD_NUMBERS, request, frequency_ratios), .unit = "1", .min = 0,
     .max = RATIO_MAX, .min_items = 1, .max_items = FREQUENCIES_MAX,
     .help = "forcing frequencies in sqrt(g/a); 0 is the static answer"},
    {FIELD_AT(FIELD_NUMBER, request, frequency_ratio_min), .unit = "1", .min = 0,
     .max = RATIO_MAX, .help = "first forcing frequency of the curve, in sqrt(g/a)"},
    {FIELD_AT(FIELD_NUMBER, request, frequency_ratio_max), .unit = "1", .min = 0,
     .max = RATIO_MAX, .flags = FIELD_OPEN_MIN, .help = "last forcing frequency of the curve"},
    {FIELD_AT(FIELD_INTEGER, request, points), .min = 2, .max = FREQUENCIES_MAX,
     .flags = FIELD_DEFAULT, .fallback = 201,
     .help = "equally spaced frequencies of the curve, ends included"},
    {FIELD_AT(FIELD_NUMBERS, request, profiles_at), .unit = "1", .min = 0, .max = RATIO_MAX,
     .max_items = 100,
     .help = "forcing frequencies whose motion and tension along the cable are wanted"},
    {FIELD_AT(FIELD_INTEGER, request, profile_points), .min = 2, .max = 2000,
     .flags = FIELD_DEFAULT, .fallback = 33,
     .help = "points of each profile, equally spaced in chi, ends included"},
    {FIELD_AT(FIELD_NUMBERS, request, profile_chi), .unit = "1", .min = -STRUM_CHI_MAX,
     .max = STRUM_CHI_MAX, .min_items = 1, .max_items = 2000,
     .help = "places of the profiles' points instead, between chi_1 and chi_2"},
    {FIELD_AT(FIELD_FLAG, request, verify), .flags = FIELD_DEFAULT,
     .help = "check the answer by a second, independent method"},
    {.kind = FIELD_END}};

static const char *const motion_groups[] = {
    "[tangential_displacement] [normal_displacement] [out_of_plane_displacement]",
    "[tangential_displacement_m] [normal_displacement_m] [out_of_plane_displacement_m] +span_m",
    "harmonics", NULL};
static const char *const frequency_groups[] = {
    "frequency_ratios", "frequency_ratio_min frequency_ratio_max [points]", NULL};
static const char *const profile_groups[] = {"[profile_points]", "profile_chi", NULL};
static const field_groups groups[] = {{CABLE_GEOMETRY_GROUPS},
                                      {CABLE_ELASTICITY_GROUPS},
                                      {"motion", true, motion_groups},
                                      {"forcing frequency", false, frequency_groups},
                                      {"profile places", true, profile_groups},
                                      {0}};

static const schema request_schema = {.name = "forced_tension_request",
                                      .fields = fields,
                                      .groups = groups,
                                      .size = sizeof(request)};

static bool given(const request *r, const char *name)
{
    return field_given(&request_schema, r, name);
}

/* Amplitudes that were left out are 0; with none at all the report's tangential 0.01 moves the
 * end. */
static void complete_motion(request *r)
{
    static const char *const names[] = {"tangential_displacement", "normal_displacement",
                                        "out_of_plane_displacement"};
    const bool metres = given(r, "tangential_displacement_m") ||
                        given(r, "normal_displacement_m") ||
                        given(r, "out_of_plane_displacement_m");
    if (given(r, "harmonics")) {
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
    if (!given(r, names[0]) && !given(r, names[1]) && !given(r, names[2]))
        r->tangential_displacement = 0.01;
    for (int i = 0; i < 3; i++)
        field_give(&request_schema, r, names[i]);
    r->motions[0] = (strum_end_motion){r->tangential_displacement, r->normal_displacement,
                                       r->out_of_plane_displacement};
}

static double frequency_at(const request *r, int i)
{
    if (r->frequency_ratios.count > 0)
        return r->frequency_ratios.items[i];
    const double share = (double)i / (double)(r->points - 1);
    return r->frequency_ratio_min * (1 - share) + r->frequency_ratio_max * share;
}

static int frequency_count(const request *r)
{
    return (int)(r->frequency_ratios.count > 0 ? (int64_t)r->frequency_ratios.count
                                               : r->points);
}

static void prepare(void *data, schema_arena *arena, problem *p)
{
    (void)arena;
    request *r = data;
    cable_prepare(&request_schema, &r->in, p);
    if (r->frequency_ratios.count == 0 && !(r->frequency_ratio_min < r->frequency_ratio_max))
        problem_add(p, "/frequency_ratio_max", "must be greater than frequency_ratio_min");
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
    for (int i = 0; i < frequency_count(r); i++)
        r->highest = fmax(r->highest, frequency_at(r, i));
    for (size_t i = 0; i < r->profiles_at.count; i++)
        r->highest = fmax(r->highest, r->profiles_at.items[i]);
    r->highest *= multiple;
}

static double cost_us(const void *data)
{
    const request *r = data;
    const double count = frequency_count(r) + (double)r->profiles_at.count;
    const bool direct = cable_damped(&r->in) && r->in.eta_tangential != r->in.eta_normal;
    return 1000 + count * (direct ? 500 : 30) * r->motion_count;
}

/* ---- answering ---- */

/* What one request is answered from; owns forced and responses. */
typedef struct solving {
    const request *r;
    strum_forced *forced;
    strum_response *responses[HARMONICS_MAX];
    strum_resonance at; /* the resonance that was met */
} solving;

static void solving_free(solving *s)
{
    for (int i = 0; i < HARMONICS_MAX; i++)
        strum_response_free(&s->responses[i]);
    strum_forced_free(&s->forced);
}

/* The field that holds the highest frequency. */
static const char *highest_field(const request *r)
{
    double curve = 0, profiles = 0;
    for (int i = 0; i < frequency_count(r); i++)
        curve = fmax(curve, frequency_at(r, i));
    for (size_t i = 0; i < r->profiles_at.count; i++)
        profiles = fmax(profiles, r->profiles_at.items[i]);
    return profiles > curve                ? "/profiles_at"
           : r->frequency_ratios.count > 0 ? "/frequency_ratios"
                                           : "/frequency_ratio_max";
}

static bool solving_make(solving *s, const request *r, problem *p)
{
    strum_fault fault = {0};
    *s = (solving){.r = r};
    strum_status status = strum_forced_make(&r->in.cable, r->highest / r->in.ratio, r->in_plane,
                                            r->out_of_plane, &s->forced, &fault);
    for (int i = 0; i < r->motion_count && status == STRUM_OK; i++) {
        s->responses[i] = strum_response_make(s->forced);
        status = s->responses[i] != NULL ? STRUM_OK : STRUM_ERR_MEMORY;
    }
    if (status != STRUM_OK) {
        cable_refuse(&fault, status, p);
        if (status == STRUM_ERR_RANGE || status == STRUM_ERR_ACCURACY)
            problem_add(p, highest_field(r), "%s", fault.reason);
    }
    return status == STRUM_OK;
}

/* All harmonics at one forcing frequency. STRUM_ERR_METHOD: a resonance, in s->at. */
static strum_status solve_at(solving *s, double frequency_ratio)
{
    strum_status status = STRUM_OK;
    for (int i = 0; i < s->r->motion_count && status == STRUM_OK; i++)
        status =
            strum_forced_solve(s->forced, frequency_ratio / s->r->in.ratio * s->r->multiples[i],
                               &s->r->motions[i], s->responses[i], &s->at);
    return status;
}

static bool periodic(const request *r)
{
    return given(r, "harmonics");
}

static double degrees(double radians)
{
    const double turned = fmod(radians * 180 / M_PI, 360);
    return turned > 180 ? turned - 360 : turned <= -180 ? turned + 360 : turned;
}

static void write_frequency(json_writer *json, const request *r, double frequency_ratio)
{
    json_put_number(json, "frequency_ratio", frequency_ratio);
    if (r->in.rad_per_s > 0) {
        const double angular = frequency_ratio * r->in.rad_per_s;
        json_put_number(json, "angular_frequency_rad_per_s", angular);
        json_put_number(json, "frequency_Hz", angular / (2 * M_PI));
        if (angular > 0)
            json_put_number(json, "period_s", 2 * M_PI / angular);
    }
}

static void write_unbounded(json_writer *json, const solving *s)
{
    const char *plane = s->at.plane == STRUM_IN_PLANE ? "in_plane" : "out_of_plane";
    json_put_flag(json, "unbounded", true);
    json_put_string(json, "plane", plane);
    json_put_number(json, "natural_frequency_ratio", s->at.frequency * s->r->in.ratio);
    json_put_string(
        json, "statement",
        "the undamped cable is driven at a natural frequency that this motion excites: its "
        "motion grows without limit, and there is no steady amplitude");
}

static strum_status write_peak(json_writer *json, const solving *s, double frequency_ratio)
{
    const request *r = s->r;
    double tension, chi;
    if (periodic(r)) {
        strum_periodic_peak peak;
        const strum_status status =
            strum_periodic_peak_find(s->responses, r->multiples, r->motion_count, &peak);
        if (status != STRUM_OK)
            return status;
        tension = fabs(peak.tension);
        chi = peak.chi;
        json_put_number(json, "max_dynamic_tension", tension);
        json_put_number(json, "at_chi", chi);
        json_put_flag(json, "tensile", peak.tension >= 0);
        json_put_number(json, "at_time_to_period", peak.phase / (2 * M_PI));
        const double angular = frequency_ratio * r->in.rad_per_s;
        if (angular > 0)
            json_put_number(json, "at_time_s", peak.phase / angular);
    } else {
        strum_peak peak;
        strum_response_peak(s->responses[0], &peak);
        tension = peak.tension;
        chi = peak.chi;
        json_put_number(json, "max_dynamic_tension", tension);
        json_put_number(json, "at_chi", chi);
        if (cable_damped(&r->in))
            json_put_number(json, "phase_deg", degrees(peak.phase));
    }
    if (r->in.tension_N > 0)
        json_put_number(json, "max_dynamic_tension_N", tension * r->in.tension_N);
    return STRUM_OK;
}

static strum_status write_curve(json_writer *json, solving *s, const answer *a)
{
    strum_status status = STRUM_OK;
    json_key(json, "curve");
    json_open_array(json);
    for (int i = 0; i < frequency_count(s->r) && status == STRUM_OK; i++) {
        const double frequency = frequency_at(s->r, i);
        json_open_object(json);
        write_frequency(json, s->r, frequency);
        status = solve_at(s, frequency);
        if (status == STRUM_ERR_METHOD) {
            write_unbounded(json, s);
            status = STRUM_OK;
        } else if (status == STRUM_OK) {
            status = write_peak(json, s, frequency);
        }
        json_close_object(json);
        answer_progress(a, i + 1, NAN, "frequencies of the curve");
        if (answer_cancelled(a))
            status = STRUM_ERR_CANCELLED;
    }
    json_close_array(json);
    return status;
}

/* Undamped: the signed amplitude. Damped: the amplitude and its phase. */
static void put_amplitude(json_writer *json, const request *r, const char *name,
                          const char *phase_name, double _Complex value)
{
    if (periodic(r) || !cable_damped(&r->in)) {
        json_put_number(json, name, creal(value));
        return;
    }
    json_put_number(json, name, cabs(value));
    json_put_number(json, phase_name, degrees(carg(value)));
}

/* The point of the response at chi; of harmonics, the sum at the given phase of the period. */
static strum_forced_point point_of(const solving *s, double chi, double phase)
{
    strum_forced_point sum = {.chi = chi}, one;
    for (int i = 0; i < s->r->motion_count; i++) {
        const double _Complex turn =
            periodic(s->r) ? cexp(CMPLX(0, s->r->multiples[i] * phase)) : 1;
        strum_response_at(s->responses[i], chi, &one);
        sum.tangential += turn * one.tangential;
        sum.normal += turn * one.normal;
        sum.out_of_plane += turn * one.out_of_plane;
        sum.tension += turn * one.tension;
    }
    return sum;
}

static double chi_at(const request *r, int i)
{
    const strum_catenary *c = &r->in.catenary;
    if (r->profile_chi.count > 0)
        return r->profile_chi.items[i];
    return c->chi_m + c->mu * (2.0 * i / (double)(r->profile_points - 1) - 1);
}

static void write_profile_points(json_writer *json, const solving *s, double phase)
{
    const request *r = s->r;
    json_key(json, "points");
    json_open_array(json);
    const int points =
        (int)(r->profile_chi.count > 0 ? (int64_t)r->profile_chi.count : r->profile_points);
    for (int i = 0; i < points; i++) {
        const strum_forced_point at = point_of(s, chi_at(r, i), phase);
        json_open_object(json);
        json_put_number(json, "chi", at.chi);
        json_put_number(json, "xi", strum_xi_of_chi(at.chi));
        if (r->in.a_m > 0) {
            double x, y;
            strum_catenary_point(&r->in.catenary, at.chi, &x, &y);
            json_put_number(json, "x_m", x * r->in.a_m);
            json_put_number(json, "y_m", y * r->in.a_m);
        }
        put_amplitude(json, r, "tangential", "tangential_phase_deg", at.tangential);
        put_amplitude(json, r, "normal", "normal_phase_deg", at.normal);
        put_amplitude(json, r, "out_of_plane", "out_of_plane_phase_deg", at.out_of_plane);
        put_amplitude(json, r, "tension", "tension_phase_deg", at.tension);
        if (r->in.tension_N > 0)
            json_put_number(
                json, "tension_N",
                (cable_damped(&r->in) && !periodic(r) ? cabs(at.tension) : creal(at.tension)) *
                    r->in.tension_N);
        json_close_object(json);
    }
    json_close_array(json);
}

static strum_status write_profiles(json_writer *json, solving *s)
{
    const request *r = s->r;
    strum_status status = STRUM_OK;
    json_key(json, "profiles");
    json_open_array(json);
    for (size_t i = 0; i < r->profiles_at.count && status == STRUM_OK; i++) {
        json_open_object(json);
        write_frequency(json, r, r->profiles_at.items[i]);
        status = solve_at(s, r->profiles_at.items[i]);
        if (status == STRUM_ERR_METHOD) {
            write_unbounded(json, s);
            status = STRUM_OK;
        } else if (status == STRUM_OK) {
            strum_periodic_peak peak = {0};
            if (periodic(r)) {
                status = strum_periodic_peak_find(s->responses, r->multiples, r->motion_count,
                                                  &peak);
                json_put_number(json, "at_time_to_period", peak.phase / (2 * M_PI));
            }
            write_profile_points(json, s, peak.phase);
        }
        json_close_object(json);
    }
    json_close_array(json);
    return status;
}

static const char *symmetry_text(strum_symmetry symmetry)
{
    static const char *const texts[] = {"none", "symmetric", "antisymmetric"};
    return texts[symmetry];
}

/* True when some harmonic at `multiple`, the first such one being `i`, moves the end in this
 * plane. */
static bool drives(const request *r, int i, strum_plane plane)
{
    bool moves = false;
    for (int k = 0; k < r->motion_count; k++) {
        if (r->multiples[k] != r->multiples[i])
            continue;
        if (k < i)
            return false;
        const strum_end_motion *m = &r->motions[k];
        moves |= plane == STRUM_IN_PLANE ? m->tangential != 0 || m->normal != 0
                                         : m->out_of_plane != 0;
    }
    return moves || !periodic(r);
}

/* One natural frequency, once for every multiple of a forcing frequency in the range that meets
 * it. `strength` is negative where it has no meaning. */
static void write_resonance(json_writer *json, const request *r, const strum_resonance *at,
                            double decay, double strength)
{
    double lowest = INFINITY, highest = 0;
    for (int i = 0; i < frequency_count(r); i++) {
        lowest = fmin(lowest, frequency_at(r, i));
        highest = fmax(highest, frequency_at(r, i));
    }
    for (int i = 0; i < r->motion_count; i++) {
        const double forcing = at->frequency * r->in.ratio / r->multiples[i];
        if (forcing < lowest || forcing > highest || !drives(r, i, at->plane))
            continue;
        json_open_object(json);
        json_put_string(json, "plane",
                        at->plane == STRUM_IN_PLANE ? "in_plane" : "out_of_plane");
        json_put_integer(json, "mode", at->mode);
        cable_write_rates(json, &r->in, CMPLX(-decay, at->frequency));
        json_put_string(json, "symmetry", symmetry_text(at->symmetry));
        if (strength >= 0)
            json_put_number(json, "strength", strength);
        if (periodic(r)) {
            json_put_integer(json, "multiple", r->multiples[i]);
            json_put_number(json, "forcing_frequency_ratio", forcing);
        }
        json_close_object(json);
    }
}

/* The damped modes up to the highest frequency, at least; damping lowers frequencies and
 * changes their number. Where they cannot be found the curve stands without them. */
static strum_status write_damped_resonances(json_writer *json, const request *r,
                                            strum_plane plane, answer *a)
{
    strum_spectrum *spectrum = NULL;
    strum_fault fault = {0};
    strum_status status;
    double last = 0;
    if (r->highest == 0)
        return STRUM_OK;
    for (int modes = 6; last * r->in.ratio <= r->highest && modes <= STRUM_MODES_MAX;
         modes = modes < STRUM_MODES_MAX ? (int)fmin(2 * modes, STRUM_MODES_MAX) : modes + 1) {
        strum_spectrum_free(&spectrum);
        status = strum_modes_solve(&r->in.cable, plane, modes, false, &spectrum, &fault);
        if (status == STRUM_ERR_RANGE || status == STRUM_ERR_ACCURACY) {
            answer_warn(a, "the resonances %s are not listed: %s",
                        plane == STRUM_IN_PLANE ? "in plane" : "out of plane", fault.reason);
            return STRUM_OK;
        }
        if (status != STRUM_OK)
            return status;
        last = strum_spectrum_mode(spectrum, modes - 1)->frequency;
    }
    for (int i = 0; i < strum_spectrum_count(spectrum); i++) {
        const strum_mode *mode = strum_spectrum_mode(spectrum, i);
        const strum_resonance at = {.frequency = mode->frequency,
                                    .plane = plane,
                                    .mode = i + 1,
                                    .symmetry = mode->symmetry};
        write_resonance(json, r, &at, mode->decay, -1);
    }
    strum_spectrum_free(&spectrum);
    return STRUM_OK;
}

/* With damping the oscillating modes with their decays, without it the natural frequencies with
 * how strongly the motion drives each. */
static strum_status write_resonances(json_writer *json, const request *r,
                                     const strum_resonance *list, int count, answer *a)
{
    strum_status status = STRUM_OK;
    json_key(json, "resonances");
    json_open_array(json);
    if (cable_damped(&r->in)) {
        if (r->in_plane)
            status = write_damped_resonances(json, r, STRUM_IN_PLANE, a);
        if (r->out_of_plane && status == STRUM_OK)
            status = write_damped_resonances(json, r, STRUM_OUT_OF_PLANE, a);
    } else {
        for (int i = 0; i < count; i++)
            write_resonance(json, r, &list[i], 0, periodic(r) ? -1 : list[i].residue);
    }
    json_close_array(json);
    return status;
}

/* The worst differences from shooting at one frequency so far. */
static strum_status compare_at(solving *s, double frequency_ratio, double *tension,
                               double *displacement, strum_fault *fault)
{
    const request *r = s->r;
    strum_status status = solve_at(s, frequency_ratio);
    if (status == STRUM_ERR_METHOD)
        return STRUM_OK; /* a resonance has no answer to compare */
    for (int m = 0; m < r->motion_count && status == STRUM_OK; m++) {
        double dt, dx;
        status = strum_forced_compare(
            s->responses[m], frequency_ratio / r->in.ratio * r->multiples[m], &dt, &dx, fault);
        *tension = fmax(*tension, dt);
        *displacement = fmax(*displacement, dx);
    }
    return status;
}

/* How many natural frequencies the second method counts where `count` were found. */
static strum_status count_modes(const request *r, const strum_resonance *list, int count,
                                int *expected, strum_fault *fault)
{
    strum_cable undamped = r->in.cable;
    undamped.eta_t = undamped.eta_n = 0;
    strum_status status = STRUM_OK;
    *expected = 0;
    for (int plane = 0; plane < 2 && status == STRUM_OK; plane++) {
        int modes = 0;
        for (int i = 0; i < count; i++)
            modes += list[i].plane == (strum_plane)plane;
        strum_spectrum *spectrum;
        strum_verification v = {0};
        if (modes == 0)
            continue;
        status =
            strum_modes_solve(&undamped, (strum_plane)plane, modes, true, &spectrum, fault);
        if (status == STRUM_OK)
            status = strum_modes_verify(spectrum, &v, fault);
        *expected += v.modes_expected;
        strum_spectrum_free(&spectrum);
    }
    return status;
}

static strum_status write_verification(json_writer *json, solving *s,
                                       const strum_resonance *list, int count,
                                       strum_fault *fault)
{
    const request *r = s->r;
    double tension = 0, displacement = 0;
    strum_status status = STRUM_OK;
    const int step = 1 + (frequency_count(r) - 1) / VERIFIED_MAX;
    for (int i = 0; i < frequency_count(r) && status == STRUM_OK; i += step)
        status = compare_at(s, frequency_at(r, i), &tension, &displacement, fault);
    for (size_t i = 0; i < r->profiles_at.count && status == STRUM_OK; i++)
        status = compare_at(s, r->profiles_at.items[i], &tension, &displacement, fault);
    int expected;
    if (status == STRUM_OK)
        status = count_modes(r, list, count, &expected, fault);
    if (status != STRUM_OK)
        return status;
    json_key(json, "verification");
    json_open_object(json);
    json_put_string(
        json, "method",
        "shooting of the first-order system (Runge-Kutta 8), at profiles and up to 9 "
        "frequencies of the curve; natural frequencies counted by the displacement form");
    json_put_number(json, "max_relative_difference", tension);
    json_put_integer(json, "modes_expected", expected);
    json_put_integer(json, "modes_found", count);
    json_put_number(json, "max_residual", displacement);
    json_close_object(json);
    return STRUM_OK;
}

static bool answer_forced(const void *data, answer *a)
{
    const request *r = data;
    solving s;
    strum_fault fault = {0};
    bool good = solving_make(&s, r, a->problem);
    strum_resonance *list = calloc(2 * STRUM_MODES_MAX, sizeof *list);
    if (good && list == NULL) {
        problem_out_of_memory(a->problem);
        good = false;
    }
    a->theory =
        "linear forced motion about the catenary (Gale 1976, 2.5), force Galerkin method";
    cable_warn(&r->in, a);
    if (r->out_of_plane)
        answer_warn(
            a, "motion out of plane makes no dynamic tension to first order: see the profiles");
    json_writer *json = a->result;
    json_open_object(json);
    cable_write_geometry(json, &r->in);
    if (good) {
        const int count =
            strum_forced_resonances(s.forced, &r->motions[0], list, 2 * STRUM_MODES_MAX);
        strum_status status = write_curve(json, &s, a);
        if (status == STRUM_OK)
            status = write_resonances(json, r, list, count, a);
        if (status == STRUM_OK && r->profiles_at.count > 0)
            status = write_profiles(json, &s);
        if (status == STRUM_OK && r->verify)
            status = write_verification(json, &s, list, count, &fault);
        if (status != STRUM_OK)
            cable_refuse(&fault, status, a->problem);
        good = status == STRUM_OK;
    }
    json_close_object(json);
    free(list);
    solving_free(&s);
    return good;
}

const endpoint forced_tension = {
    .path = "/v1/forced/tension",
    .title =
        "Dynamic tension of a suspended cable whose end 2 moves, against forcing frequency",
    .request = &request_schema,
    .query = true,
    .prepare = prepare,
    .cost_us = cost_us,
    .answer = answer_forced,
};
