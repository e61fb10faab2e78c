/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The models of an inclined cable beside one another: each against its own equation, all against
 * the full model and their second methods. Reference values as in test_inclined.c.
 */
#include <complex.h>
#include <gsl/gsl_sf_airy.h>

#include "inclined/cables.h"

/* ---- the approximations ---- */

static void determinant_and_closed_form(void **state)
{
    (void)state;
    static const struct {
        double epsilon, degrees, lambda_squared;
        double want[3][2], spurious[3]; /* (17)-(18), tangent at s_a, (21) */
    } rows[] = {
        {0.18,
         23.46,
         38.0,
         {{1.96162698195438, 2.01305475859859},
          {1.9607967394672, 2.01277432687097},
          {1.96119287129312, 2.01331585231913}},
         {0.196146556498629, 0.194058132421569, 0.188455472685565}},
        {0.18,
         23.46,
         150.0,
         {{1.99881888807602, 2.73013589372125},
          {1.99881645149536, 2.72939277703784},
          {1.9989193475589, 2.72634790781259}},
         {0.206435365167718, 0.204050835530879, 0.196914348104741}},
        {0.49,
         45,
         19.0,
         {{1.5772838956403, 2.01589265103395},
          {1.56437950915424, 2.01539294546521},
          {1.57895170176947, 2.01647413125617}},
         {0.351386720400374, 0.336417231333547, 0.347307345673129}},
        {0.49,
         45,
         64.0,
         {{1.96055447030558, 2.3609344479734},
          {1.95689719037073, 2.33284025407379},
          {1.95622600565376, 2.35533591782907}},
         {0.371238551181823, 0.353811471888491, 0.364218712086786}},
    };
    for (int i = 0; i < COUNT(rows); i++)
        for (int k = 0; k < 3; k++) {
            const strum_inclined_cable cable =
                taut(rows[i].epsilon, rows[i].degrees, rows[i].lambda_squared, 1);
            strum_inclined *modes =
                solved(&cable, (strum_inclined_model)(STRUM_INCLINED_AIRY + k), 2);
            check_relative(kl(modes, 1) / M_PI, rows[i].want[k][0], 1e-13);
            check_relative(kl(modes, 2) / M_PI, rows[i].want[k][1], 1e-13);
            check_relative(strum_inclined_spurious(modes) / M_PI, rows[i].spurious[k], 1e-12);
            strum_inclined_free(modes);
        }
}

/* The 4 x 4 matrix of the report's section 3.1 in Airy functions proper. Its determinant at kl.
 */
static double airy_determinant(const strum_inclined_cable *c, double x)
{
    strum_inclined_statics st;
    assert_int_equal(strum_inclined_statics_find(c, &st, NULL), STRUM_OK);
    const double e = c->epsilon, sine = sin(c->inclination), cosine = cos(c->inclination);
    const double h = c->mass_ratio;
    const double q0 = cbrt(4 * h * pow(e, 3) * cosine * cosine * sine); /* (17) */
    const double s0 =
        (1 - x * x / c->lambda_squared + 2 * e * sine) / (4 * e * sine); /* (18) */
    const double curvature[2] = {st.curvature_bottom, st.curvature_top};
    const double q[2] = {pow(st.tension_bottom, 0.25), pow(st.tension_top, 0.25)};
    double a[4][4];
    for (int end = 0; end < 2; end++) {
        const double z = -q0 * (end - s0), w = end * x * st.phase, k = curvature[end];
        double *u = a[2 * end], *t = a[2 * end + 1];
        u[0] = -q0 / h * gsl_sf_airy_Ai_deriv(z, GSL_PREC_DOUBLE);
        u[1] = -q0 / h * gsl_sf_airy_Bi_deriv(z, GSL_PREC_DOUBLE);
        u[2] = k * q[end] / x * sin(w);
        u[3] = k * q[end] / x * cos(w);
        t[0] = k * gsl_sf_airy_Ai(z, GSL_PREC_DOUBLE);
        t[1] = k * gsl_sf_airy_Bi(z, GSL_PREC_DOUBLE);
        t[2] = cos(w) / q[end];
        t[3] = -sin(w) / q[end];
    }
    double det = 1;
    for (int k = 0; k < 4; k++) {
        int pivot = k;
        for (int i = k + 1; i < 4; i++)
            if (fabs(a[i][k]) > fabs(a[pivot][k]))
                pivot = i;
        for (int j = 0; j < 4; j++) {
            const double swap = a[k][j];
            a[k][j] = a[pivot][j];
            a[pivot][j] = swap;
        }
        det *= (pivot == k ? 1 : -1) * a[k][k];
        for (int i = k + 1; i < 4; i++)
            for (int j = 3; j >= k; j--)
                a[i][j] -= a[i][k] / a[k][k] * a[k][j];
    }
    return det;
}

static void airy_functions(void **state)
{
    (void)state;
    for (int i = 0; i < 30; i++) {
        const strum_inclined_cable cable =
            taut(uniform(0.1, 0.8), uniform(5, 85), exp(uniform(0, 6)), uniform(0.5, 1));
        strum_inclined *modes = solved(&cable, STRUM_INCLINED_AIRY, 6);
        double least = 1;
        for (int k = 2; k <= 6; k++)
            least = fmin(least, kl(modes, k) - kl(modes, k - 1));
        for (int k = 1; k <= 6 && least > 0.01; k++) {
            const double x = kl(modes, k), d = 1e-7 * x;
            if (airy_determinant(&cable, x - d) * airy_determinant(&cable, x + d) >= 0)
                fail_msg("epsilon %.17g, %.17g rad, lambda^2 %.17g: no zero at %.17g",
                         cable.epsilon, cable.inclination, cable.lambda_squared, x);
        }
        /* and none between two of them */
        for (double at = 0.8 * M_PI; at < kl(modes, 6) && least > 0.01; at += least / 3) {
            double sign = 1;
            for (int k = 1; k <= 6; k++)
                sign *= at < kl(modes, k) ? -1 : 1;
            double nearest = 1;
            for (int k = 1; k <= 6; k++)
                nearest = fmin(nearest, fabs(at - kl(modes, k)));
            const double beyond = airy_determinant(&cable, kl(modes, 6) + 1e-3);
            if (nearest > 1e-6)
                assert_true(airy_determinant(&cable, at) * sign * beyond > 0);
        }
        strum_inclined_free(modes);
    }
}

/* Irvine and Caughey: symmetric roots of tan(b/2) = b/2 - (4/lambda^2)(b/2)^3 as b/pi, and the
 * poles of the dynamic stiffness 1/(1 + (lambda^2/b^2)(tan(b/2)/(b/2) - 1)), whose static limit
 * is Ernst's 1/(1 + lambda^2/12). Antisymmetric ones are 2 n pi. */
static void irvine(void **state)
{
    (void)state;
    static const double table[][4] = {
        {0.1, 1.00409744823, 3.00015223684, 5.00003286381},
        {4, 1.15182280544, 3.00632880394, 5.00133461656},
        {20, 1.60953642787, 3.03750897874, 5.00711724162},
        {4 * M_PI * M_PI, 2, 3.09342222806, 5.01527810753},
        {100, 2.59718454463, 3.47967507554, 5.05266279231},
        {1000, 2.84826363845, 4.89257074009, 6.89041196199},
    };
    for (int i = 0; i < COUNT(table); i++) {
        const strum_inclined_cable cable = taut(0.01, 0, table[i][0], 1);
        strum_inclined *modes = solved(&cable, STRUM_INCLINED_IRVINE, 7);
        int symmetric = 0, antisymmetric = 0;
        for (int k = 1; k <= 7; k++) {
            const double b = kl(modes, k);
            if (mode_at(modes, k - 1).symmetry == STRUM_ANTISYMMETRIC) {
                check_relative(b / M_PI, 2.0 * ++antisymmetric, 1e-15);
                continue;
            }
            if (++symmetric <= 3)
                check_relative(b / M_PI, table[i][symmetric], 5e-12);
            check_absolute(1 + table[i][0] / (b * b) * (tan(b / 2) / (b / 2) - 1), 0,
                           1e-13 * (1 + table[i][0]) * (1 + pow(tan(b / 2), 2)));
        }
        assert_true(symmetric >= 3 && antisymmetric >= 2);
        strum_inclined_free(modes);
    }
}

/* Largest relative error of the determinant and of (21) over lambda^2/4 pi^2 in [0.1, 100] and
 * six modes, h = 1, against (1)-(5) computed independently (rounded upwards): it grows with
 * epsilon^2. */
static void accuracy_map(void **state)
{
    (void)state;
    static const struct {
        double epsilon, degrees, airy, closed;
    } rows[] = {{0.05, 45, 1.3e-4, 1.5e-4},
                {0.1, 23.46, 3.0e-4, 3.2e-4},
                {0.18, 60, 3.2e-3, 3.3e-3},
                {0.3, 80, 1.1e-2, 1.2e-2}};
    for (int i = 0; i < COUNT(rows); i++) {
        double airy_error = 0, closed_error = 0;
        for (int step = 0; step < 12; step++) {
            const strum_inclined_cable cable =
                taut(rows[i].epsilon, rows[i].degrees,
                     4 * M_PI * M_PI * 0.1 * pow(1000, step / 11.0), 1);
            strum_inclined *full = solved(&cable, STRUM_INCLINED_FULL, 6);
            strum_inclined *airy = solved(&cable, STRUM_INCLINED_AIRY, 6);
            strum_inclined *closed = solved(&cable, STRUM_INCLINED_ASYMPTOTIC, 6);
            for (int k = 1; k <= 6; k++) {
                airy_error = fmax(airy_error, fabs(kl(airy, k) / kl(full, k) - 1));
                closed_error = fmax(closed_error, fabs(kl(closed, k) / kl(full, k) - 1));
            }
            strum_inclined_free(full);
            strum_inclined_free(airy);
            strum_inclined_free(closed);
        }
        check_relative(airy_error, rows[i].airy, 0.25);
        check_relative(closed_error, rows[i].closed, 0.25);
    }
}

/* ---- random cables, every model by its second method ---- */

static void random_cables(void **state)
{
    (void)state;
    for (int i = 0; i < 60; i++) {
        strum_inclined_cable cable =
            taut(exp(uniform(log(0.005), 0)), i % 6 == 0 ? 0 : uniform(0, 89),
                 i % 7 == 0 ? INFINITY : exp(uniform(-2, 10)), i % 2 ? 1 : uniform(0.3, 1));
        cable.elastic_statics = i % 3 == 0;
        if (cable.lambda_squared < 3 * pow(cable.epsilon * cos(cable.inclination), 2))
            continue; /* stretched by a third */
        for (int model = STRUM_INCLINED_FULL; model <= STRUM_INCLINED_IRVINE; model++) {
            const int count = 1 + rand() % 10;
            strum_inclined *modes = solved(&cable, (strum_inclined_model)model, count);
            strum_verification v;
            assert_int_equal(strum_inclined_verify(modes, NULL, &v, NULL), STRUM_OK);
            if (v.modes_expected != count || v.modes_found != count ||
                !(v.max_relative_difference < 1e-12 && v.max_residual < 1e-9))
                fail_msg("epsilon %.17g, %.17g rad, lambda^2 %.17g, model %d: %d of %d modes, "
                         "difference %.1e, residual %.1e",
                         cable.epsilon, cable.inclination, cable.lambda_squared, model, count,
                         v.modes_expected, v.max_relative_difference, v.max_residual);
            for (int k = 0; k < count; k++) {
                const strum_inclined_mode mode = mode_at(modes, k);
                assert_true(mode.longitudinal_energy >= 0 && mode.longitudinal_energy <= 1);
                assert_true(mode.symmetric_share > -1e-12 && mode.symmetric_share < 1 + 1e-12);
                assert_true(k == 0 || mode.kl >= kl(modes, k));
            }
            strum_inclined_free(modes);
        }
    }
}

static void counts(void **state)
{
    (void)state;
    static const struct {
        double epsilon, degrees, lambda_squared, kl;
        int below;
    } rows[] = {{0.18, 23.46, 38, 2.005, 1}, {0.1, 20, 0.14128, 4.01, 4}};
    for (int i = 0; i < COUNT(rows); i++) {
        const strum_inclined_cable cable =
            taut(rows[i].epsilon, rows[i].degrees, rows[i].lambda_squared, 1);
        strum_inclined *modes = solved(&cable, STRUM_INCLINED_FULL, rows[i].below + 1);
        assert_true(kl(modes, rows[i].below) < rows[i].kl * M_PI);
        assert_true(kl(modes, rows[i].below + 1) > rows[i].kl * M_PI);
        strum_inclined_free(modes);
    }
}

int main(void)
{
    srand(1984);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(determinant_and_closed_form),
        cmocka_unit_test(airy_functions),
        cmocka_unit_test(irvine),
        cmocka_unit_test(accuracy_map),
        cmocka_unit_test(random_cables),
        cmocka_unit_test(counts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
