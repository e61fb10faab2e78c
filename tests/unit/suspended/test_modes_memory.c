/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equilibrium, modes and series while every allocation fails in turn: each function either says
 * so or has the right result. */
#include <complex.h>
#include <stdlib.h>
#include <string.h>

#include <strum/catenary.h>
#include <strum/modes.h>
#include <strum/series.h>

#include "check.h"

static long allocations, failing = -1; /* count, and number of the one that fails (-1: none) */

static bool refuse_memory(void)
{
    return allocations++ == failing;
}

#include "failing_memory.h"

/* What each of the questions came to. */
enum { SAG, XI, CHI, LENGTH, ELASTIC, CHORD, RAYLEIGH, BELOW, SERIES, SOLVE, SHAPE, VERIFY };
enum { QUESTIONS = VERIFY + 1, MODES = 4, POINTS = 5 };

typedef struct answers {
    strum_status status[QUESTIONS]; /* STRUM_ERR_INTERNAL: was not asked */
    strum_catenary catenaries[6];
    double rayleigh;
    int below;
    strum_mode series[MODES], modes[MODES];
    strum_shape_point shape[POINTS];
    strum_verification verification;
} answers;

static void ask_equilibrium(answers *a, strum_error *error)
{
    strum_catenary *c = a->catenaries;
    a->status[SAG] = strum_catenary_from_sag(0.2, 0.8, &c[0], error);
    a->status[XI] = strum_catenary_from_xi(-0.3, 1, &c[1], error);
    a->status[CHI] = strum_catenary_from_chi(-0.3, 1, &c[2], error);
    a->status[LENGTH] = strum_catenary_from_length(100, 10, 110, &c[3], error);
    a->status[ELASTIC] = strum_catenary_from_unstretched(100, 10, 100, 1e-2, &c[4], error);
    a->status[CHORD] = strum_catenary_from_chord(0.5, 0.3, 0, &c[5], error);
    a->status[RAYLEIGH] = strum_rayleigh_out_of_plane(&c[2], &a->rayleigh, error);
}

static void ask_all(const strum_cable *cable, strum_plane plane, answers *a)
{
    strum_error error = {0};
    strum_modes *modes;
    strum_series_report report;
    strum_cable undamped = *cable;
    undamped.eta_t = undamped.eta_n = undamped.kappa_t = undamped.kappa_n = 0;
    memset(a, 0, sizeof *a);
    for (int i = 0; i < QUESTIONS; i++)
        a->status[i] = STRUM_ERR_INTERNAL;
    ask_equilibrium(a, &error);
    a->status[BELOW] = strum_modes_below(&undamped, 9, NULL, &a->below, &error);
    a->status[SERIES] =
        strum_series_solve(&(strum_series_params){undamped, plane, MODES, false}, NULL,
                           a->series, &report, &error);
    a->status[SOLVE] = strum_modes_solve(&(strum_modes_params){*cable, plane, MODES, true},
                                         NULL, &modes, &error);
    assert_true((a->status[SOLVE] == STRUM_OK) == (modes != NULL));
    if (modes == NULL) {
        assert_int_equal(error.status, a->status[SOLVE]);
        return;
    }
    for (size_t i = 0; i < MODES; i++)
        assert_int_equal(strum_modes_get(modes, i, &a->modes[i]), STRUM_OK);
    a->status[SHAPE] = strum_modes_shape(modes, 1, NULL, POINTS, a->shape);
    a->status[VERIFY] = strum_modes_verify(modes, NULL, &a->verification, &error);
    strum_modes_free(modes);
}

#define SAME(question, member)                                                                 \
    do {                                                                                       \
        if (got->status[question] == STRUM_OK)                                                 \
            assert_memory_equal(&got->member, &right->member, sizeof got->member);             \
    } while (0)

static void expect_right(const answers *got, const answers *right)
{
    for (int i = SAG; i <= CHORD; i++)
        SAME(i, catenaries[i]);
    SAME(RAYLEIGH, rayleigh);
    SAME(BELOW, below);
    for (int i = 0; i < MODES; i++) {
        SAME(SERIES, series[i].frequency);
        SAME(SOLVE, modes[i].frequency);
        SAME(SOLVE, modes[i].decay);
    }
    SAME(SHAPE, shape);
    SAME(VERIFY, verification.max_relative_difference);
    SAME(VERIFY, verification.max_residual);
    SAME(VERIFY, verification.modes_expected);
}

/* Every allocation in turn: exactly one question meets it and says so, all others that could be
 * asked are answered rightly. */
static void fail_each(const strum_cable *cable, strum_plane plane)
{
    static answers right, got;
    long hits = 0;
    ask_all(cable, plane, &right);
    for (int i = 0; i < QUESTIONS; i++)
        assert_int_equal(right.status[i], STRUM_OK);
    assert_true(right.verification.max_relative_difference < 1e-9);
    for (failing = 0;; failing++, hits++) {
        int refused = 0;
        allocations = 0;
        ask_all(cable, plane, &got);
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
    assert_true(hits > 30);
}

static void a_level_cable(void **state)
{
    (void)state;
    const strum_cable cable = {.mu = 0.9, .mass_t = 1, .mass_n = 1};
    fail_each(&cable, STRUM_IN_PLANE);
    fail_each(&cable, STRUM_OUT_OF_PLANE);
}

static void an_elastic_inclined_cable(void **state)
{
    (void)state;
    fail_each(
        &(strum_cable){.chi_m = 0.3, .mu = 0.9, .kappa_t = 1e-2, .mass_t = 1, .mass_n = 1},
        STRUM_IN_PLANE);
}

/* Damping that is not proportional to mass: the quadratic problem. */
static void a_damped_cable(void **state)
{
    (void)state;
    fail_each(&(strum_cable){.chi_m = 0.3, .mu = 0.9, .mass_t = 1, .mass_n = 1, .eta_n = 0.3},
              STRUM_IN_PLANE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_level_cable),
        cmocka_unit_test(an_elastic_inclined_cable),
        cmocka_unit_test(a_damped_cable),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
