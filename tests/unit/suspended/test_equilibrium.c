/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equilibrium geometry against closed forms, published solutions and itself from other inputs.
 */
#include <strum/strum.h>

#include <stdlib.h>
#include <string.h>

#include "check.h"

static double uniform(double low, double high)
{
    return low + (high - low) * (rand() / (double)RAND_MAX);
}

/* Gale A-1: b/a = 2 mu, l/a = 2 cosh(chi_m) sinh(mu), h/a = 2 sinh(chi_m) sinh(mu); from chi
 * they are direct. */
static void every_input_form_gives_one_geometry(void **state)
{
    (void)state;
    for (int i = 0; i < 2000; i++) {
        const double chi_1 = uniform(-6, 5.9), chi_2 = uniform(chi_1 + 0.01, 6);
        strum_catenary direct, other;
        assert_int_equal(strum_catenary_from_chi(chi_1, chi_2, &direct, NULL), STRUM_OK);
        const double span = chi_2 - chi_1, rise = cosh(chi_2) - cosh(chi_1);
        const double length = sinh(chi_2) - sinh(chi_1);
        check_absolute(direct.span, span, 1e-14);
        check_absolute(direct.rise, rise, 1e-13 * cosh(6));
        check_relative(direct.length, length, 1e-12);

        /* l^2 - h^2 = (2 sinh mu)^2; 1 - p and l - chord are all that tells how taut the cable
         * is */
        const double mu = span / 2, p = mu / sinh(mu);
        assert_int_equal(strum_catenary_from_sag(rise / span, p, &other, NULL), STRUM_OK);
        check_relative(other.mu, mu, 1e-13 + 1e-15 / (1 - p));
        check_absolute(other.chi_m, direct.chi_m, 1e-12);
        assert_int_equal(
            strum_catenary_from_length(3 * span, 3 * rise, 3 * length, &other, NULL), STRUM_OK);
        check_relative(other.mu, mu, 1e-13 + 1e-15 * cosh(6) * cosh(direct.chi_m) / pow(mu, 3));
        assert_int_equal(strum_catenary_from_xi(strum_xi_of_chi(chi_1), strum_xi_of_chi(chi_2),
                                                &other, NULL),
                         STRUM_OK);
        check_relative(other.mu, direct.mu, 1e-11);
    }
}

/* tests by decimals: 1 - p is meant as typed, mu^2 = 6 (1/p - 1) (1 - (1/p - 1)/... ) by its
 * own series */
static void taut_cables_keep_their_digits(void **state)
{
    (void)state;
    const double parameters[] = {0.9999, 0.99999, 0.9999999, 0.999999999};
    const long double deficits[] = {1e-4L, 1e-5L, 1e-7L, 1e-9L};
    for (int i = 0; i < 4; i++) {
        strum_catenary c;
        assert_int_equal(strum_catenary_from_sag(0, parameters[i], &c, NULL), STRUM_OK);
        /* sinh(mu)/mu = 1/p: mu^2 = 6 d - (9/5)... inverted: with s = mu^2, s/6 + s^2/120 +
         * s^3/5040 = d */
        const long double d = deficits[i] / (1 - deficits[i]);
        long double s = 6 * d;
        for (int k = 0; k < 50; k++)
            s = 6 * (d - s * s / 120 - s * s * s / 5040 - s * s * s * s / 362880);
        check_relative(c.mu, (double)sqrtl(s), 3e-15);
    }
    /* 100 m span, 100.0001 m of cable: p = b/l with l meant as typed */
    strum_catenary by_length, by_sag;
    assert_int_equal(strum_catenary_from_length(100, 0, 100.0001, &by_length, NULL), STRUM_OK);
    const long double d = 1e-6L;
    long double s = 6 * d;
    for (int k = 0; k < 50; k++)
        s = 6 * (d - s * s / 120 - s * s * s / 5040);
    check_relative(by_length.mu, (double)sqrtl(s), 3e-15);
    assert_int_equal(strum_catenary_from_sag(0, 0.5, &by_sag, NULL), STRUM_OK);
    check_relative(sinh(by_sag.mu) / by_sag.mu, 2, 1e-15);
}

/* MoorPy's test_catenary: x 400, z 200, L 500, w 200; closed form H 43694.60643, V 22365.58863,
 * 77634.41137 */
static void published_catenary(void **state)
{
    (void)state;
    strum_catenary c;
    assert_int_equal(strum_catenary_from_length(400, 200, 500, &c, NULL), STRUM_OK);
    const double horizontal = 200 * 400 / c.span;
    check_relative(horizontal, 43694.60643, 1e-9);
    check_relative(horizontal * sinh(c.chi_m - c.mu), -22365.58863, 1e-9);
    check_relative(horizontal * sinh(c.chi_m + c.mu), 77634.41137, 1e-9);
    /* nearly inextensible */
    assert_int_equal(
        strum_catenary_from_unstretched(400, 200, 500, 200 * 500 / 7.51e12, &c, NULL),
        STRUM_OK);
    check_relative(200 * 500 / c.unstretched_length, 43694.60643, 1e-7);
}

/* Irvine: x(s) = (H s/EA) + (H/w)[asinh((V)/H)], z likewise; integrated here by quadrature of
 * the definition. */
static void elastic_catenary_spans_its_supports(void **state)
{
    (void)state;
    for (int i = 0; i < 300; i++) {
        const double span = uniform(1, 200), rise = uniform(-100, 100);
        const double chord = hypot(span, rise);
        const double length = chord * uniform(0.97, 1.5);
        const double strain = length < chord ? uniform(0.01, 2) : pow(10, uniform(-8, 0));
        strum_catenary c;
        strum_error fault;
        const strum_status status =
            strum_catenary_from_unstretched(span, rise, length, strain, &c, &fault);
        if (status == STRUM_ERR_RANGE) /* too steep or too taut for the documented range */
            continue;
        assert_int_equal(status, STRUM_OK);
        const double a = length / c.unstretched_length;
        double x = 0, y = 0, stretched = 0;
        const int steps = 4000;
        const double sigma_1 = sinh(c.chi_m - c.mu), sigma_2 = sinh(c.chi_m + c.mu);
        for (int k = 0; k <= steps; k++) { /* Simpson in chi, d sigma = cosh chi d chi */
            const double chi = c.chi_m + c.mu * (2.0 * k / steps - 1), s = cosh(chi);
            const double w = (k == 0 || k == steps ? 1
                              : k % 2 == 1         ? 4
                                                   : 2) *
                             2 * c.mu / steps / 3;
            const double stretch = 1 + c.kappa * s;
            x += w * stretch;
            y += w * stretch * sinh(chi);
            stretched += w * stretch * s;
        }
        check_relative(a * (sigma_2 - sigma_1), length, 1e-9);
        check_relative(a * x, span, 1e-9);
        check_absolute(a * y, rise, 1e-9 * chord);
        check_relative(c.length, stretched, 1e-9);
        check_relative(c.span * a, span, 1e-12);
        check_absolute(c.rise * a, rise, 1e-11 * chord);
        check_relative(c.kappa, strain / c.unstretched_length, 1e-14);
        double px, py;
        strum_catenary_point(&c, c.chi_m + c.mu, &px, &py);
        check_relative(px, c.span, 1e-12);
        check_absolute(py, c.rise, 1e-12 * hypot(c.span, c.rise));
    }
}

/* The sag is the largest vertical distance of chord and cable, found here by looking
 * everywhere. */
static void sag_is_the_largest_distance(void **state)
{
    (void)state;
    for (int i = 0; i < 100; i++) {
        strum_catenary c;
        const double length = uniform(1.01, 3);
        if (strum_catenary_from_unstretched(1, uniform(-0.1, 0.1), length,
                                            pow(10, uniform(-6, 0)), &c, NULL) != STRUM_OK)
            continue;
        double largest = 0;
        for (int k = 0; k <= 20000; k++) {
            double x, y;
            strum_catenary_point(&c, c.chi_m + c.mu * (k / 10000.0 - 1), &x, &y);
            largest = fmax(largest, c.rise / c.span * x - y);
        }
        check_relative(strum_catenary_sag(&c), largest, 1e-7);
    }
    /* a taut cable: sag/span = mu/4 (1 + mu^2/12 ..), which a difference would lose */
    strum_catenary c;
    assert_int_equal(strum_catenary_from_chi(-1e-7, 1e-7, &c, NULL), STRUM_OK);
    check_relative(strum_catenary_sag(&c) / c.span, 1e-7 / 4, 1e-13);
}

static void xi_and_chi_are_inverse(void **state)
{
    (void)state;
    for (int i = 0; i < 1000; i++) {
        const double chi = uniform(-12, 12) * pow(10, uniform(-12, 0));
        check_relative(strum_chi_of_xi(strum_xi_of_chi(chi)), chi, 1e-14);
    }
    check_relative(strum_xi_of_chi(3), cosh(3) - 1, 1e-15);
    check_relative(strum_xi_of_chi(-3), 1 - cosh(3), 1e-15);
}

/* Gale B-5, h = 0: omega^2 = INT z ds / INT z^2 ds, in closed form with z = cosh(mu) -
 * cosh(chi). */
static void rayleigh_estimate(void **state)
{
    (void)state;
    for (double mu = 0.5; mu < 6; mu += 0.5) {
        strum_catenary c;
        double w;
        assert_int_equal(strum_catenary_from_chi(-mu, mu, &c, NULL), STRUM_OK);
        assert_int_equal(strum_rayleigh_out_of_plane(&c, &w, NULL), STRUM_OK);
        /* INT cosh = 2 sinh mu; INT cosh^2 = mu + sinh(2mu)/2; INT cosh^3 = 2 (sinh + sinh^3/3)
         */
        const double s = sinh(mu), k = cosh(mu), c2 = mu + sinh(2 * mu) / 2;
        const double c3 = 2 * (s + s * s * s / 3);
        const double z1 = 2 * k * s - c2, z2 = 2 * k * k * s - 2 * k * c2 + c3;
        check_relative(w, sqrt(z1 / z2), 1e-10);
    }
}

static void impossible_and_unreachable_inputs_are_refused(void **state)
{
    (void)state;
    strum_catenary c;
    strum_error fault;
    assert_int_equal(strum_catenary_from_length(100, 0, 99, &c, &fault), STRUM_ERR_IMPOSSIBLE);
    assert_non_null(strstr(fault.reason, "99"));
    assert_int_equal(strum_catenary_from_length(3, 4, 5, &c, &fault), STRUM_ERR_IMPOSSIBLE);
    assert_int_equal(strum_catenary_from_length(3, 4, 5.0000001, &c, &fault), STRUM_OK);
    assert_int_equal(strum_catenary_from_length(0, 4, 5, &c, &fault), STRUM_ERR_RANGE);
    assert_int_equal(strum_catenary_from_length(NAN, 4, 5, &c, &fault), STRUM_ERR_RANGE);
    assert_int_equal(strum_catenary_from_length(1e-9, 0, 5, &c, &fault), STRUM_ERR_RANGE);
    assert_int_equal(strum_catenary_from_sag(0, 1, &c, &fault), STRUM_ERR_RANGE);
    assert_int_equal(strum_catenary_from_sag(0, 0, &c, &fault), STRUM_ERR_RANGE);
    assert_int_equal(strum_catenary_from_sag(INFINITY, 0.5, &c, &fault), STRUM_ERR_RANGE);
    assert_int_equal(strum_catenary_from_sag(1e9, 0.5, &c, &fault), STRUM_ERR_RANGE);
    assert_int_equal(strum_catenary_from_xi(1, 1, &c, &fault), STRUM_ERR_RANGE);
    assert_int_equal(strum_catenary_from_xi(1, 1e9, &c, &fault), STRUM_ERR_RANGE);
    assert_int_equal(strum_catenary_from_chi(2, 1, &c, &fault), STRUM_ERR_RANGE);
    assert_int_equal(strum_catenary_from_unstretched(1, 0, 1, 0, &c, &fault), STRUM_ERR_RANGE);
    assert_int_equal(strum_catenary_from_unstretched(1, 0, -1, 1, &c, &fault), STRUM_ERR_RANGE);
}

/* The argument of each error is the parameter that a caller would change. */
static void errors_name_their_argument(void **state)
{
    (void)state;
    strum_catenary c;
    strum_error e;
#define NAMES(call, which)                                                                     \
    do {                                                                                       \
        e = (strum_error){0};                                                                  \
        assert_int_not_equal(call, STRUM_OK);                                                  \
        assert_int_equal(e.argument, which);                                                   \
        assert_true(e.reason[0] != 0);                                                         \
    } while (0)
    NAMES(strum_catenary_from_sag(0, 1.5, &c, &e), STRUM_CATENARY_ARG_SAG_PARAMETER);
    NAMES(strum_catenary_from_sag(3, 1e-12, &c, &e), STRUM_CATENARY_ARG_SAG_PARAMETER);
    NAMES(strum_catenary_from_sag(0, 1e-9, &c, &e), STRUM_CATENARY_ARG_SAG_PARAMETER);
    NAMES(strum_catenary_from_sag(1e9, 0.5, &c, &e), STRUM_CATENARY_ARG_RISE);
    NAMES(strum_catenary_from_xi(1, 1, &c, &e), STRUM_CATENARY_ARG_XI);
    NAMES(strum_catenary_from_xi(1, 1e9, &c, &e), STRUM_CATENARY_ARG_XI);
    NAMES(strum_catenary_from_chi(2, 1, &c, &e), STRUM_CATENARY_ARG_CHI);
    NAMES(strum_catenary_from_chi(0, 13, &c, &e), STRUM_CATENARY_ARG_CHI);
    NAMES(strum_catenary_from_length(0, 4, 5, &c, &e), STRUM_CATENARY_ARG_SPAN);
    NAMES(strum_catenary_from_length(3, 4, 5, &c, &e), STRUM_CATENARY_ARG_LENGTH);
    NAMES(strum_catenary_from_length(1e-9, 0, 5, &c, &e), STRUM_CATENARY_ARG_LENGTH);
    NAMES(strum_catenary_from_unstretched(0, 0, 1, 1, &c, &e), STRUM_CATENARY_ARG_SPAN);
    NAMES(strum_catenary_from_unstretched(1, 0, 1, 0, &c, &e),
          STRUM_CATENARY_ARG_WEIGHT_STRAIN);
    NAMES(strum_catenary_from_unstretched(1, 0, 1e9, 1e-9, &c, &e), STRUM_CATENARY_ARG_LENGTH);
    NAMES(strum_catenary_from_chord(-1, 0, 0, &c, &e), STRUM_CATENARY_ARG_EPSILON);
    NAMES(strum_catenary_from_chord(1, 2, 0, &c, &e), STRUM_CATENARY_ARG_INCLINATION);
    NAMES(strum_catenary_from_chord(1, 0, -1, &c, &e), STRUM_CATENARY_ARG_WEIGHT_STRAIN);
#undef NAMES
}

int main(void)
{
    srand(1976);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_input_form_gives_one_geometry),
        cmocka_unit_test(taut_cables_keep_their_digits),
        cmocka_unit_test(published_catenary),
        cmocka_unit_test(elastic_catenary_spans_its_supports),
        cmocka_unit_test(sag_is_the_largest_distance),
        cmocka_unit_test(xi_and_chi_are_inverse),
        cmocka_unit_test(rayleigh_estimate),
        cmocka_unit_test(errors_name_their_argument),
        cmocka_unit_test(impossible_and_unreachable_inputs_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
