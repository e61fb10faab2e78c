/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From frequencies back to the cable: what was put in comes out, what is wrong is named, what is
 * cancelled ends. */
#include <stdlib.h>
#include <string.h>

#include <strum/identify.h>

#include "check.h"
#include "core/identify/beam.h"

#define MODES 10

/* Ten frequencies of a beam of tension and stiffness, both ends of one fixity. */
typedef struct record {
    double f[MODES], sd[MODES];
    int modes[MODES];
    strum_identify_params p;
} record;

static void make(record *r, double tension, double bending, double length, double mass,
                 double rho)
{
    const double u = sqrt(bending / tension) / length;
    const beam_end ends[2] = {beam_end_by_fixity(rho, u), beam_end_by_fixity(rho, u)};
    *r = (record){.p = STRUM_IDENTIFY_PARAMS_INIT};
    for (int i = 0; i < MODES; i++) {
        r->modes[i] = i + 1;
        r->f[i] = beam_solve(i + 1, u, ends).om * sqrt(tension / mass) / (2 * M_PI * length);
        r->sd[i] = 1e-3 * r->f[0];
    }
    r->p.frequencies = r->f;
    r->p.standard_deviations = r->sd;
    r->p.modes = r->modes;
    r->p.count = MODES;
    r->p.quantities[STRUM_IDENTIFY_TENSION].unknown = true;
    r->p.quantities[STRUM_IDENTIFY_LENGTH].value = length;
    r->p.quantities[STRUM_IDENTIFY_MASS].value = mass;
    for (int i = 0; i < 2; i++)
        r->p.ends[i] = (strum_identify_end){STRUM_IDENTIFY_FIXED_FIXITY, rho};
}

static strum_identify *solve(const record *r)
{
    strum_identify *found = NULL;
    strum_error error = {0};
    if (strum_identify_solve(&r->p, NULL, &found, &error) != STRUM_OK)
        fail_msg("%s", error.reason);
    return found;
}

static double value_of(const strum_identify *f, strum_identify_quantity q)
{
    return strum_identify_estimate_of(f, q)->value;
}

static void what_was_put_in_comes_out(void **state)
{
    (void)state;
    for (double xi = 1.5; xi < 1500; xi *= 2.1)
        for (double rho = 0; rho <= 1; rho += 0.25) {
            record r;
            const double tension = 4e5, length = 31, bending = tension * pow(length / xi, 2);
            make(&r, tension, bending, length, 12, rho);
            r.p.quantities[STRUM_IDENTIFY_BENDING].unknown = true;
            strum_identify *found = solve(&r);
            check_relative(value_of(found, STRUM_IDENTIFY_TENSION), tension, 1e-9);
            check_relative(value_of(found, STRUM_IDENTIFY_BENDING), bending, 1e-6);
            strum_verification v;
            strum_error error;
            assert_int_equal(strum_identify_verify(found, &r.p, NULL, &v, &error), STRUM_OK);
            assert_true(v.max_relative_difference < 1e-12);
            assert_int_equal(v.modes_expected, v.modes_found);
            strum_identify_free(found);
            if (rho == 0)
                continue;
            r.p.quantities[STRUM_IDENTIFY_BENDING] = (strum_identify_value){false, bending, 0};
            r.p.quantities[STRUM_IDENTIFY_LENGTH].unknown = true;
            found = solve(&r);
            check_relative(value_of(found, STRUM_IDENTIFY_LENGTH), length,
                           xi < 100 ? 1e-7 : 1e-3);
            strum_identify_free(found);
        }
}

static void numbers_are_found_again(void **state)
{
    (void)state;
    const int seen[] = {2, 3, 5, 6, 8};
    record r;
    make(&r, 2e6, 3e5, 120, 60, 1);
    for (int i = 0; i < 5; i++) {
        r.f[i] = r.f[seen[i] - 1];
        r.sd[i] = r.sd[0];
    }
    r.p.count = 5;
    r.p.modes = NULL;
    r.p.quantities[STRUM_IDENTIFY_BENDING].unknown = true;
    strum_identify *found = solve(&r);
    const strum_identify_reading *readings;
    bool ambiguous, by_price;
    double assumed;
    assert_true(strum_identify_readings(found, &readings, &ambiguous, &by_price, &assumed) > 1);
    assert_memory_equal(readings[0].modes, seen, sizeof seen);
    assert_false(ambiguous);
    check_relative(readings[0].tension, 2e6, 1e-8);
    strum_identify_free(found);
}

static void shifted_numbers_are_noticed(void **state)
{
    (void)state;
    record r;
    make(&r, 2e6, 3e5, 120, 60, 1);
    memmove(r.f, r.f + 1, 5 * sizeof *r.f);
    r.p.count = 5;
    r.p.quantities[STRUM_IDENTIFY_BENDING].unknown = true;
    strum_identify *found = solve(&r);
    assert_int_equal(strum_identify_summary_of(found)->better_shift, 1);
    check_relative(strum_identify_summary_of(found)->shift_tension, 2e6, 1e-8);
    strum_identify_free(found);
}

/* ---- refusals ---- */

static void refused(const record *r, strum_status status, int argument, const char *says)
{
    strum_identify *found = NULL;
    strum_error error = {0};
    assert_int_equal(strum_identify_solve(&r->p, NULL, &found, &error), status);
    assert_null(found);
    assert_int_equal(error.argument, argument);
    if (strstr(error.reason, says) == NULL)
        fail_msg("%s: does not say %s", error.reason, says);
}

static void combinations_are_named(void **state)
{
    (void)state;
    record r;
    make(&r, 2e6, 3e5, 120, 60, 1);
    r.p.quantities[STRUM_IDENTIFY_MASS].unknown = true;
    r.p.quantities[STRUM_IDENTIFY_BENDING].unknown = true;
    refused(&r, STRUM_ERR_IMPOSSIBLE, STRUM_IDENTIFY_ARG_UNKNOWNS,
            "tension +1, bending_stiffness +1, mass +1");
    r.p.quantities[STRUM_IDENTIFY_MASS].unknown = false;
    r.p.quantities[STRUM_IDENTIFY_LENGTH].unknown = true;
    refused(&r, STRUM_ERR_IMPOSSIBLE, STRUM_IDENTIFY_ARG_UNKNOWNS,
            "bending_stiffness +1, length +0.25");
}

static void faults_are_named(void **state)
{
    (void)state;
    record r;
    make(&r, 2e6, 0, 120, 60, 0);
    r.f[3] = r.f[2];
    refused(&r, STRUM_ERR_RANGE, STRUM_IDENTIFY_ARG_FREQUENCIES, "ascend");
    make(&r, 2e6, 0, 120, 60, 0);
    r.modes[2] = 9;
    refused(&r, STRUM_ERR_RANGE, STRUM_IDENTIFY_ARG_MODES, "increase");
    make(&r, 2e6, 0, 120, 60, 0);
    r.p.quantities[STRUM_IDENTIFY_MASS].value = 0;
    refused(&r, STRUM_ERR_RANGE, STRUM_IDENTIFY_ARG_QUANTITIES, "missing");
    make(&r, 2e6, 1e4, 120, 60, 1);
    r.p.quantities[STRUM_IDENTIFY_BENDING].value = 1e12; /* far above what was measured */
    refused(&r, STRUM_ERR_IMPOSSIBLE, STRUM_IDENTIFY_ARG_FREQUENCIES, "compressed");
}

static bool at_once(void *context)
{
    int *left = context;
    return --*left < 0;
}

static void a_cancelled_solve_ends(void **state)
{
    (void)state;
    record r;
    make(&r, 2e6, 3e5, 120, 60, 1);
    r.p.quantities[STRUM_IDENTIFY_BENDING].unknown = true;
    for (int after = 0; after < 2000; after = 2 * after + 1) {
        int left = after;
        const strum_options options = {.cancelled = at_once, .context = &left};
        strum_identify *found = NULL;
        strum_error error = {0};
        const strum_status status = strum_identify_solve(&r.p, &options, &found, &error);
        assert_true(status == STRUM_ERR_CANCELLED || (status == STRUM_OK && after > 20));
        strum_identify_free(found);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_was_put_in_comes_out),
        cmocka_unit_test(numbers_are_found_again),
        cmocka_unit_test(shifted_numbers_are_noticed),
        cmocka_unit_test(combinations_are_named),
        cmocka_unit_test(faults_are_named),
        cmocka_unit_test(a_cancelled_solve_ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
