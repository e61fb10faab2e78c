/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Natural frequencies and shapes against closed forms, an integrated oracle and the second
 * method. */
#include <strum/strum.h>

#include <stdlib.h>
#include <time.h>

#include "check.h"
#include "suspended/modes.h"
#include "suspended/shooting.h"

static double uniform(double low, double high)
{
    return low + (high - low) * (rand() / (double)RAND_MAX);
}

static strum_cable plain(double chi_1, double chi_2)
{
    return (strum_cable){
        .chi_m = (chi_1 + chi_2) / 2, .mu = (chi_2 - chi_1) / 2, .mass_t = 1, .mass_n = 1};
}

static strum_modes *solved(const strum_cable *cable, strum_plane plane, int count, bool shapes)
{
    strum_modes *spectrum;
    strum_error fault = {0};
    if (strum_modes_solve(&(strum_modes_params){*cable, plane, count, shapes}, NULL, &spectrum,
                          &fault) != STRUM_OK)
        fail_msg("chi_m %.17g mu %.17g: %s", cable->chi_m, cable->mu, fault.reason);
    assert_int_equal(strum_modes_count(spectrum), count);
    return spectrum;
}

static double frequency(const strum_modes *spectrum, int mode)
{
    return mode_at(spectrum, mode - 1).frequency;
}

/* Exact inextensible level catenary, Omega = omega sqrt(S/g) with S the arc length (published
 * table). */
static void published_level_catenaries(void **state)
{
    (void)state;
    static const struct {
        double degrees, in_plane[5], out_of_plane[3];
    } rows[] = {
        {5,
         {15.00271816, 21.49326647, 30.04671951, 36.95710637, 45.08151442},
         {7.51801401, 15.03166810, 22.54629377}},
        {30,
         {5.62244991, 8.50591071, 11.81810598, 14.70344230, 17.87324593},
         {3.04265425, 6.01671054, 9.00766469}},
        {60,
         {3.07741345, 5.30992641, 7.41872246, 9.42183917, 11.43614457},
         {2.09678767, 3.94303740, 5.87677824}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const double chi = asinh(tan(rows[i].degrees * M_PI / 180));
        const double scale = sqrt(2 * sinh(chi)); /* sqrt(S/a) */
        const strum_cable cable = plain(-chi, chi);
        strum_modes *in = solved(&cable, STRUM_IN_PLANE, 5, false);
        strum_modes *out = solved(&cable, STRUM_OUT_OF_PLANE, 3, false);
        for (int k = 0; k < 5; k++)
            check_absolute(frequency(in, k + 1) * scale, rows[i].in_plane[k], 6e-9);
        for (int k = 0; k < 3; k++)
            check_absolute(frequency(out, k + 1) * scale, rows[i].out_of_plane[k], 6e-9);
        strum_modes_free(in);
        strum_modes_free(out);
    }
}

/* Irvine and Caughey, shallow limit: symmetric roots of tan(b/2) = b/2 - (4/lambda^2)(b/2)^3,
 * antisymmetric 2 n pi, out of plane n pi; b = 2 mu omega, lambda^2 = (2 mu)^2/kappa. The error
 * is O(mu^2). */
static void shallow_elastic_limit(void **state)
{
    (void)state;
    static const double table[][4] = {
        {0.1, 1.00409744823, 3.00015223684, 5.00003286381},
        {4, 1.15182280544, 3.00632880394, 5.00133461656},
        {20, 1.60953642787, 3.03750897874, 5.00711724162},
        {100, 2.59718454463, 3.47967507554, 5.05266279231},
        {1000, 2.84826363845, 4.89257074009, 6.89041196199},
    };
    const double mu = 1e-5;
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        strum_cable cable = plain(-mu, mu);
        cable.kappa_t = 4 * mu * mu / table[i][0];
        strum_modes *in = solved(&cable, STRUM_IN_PLANE, 8, false);
        int symmetric = 0, antisymmetric = 0;
        for (int k = 1; k <= 8; k++) {
            const double b = 2 * mu * frequency(in, k);
            const strum_symmetry which = mode_at(in, k - 1).symmetry;
            if (which == STRUM_SYMMETRIC && symmetric++ < 3)
                check_relative(b / M_PI, table[i][symmetric], 1e-9);
            if (which == STRUM_ANTISYMMETRIC)
                check_relative(b / M_PI, 2.0 * ++antisymmetric, 1e-9);
        }
        assert_true(symmetric >= 3 && antisymmetric >= 3);
        strum_modes_free(in);
    }
}

static strum_cable random_cable(double reach)
{
    const double chi_1 = uniform(-reach, reach), width = uniform(0.02, reach);
    const double chi_2 = fmin(chi_1 + width, reach + 0.02);
    strum_cable cable =
        plain(rand() % 3 == 0 ? -width / 2 : chi_1, rand() % 3 == 0 ? width / 2 : chi_2);
    if (cable.mu <= 0)
        cable = plain(-width / 2, width / 2);
    if (rand() % 2)
        cable.kappa_t = pow(10, uniform(-9, 0));
    if (cable.kappa_t > 0 && rand() % 2)
        cable.kappa_n = cable.kappa_t;
    if (rand() % 3 == 0)
        cable.mass_n = uniform(1, 3);
    return cable;
}

static void random_undamped_modes_are_roots(void **state)
{
    (void)state;
    for (int i = 0; i < 25; i++) {
        const strum_cable cable = random_cable(2.5);
        const int count = 1 + rand() % 8;
        strum_modes *in = solved(&cable, STRUM_IN_PLANE, count, false);
        for (int k = 1; k <= count; k++) {
            const double error = shooting_error(&cable, CMPLX(0, frequency(in, k)));
            if (!(error < 1e-9))
                fail_msg("chi_m %.17g mu %.17g kappa %g %g mass %g: mode %d error %.1e",
                         cable.chi_m, cable.mu, cable.kappa_t, cable.kappa_n, cable.mass_n, k,
                         error);
        }
        strum_modes_free(in);
    }
}

static void random_damped_modes_are_roots(void **state)
{
    (void)state;
    for (int i = 0; i < 12; i++) {
        strum_cable cable = random_cable(2);
        const double w = M_PI / (2 * cable.mu);
        cable.eta_t = uniform(0, 0.5) * w;
        cable.eta_n = uniform(0, 2) * w;
        strum_modes *in = solved(&cable, STRUM_IN_PLANE, 4, false);
        const double *decays;
        const int overdamped = (int)strum_modes_overdamped(in, &decays);
        for (int k = 0; k < 4; k++) {
            const strum_mode m_at = mode_at(in, k), *m = &m_at;
            assert_true(m->decay > 0);
            assert_true(shooting_error(&cable, CMPLX(-m->decay, m->frequency)) < 1e-8);
        }
        for (int k = 0; k < overdamped; k++)
            assert_true(shooting_error(&cable, -decays[k]) < 1e-7);
        strum_modes_free(in);
    }
}

/* Deep cables and many modes, where sizes, stretched coordinate and quadrature are at their
 * limits: two sizes that share a fault agree, the integrated oracle does not. */
static void deep_cables_with_many_modes(void **state)
{
    (void)state;
    static const double rows[][3] = {
        {-1, 3e4, 1e-3}, {-1000, 1000, 1e-3}, {-1e4, 1e4, 0}, {0.05, 4e3, 0.1}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        strum_catenary c;
        assert_int_equal(strum_catenary_from_xi(rows[i][0], rows[i][1], &c, NULL), STRUM_OK);
        strum_cable cable = {
            .chi_m = c.chi_m, .mu = c.mu, .mass_t = 1, .mass_n = 1, .kappa_t = rows[i][2]};
        strum_modes *in = solved(&cable, STRUM_IN_PLANE, 60, false);
        for (int k = 1; k <= 60; k += 19)
            check_absolute(shooting_error(&cable, CMPLX(0, frequency(in, k))), 0, 2e-12);
        strum_modes_free(in);
    }
}

/* The second method agrees, counts the same, and the shapes meet the supports. */
static void second_method_agrees(void **state)
{
    (void)state;
    for (int i = 0; i < 60; i++) {
        strum_cable cable = random_cable(i % 2 ? 3 : 7);
        const strum_plane plane = i % 3 == 0 ? STRUM_OUT_OF_PLANE : STRUM_IN_PLANE;
        if (i % 4 == 0)
            cable.eta_n = cable.eta_t = uniform(0, 0.3);
        if (i % 8 == 0)
            cable.eta_t = 0;
        const int count = 1 + rand() % 12;
        strum_modes *spectrum = solved(&cable, plane, count, true);
        strum_verification v;
        assert_int_equal(strum_modes_verify(spectrum, NULL, &v, NULL), STRUM_OK);
        if (!(v.max_relative_difference < 1e-12 && v.modes_expected == count &&
              v.max_residual < 1e-9))
            fail_msg("plane %d chi_m %.17g mu %.17g kappa %g: %s: difference %.1e, %d of %d, "
                     "residual %.1e",
                     plane, cable.chi_m, cable.mu, cable.kappa_t, v.method,
                     v.max_relative_difference, v.modes_found, v.modes_expected,
                     v.max_residual);
        strum_modes_free(spectrum);
    }
}

/* A level elastic cable whose first symmetric and antisymmetric modes coincide has two modes
 * there (reference values: half-cable shooting in high precision for each parity). */
static void exact_crossing_gives_both_modes(void **state)
{
    (void)state;
    static const double rows[][3] = {{0.99, .0062927165960379377, 12.533177014574412},
                                     {0.97, .020209494673890738, 6.9040302987636845}};
    for (int i = 0; i < 2; i++) {
        strum_catenary c;
        assert_int_equal(strum_catenary_from_sag(0, rows[i][0], &c, NULL), STRUM_OK);
        strum_cable cable = plain(-c.mu, c.mu);
        cable.kappa_t = rows[i][1];
        strum_modes *in = solved(&cable, STRUM_IN_PLANE, 3, true);
        check_relative(frequency(in, 1), rows[i][2], 1e-9);
        check_relative(frequency(in, 2), rows[i][2], 1e-9);
        assert_true(frequency(in, 3) > 1.2 * rows[i][2]);
        assert_int_not_equal(mode_at(in, 0).symmetry, mode_at(in, 1).symmetry);
        strum_verification v;
        assert_int_equal(strum_modes_verify(in, NULL, &v, NULL), STRUM_OK);
        assert_int_equal(v.modes_expected, 3);
        strum_modes_free(in);
    }
}

/* eta_t = eta_n = eta: s^2 + eta s + omega^2 = 0 exactly, in plane and out of plane; overdamped
 * pairs listed. */
static void uniform_damping_is_exact(void **state)
{
    (void)state;
    const strum_cable bare = plain(-0.8, 1.4);
    for (int plane = 0; plane < 2; plane++) {
        strum_modes *free_modes = solved(&bare, (strum_plane)plane, 12, false);
        strum_cable damped = bare;
        damped.eta_t = damped.eta_n = 2.1 * frequency(free_modes, 3);
        strum_modes *modes = solved(&damped, (strum_plane)plane, 6, false);
        const double *decays;
        assert_int_equal(strum_modes_overdamped(modes, &decays), 6);
        for (int k = 1; k <= 3; k++) {
            const double half = damped.eta_n / 2, w = frequency(free_modes, k);
            check_relative(decays[k - 1], half - sqrt(half * half - w * w), 1e-11);
            check_relative(decays[6 - k], half + sqrt(half * half - w * w), 1e-11);
        }
        for (int k = 1; k <= 6; k++) {
            const double half = damped.eta_n / 2, w = frequency(free_modes, k + 3);
            check_relative(frequency(modes, k), sqrt(w * w - half * half), 1e-11);
            check_relative(mode_at(modes, k - 1).decay, half, 1e-12);
        }
        strum_modes_free(free_modes);
        strum_modes_free(modes);
    }
}

/* Turning a cable end for end changes nothing. */
static void end_reversal_changes_nothing(void **state)
{
    (void)state;
    strum_cable cable = plain(-0.4, 1.9), turned = plain(-1.9, 0.4);
    cable.kappa_t = turned.kappa_t = 0.01;
    cable.eta_n = turned.eta_n = 0.2;
    strum_modes *a = solved(&cable, STRUM_IN_PLANE, 8, true);
    strum_modes *b = solved(&turned, STRUM_IN_PLANE, 8, true);
    strum_shape_point left[21], right[21];
    for (int k = 0; k < 8; k++) {
        check_relative(frequency(a, k + 1), frequency(b, k + 1), 1e-12);
        assert_int_equal(strum_modes_shape(a, k, NULL, 21, left), STRUM_OK);
        assert_int_equal(strum_modes_shape(b, k, NULL, 21, right), STRUM_OK);
        /* normalised at the same place, so they agree up to the sign of the turned components
         */
        const double sign = creal(left[10].normal) * creal(right[10].normal) >= 0 ? 1 : -1;
        for (int i = 0; i < 21; i++)
            check_absolute(cabs(left[i].normal - sign * right[20 - i].normal), 0, 1e-8);
    }
    strum_modes_free(a);
    strum_modes_free(b);
}

/* Largest displacement is 1; an inextensible cable does not stretch: du/dalpha = v, so u_chi =
 * v/cosh chi. */
static void shapes_are_normalised_and_inextensible(void **state)
{
    (void)state;
    enum { N = 2001 };
    static strum_shape_point shape[N];
    const strum_cable cable = plain(-0.7, 1.6);
    strum_modes *in = solved(&cable, STRUM_IN_PLANE, 4, true);
    for (int k = 0; k < 4; k++) {
        assert_int_equal(strum_modes_shape(in, k, NULL, N, shape), STRUM_OK);
        double largest = 0, most = 0;
        for (int i = 0; i < N; i++) {
            for (int c = 0; c < 2; c++) {
                const double value = creal(c ? shape[i].normal : shape[i].tangential);
                if (fabs(value) > fabs(largest))
                    largest = value;
            }
            assert_true(cimag(shape[i].normal) == 0);
        }
        check_absolute(largest, 1, 1e-5);
        assert_true(largest <= 1 + 1e-12);
        const double h = shape[1].chi - shape[0].chi;
        for (int i = 1; i < N - 1; i++) {
            const double slope =
                creal(shape[i + 1].tangential - shape[i - 1].tangential) / (2 * h);
            most = fmax(most, fabs(slope - creal(shape[i].normal) / cosh(shape[i].chi)));
        }
        assert_true(most < 1e-4);
        check_absolute(cabs(shape[0].normal), 0, 1e-9);
        check_absolute(cabs(shape[N - 1].tangential), 0, 1e-9);
    }
    strum_modes_free(in);
}

/* Total mass: with a heavier normal mass every frequency falls; as sqrt(mass) where motion is
 * all normal. */
static void added_mass_lowers_frequencies(void **state)
{
    (void)state;
    strum_cable cable = plain(-0.5, 0.9);
    strum_modes *bare = solved(&cable, STRUM_OUT_OF_PLANE, 5, false);
    cable.mass_n = 2.25;
    strum_modes *loaded = solved(&cable, STRUM_OUT_OF_PLANE, 5, false);
    for (int k = 1; k <= 5; k++)
        check_relative(frequency(loaded, k), frequency(bare, k) / 1.5, 1e-13);
    strum_modes_free(bare);
    strum_modes_free(loaded);
}

/* Of many peaks that are nearly alike the largest is found, not the one beside a sample. */
static void no_point_of_a_shape_exceeds_one(void **state)
{
    (void)state;
    enum { N = 4001, MODES = 40 };
    static strum_shape_point shape[N];
    for (int plane = 0; plane < 2; plane++) {
        const strum_cable cable = plain(-0.0673, 0.0873);
        strum_modes *spectrum = solved(&cable, (strum_plane)plane, MODES, true);
        for (int k = 0; k < MODES; k++) {
            double largest = 0;
            assert_int_equal(strum_modes_shape(spectrum, k, NULL, N, shape), STRUM_OK);
            for (int i = 0; i < N; i++)
                largest = fmax(largest, fmax(cabs(shape[i].normal), cabs(shape[i].tangential)));
            check_absolute(largest, 1, 1e-3);
            assert_true(largest <= 1 + 1e-10);
        }
        strum_modes_free(spectrum);
    }
}

/* 200 modes, ordered, none missed: the second method counts them. */
static void two_hundred_modes(void **state)
{
    (void)state;
    const strum_cable cable = plain(-1.1827255397923292, 1.1827255397923292);
    for (int plane = 0; plane < 2; plane++) {
        strum_modes *spectrum = solved(&cable, (strum_plane)plane, 200, true);
        for (int k = 2; k <= 200; k++)
            assert_true(frequency(spectrum, k) > frequency(spectrum, k - 1));
        strum_verification v;
        assert_int_equal(strum_modes_verify(spectrum, NULL, &v, NULL), STRUM_OK);
        assert_int_equal(v.modes_expected, 200);
        check_absolute(v.max_relative_difference, 0, 1e-12);
        strum_modes_free(spectrum);
    }
}

/* Where no shapes are asked for another formulation may answer (displacement instead of force):
 * in unknown, equation and boundary conditions independent of the first. */
static void frequencies_alone_are_the_same(void **state)
{
    (void)state;
    srand(5);
    for (int i = 0; i < 60; i++) {
        const double steepest = uniform(0.01, 2.6), mu = steepest * uniform(0.05, 1);
        strum_cable cable = {.chi_m = i % 3 == 0 ? 0 : steepest - mu,
                             .mu = i % 3 == 0 ? steepest : mu,
                             .mass_t = 1,
                             .mass_n = i % 4 == 0 ? 1.7 : 1};
        if (i % 5 == 0) /* damping that is proportional to mass, below critical */
            cable.eta_t = 0.3 * M_PI / cable.mu, cable.eta_n = cable.eta_t * cable.mass_n;
        const int count = i % 10 == 0 ? 60 : 1 + i % 9;
        strum_modes *alone = solved(&cable, STRUM_IN_PLANE, count, false);
        strum_modes *shapes = solved(&cable, STRUM_IN_PLANE, count, true);
        for (int k = 1; k <= count; k++) {
            check_relative(frequency(alone, k), frequency(shapes, k), 1e-14);
            assert_int_equal(mode_at(alone, k - 1).symmetry, mode_at(shapes, k - 1).symmetry);
        }
        strum_modes_free(alone);
        strum_modes_free(shapes);
    }
}

static void what_cannot_be_solved_is_refused(void **state)
{
    (void)state;
    strum_modes *spectrum = NULL;
    strum_error fault;
    strum_cable cable = plain(-1, 1);
    assert_int_equal(strum_modes_solve(&(strum_modes_params){cable, STRUM_IN_PLANE, 0, false},
                                       NULL, &spectrum, &fault),
                     STRUM_ERR_RANGE);
    assert_null(spectrum);
    assert_int_equal(strum_modes_solve(&(strum_modes_params){cable, STRUM_IN_PLANE, 201, false},
                                       NULL, &spectrum, &fault),
                     STRUM_ERR_RANGE);
    cable.mass_n = 0;
    assert_int_equal(strum_modes_solve(&(strum_modes_params){cable, STRUM_IN_PLANE, 1, false},
                                       NULL, &spectrum, &fault),
                     STRUM_ERR_RANGE);
    cable = plain(-1, 1);
    cable.kappa_t = NAN;
    assert_int_equal(strum_modes_solve(&(strum_modes_params){cable, STRUM_IN_PLANE, 1, false},
                                       NULL, &spectrum, &fault),
                     STRUM_ERR_RANGE);
    cable = plain(-13, 13);
    assert_int_equal(strum_modes_solve(&(strum_modes_params){cable, STRUM_IN_PLANE, 1, false},
                                       NULL, &spectrum, &fault),
                     STRUM_ERR_RANGE);
    cable = plain(-1, 1);
    cable.eta_n = 1e5; /* tens of thousands of overdamped modes */
    assert_int_equal(strum_modes_solve(&(strum_modes_params){cable, STRUM_IN_PLANE, 1, false},
                                       NULL, &spectrum, &fault),
                     STRUM_ERR_RANGE);
    cable = plain(-1, 1);
    strum_shape_point shape[2];
    strum_verification v;
    spectrum = solved(&cable, STRUM_IN_PLANE, 1, false);
    assert_int_equal(strum_modes_shape(spectrum, 0, NULL, 2, shape), STRUM_ERR_METHOD);
    assert_int_equal(strum_modes_verify(spectrum, NULL, &v, &fault), STRUM_ERR_METHOD);
    strum_modes_free(spectrum);
    spectrum = solved(&cable, STRUM_IN_PLANE, 1, true);
    assert_int_equal(strum_modes_shape(spectrum, 1, NULL, 2, shape), STRUM_ERR_RANGE);
    assert_int_equal(strum_modes_shape(spectrum, 0, NULL, 1, shape), STRUM_ERR_RANGE);
    strum_modes_free(spectrum);
}

typedef struct stop {
    long asked, after;
    double until_s; /* CPU time of the thread */
} stop;

static double cpu_s(void)
{
    struct timespec now;
    (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static bool after_some_questions(void *context)
{
    stop *s = context;
    return ++s->asked > s->after;
}

static bool after_some_time(void *context)
{
    return cpu_s() > ((stop *)context)->until_s;
}

/* Cancelled at each place in turn where a solve asks: an error, no modes, nothing left. */
static void a_solve_can_be_stopped_anywhere(void **state)
{
    (void)state;
    const strum_modes_params kinds[] = {{plain(-1, 2), STRUM_IN_PLANE, 4, true},
                                        {plain(-1, 2), STRUM_OUT_OF_PLANE, 4, true},
                                        {plain(-1, 1), STRUM_IN_PLANE, 6, false}};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        strum_modes *modes;
        strum_error error;
        strum_verification v;
        stop s = {.after = 0};
        const strum_options options = {.cancelled = after_some_questions, .context = &s},
                            little = {.work_max = 1e-3};
        strum_status status = STRUM_ERR_CANCELLED;
        for (; status != STRUM_OK; s.after += 1 + s.after / 4) {
            s.asked = 0;
            status = strum_modes_solve(&kinds[k], &options, &modes, &error);
            assert_true(status == STRUM_OK || (status == STRUM_ERR_CANCELLED && modes == NULL));
        }
        assert_true(s.after >= 2);
        s = (stop){.after = 0};
        if (kinds[k].shapes)
            assert_int_equal(strum_modes_verify(modes, &options, &v, &error),
                             STRUM_ERR_CANCELLED);
        strum_modes_free(modes);
        assert_int_equal(strum_modes_solve(&kinds[k], &little, &modes, &error), STRUM_ERR_WORK);
    }
}

/* The heaviest question: what is asked to stop after 0.1 s has stopped soon after. */
static void a_heavy_solve_stops_in_time(void **state)
{
    (void)state;
    strum_modes_params params = {plain(-12.5, 12.5), STRUM_IN_PLANE, 200, true};
    stop s = {0};
    const strum_options options = {.cancelled = after_some_time, .context = &s};
    for (int damped = 0; damped < 2; damped++) {
        strum_modes *modes;
        strum_error error;
        if (damped) {
            params.cable = plain(-2, 3);
            params.cable.eta_n = 0.2;
            params.count = 60;
        }
        const double begun = cpu_s();
        s.until_s = begun + 0.1;
        assert_int_equal(strum_modes_solve(&params, &options, &modes, &error),
                         STRUM_ERR_CANCELLED);
        /* what one call of LAPACK takes, and what a sanitizer makes of the rest */
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
        assert_true(cpu_s() - begun < 20);
#else
        assert_true(cpu_s() - begun < 1.5);
#endif
    }
}

int main(void)
{
    srand(1976);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(published_level_catenaries),
        cmocka_unit_test(shallow_elastic_limit),
        cmocka_unit_test(random_undamped_modes_are_roots),
        cmocka_unit_test(random_damped_modes_are_roots),
        cmocka_unit_test(deep_cables_with_many_modes),
        cmocka_unit_test(second_method_agrees),
        cmocka_unit_test(exact_crossing_gives_both_modes),
        cmocka_unit_test(uniform_damping_is_exact),
        cmocka_unit_test(end_reversal_changes_nothing),
        cmocka_unit_test(shapes_are_normalised_and_inextensible),
        cmocka_unit_test(no_point_of_a_shape_exceeds_one),
        cmocka_unit_test(added_mass_lowers_frequencies),
        cmocka_unit_test(two_hundred_modes),
        cmocka_unit_test(frequencies_alone_are_the_same),
        cmocka_unit_test(what_cannot_be_solved_is_refused),
        cmocka_unit_test(a_solve_can_be_stopped_anywhere),
        cmocka_unit_test(a_heavy_solve_stops_in_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
