/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forced motion against shooting, statics, resonances and sums of harmonics. */
#include <strum/strum.h>

#include <stdlib.h>

#include <string.h>
#include <time.h>

#include "check.h"
#include "suspended/modes.h"

#include <complex.h>

static double uniform(double low, double high)
{
    return low + (high - low) * (rand() / (double)RAND_MAX);
}

static strum_cable random_cable(void)
{
    const double mu = uniform(0.05, 1.6);
    strum_cable cable = {.chi_m = rand() % 3 == 0 ? 0 : uniform(-1.2, 1.2),
                         .mu = mu,
                         .mass_t = 1,
                         .mass_n = rand() % 2 ? 1 : uniform(1, 2.5)};
    if (rand() % 2)
        cable.kappa_t = pow(10, uniform(-6, -1));
    if (rand() % 2)
        cable.kappa_n = cable.kappa_t;
    if (rand() % 3 == 0) {
        cable.eta_t = uniform(0, 0.5) / mu;
        cable.eta_n = rand() % 2 ? cable.eta_t * cable.mass_n : uniform(0, 1) / mu;
    }
    return cable;
}

/* The Galerkin response and the integrated one, at random frequencies and places. */
static void responses_agree_with_shooting(void **state)
{
    (void)state;
    for (int i = 0; i < 60; i++) {
        const strum_cable cable = random_cable();
        const double highest = uniform(0.1, 12) / cable.mu;
        strum_forced *forced;
        strum_error fault;
        if (strum_forced_solve(&(strum_forced_params){cable, highest, true, true}, NULL,
                               &forced, &fault) != STRUM_OK)
            fail_msg("%s", fault.reason);
        strum_response *response;
        assert_int_equal(strum_response_make(forced, &response, NULL), STRUM_OK);
        const strum_end_motion motion = {uniform(-1, 1), CMPLX(uniform(-1, 1), i % 2),
                                         uniform(-1, 1)};
        for (int j = 0; j < 3; j++) {
            const double frequency = highest * uniform(0.001, 1);
            strum_forced_point shot[9];
            double largest[4] = {0}, worst[4] = {0};
            if (strum_response_solve(response, frequency, &motion, NULL) != STRUM_OK)
                continue;
            for (int k = 0; k < 9; k++)
                shot[k].chi = cable.chi_m + cable.mu * (k / 4.0 - 1);
            assert_int_equal(
                strum_forced_shoot(&cable, frequency, &motion, shot, 9, NULL, NULL), STRUM_OK);
            for (int k = 0; k < 9; k++) {
                strum_forced_point at;
                strum_response_at(response, shot[k].chi, &at);
                const double _Complex pairs[4][2] = {{at.tangential, shot[k].tangential},
                                                     {at.normal, shot[k].normal},
                                                     {at.out_of_plane, shot[k].out_of_plane},
                                                     {at.tension, shot[k].tension}};
                for (int c = 0; c < 4; c++) {
                    largest[c] = fmax(largest[c], cabs(pairs[c][1]));
                    worst[c] = fmax(worst[c], cabs(pairs[c][0] - pairs[c][1]));
                }
            }
            const double moved = fmax(largest[0], largest[1]);
            if (!(worst[0] < 1e-8 * moved && worst[1] < 1e-8 * moved &&
                  worst[2] < 1e-8 * largest[2] && worst[3] < 1e-8 * largest[3]))
                fail_msg("chi_m %g mu %g kappa %g %g mass %g eta %g %g frequency %g: %.1e %.1e "
                         "%.1e %.1e",
                         cable.chi_m, cable.mu, cable.kappa_t, cable.kappa_n, cable.mass_n,
                         cable.eta_t, cable.eta_n, frequency, worst[0] / moved,
                         worst[1] / moved, worst[2] / largest[2], worst[3] / largest[3]);
        }
        strum_response_free(response);
        strum_forced_free(forced);
    }
}

/* No sample of the tension exceeds the peak, and the peak is reached. */
static void peak_is_the_largest(void **state)
{
    (void)state;
    for (int i = 0; i < 40; i++) {
        const strum_cable cable = random_cable();
        const double highest = uniform(1, 15) / cable.mu;
        strum_forced *forced;
        assert_int_equal(strum_forced_solve(&(strum_forced_params){cable, highest, true, false},
                                            NULL, &forced, NULL),
                         STRUM_OK);
        strum_response *response;
        assert_int_equal(strum_response_make(forced, &response, NULL), STRUM_OK);
        const strum_end_motion motion = {uniform(-1, 1), uniform(-1, 1), 0};
        if (strum_response_solve(response, highest, &motion, NULL) == STRUM_OK) {
            strum_peak peak;
            strum_forced_point at;
            double largest = 0;
            strum_response_peak(response, &peak);
            for (int k = 0; k <= 20000; k++) {
                strum_response_at(response, cable.chi_m + cable.mu * (k / 10000.0 - 1), &at);
                largest = fmax(largest, cabs(at.tension));
            }
            assert_true(peak.tension >= largest * (1 - 1e-13));
            check_relative(peak.tension, largest, 1e-6);
            strum_response_at(response, peak.chi, &at);
            check_relative(cabs(at.tension), peak.tension, 1e-11);
            check_absolute(cos(peak.phase), creal(at.tension) / cabs(at.tension), 1e-7);
        }
        strum_response_free(response);
        strum_forced_free(forced);
    }
}

/* Statics: pulling an inextensible level cable slowly at one end changes its shape to the
 * catenary of the new span; T = t.dF with dF the change of end forces, here by a difference of
 * exact equilibria. */
static void frequency_zero_is_the_difference_of_equilibria(void **state)
{
    (void)state;
    const double span = 2, rise = 0.6, length = 2.6, step = 1e-5;
    strum_catenary before, after, base;
    assert_int_equal(strum_catenary_from_length(span, rise, length, &base, NULL), STRUM_OK);
    const double a = span / base.span;
    const strum_cable cable = {.chi_m = base.chi_m, .mu = base.mu, .mass_t = 1, .mass_n = 1};
    strum_forced *forced;
    assert_int_equal(
        strum_forced_solve(&(strum_forced_params){cable, 0, true, false}, NULL, &forced, NULL),
        STRUM_OK);
    strum_response *response;
    assert_int_equal(strum_response_make(forced, &response, NULL), STRUM_OK);
    for (int direction = 0; direction < 2; direction++) {
        const double dx = direction == 0 ? step : 0, dy = step - dx;
        assert_int_equal(
            strum_catenary_from_length(span - dx, rise - dy, length, &before, NULL), STRUM_OK);
        assert_int_equal(strum_catenary_from_length(span + dx, rise + dy, length, &after, NULL),
                         STRUM_OK);
        /* end forces in units of w a: H and V at end 1; the Cartesian dynamic force is constant
         * in statics */
        const double ab = (span - dx) / before.span / a, aa = (span + dx) / after.span / a;
        const double fx = (aa - ab) / (2 * step / a);
        const double fy =
            (aa * sinh(after.chi_m - after.mu) - ab * sinh(before.chi_m - before.mu)) /
            (2 * step / a);
        const double chi_2 = base.chi_m + base.mu, c = 1 / cosh(chi_2), s = tanh(chi_2);
        const strum_end_motion motion = {direction == 0 ? c : s, direction == 0 ? -s : c, 0};
        assert_int_equal(strum_response_solve(response, 0, &motion, NULL), STRUM_OK);
        for (int k = 0; k <= 4; k++) {
            const double chi = base.chi_m + base.mu * (k / 2.0 - 1);
            strum_forced_point at;
            strum_response_at(response, chi, &at);
            check_absolute(creal(at.tension), fx / cosh(chi) + fy * tanh(chi), 1e-7);
        }
    }
    strum_response_free(response);
    strum_forced_free(forced);
}

/* Resonances are the natural frequencies; beside one, |T| (omega/omega_n - 1) tends to the
 * residue; on it there is no answer, unless the cable is damped. */
static void resonances_are_natural_frequencies(void **state)
{
    (void)state;
    const strum_cable cable = {
        .chi_m = 0.436, .mu = 0.803, .mass_t = 1, .mass_n = 1.3, .kappa_t = 1e-3};
    strum_forced *forced;
    assert_int_equal(
        strum_forced_solve(&(strum_forced_params){cable, 12, true, true}, NULL, &forced, NULL),
        STRUM_OK);
    strum_response *response;
    assert_int_equal(strum_response_make(forced, &response, NULL), STRUM_OK);
    const strum_end_motion motion = {0.3, -0.2, 1};
    strum_resonance list[64], met;
    const int count = (int)strum_forced_count(forced);
    assert_in_range(count, 8, 64);
    for (int i = 0; i < count; i++) {
        assert_int_equal(strum_forced_get(forced, (size_t)i, &motion, &list[i]), STRUM_OK);
        assert_true(i == 0 || list[i].frequency >= list[i - 1].frequency);
        assert_int_equal(strum_forced_get(forced, (size_t)i, NULL, &met), STRUM_OK);
        assert_true(met.frequency == list[i].frequency && met.residue == 0);
    }
    assert_int_equal(strum_forced_get(forced, (size_t)count, &motion, &met), STRUM_ERR_RANGE);
    for (int plane = 0; plane < 2; plane++) {
        strum_modes *spectrum;
        int modes = 0;
        for (int i = 0; i < count; i++)
            modes += list[i].plane == (strum_plane)plane;
        assert_true(modes > 3);
        assert_int_equal(strum_modes_solve(
                             &(strum_modes_params){cable, (strum_plane)plane, modes + 1, false},
                             NULL, &spectrum, NULL),
                         STRUM_OK);
        assert_true(mode_at(spectrum, modes).frequency > 12);
        for (int i = 0; i < count; i++)
            if (list[i].plane == (strum_plane)plane)
                check_relative(list[i].frequency, mode_at(spectrum, list[i].mode - 1).frequency,
                               1e-12);
        strum_modes_free(spectrum);
    }
    for (int i = 0; i < count; i++) {
        if (list[i].plane != STRUM_IN_PLANE)
            continue;
        strum_peak peak;
        assert_int_equal(
            strum_response_solve(response, list[i].frequency * (1 + 1e-6), &motion, NULL),
            STRUM_OK);
        strum_response_peak(response, &peak);
        check_relative(peak.tension * 1e-6, list[i].residue, 2e-2);
        assert_int_equal(strum_response_solve(response, list[i].frequency, &motion, &met),
                         STRUM_ERR_METHOD);
        check_relative(met.frequency, list[i].frequency, 1e-12);
    }
    strum_response_free(response);
    strum_forced_free(forced);
    strum_cable damped = cable;
    damped.eta_t = damped.eta_n = 0.01;
    assert_int_equal(strum_forced_solve(&(strum_forced_params){damped, 12, true, false}, NULL,
                                        &forced, NULL),
                     STRUM_OK);
    assert_int_equal(strum_response_make(forced, &response, NULL), STRUM_OK);
    assert_int_equal(strum_response_solve(response, list[0].frequency, &motion, NULL),
                     STRUM_OK);
    strum_response_free(response);
    strum_forced_free(forced);
}

/* Pulled sideways slowly: statics out of plane of an elastic profile is W_chi = (1 + kappa cosh
 * chi) V with V constant, so W is the share of the horizontal projection x: a straight line in
 * plan. */
static void slow_sideways_motion_is_straight_in_plan(void **state)
{
    (void)state;
    strum_catenary c;
    assert_int_equal(strum_catenary_from_unstretched(10, 3, 10.2, 0.4, &c, NULL), STRUM_OK);
    const strum_cable cable = {.chi_m = c.chi_m,
                               .mu = c.mu,
                               .kappa_t = c.kappa,
                               .kappa_n = c.kappa,
                               .mass_t = 1,
                               .mass_n = 1};
    strum_forced *forced;
    assert_int_equal(
        strum_forced_solve(&(strum_forced_params){cable, 0, false, true}, NULL, &forced, NULL),
        STRUM_OK);
    strum_response *response;
    assert_int_equal(strum_response_make(forced, &response, NULL), STRUM_OK);
    const strum_end_motion motion = {0, 0, 1};
    assert_int_equal(strum_response_solve(response, 0, &motion, NULL), STRUM_OK);
    for (int i = 0; i <= 10; i++) {
        const double chi = c.chi_m + c.mu * (i / 5.0 - 1);
        double x, y;
        strum_forced_point at;
        strum_catenary_point(&c, chi, &x, &y);
        strum_response_at(response, chi, &at);
        check_absolute(creal(at.out_of_plane), x / c.span, 1e-12);
    }
    strum_response_free(response);
    strum_forced_free(forced);
}

/* A sum of harmonics never exceeds its peak, and takes that value at the phase that is named.
 */
static void periodic_peak_is_the_largest(void **state)
{
    (void)state;
    const strum_cable cable = {.chi_m = 0.2, .mu = 0.9, .mass_t = 1, .mass_n = 1};
    strum_forced *forced;
    assert_int_equal(
        strum_forced_solve(&(strum_forced_params){cable, 6, true, false}, NULL, &forced, NULL),
        STRUM_OK);
    const int multiples[3] = {1, 2, 5};
    const strum_end_motion motions[3] = {
        {0.01, 0, 0}, {0, 0.004, 0}, {CMPLX(0.001, 0.002), 0, 0}};
    strum_response *responses[3];
    for (int k = 0; k < 3; k++) {
        assert_int_equal(strum_response_make(forced, &responses[k], NULL), STRUM_OK);
        assert_int_equal(
            strum_response_solve(responses[k], 1.1 * multiples[k], &motions[k], NULL),
            STRUM_OK);
    }
    strum_periodic_peak peak;
    assert_int_equal(strum_periodic_peak_find(responses, multiples, 3, &peak), STRUM_OK);
    double largest = 0;
    for (int i = 0; i <= 400; i++) {
        double _Complex tension[3];
        for (int k = 0; k < 3; k++) {
            strum_forced_point at;
            strum_response_at(responses[k], cable.chi_m + cable.mu * (i / 200.0 - 1), &at);
            tension[k] = at.tension;
        }
        for (int j = 0; j < 720; j++) {
            double sum = 0;
            for (int k = 0; k < 3; k++)
                sum += creal(tension[k] * cexp(CMPLX(0, multiples[k] * j * M_PI / 360)));
            largest = fmax(largest, fabs(sum));
        }
    }
    assert_true(fabs(peak.tension) >= largest * (1 - 1e-12));
    check_relative(fabs(peak.tension), largest, 1e-3);
    double there = 0;
    for (int k = 0; k < 3; k++) {
        strum_forced_point at;
        strum_response_at(responses[k], peak.chi, &at);
        there += creal(at.tension * cexp(CMPLX(0, multiples[k] * peak.phase)));
        strum_response_free(responses[k]);
    }
    check_relative(there, peak.tension, 1e-9);
    strum_forced_free(forced);
}

static void what_cannot_be_forced_is_refused(void **state)
{
    (void)state;
    strum_cable cable = {.mu = 1, .mass_t = 1, .mass_n = 1};
    strum_forced *forced = NULL;
    strum_error fault;
    assert_int_equal(strum_forced_solve(&(strum_forced_params){cable, -1, true, false}, NULL,
                                        &forced, &fault),
                     STRUM_ERR_RANGE);
    assert_int_equal(strum_forced_solve(&(strum_forced_params){cable, NAN, true, false}, NULL,
                                        &forced, &fault),
                     STRUM_ERR_RANGE);
    assert_int_equal(strum_forced_solve(&(strum_forced_params){cable, 1e4, true, false}, NULL,
                                        &forced, &fault),
                     STRUM_ERR_RANGE);
    assert_int_equal(fault.argument, STRUM_FORCED_ARG_FREQUENCY);
    assert_null(forced);
    cable.mu = 0;
    assert_int_equal(strum_forced_solve(&(strum_forced_params){cable, 1, true, false}, NULL,
                                        &forced, &fault),
                     STRUM_ERR_RANGE);
    assert_int_equal(fault.argument, STRUM_FORCED_ARG_CABLE);
    cable.mu = 1;
    assert_int_equal(strum_forced_solve(&(strum_forced_params){cable, 1, true, false}, NULL,
                                        &forced, &fault),
                     STRUM_OK);
    strum_response *response;
    assert_int_equal(strum_response_make(forced, &response, NULL), STRUM_OK);
    const strum_end_motion motion = {1, 0, 0};
    assert_int_equal(strum_response_solve(response, 1.5, &motion, NULL), STRUM_ERR_RANGE);
    assert_int_equal(strum_response_solve(response, -1, &motion, NULL), STRUM_ERR_RANGE);
    strum_response_free(response);
    strum_forced_free(forced);
}

/* A response keeps what it needs of its system, whichever is freed first (seen by
 * AddressSanitizer). */
static void a_response_outlives_its_system(void **state)
{
    (void)state;
    const strum_forced_params params = {{.mu = 1, .mass_t = 1, .mass_n = 1}, 3, true, false};
    const strum_end_motion motion = {0.01, 0, 0};
    strum_forced *forced;
    strum_response *first, *second;
    strum_peak right, got;
    assert_int_equal(strum_forced_solve(&params, NULL, &forced, NULL), STRUM_OK);
    assert_int_equal(strum_response_make(forced, &first, NULL), STRUM_OK);
    assert_int_equal(strum_response_make(forced, &second, NULL), STRUM_OK);
    assert_int_equal(strum_response_solve(first, 1.5, &motion, NULL), STRUM_OK);
    strum_response_peak(first, &right);
    strum_forced_free(forced);
    strum_response_free(first);
    assert_int_equal(strum_response_solve(second, 1.5, &motion, NULL), STRUM_OK);
    strum_response_peak(second, &got);
    assert_memory_equal(&got, &right, sizeof got);
    strum_response_free(second);
}

static double cpu_s(void)
{
    struct timespec now;
    (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* However high the frequency, the second method ends: within its steps, or when told to. */
static void shooting_is_bounded(void **state)
{
    (void)state;
    const strum_cable cable = {.mu = 1, .mass_t = 1, .mass_n = 1};
    const strum_end_motion motion = {0.01, 0.01, 0.01};
    strum_forced_point at = {.chi = 0};
    strum_error fault = {0};
    const double high[] = {1e5, 1e6, 1e12, 1e160, 1e300};
    for (size_t i = 0; i < sizeof high / sizeof *high; i++) {
        const double before = cpu_s();
        assert_int_equal(strum_forced_shoot(&cable, high[i], &motion, &at, 1, NULL, &fault),
                         STRUM_ERR_ACCURACY);
        assert_non_null(strstr(fault.reason, "steps"));
        assert_true(cpu_s() - before < 5); /* 20,000 steps, under any sanitizer */
    }
    assert_int_equal(strum_forced_shoot(&cable, INFINITY, &motion, &at, 1, NULL, &fault),
                     STRUM_ERR_RANGE);
    assert_int_equal(fault.argument, STRUM_FORCED_ARG_FREQUENCY);
    const strum_cable none = {.mu = NAN, .mass_t = 1, .mass_n = 1};
    assert_int_equal(strum_forced_shoot(&none, 1, &motion, &at, 1, NULL, &fault),
                     STRUM_ERR_RANGE);
    assert_int_equal(fault.argument, STRUM_FORCED_ARG_CABLE);
    const strum_options few = {.work_max = 1000};
    assert_int_equal(strum_forced_shoot(&cable, 1e6, &motion, &at, 1, &few, &fault),
                     STRUM_ERR_WORK);
}

typedef struct stop {
    long asked, after;
} stop;

static bool stopped(void *context)
{
    stop *s = context;
    return ++s->asked > s->after;
}

/* Cancelled at each place in turn where it asks: no answer, nothing left behind. */
static void stop_each(bool in_plane, bool out_of_plane)
{
    const strum_forced_params params = {
        {.chi_m = 1, .mu = 2, .mass_t = 1, .mass_n = 1, .eta_n = 0.3},
        20,
        in_plane,
        out_of_plane};
    strum_error fault;
    stop s = {.after = 0};
    const strum_options options = {.cancelled = stopped, .context = &s};
    for (;; s.after += 1 + s.after / 4) { /* far apart where there are many */
        strum_forced *forced;
        s.asked = 0;
        const strum_status status = strum_forced_solve(&params, &options, &forced, &fault);
        if (status == STRUM_OK) {
            strum_forced_free(forced);
            break;
        }
        assert_int_equal(status, STRUM_ERR_CANCELLED);
        assert_null(forced);
    }
    assert_true(s.after >= 1);
    strum_forced *forced;
    const strum_options little = {.work_max = 1};
    assert_int_equal(strum_forced_solve(&params, &little, &forced, &fault), STRUM_ERR_WORK);
    assert_null(forced);
}

static void a_solve_can_be_stopped(void **state)
{
    (void)state;
    stop_each(true, false);
    stop_each(false, true);
    stop_each(true, true);
}

int main(void)
{
    srand(1976);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(responses_agree_with_shooting),
        cmocka_unit_test(peak_is_the_largest),
        cmocka_unit_test(frequency_zero_is_the_difference_of_equilibria),
        cmocka_unit_test(resonances_are_natural_frequencies),
        cmocka_unit_test(a_response_outlives_its_system),
        cmocka_unit_test(shooting_is_bounded),
        cmocka_unit_test(a_solve_can_be_stopped),
        cmocka_unit_test(slow_sideways_motion_is_straight_in_plan),
        cmocka_unit_test(periodic_peak_is_the_largest),
        cmocka_unit_test(what_cannot_be_forced_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
