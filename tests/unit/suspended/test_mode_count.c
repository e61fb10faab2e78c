/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The exact count of modes, and the strain form, against the spectrum they are independent of.
 */
#include <strum/strum.h>

#include <stdlib.h>

#include "check.h"
#include "suspended/modes.h"
#include "core/suspended/modes.h"
#include "core/suspended/strain.h"

static double uniform(double low, double high)
{
    return low + (high - low) * (rand() / (double)RAND_MAX);
}

static int count_below(const strum_cable *cable, double frequency)
{
    int count = -1;
    strum_error fault = {0};
    if (strum_modes_below(cable, frequency, NULL, &count, &fault) != STRUM_OK)
        fail_msg("%s", fault.reason);
    return count;
}

/* Taut string with longitudinal waves: chi small, frequencies n pi/(2 mu) across and j
 * pi/(2 mu sqrt(kappa m_t)) along, in all ratios; the sag is O(mu). */
static void taut_string(void **state)
{
    (void)state;
    for (int i = 0; i < 20; i++) {
        const double mu = 1e-7, ratio = uniform(0.1, 20), mass_t = uniform(0.2, 2);
        const strum_cable cable = {
            .mu = mu, .kappa_t = ratio, .mass_t = mass_t, .mass_n = uniform(1, 2)};
        const double across = M_PI / (2 * mu * sqrt(cable.mass_n));
        const double along = M_PI / (2 * mu * sqrt(ratio * mass_t));
        const double frequency = uniform(0.2, 40) * across;
        assert_int_equal(count_below(&cable, frequency),
                         (int)(frequency / across) + (int)(frequency / along));
    }
}

static strum_cable random_cable(double reach)
{
    const double chi_1 = uniform(-reach, reach - 0.02);
    const double chi_2 = uniform(chi_1 + 0.01, reach);
    strum_cable cable = {.chi_m = (chi_1 + chi_2) / 2,
                         .mu = (chi_2 - chi_1) / 2,
                         .mass_t = 1,
                         .mass_n = rand() % 2 ? 1 : uniform(1, 3)};
    if (rand() % 3 == 0)
        cable.chi_m = 0;
    if (rand() % 2)
        cable.kappa_t = pow(10, uniform(-9, 0));
    if (cable.kappa_t > 0 && rand() % 2)
        cable.kappa_n = cable.kappa_t;
    return cable;
}

/* Just below mode n there are n - 1 modes, just above it n. */
static void random_spectra(void **state)
{
    (void)state;
    for (int i = 0; i < 60; i++) {
        const strum_cable cable = random_cable(i % 3 == 0 ? 6 : 2);
        const int modes = 1 + rand() % 10;
        strum_modes *spectrum;
        assert_int_equal(
            strum_modes_solve(&(strum_modes_params){cable, STRUM_IN_PLANE, modes, false}, NULL,
                              &spectrum, NULL),
            STRUM_OK);
        for (int k = 0; k < modes; k++) {
            const double w = mode_at(spectrum, k).frequency;
            const double below = k > 0 ? mode_at(spectrum, k - 1).frequency : 0;
            if (w - below < 1e-6 * w)
                continue; /* a crossing: neither side of it is between two modes */
            if (count_below(&cable, w * (1 - 1e-9)) != k)
                fail_msg("chi_m %.17g mu %.17g kappa %g: %d modes below mode %d", cable.chi_m,
                         cable.mu, cable.kappa_t, count_below(&cable, w * (1 - 1e-9)), k + 1);
        }
        const double last = mode_at(spectrum, modes - 1).frequency;
        assert_in_range(count_below(&cable, last * (1 + 1e-9)), modes, modes + 1);
        strum_modes_free(spectrum);
    }
}

static void strain_form_agrees(void **state)
{
    (void)state;
    for (int i = 0; i < 40; i++) {
        const strum_cable cable = random_cable(2.5);
        const int modes = 1 + rand() % 8;
        strum_modes *spectrum;
        assert_int_equal(
            strum_modes_solve(&(strum_modes_params){cable, STRUM_IN_PLANE, modes, true}, NULL,
                              &spectrum, NULL),
            STRUM_OK);
        arena memory = {0};
        root_list list = {0};
        assert_int_equal(strain_roots(&cable, &spectrum->coordinate, spectrum->size + 8, modes,
                                      &memory, &list),
                         STRUM_OK);
        for (int k = 0; k < modes; k++)
            check_relative(cimag(list.items[k].s), mode_at(spectrum, k).frequency, 1e-12);
        arena_free(&memory);
        strum_modes_free(spectrum);
    }
}

static void refusals(void **state)
{
    (void)state;
    int count;
    strum_cable cable = {.mu = 0.5, .mass_t = 1, .mass_n = 1, .eta_n = 0.1};
    assert_int_equal(strum_modes_below(&cable, 1, NULL, &count, NULL), STRUM_ERR_METHOD);
    cable.eta_n = 0;
    assert_int_equal(strum_modes_below(&cable, NAN, NULL, &count, NULL), STRUM_ERR_RANGE);
    assert_int_equal(strum_modes_below(&cable, 0, NULL, &count, NULL), STRUM_ERR_RANGE);
    assert_int_equal(strum_modes_below(&cable, 1e12, NULL, &count, NULL), STRUM_ERR_RANGE);
    cable.mass_t = 0;
    assert_int_equal(strum_modes_below(&cable, 1, NULL, &count, NULL), STRUM_ERR_RANGE);
}

static bool at_once(void *asked)
{
    return ++*(int *)asked > 10;
}

/* A count of 10^5 steps ends when it is asked to. */
static void a_count_can_be_stopped(void **state)
{
    (void)state;
    const strum_cable cable = {.mu = 0.5, .mass_t = 1, .mass_n = 1}, bad = {.mu = -1};
    int count, asked = 0;
    strum_error error = {0};
    const strum_options stop = {.cancelled = at_once, .context = &asked},
                        little = {.work_max = 100};
    assert_int_equal(strum_modes_below(&cable, 4e4, &stop, &count, &error),
                     STRUM_ERR_CANCELLED);
    assert_int_equal(asked, 11);
    assert_int_equal(strum_modes_below(&cable, 4e4, &little, &count, &error), STRUM_ERR_WORK);
    assert_int_equal(strum_modes_below(&bad, 1, NULL, &count, &error), STRUM_ERR_RANGE);
    assert_int_equal(error.argument, STRUM_MODES_ARG_CABLE);
    strum_modes *modes;
    error = (strum_error){0};
    assert_int_equal(strum_modes_solve(&(strum_modes_params){bad, STRUM_IN_PLANE, 3, false},
                                       NULL, &modes, &error),
                     STRUM_ERR_RANGE);
    assert_int_equal(error.argument, STRUM_MODES_ARG_CABLE);
}

int main(void)
{
    srand(1984);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(taut_string),
        cmocka_unit_test(random_spectra),
        cmocka_unit_test(strain_form_agrees),
        cmocka_unit_test(refusals),
        cmocka_unit_test(a_count_can_be_stopped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
