/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The answer of /v1/forced/tension: curve, resonances, profiles, verification. */
#include <math.h>
#include <stdlib.h>

#include "endpoints/common/plausibility.h"
#include "endpoints/forced/answer.h"

/* Frequencies of a curve that `verify` recomputes, besides all profiles. */
#define VERIFIED_MAX 8

/* What one request is answered from; owns forced and responses. */
typedef struct solving {
    const forced_request *r;
    strum_forced *forced;
    strum_response *responses[FORCED_HARMONICS_MAX];
    strum_resonance at; /* the resonance that was met */
    /* The highest peak of the curve, where it is, the frequencies beside it; 0: none so far. */
    double tallest, tallest_at, before, after;
    double resonance; /* beside that peak, narrower than the steps; NAN: none */
    double slack_at;  /* the first frequency whose peak exceeds the static tension; NAN: none */
} solving;

static void solving_free(solving *s)
{
    for (int i = 0; i < FORCED_HARMONICS_MAX; i++)
        strum_response_free(s->responses[i]);
    strum_forced_free(s->forced);
}

static bool solving_make(solving *s, const forced_request *r, const answer *a)
{
    problem *p = a->problem;
    strum_error fault = {0};
    *s = (solving){.r = r, .slack_at = NAN, .resonance = NAN};
    const strum_forced_params params = {r->in.cable, r->highest / r->in.ratio, r->in_plane,
                                        r->out_of_plane};
    const strum_options options = answer_options(a);
    strum_status status = strum_forced_solve(&params, &options, &s->forced, &fault);
    for (int i = 0; i < r->motion_count && status == STRUM_OK; i++)
        status = strum_response_make(s->forced, &s->responses[i], &fault);
    if (status != STRUM_OK) {
        cable_refuse(&fault, status, p);
        if (fault.argument == STRUM_FORCED_ARG_FREQUENCY)
            problem_add(p, forced_highest_field(r), "%s", fault.reason);
    }
    return status == STRUM_OK;
}

/* All harmonics at one forcing frequency. STRUM_ERR_METHOD: a resonance, in s->at. */
static strum_status solve_at(solving *s, double frequency_ratio)
{
    strum_status status = STRUM_OK;
    for (int i = 0; i < s->r->motion_count && status == STRUM_OK; i++)
        status = strum_response_solve(s->responses[i],
                                      frequency_ratio / s->r->in.ratio * s->r->multiples[i],
                                      &s->r->motions[i], &s->at);
    return status;
}

static double degrees(double radians)
{
    const double turned = fmod(radians * 180 / M_PI, 360);
    return turned > 180 ? turned - 360 : turned <= -180 ? turned + 360 : turned;
}

static void write_frequency(json_writer *json, const forced_request *r, double frequency_ratio)
{
    json_put_number(json, "frequency_ratio", frequency_ratio);
    if (r->in.rad_per_s > 0)
        put_frequency(json, frequency_ratio * r->in.rad_per_s);
}

static void write_unbounded(json_writer *json, const solving *s)
{
    json_put_flag(json, "unbounded", true);
    json_put_string(json, "plane", plane_keys[s->at.plane]);
    json_put_number(json, "natural_frequency_ratio", s->at.frequency * s->r->in.ratio);
    json_put_string(
        json, "statement",
        "the undamped cable is driven at a natural frequency that this motion excites: its "
        "motion grows without limit, and there is no steady amplitude");
}

/* Dynamic tension beyond the static one, in H cosh(chi) where the cable hangs: no longer taut. */
static void keep_peak(solving *s, double frequency_ratio, double tension, double chi,
                      bool tensile)
{
    if (tension > s->tallest) {
        s->tallest = tension;
        s->tallest_at = frequency_ratio;
    }
    if (isnan(s->slack_at) && !tensile && tension > cosh(chi))
        s->slack_at = frequency_ratio;
}

static strum_status write_peak(json_writer *json, solving *s, double frequency_ratio)
{
    const forced_request *r = s->r;
    double tension, chi;
    if (forced_periodic(r)) {
        strum_periodic_peak peak;
        const strum_status status = strum_periodic_peak_find(s->responses, r->multiples,
                                                             (size_t)r->motion_count, &peak);
        if (status != STRUM_OK)
            return status;
        tension = fabs(peak.tension);
        chi = peak.chi;
        json_put_number(json, "max_dynamic_tension", tension);
        json_put_number(json, "at_chi", chi);
        json_put_flag(json, "tensile", peak.tension >= 0);
        keep_peak(s, frequency_ratio, tension, chi, peak.tension >= 0);
        json_put_number(json, "at_time_to_period", peak.phase / (2 * M_PI));
        if (r->in.rad_per_s > 0)
            put_finite(json, "at_time_s", peak.phase / (frequency_ratio * r->in.rad_per_s));
    } else {
        strum_peak peak;
        strum_response_peak(s->responses[0], &peak);
        tension = peak.tension;
        chi = peak.chi;
        json_put_number(json, "max_dynamic_tension", tension);
        json_put_number(json, "at_chi", chi);
        keep_peak(s, frequency_ratio, tension, chi, false);
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
    for (int i = 0; i < forced_frequency_count(s->r) && status == STRUM_OK; i++) {
        const double frequency = forced_frequency_at(s->r, i);
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
static void put_amplitude(json_writer *json, const forced_request *r, const char *name,
                          const char *phase_name, double _Complex value)
{
    if (forced_periodic(r) || !cable_damped(&r->in)) {
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
            forced_periodic(s->r) ? cexp(CMPLX(0, s->r->multiples[i] * phase)) : 1;
        strum_response_at(s->responses[i], chi, &one);
        sum.tangential += turn * one.tangential;
        sum.normal += turn * one.normal;
        sum.out_of_plane += turn * one.out_of_plane;
        sum.tension += turn * one.tension;
    }
    return sum;
}

static double chi_at(const forced_request *r, int i)
{
    const strum_catenary *c = &r->in.catenary;
    if (r->profile_chi.count > 0)
        return r->profile_chi.items[i];
    return c->chi_m + c->mu * (2.0 * i / (double)(r->profile_points - 1) - 1);
}

static void write_profile_points(json_writer *json, const solving *s, double phase)
{
    const forced_request *r = s->r;
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
            json_put_number(json, "tension_N",
                            (cable_damped(&r->in) && !forced_periodic(r) ? cabs(at.tension)
                                                                         : creal(at.tension)) *
                                r->in.tension_N);
        json_close_object(json);
    }
    json_close_array(json);
}

static strum_status write_profiles(json_writer *json, solving *s, const answer *a)
{
    const forced_request *r = s->r;
    strum_status status = STRUM_OK;
    json_key(json, "profiles");
    json_open_array(json);
    for (size_t i = 0; i < r->profiles.count && status == STRUM_OK; i++) {
        json_open_object(json);
        write_frequency(json, r, r->profiles.items[i]);
        status = solve_at(s, r->profiles.items[i]);
        if (status == STRUM_ERR_METHOD) {
            write_unbounded(json, s);
            status = STRUM_OK;
        } else if (status == STRUM_OK) {
            strum_periodic_peak peak = {0};
            if (forced_periodic(r)) {
                status = strum_periodic_peak_find(s->responses, r->multiples,
                                                  (size_t)r->motion_count, &peak);
                json_put_number(json, "at_time_to_period", peak.phase / (2 * M_PI));
            }
            write_profile_points(json, s, peak.phase);
        }
        json_close_object(json);
        if (answer_cancelled(a))
            status = STRUM_ERR_CANCELLED;
    }
    json_close_array(json);
    return status;
}

/* True when some harmonic at `multiple`, the first such one being `i`, moves the end in this
 * plane. */
static bool drives(const forced_request *r, int i, strum_plane plane)
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
    return moves || !forced_periodic(r);
}

/* The frequencies of the curve next below and above its highest peak. */
static void find_neighbours(solving *s)
{
    s->before = -INFINITY;
    s->after = INFINITY;
    for (int i = 0; i < forced_frequency_count(s->r); i++) {
        const double frequency = forced_frequency_at(s->r, i);
        if (frequency < s->tallest_at)
            s->before = fmax(s->before, frequency);
        else if (frequency > s->tallest_at)
            s->after = fmin(s->after, frequency);
    }
}

/* A resonance narrower than the curve's steps beside its highest peak. Half the width of a peak at
 * half its power is the decay. */
static void keep_resonance(solving *s, double forcing, double decay)
{
    const double step =
        forcing < s->tallest_at ? s->tallest_at - s->before : s->after - s->tallest_at;
    const double distance = fabs(forcing - s->tallest_at);
    if (forced_frequency_count(s->r) > 2 && s->tallest > 0 && isfinite(step) &&
        distance < step && decay < 0.5 * step &&
        !(distance >= fabs(s->resonance - s->tallest_at)))
        s->resonance = forcing;
}

static void warn_of_curve(const solving *s, answer *a)
{
    if (s->slack_at >= 0)
        answer_warn(a,
                    "at frequency_ratio %.6g the dynamic tension exceeds the static tension: "
                    "the cable would go slack, which linear dynamics do not know",
                    s->slack_at);
    if (s->resonance >= 0)
        answer_warn(
            a,
            "the highest peak of the curve, %.4g at frequency_ratio %.6g, stands beside a "
            "resonance at %.9g that is narrower than the steps: its height depends on how near "
            "a frequency of the curve lies to it; %s",
            s->tallest, s->tallest_at, s->resonance,
            cable_damped(&s->r->in) ? "take smaller steps there"
                                    : "without damping it has no limit");
}

static bool on_curve(const forced_request *r, double frequency_ratio)
{
    return r->curve_min <= frequency_ratio && frequency_ratio <= r->curve_max;
}

/* One natural frequency, once for every multiple of a forcing frequency in the range that meets
 * it. `strength` is negative where it has no meaning. */
static void write_resonance(json_writer *json, solving *s, const strum_resonance *at,
                            double decay, double strength)
{
    const forced_request *r = s->r;
    for (int i = 0; i < r->motion_count; i++) {
        const double forcing = at->frequency * r->in.ratio / r->multiples[i];
        if (!on_curve(r, forcing) || !drives(r, i, at->plane))
            continue;
        if (strength != 0)
            keep_resonance(s, forcing, decay * r->in.ratio / r->multiples[i]);
        json_open_object(json);
        json_put_string(json, "plane", plane_keys[at->plane]);
        json_put_integer(json, "mode", at->mode);
        cable_write_rates(json, &r->in, CMPLX(-decay, at->frequency));
        json_put_string(json, "symmetry", symmetry_names[at->symmetry]);
        if (strength >= 0)
            json_put_number(json, "strength", strength);
        if (forced_periodic(r)) {
            json_put_integer(json, "multiple", r->multiples[i]);
            json_put_number(json, "forcing_frequency_ratio", forcing);
        }
        json_close_object(json);
    }
}

/* The damped modes up to the highest frequency, at least; damping lowers frequencies and
 * changes their number. Where they cannot be found the curve stands without them. */
static strum_status write_damped_resonances(json_writer *json, solving *s, strum_plane plane,
                                            answer *a)
{
    const forced_request *r = s->r;
    strum_modes *spectrum = NULL;
    const strum_options options = answer_options(a);
    strum_error fault = {0};
    strum_status status;
    double last = 0;
    if (r->highest == 0)
        return STRUM_OK;
    for (int modes = 6; last * r->in.ratio <= r->highest && modes <= STRUM_MODES_MAX;
         modes = modes < STRUM_MODES_MAX ? (int)fmin(2 * modes, STRUM_MODES_MAX) : modes + 1) {
        strum_modes_free(spectrum);
        status = strum_modes_solve(&(strum_modes_params){r->in.cable, plane, modes, false},
                                   &options, &spectrum, &fault);
        if (status == STRUM_ERR_RANGE || status == STRUM_ERR_ACCURACY) {
            answer_warn(a, "the resonances %s are not listed: %s",
                        plane == STRUM_IN_PLANE ? "in plane" : "out of plane", fault.reason);
            return STRUM_OK;
        }
        if (status != STRUM_OK)
            return status;
        strum_mode highest = {0};
        (void)strum_modes_get(spectrum, (size_t)modes - 1, &highest);
        last = highest.frequency;
    }
    strum_mode mode;
    for (size_t i = 0; strum_modes_get(spectrum, i, &mode) == STRUM_OK; i++) {
        const strum_resonance at = {.frequency = mode.frequency,
                                    .plane = plane,
                                    .mode = (int)i + 1,
                                    .symmetry = mode.symmetry};
        write_resonance(json, s, &at, mode.decay, -1);
    }
    strum_modes_free(spectrum);
    return STRUM_OK;
}

/* With damping the oscillating modes with their decays, without it the natural frequencies with
 * how strongly the motion drives each. */
static strum_status write_resonances(json_writer *json, solving *s, const strum_resonance *list,
                                     int count, answer *a)
{
    const forced_request *r = s->r;
    strum_status status = STRUM_OK;
    json_key(json, "resonances");
    json_open_array(json);
    if (cable_damped(&r->in)) {
        if (r->in_plane)
            status = write_damped_resonances(json, s, STRUM_IN_PLANE, a);
        if (r->out_of_plane && status == STRUM_OK)
            status = write_damped_resonances(json, s, STRUM_OUT_OF_PLANE, a);
    } else {
        for (int i = 0; i < count; i++)
            write_resonance(json, s, &list[i], 0, forced_periodic(r) ? -1 : list[i].residue);
    }
    json_close_array(json);
    return status;
}

/* The worst differences from shooting at one frequency so far. */
static strum_status compare_at(solving *s, double frequency_ratio, const strum_options *options,
                               double *tension, double *displacement, strum_error *fault)
{
    const forced_request *r = s->r;
    strum_status status = solve_at(s, frequency_ratio);
    if (status == STRUM_ERR_METHOD)
        return STRUM_OK; /* a resonance has no answer to compare */
    for (int m = 0; m < r->motion_count && status == STRUM_OK; m++) {
        double dt, dx;
        status = strum_response_verify(s->responses[m], options, &dt, &dx, fault);
        *tension = fmax(*tension, dt);
        *displacement = fmax(*displacement, dx);
    }
    return status;
}

/* How many natural frequencies the second method counts where `count` were found. */
static strum_status count_modes(const forced_request *r, const strum_resonance *list, int count,
                                const strum_options *options, int *expected, strum_error *fault)
{
    strum_cable undamped = r->in.cable;
    undamped.eta_t = undamped.eta_n = 0;
    strum_status status = STRUM_OK;
    *expected = 0;
    for (int plane = 0; plane < 2 && status == STRUM_OK; plane++) {
        int modes = 0;
        for (int i = 0; i < count; i++)
            modes += list[i].plane == (strum_plane)plane;
        strum_modes *spectrum;
        strum_verification v = {0};
        if (modes == 0)
            continue;
        status =
            strum_modes_solve(&(strum_modes_params){undamped, (strum_plane)plane, modes, true},
                              options, &spectrum, fault);
        if (status == STRUM_OK)
            status = strum_modes_verify(spectrum, options, &v, fault);
        *expected += (int)v.modes_expected;
        strum_modes_free(spectrum);
    }
    return status;
}

static strum_status write_verification(json_writer *json, solving *s,
                                       const strum_resonance *list, int count, const answer *a,
                                       strum_error *fault)
{
    const strum_options options = answer_options(a);
    const forced_request *r = s->r;
    double tension = 0, displacement = 0;
    strum_status status = STRUM_OK;
    const int step = 1 + (forced_frequency_count(r) - 1) / VERIFIED_MAX;
    for (int i = 0; i < forced_frequency_count(r) && status == STRUM_OK; i += step)
        status =
            compare_at(s, forced_frequency_at(r, i), &options, &tension, &displacement, fault);
    for (size_t i = 0; i < r->profiles.count && status == STRUM_OK; i++)
        status =
            compare_at(s, r->profiles.items[i], &options, &tension, &displacement, fault);
    int expected;
    if (status == STRUM_OK)
        status = count_modes(r, list, count, &options, &expected, fault);
    if (status != STRUM_OK)
        return status;
    put_verification(
        json, &(strum_verification){
                  .method = "shooting of the first-order system (extrapolated midpoint rule), "
                            "at profiles and up to 9 frequencies of the curve; natural "
                            "frequencies counted by the displacement form",
                  .max_relative_difference = tension,
                  .modes_expected = expected,
                  .modes_found = count,
                  .max_residual = displacement});
    return STRUM_OK;
}

/* The natural frequencies that were met, with how strongly the motion drives each where that
 * is written; NULL without memory. */
static strum_resonance *list_resonances(const solving *s, size_t *count)
{
    const forced_request *r = s->r;
    const bool strengths = !forced_periodic(r) && !cable_damped(&r->in);
    *count = strum_forced_count(s->forced);
    strum_resonance *list = calloc(*count + 1, sizeof *list);
    for (size_t i = 0; list != NULL && i < *count; i++) {
        strum_status status = strum_forced_get(s->forced, i, NULL, &list[i]);
        if (status == STRUM_OK && strengths && on_curve(r, list[i].frequency * r->in.ratio))
            status = strum_forced_get(s->forced, i, &r->motions[0], &list[i]);
        if (status != STRUM_OK) {
            free(list);
            list = NULL;
        }
    }
    return list;
}

static strum_status write_answer(json_writer *json, solving *s, answer *a, strum_error *fault)
{
    const forced_request *r = s->r;
    size_t found;
    strum_resonance *list = list_resonances(s, &found);
    if (list == NULL)
        return STRUM_ERR_MEMORY;
    const int count = (int)found;
    strum_status status = write_curve(json, s, a);
    find_neighbours(s);
    if (status == STRUM_OK)
        status = write_resonances(json, s, list, count, a);
    if (status == STRUM_OK && r->profiles.count > 0)
        status = write_profiles(json, s, a);
    if (status == STRUM_OK && r->verify)
        status = write_verification(json, s, list, count, a, fault);
    free(list);
    if (status == STRUM_OK)
        warn_of_curve(s, a);
    return status;
}

static void warn_of_input(const forced_request *r, answer *a)
{
    double amplitude = 0;
    for (int i = 0; i < r->motion_count; i++) {
        const strum_end_motion *m = &r->motions[i];
        amplitude += hypot(hypot(cabs(m->tangential), cabs(m->normal)), cabs(m->out_of_plane));
    }
    cable_warn(&r->in, a);
    warn_suspended(&r->in, a);
    warn_motion(amplitude / r->in.catenary.span, a);
    if (r->in_plane) {
        warn_without_stretch(&r->in, a);
        warn_added_mass(r->in.added_mass_kg_per_m, r->in.mass_kg_per_m, turn_of(&r->in), a);
    }
}

bool forced_answer(const void *data, answer *a)
{
    const forced_request *r = data;
    solving s;
    strum_error fault = {0};
    bool good = solving_make(&s, r, a);
    a->theory =
        "linear forced motion about the catenary (Gale 1976, 2.5), force Galerkin method";
    warn_of_input(r, a);
    if (r->out_of_plane)
        answer_warn(
            a, "motion out of plane makes no dynamic tension to first order: see the profiles");
    json_writer *json = a->result;
    json_open_object(json);
    cable_write_geometry(json, &r->in);
    if (good) {
        const strum_status status = write_answer(json, &s, a, &fault);
        if (status != STRUM_OK)
            cable_refuse(&fault, status, a->problem);
        good = status == STRUM_OK;
    }
    json_close_object(json);
    solving_free(&s);
    return good;
}
