/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "endpoints/catenary/comparison.h"

#include <math.h>

#include <strum/handbook.h>

/* ---- verification ---- */

typedef struct opinion {
    strum_verification second;
    bool has_series;
    double series_difference;
    int series_terms;
} opinion;

/* The series are a further method where they are cheap: few modes, 64 bit arithmetic. */
#define VERIFY_SERIES_MODES 20

double verification_series_work(const cable_input *in, strum_plane plane, int count)
{
    return count > VERIFY_SERIES_MODES ? 0 : strum_series_work(&in->cable, plane, count, false);
}

static double difference(const strum_mode *modes, const strum_mode *others, int count)
{
    double worst = 0;
    for (int i = 0; i < count; i++)
        worst = fmax(worst, fabs(others[i].frequency / modes[i].frequency - 1));
    return worst;
}

/* A Galerkin answer: the core's second method, and the series where they reach. */
static strum_status confirm_galerkin(const cable_input *in, strum_plane plane,
                                     const plane_modes *found, const strum_options *options,
                                     opinion *o, strum_error *fault)
{
    const strum_status status = strum_modes_verify(found->spectrum, options, &o->second, fault);
    if (status != STRUM_OK || verification_series_work(in, plane, found->count) <= 0)
        return status;
    strum_mode modes[VERIFY_SERIES_MODES];
    strum_series_report report;
    const strum_status series =
        strum_series_solve(&in->cable, plane, found->count, false, modes, &report, NULL);
    if (series == STRUM_ERR_MEMORY)
        return series;
    o->has_series = series == STRUM_OK;
    if (o->has_series) {
        o->series_difference = difference(found->modes, modes, found->count);
        o->series_terms = report.terms;
    }
    return STRUM_OK;
}

/* An answer by series: the Galerkin methods, with a few modes more so that one that the series
 * had missed would be counted. */
static strum_status confirm_series(const cable_input *in, strum_plane plane,
                                   const plane_modes *found, const strum_options *options,
                                   opinion *o, strum_error *fault)
{
    const int count = found->count, more = (int)fmin(count + 4, STRUM_MODES_MAX);
    strum_modes *exact = NULL;
    strum_status status = strum_modes_solve(&(strum_modes_params){in->cable, plane, more, true},
                                            options, &exact, fault);
    if (status == STRUM_OK)
        status = strum_modes_verify(exact, options, &o->second, fault);
    if (status == STRUM_OK) {
        const double last = found->modes[count - 1].frequency * (1 + 1e-9);
        o->second.method = plane == STRUM_IN_PLANE ? "force Galerkin" : "displacement Galerkin";
        o->second.modes_found = count;
        o->second.modes_expected = 0;
        strum_mode modes[STRUM_MODES_MAX];
        for (int i = 0; i < more; i++) {
            (void)strum_modes_get(exact, (size_t)i, &modes[i]); /* all are there */
            o->second.modes_expected += modes[i].frequency <= last;
        }
        o->second.max_relative_difference = difference(found->modes, modes, count);
    }
    strum_modes_free(exact);
    return status;
}

static void write_opinion(json_writer *json, const opinion *o)
{
    put_verification_members(json, &o->second);
    if (!o->has_series)
        return;
    json_key(json, "series");
    json_open_object(json);
    json_put_string(json, "method", "power series (Gale 2.42-2.74, 2.44-2.110)");
    json_put_number(json, "max_relative_difference", o->series_difference);
    json_put_integer(json, "terms", o->series_terms);
    json_close_object(json);
}

/* One plane: its verification; both: the worse of the two on top, each in full below. */
bool write_verification(json_writer *json, const cable_input *in, const plane_modes found[2],
                        const answer *a)
{
    const strum_options options = answer_options(a);
    opinion each[2] = {0}, worst = {.second.method = "each plane by its own, see below"};
    for (int plane = 0; plane < 2; plane++) {
        if (found[plane].count == 0)
            continue;
        strum_error fault = {0};
        const strum_status status =
            found[plane].spectrum != NULL
                ? confirm_galerkin(in, (strum_plane)plane, &found[plane], &options,
                                   &each[plane], &fault)
                : confirm_series(in, (strum_plane)plane, &found[plane], &options, &each[plane],
                                 &fault);
        if (status != STRUM_OK) {
            cable_refuse(&fault, status, a->problem);
            return false;
        }
        const strum_verification *v = &each[plane].second;
        strum_verification *w = &worst.second;
        w->max_relative_difference =
            fmax(w->max_relative_difference, v->max_relative_difference);
        w->max_residual = fmax(w->max_residual, v->max_residual);
        w->modes_expected += v->modes_expected;
        w->modes_found += v->modes_found;
    }
    const bool both = found[0].count > 0 && found[1].count > 0;
    json_key(json, "verification");
    json_open_object(json);
    write_opinion(json, both ? &worst : &each[found[0].count > 0 ? 0 : 1]);
    for (int plane = 0; plane < 2 && both; plane++) {
        json_key(json, plane_keys[plane]);
        json_open_object(json);
        write_opinion(json, &each[plane]);
        json_close_object(json);
    }
    json_close_object(json);
    return true;
}

/* ---- comparison ---- */

static void put_beside(json_writer *json, const cable_input *in, const char *ratio_key,
                       const char *hertz_key, const char *difference_key, double value,
                       double exact)
{
    json_put_number(json, ratio_key, value * in->ratio);
    if (in->rad_per_s > 0)
        json_put_number(json, hertz_key, value * in->ratio * in->rad_per_s / (2 * M_PI));
    if (difference_key != NULL)
        json_put_number(json, difference_key, value / exact - 1);
}

/* The n-th frequency in plane of an inclined cable: both symmetries in one ascending list. */
static double merged(const strum_handbook *s, int n)
{
    int symmetric = 1, antisymmetric = 1;
    double value = 0;
    while (symmetric + antisymmetric - 2 < n) {
        const double a = strum_handbook_in_plane(s, STRUM_SYMMETRIC, symmetric);
        const double b = strum_handbook_in_plane(s, STRUM_ANTISYMMETRIC, antisymmetric);
        value = fmin(a, b);
        *(a <= b ? &symmetric : &antisymmetric) += 1;
    }
    return value;
}

static void compare_plane(json_writer *json, const cable_input *in, const strum_handbook *s,
                          strum_plane plane, const plane_modes *found, double limit)
{
    int seen[3] = {0};
    json_key(json, plane_keys[plane]);
    json_open_array(json);
    for (int i = 0; i < found->count && found->modes[i].frequency < limit; i++) {
        const strum_mode *mode = &found->modes[i];
        const int k = ++seen[mode->symmetry];
        const int half_waves = mode->symmetry == STRUM_SYMMETRIC       ? 2 * k - 1
                               : mode->symmetry == STRUM_ANTISYMMETRIC ? 2 * k
                                                                       : k;
        const double string = strum_handbook_string(s, half_waves);
        const double shallow = plane == STRUM_OUT_OF_PLANE ? string
                               : mode->symmetry == STRUM_NO_SYMMETRY
                                   ? merged(s, k)
                                   : strum_handbook_in_plane(s, mode->symmetry, k);
        json_open_object(json);
        json_put_integer(json, "mode", i + 1);
        put_beside(json, in, "frequency_ratio", "frequency_Hz", NULL, mode->frequency, 1);
        put_beside(json, in, "shallow_cable_ratio", "shallow_cable_Hz",
                   "shallow_cable_difference", shallow, mode->frequency);
        put_beside(json, in, "taut_string_ratio", "taut_string_Hz", "taut_string_difference",
                   string, mode->frequency);
        json_close_object(json);
    }
    json_close_array(json);
}

void write_comparison(json_writer *json, const cable_input *in, const plane_modes found[2])
{
    const strum_cable *cable = &in->cable;
    strum_handbook s;
    strum_handbook_of(&in->catenary, cable, &s);
    /* waves along an elastic cable, which neither theory knows, begin near here and shift the
     * numbers of the modes */
    const double along =
        cable->kappa_t > 0
            ? 0.9 * M_PI /
                  (in->catenary.unstretched_length * sqrt(cable->kappa_t * cable->mass_t))
            : INFINITY;
    json_key(json, "comparison");
    json_open_object(json);
    json_put_string(
        json, "theories",
        "shallow cable: Irvine and Caughey 1974; taut string; both with this cable's "
        "horizontal tension and sag, along the chord where it is inclined, undamped");
    json_put_string(json, "matched_by", cable->chi_m == 0 ? "symmetry" : "order");
    json_put_number(json, "sag_ratio", s.sag_ratio);
    if (isfinite(s.lambda_squared))
        json_put_number(json, "lambda_squared", s.lambda_squared);
    for (int plane = 0; plane < 2; plane++)
        if (found[plane].count > 0)
            compare_plane(json, in, &s, (strum_plane)plane, &found[plane],
                          plane == STRUM_IN_PLANE ? along : INFINITY);
    if (isfinite(along))
        json_put_number(json, "in_plane_compared_below", along * in->ratio);
    json_close_object(json);
}
