/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The functions and the quadrature beneath the Galerkin methods. */
#include "core/numerics/legendre.h"

#include <gsl/gsl_sf_legendre.h>

#include "check.h"

/* p_k = sqrt(k + 1/2) P_k and q_k' = p_k, with GSL's Legendre polynomials as the oracle. */
static void functions_are_legendre(void **state)
{
    (void)state;
    enum { COUNT = 40 };
    double p[COUNT], q[COUNT], p2[COUNT], q2[COUNT], factors[4 * COUNT];
    legendre_factors(COUNT, factors);
    for (double x = -1; x <= 1; x += 0.0625) {
        legendre_at(x, COUNT, p, q);
        legendre_at_with(factors, x, COUNT, p2, q2);
        for (int k = 0; k < COUNT; k++) {
            const double norm = sqrt(k + 0.5);
            check_absolute(p[k], norm * gsl_sf_legendre_Pl(k, x), 1e-12);
            const double before = k > 0 ? gsl_sf_legendre_Pl(k - 1, x) : 0;
            check_absolute(q[k], norm * (gsl_sf_legendre_Pl(k + 1, x) - before) / (2 * k + 1),
                           1e-12);
            check_absolute(p2[k], p[k], 1e-12);
            check_absolute(q2[k], q[k], 1e-12);
        }
    }
}

/* Orthonormality, also with more points than GSL has tables for: its own nodes there are good
 * to 1e-10 only. */
static void quadrature_is_exact(void **state)
{
    (void)state;
    static const int counts[] = {5, 24, 60, 200, 700, 1100};
    for (int half = 0; half < 2; half++)
        for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
            arena a = {0};
            legendre b;
            const int count = counts[c];
            assert_int_equal(legendre_make(count, 0.05, half == 1, &a, &b), STRUM_OK);
            double weights = 0, fourth = 0;
            for (int i = 0; i < b.points; i++) {
                weights += b.w[i];
                fourth += b.w[i] * pow(b.x[i], 4);
            }
            check_absolute(weights, 2, 1e-13);
            check_absolute(fourth, 0.4, 1e-13);
            for (int j = count - 1; j >= 0; j -= 1 + count / 7)
                for (int k = j; k >= 0; k -= 2 * (1 + count / 9)) { /* even products */
                    double sum = 0;
                    for (int i = 0; i < b.points; i++)
                        sum += b.w[i] * b.p[(size_t)j * (size_t)b.points + (size_t)i] *
                               b.p[(size_t)k * (size_t)b.points + (size_t)i];
                    check_absolute(sum, j == k, 3e-12);
                }
            arena_free(&a);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(functions_are_legendre),
        cmocka_unit_test(quadrature_is_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
