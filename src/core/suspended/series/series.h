/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Gale's power series (1976, section II.4.2): what the three arithmetics of series_terms.h
 * share.
 *
 * The tangential displacement (m = 2) or the displacement out of plane (m = 1) solves an
 * ordinary equation of order 2m with polynomial coefficients in xi  [2.42, 2.44]. Its solutions
 * are y_j = sum a_k xi^{k + j/2} about the lowest point  [2.45-2.50, 2.82-2.87], which converge
 * for |xi| < 1 (2 out of plane), and z_j = sum b_k t^k, t = (xi - 2)/2, about xi = 2
 * [2.57-2.63, 2.94-2.100], which converge for 0 < xi < 4. Coefficients follow from putting the
 * series into the polynomial equation, which is what (2.50), (2.63), (2.87) and (2.100) are, so
 * that none of their misprints can enter.
 */
#ifndef CORE_SUSPENDED_SERIES_SERIES_H
#define CORE_SUSPENDED_SERIES_SERIES_H

#include <stdbool.h>

#include <strum/series.h>

#include "core/numerics/arena.h"

/* Most terms that are taken: reached at |xi| about 3.96. */
#define SERIES_TERMS_MAX 4000
#define SERIES_LAGS      6 /* most terms of a recursion */

/* sum over lags of (steady[i] + w^2 inertial[i]) c[k - i] + lead c[k] = 0 */
typedef struct series_row {
    long double lead, steady[SERIES_LAGS], inertial[SERIES_LAGS];
} series_row;

/* The recursion about one point. Rows are polynomials of k with integer values, exact in long
 * double. */
typedef struct series_recursion {
    int order;         /* of the equation: number of solutions */
    bool singular;     /* about xi = 0: solution j has exponents k + j/2; else k >= j */
    long double reach; /* largest |xi| (|t|) at which it is summed; < 1 */
    long double p[5][6], q[5][6]; /* sum_d (sum_e (p + w^2 q)_de x^e) d^d/dx^d y = 0 */
    int room;                     /* rows there are place for: terms that may be taken */
    int known;                    /* rows filled, k < known */
    series_row *rows;             /* singular: rows[j * room + k]; else rows[k] */
} series_recursion;

/* x = xi, or, where not singular, xi = 2 + 2x: coefficients; no rows yet. */
void series_recursion_make(series_recursion *r, int m, bool singular);
/* Fills rows up to k. */
void series_recursion_extend(series_recursion *r, int k);

/* One boundary value problem. */
typedef struct series_problem {
    int m;
    strum_symmetry symmetry; /* class to count and to solve */
    long double chi_1, chi_2;
    long double xi_1, xi_2;
    long double match;        /* |xi| from which on the series about xi = 2 is summed */
    bool near_zero, near_two; /* which series are needed */
    series_recursion zero, two;
    int room;
    void *work[3];   /* coefficients, one for each arithmetic */
    int terms;       /* most that any series has taken so far */
    int evaluations; /* of the boundary determinant or the count */
} series_problem;

/* An arithmetic to sum the series in. */
typedef struct series_arithmetic {
    int bits;
    /* Gale's determinant  [2.74, 2.110]; on a level cable that of the problem's symmetry. Its
     * zeros are the natural frequencies. Sets *converged. */
    long double (*determinant)(series_problem *problem, long double w, bool *converged);
    /* Number of natural frequencies below w, by Wittrick and Williams' count over short
     * elements whose stiffnesses the series give. *asymmetry: of those stiffnesses, relative:
     * what rounding has left of them (2 where a series has not converged). */
    int (*count)(series_problem *problem, long double w, long double *asymmetry);
} series_arithmetic;

enum { SERIES_DOUBLE, SERIES_EXTENDED, SERIES_QUADRUPLE, SERIES_ARITHMETICS };
extern const series_arithmetic series_arithmetics[SERIES_ARITHMETICS];

#endif
