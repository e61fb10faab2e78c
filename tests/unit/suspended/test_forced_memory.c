/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forced motion while every allocation fails in turn: each function either says so or has the
 * right result. */
#include <strum/forced.h>

#include <complex.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"

/* ---- allocations that fail: the linker sends malloc and its kin here ---- */

static long allocations, failing = -1; /* count, and number of the one that fails (-1: none) */

static bool refuse_memory(void)
{
    return allocations++ == failing;
}

#include "failing_memory.h"

/* ---- everything a caller can ask, in turn ---- */

enum { RESONANCES = 16, PLACES = 5, HARMONICS = 2 };
static const int multiples[HARMONICS] = {1, 2};
static const strum_end_motion motions[HARMONICS] = {{0.01, 0.002, 0.003}, {0.004, 0, 0}};
#define FREQUENCY 1.7

/* What each of the questions came to. */
enum { SOLVE, MAKE, RESPOND, PEAK, PERIODIC, LIST, SHOOT, VERIFY, QUESTIONS };

typedef struct answers {
    strum_status status[QUESTIONS]; /* STRUM_ERR_INTERNAL: was not asked */
    size_t count;
    strum_resonance list[RESONANCES];
    strum_forced_point at, shot[PLACES];
    strum_peak peak;
    strum_periodic_peak periodic;
    double tension, displacement;
} answers;

static strum_status list(const strum_forced *forced, answers *a)
{
    strum_status status = STRUM_OK;
    a->count = strum_forced_count(forced);
    assert_in_range(a->count, 1, RESONANCES);
    for (size_t i = 0; i < a->count && status == STRUM_OK; i++)
        status = strum_forced_get(forced, i, &motions[0], &a->list[i]);
    return status;
}

static void ask_responses(strum_response *const r[HARMONICS], answers *a)
{
    a->status[RESPOND] = STRUM_OK;
    for (int k = 0; k < HARMONICS && a->status[RESPOND] == STRUM_OK; k++)
        a->status[RESPOND] =
            strum_response_solve(r[k], FREQUENCY * multiples[k], &motions[k], NULL);
    if (a->status[RESPOND] != STRUM_OK)
        return;
    strum_response_at(r[0], 0.4, &a->at);
    strum_response_peak(r[0], &a->peak);
    a->status[PEAK] = STRUM_OK;
    a->status[PERIODIC] = strum_periodic_peak_find(r, multiples, HARMONICS, &a->periodic);
    a->status[VERIFY] = strum_response_verify(r[0], NULL, &a->tension, &a->displacement, NULL);
}

static void ask_all(const strum_cable *cable, answers *a)
{
    const strum_forced_params params = {*cable, 2 * FREQUENCY, true, true};
    strum_forced *forced;
    strum_response *r[HARMONICS] = {NULL};
    strum_error error = {0};
    memset(a, 0, sizeof *a);
    for (int i = 0; i < QUESTIONS; i++)
        a->status[i] = STRUM_ERR_INTERNAL;
    for (int i = 0; i < PLACES; i++)
        a->shot[i].chi = cable->chi_m + cable->mu * (2.0 * i / (PLACES - 1) - 1);
    a->status[SHOOT] =
        strum_forced_shoot(cable, FREQUENCY, &motions[0], a->shot, PLACES, NULL, &error);
    a->status[SOLVE] = strum_forced_solve(&params, NULL, &forced, &error);
    assert_true((a->status[SOLVE] == STRUM_OK) == (forced != NULL));
    if (forced == NULL) {
        assert_int_equal(error.status, a->status[SOLVE]);
        return;
    }
    a->status[LIST] = list(forced, a);
    a->status[MAKE] = STRUM_OK;
    for (int k = 0; k < HARMONICS && a->status[MAKE] == STRUM_OK; k++) {
        a->status[MAKE] = strum_response_make(forced, &r[k], &error);
        assert_true((a->status[MAKE] == STRUM_OK) == (r[k] != NULL));
    }
    if (a->status[MAKE] == STRUM_OK)
        ask_responses(r, a);
    for (int k = 0; k < HARMONICS; k++)
        strum_response_free(r[k]);
    strum_forced_free(forced);
}

#define SAME(question, member)                                                                 \
    do {                                                                                       \
        if (got->status[question] == STRUM_OK)                                                 \
            assert_memory_equal(&got->member, &right->member, sizeof got->member);             \
    } while (0)

static void expect_right(const answers *got, const answers *right)
{
    SAME(LIST, count);
    for (size_t i = 0; got->status[LIST] == STRUM_OK && i < right->count; i++) {
        assert_true(got->list[i].frequency == right->list[i].frequency);
        assert_true(got->list[i].residue == right->list[i].residue);
        assert_int_equal(got->list[i].mode, right->list[i].mode);
    }
    SAME(RESPOND, at);
    SAME(PEAK, peak);
    SAME(PERIODIC, periodic);
    SAME(SHOOT, shot);
    SAME(VERIFY, tension);
    SAME(VERIFY, displacement);
}

/* Every allocation in turn: exactly one question meets it and says so, all others that could be
 * asked are answered rightly. */
static void fail_each(const strum_cable *cable)
{
    static answers right, got;
    long hits = 0;
    ask_all(cable, &right);
    for (int i = 0; i < QUESTIONS; i++)
        assert_int_equal(right.status[i], STRUM_OK);
    assert_true(right.tension < 1e-8 && right.displacement < 1e-8);
    for (failing = 0;; failing++, hits++) {
        int refused = 0;
        allocations = 0;
        ask_all(cable, &got);
        if (allocations <= failing)
            break;
        for (int i = 0; i < QUESTIONS; i++)
            refused += got.status[i] == STRUM_ERR_MEMORY;
        if (refused != 1)
            fail_msg("allocation %ld failed, and %d questions said so", failing, refused);
        expect_right(&got, &right);
    }
    failing = -1;
    expect_right(&got, &right);
    assert_true(hits > 50);
}

static void an_undamped_cable(void **state)
{
    (void)state;
    fail_each(&(strum_cable){.mu = 0.9, .mass_t = 1, .mass_n = 1});
}

static void a_damped_inclined_cable(void **state)
{
    (void)state;
    fail_each(&(strum_cable){
        .chi_m = 0.3, .mu = 0.9, .kappa_t = 1e-3, .mass_t = 1, .mass_n = 1.2, .eta_n = 0.3});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_undamped_cable),
        cmocka_unit_test(a_damped_inclined_cable),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
