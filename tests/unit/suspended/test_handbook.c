/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The handbook's closed forms against published roots and against the exact cable near its
 * limits. */
#include <strum/strum.h>

#include "check.h"
#include "suspended/modes.h"

/* b/pi of tan(b/2) = b/2 - (4/lambda^2)(b/2)^3 (Irvine and Caughey), to 12 digits. */
static void published_roots(void **state)
{
    (void)state;
    static const double table[][4] = {
        {0.1, 1.00409744823, 3.00015223684, 5.00003286381},
        {4, 1.15182280544, 3.00632880394, 5.00133461656},
        {20, 1.60953642787, 3.03750897874, 5.00711724162},
        {100, 2.59718454463, 3.47967507554, 5.05266279231},
        {1000, 2.84826363845, 4.89257074009, 6.89041196199},
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        for (int k = 1; k <= 3; k++)
            check_relative(strum_handbook_root(table[i][0], k) / M_PI, table[i][k], 6e-12);
    const double crossing = 4 * M_PI * M_PI;
    check_relative(strum_handbook_root(crossing, 1) / M_PI, 2, 1e-15);
    check_relative(strum_handbook_root(crossing, 2) / M_PI, 3.09342222806, 6e-12);
    check_relative(strum_handbook_root(crossing, 3) / M_PI, 5.01527810753, 6e-12);
    /* inextensible: tan x = x at 4.49340945790906 and 7.72525183693771 */
    check_relative(strum_handbook_root(INFINITY, 1) / 2, 4.49340945790906, 1e-15);
    check_relative(strum_handbook_root(INFINITY, 2) / 2, 7.72525183693771, 1e-15);
    /* a taut string: b = (2k - 1) pi + 4 lambda^2/((2k - 1) pi)^3 */
    for (int k = 1; k <= 100; k++) {
        const double odd = (2 * k - 1) * M_PI, b = strum_handbook_root(1e-5, k);
        check_relative(b, odd + 4e-5 / pow(odd, 3), 1e-11);
    }
}

static strum_catenary level(double mu)
{
    strum_catenary c;
    assert_int_equal(strum_catenary_from_chi(-mu, mu, &c, NULL), STRUM_OK);
    return c;
}

/* 300 m span, 6 m sag, EA 200 MN, by the handbook with H = w l^2/(8 d): lambda^2 = (8 d/l)^2
 * l EA/(H Le). */
static void lambda_of_a_real_cable(void **state)
{
    (void)state;
    const double span = 300, sag = 6, weight = 150, stiffness = 2e8;
    const double tension = weight * span * span / (8 * sag); /* 281.25 kN */
    const double effective = span * (1 + 8 * (sag / span) * (sag / span));
    const double lambda_squared =
        pow(weight * span / tension, 2) * span * stiffness / (tension * effective);
    strum_catenary c = level(weight * span / tension / 2);
    strum_cable cable = {
        .mu = c.mu, .kappa_t = tension / stiffness, .mass_t = 1, .mass_n = 1.5};
    strum_handbook s;
    strum_handbook_of(&c, &cable, &s);
    /* catenary and parabola differ by (8 d/l)^2/48 in sag */
    check_relative(s.sag_ratio, 8 * sag / span, 1e-3);
    check_relative(s.lambda_squared, lambda_squared, 2e-3);
    check_relative(s.chord, c.span, 1e-15);
    /* transverse waves: sqrt(H/m) */
    check_relative(strum_handbook_string(&s, 3), 3 * M_PI / c.span / sqrt(1.5), 1e-15);
    check_relative(strum_handbook_in_plane(&s, STRUM_ANTISYMMETRIC, 2),
                   4 * M_PI / c.span / sqrt(1.5), 1e-15);
    check_relative(strum_handbook_in_plane(&s, STRUM_SYMMETRIC, 1),
                   strum_handbook_root(s.lambda_squared, 1) / c.span / sqrt(1.5), 1e-15);
    cable.kappa_t = 0;
    strum_handbook_of(&c, &cable, &s);
    assert_true(isinf(s.lambda_squared));
}

/* Exact level inextensible cable as mu -> 0: relative to the shallow value -(.32397, .11016,
 * .14349, .09241) mu^2; out of plane relative -.03267 mu^2 (expansions by 220 bit shooting). */
static void exact_cable_near_the_shallow_limit(void **state)
{
    (void)state;
    static const double drop[] = {0.32397, 0.11016, 0.14349, 0.09241};
    const double mu = 0.05;
    const strum_catenary c = level(mu);
    const strum_cable cable = {.mu = mu, .mass_t = 1, .mass_n = 1};
    strum_handbook s;
    strum_handbook_of(&c, &cable, &s);
    strum_modes *in, *out;
    assert_int_equal(strum_modes_solve(&(strum_modes_params){cable, STRUM_IN_PLANE, 4, false},
                                       NULL, &in, NULL),
                     STRUM_OK);
    assert_int_equal(
        strum_modes_solve(&(strum_modes_params){cable, STRUM_OUT_OF_PLANE, 4, false}, NULL,
                          &out, NULL),
        STRUM_OK);
    for (int i = 0; i < 4; i++) {
        const strum_symmetry symmetry = i % 2 == 0 ? STRUM_ANTISYMMETRIC : STRUM_SYMMETRIC;
        const double shallow = strum_handbook_in_plane(&s, symmetry, i / 2 + 1);
        const double exact = mode_at(in, i).frequency;
        check_relative((1 - exact / shallow) / (mu * mu), drop[i], 0.01);
        check_absolute(1 - mode_at(out, i).frequency / strum_handbook_string(&s, i + 1),
                       0.03267 * mu * mu, i == 0 ? 1e-6 : 2e-4);
    }
    strum_modes_free(in);
    strum_modes_free(out);
}

/* Inclined and taut: weight normal to the chord, tension along it. */
static void exact_cable_near_the_inclined_taut_limit(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        const double inclination = (i - 1) * 0.9, chi_m = asinh(tan(inclination)), mu = 1e-4;
        strum_catenary c;
        assert_int_equal(strum_catenary_from_chi(chi_m - mu, chi_m + mu, &c, NULL), STRUM_OK);
        strum_cable cable = {.chi_m = c.chi_m, .mu = c.mu, .mass_t = 1, .mass_n = 1};
        strum_handbook s;
        /* lambda^2 = (w cos(theta) L/T)^2 L EA/(T Le), T = H/cos(theta) */
        const double lambda_squared = 30, cosine = cos(inclination);
        const double load = 2 * mu * cosine;
        cable.kappa_t = load * load * cosine / lambda_squared;
        strum_handbook_of(&c, &cable, &s);
        check_relative(s.sag_ratio, load, 1e-6);
        check_relative(s.lambda_squared, lambda_squared, 1e-6);
        strum_modes *in, *out;
        assert_int_equal(
            strum_modes_solve(&(strum_modes_params){cable, STRUM_IN_PLANE, 4, false}, NULL, &in,
                              NULL),
            STRUM_OK);
        assert_int_equal(
            strum_modes_solve(&(strum_modes_params){cable, STRUM_OUT_OF_PLANE, 4, false}, NULL,
                              &out, NULL),
            STRUM_OK);
        /* below 4 pi^2: symmetric, antisymmetric, symmetric, antisymmetric */
        for (int k = 0; k < 4; k++) {
            const strum_symmetry symmetry = k % 2 == 0 ? STRUM_SYMMETRIC : STRUM_ANTISYMMETRIC;
            check_relative(mode_at(in, k).frequency,
                           strum_handbook_in_plane(&s, symmetry, k / 2 + 1), 1e-6);
            check_relative(mode_at(out, k).frequency, strum_handbook_string(&s, k + 1), 1e-6);
        }
        strum_modes_free(in);
        strum_modes_free(out);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(published_roots),
        cmocka_unit_test(lambda_of_a_real_cable),
        cmocka_unit_test(exact_cable_near_the_shallow_limit),
        cmocka_unit_test(exact_cable_near_the_inclined_taut_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
