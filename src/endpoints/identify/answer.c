/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "endpoints/identify/answer.h"

#include <math.h>
#include <stdio.h>

#include "endpoints/common/members.h"

static void write_estimates(json_writer *json, const strum_identify *found)
{
    json_key(json, "estimates");
    json_open_object(json);
    for (int q = 0; q < STRUM_IDENTIFY_QUANTITIES; q++) {
        const strum_identify_estimate *e =
            strum_identify_estimate_of(found, (strum_identify_quantity)q);
        if (!e->unknown)
            continue;
        json_key(json, identify_fields[q]);
        json_open_object(json);
        json_put_number(json, "value", e->value);
        put_finite(json, "standard_error", e->standard_error);
        put_finite(json, "low", e->low);
        put_finite(json, "high", e->high);
        json_put_flag(json, "determined", e->determined);
        json_close_object(json);
    }
    json_close_object(json);
}

static void write_shares(json_writer *json, const strum_identify_mode *m)
{
    if (!isfinite(m->share_tension))
        return;
    json_key(json, "shares");
    json_open_object(json);
    json_put_number(json, "tension", m->share_tension);
    json_put_number(json, "bending", m->share_bending);
    json_put_number(json, "ends", m->share_ends);
    json_put_number(json, "sag", m->share_sag);
    json_close_object(json);
}

static void write_modes(json_writer *json, const identify_request *r,
                        const strum_identify *found)
{
    json_key(json, "modes");
    json_open_array(json);
    for (size_t i = 0; i < strum_identify_count(found); i++) {
        strum_identify_mode m;
        (void)strum_identify_get(found, i, &m);
        json_open_object(json);
        json_put_integer(json, "mode", m.mode);
        if (r->params.frequencies != NULL) {
            json_put_number(json, "measured_Hz", m.measured);
            json_put_number(json, "computed_Hz", m.computed);
            json_put_number(json, "residual_Hz", m.residual);
        }
        put_finite(json, "measured_damping_ratio", m.measured_ratio);
        put_finite(json, "computed_damping_ratio", m.computed_ratio);
        put_finite(json, "studentized_residual", m.studentized);
        put_finite(json, "leverage", m.leverage);
        put_finite(json, "tension_without_it_N", m.tension_without);
        put_finite(json, "string_rule_N", m.string_rule);
        if (m.excluded)
            json_put_flag(json, "excluded", true);
        if (r->params.damping_ratios == NULL)
            write_shares(json, &m);
        json_close_object(json);
    }
    json_close_array(json);
}

static void write_fit(json_writer *json, const strum_identify_summary *s)
{
    json_key(json, "fit");
    json_open_object(json);
    json_put_number(json, "chi_squared", s->chi_squared);
    json_put_integer(json, "degrees_of_freedom", s->degrees_of_freedom);
    put_finite(json, "p_value", s->p_value);
    put_finite(json, "residual_standard_deviation_Hz", s->residual_deviation);
    json_put_integer(json, "local_minima", (int64_t)s->local_minima);
    json_close_object(json);
}

static void write_identifiability(json_writer *json, const strum_identify_summary *s)
{
    json_key(json, "identifiability");
    json_open_object(json);
    json_key(json, "singular_values");
    json_open_array(json);
    for (size_t i = 0; i < s->unknowns; i++)
        json_number(json, s->singular_values[i]);
    json_close_array(json);
    json_key(json, "weakest");
    json_open_object(json);
    for (size_t i = 0; i < s->unknowns; i++)
        json_put_number(json, identify_unknowns[s->which[i]], s->weakest[i]);
    json_close_object(json);
    json_key(json, "correlation");
    json_open_array(json);
    for (size_t i = 0; i < s->unknowns; i++) {
        json_open_array(json);
        for (size_t j = 0; j < s->unknowns; j++)
            json_number(json, s->correlation[i][j]);
        json_close_array(json);
    }
    json_close_array(json);
    json_close_object(json);
}

static void write_numbers(json_writer *json, const int *modes, size_t count)
{
    json_key(json, "mode_numbers");
    json_open_array(json);
    for (size_t i = 0; i < count; i++)
        json_integer(json, modes[i]);
    json_close_array(json);
}

static void write_reading(json_writer *json, const identify_request *r,
                          const strum_identify_reading *one)
{
    write_numbers(json, one->modes, r->params.count);
    if (identify_asks(r, STRUM_IDENTIFY_TENSION))
        json_put_number(json, "tension_N", one->tension);
    json_put_number(json, "chi_squared", one->chi_squared);
    json_put_number(json, "criterion", one->criterion);
}

static void write_assignment(json_writer *json, const identify_request *r,
                             const strum_identify *found)
{
    const strum_identify_reading *readings;
    bool ambiguous, by_price;
    double deviation;
    const size_t count =
        strum_identify_readings(found, &readings, &ambiguous, &by_price, &deviation);
    if (count == 0)
        return;
    json_key(json, "assignment");
    json_open_object(json);
    write_reading(json, r, &readings[0]);
    json_put_flag(json, "ambiguous", ambiguous);
    json_put_string(json, "told_apart_by", by_price ? "price" : "data");
    put_finite(json, "assumed_standard_deviation_Hz", deviation);
    json_key(json, "alternatives");
    json_open_array(json);
    for (size_t i = 1; i < count; i++) {
        json_open_object(json);
        write_reading(json, r, &readings[i]);
        json_close_object(json);
    }
    json_close_array(json);
    json_close_object(json);
}

static void write_solutions(json_writer *json, const strum_identify *found)
{
    const strum_identify_solution *solutions;
    const size_t count = strum_identify_solutions(found, &solutions);
    json_key(json, "solutions");
    json_open_array(json);
    for (size_t i = 0; i < count; i++) {
        json_open_object(json);
        for (int q = 0; q < STRUM_IDENTIFY_QUANTITIES; q++)
            if (strum_identify_estimate_of(found, (strum_identify_quantity)q)->unknown)
                json_put_number(json, identify_fields[q], solutions[i].values[q]);
        put_finite(json, "lambda_squared", solutions[i].lambda_squared);
        if (strum_identify_estimate_of(found, STRUM_IDENTIFY_DAMPING)->unknown)
            json_put_string(json, "branch",
                            solutions[i].below_optimum ? "below the optimum"
                                                       : "above the optimum");
        json_put_number(json, "chi_squared", solutions[i].chi_squared);
        json_close_object(json);
    }
    json_close_array(json);
}

/* Tension varies along an inclined cable by its weight. */
static void write_end_tensions(json_writer *json, const identify_request *r,
                               const strum_identify *found)
{
    if (!(r->weight_N_per_m > 0) || !(r->inclination_deg > 0) ||
        !identify_asks(r, STRUM_IDENTIFY_TENSION))
        return;
    const double tension = strum_identify_estimate_of(found, STRUM_IDENTIFY_TENSION)->value;
    const double length = strum_identify_estimate_of(found, STRUM_IDENTIFY_LENGTH)->value;
    const double half = 0.5 * r->weight_N_per_m * length * sin(r->inclination_deg * M_PI / 180);
    json_put_number(json, "tension_upper_end_N", tension + half);
    json_put_number(json, "tension_lower_end_N", tension - half);
}

static bool write_verification(const identify_request *r, const strum_identify *found,
                               answer *a)
{
    strum_verification v;
    strum_error fault = {0};
    const strum_options options = answer_options(a);
    const strum_status status = strum_identify_verify(found, &r->params, &options, &v, &fault);
    if (status == STRUM_OK)
        put_verification(a->result, &v);
    else if (status == STRUM_ERR_METHOD || status == STRUM_ERR_ACCURACY)
        answer_warn(a, "not verified: %s", fault.reason);
    else
        chain_refuse(&r->in, &fault, status, a->problem);
    return a->problem->status == 0;
}

static void refuse(const identify_request *r, const strum_error *fault, strum_status status,
                   problem *p)
{
    if (status == STRUM_ERR_RANGE || status == STRUM_ERR_IMPOSSIBLE ||
        status == STRUM_ERR_METHOD) {
        static const char *const pointers[] = {"",
                                               "/frequencies_Hz",
                                               "/frequency_standard_deviations_Hz",
                                               "/mode_numbers",
                                               "",
                                               "/ends",
                                               "/unknowns",
                                               "/damping_ratios",
                                               "/damper_position_m",
                                               "/components",
                                               "/missing_modes_at_most"};
        const char *pointer =
            fault->argument >= 0 && fault->argument <= STRUM_IDENTIFY_ARG_ASSIGNMENT
                ? pointers[fault->argument]
                : "";
        problem_set(p, 422, "%s", fault->reason);
        char named[64];
        if (fault->argument == STRUM_IDENTIFY_ARG_QUANTITIES &&
            fault->index < STRUM_IDENTIFY_QUANTITIES) {
            (void)snprintf(named, sizeof named, "/%s", identify_fields[fault->index]);
            pointer = named;
        }
        if (fault->argument == STRUM_IDENTIFY_ARG_FREQUENCIES && r->periods_s.count > 0)
            pointer = "/periods_s";
        if (pointer[0] != '\0')
            problem_add(p, pointer, "%s", fault->reason);
        return;
    }
    chain_refuse(&r->in, fault, status, p);
}

static const char *theory(const identify_request *r)
{
    return r->params.components != NULL ? "taut chain by transfer matrices (Levesque 1997; "
                                          "Sergev and Iwan 1980), least squares"
           : r->params.damping_ratios != NULL ? "taut string with a damper to ground, branches "
                                                "followed from no damping; least squares"
           : r->plane == 1
               ? "tensioned beam between rotational springs with the tension of a shallow sag "
                 "(Irvine and Caughey 1974); "
                 "weighted least squares from all minima of a scan, profile intervals"
               : "tensioned beam between rotational springs, exact characteristic equation; "
                 "weighted least squares from all "
                 "minima of a scan, profile intervals";
}

bool identify_answer(const void *data, answer *a)
{
    const identify_request *r = data;
    const strum_options options = answer_options(a);
    strum_error fault = {0};
    strum_identify *found = NULL;
    const strum_status status = strum_identify_solve(&r->params, &options, &found, &fault);
    if (status != STRUM_OK) {
        refuse(r, &fault, status, a->problem);
        return false;
    }
    const strum_identify_summary *s = strum_identify_summary_of(found);
    json_writer *json = a->result;
    a->theory = theory(r);
    identify_warn(r, found, a);
    json_open_object(json);
    write_estimates(json, found);
    put_finite(json, "tension_if_pinned_N", s->tension_if_pinned);
    put_finite(json, "tension_if_clamped_N", s->tension_if_clamped);
    write_end_tensions(json, r, found);
    write_modes(json, r, found);
    write_fit(json, s);
    write_identifiability(json, s);
    write_assignment(json, r, found);
    write_solutions(json, found);
    put_finite(json, "xi", s->xi);
    put_finite(json, "lambda_squared", s->lambda_squared);
    if (r->compare)
        identify_write_comparison(json, found);
    const bool good = !r->verify || write_verification(r, found, a);
    json_close_object(json);
    strum_identify_free(found);
    return good;
}
