/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The recursions of Gale's series, from the coefficients of his equations. */
#include "core/suspended/series/series.h"

#include <math.h>

/* Coefficients of xi^e before the d-th derivative: [0] of w^0, [1] of w^2. In plane (2.42) with
 * what its print has lost (dy/dxi once, -w^2 y); out of plane (2.44). */
static const signed char in_plane[2][5][6] = {
    {{0}, {6, 24, 12}, {3, 51, 72, 24}, {0, 12, 46, 40, 10}, {0, 0, 4, 8, 5, 1}},
    {{-1}, {1, 9, 12, 4}, {0, 2, 5, 4, 1}}};
static const signed char out_of_plane[2][5][6] = {{{0}, {1, 1}, {0, 2, 1}}, {{1, 1}}};

/* x = xi, or, where not singular, xi = 2 + 2x. */
void series_recursion_make(series_recursion *r, int m, bool singular)
{
    r->order = 2 * m;
    r->singular = singular;
    for (int d = 0; d <= r->order; d++)
        for (int part = 0; part < 2; part++) {
            long double *to = part == 0 ? r->p[d] : r->q[d];
            for (int e = 0; e < 6; e++)
                to[e] = (m == 2 ? in_plane : out_of_plane)[part][d][e];
            for (int i = 0; !singular && i < 5; i++) /* Taylor shift by Horner's scheme */
                for (int e = 4; e >= i; e--)
                    to[e] += 2 * to[e + 1];
            for (int e = 0; !singular && e < 6; e++)
                to[e] = ldexpl(to[e], e - d);
        }
}

static long double falling(long double x, int d)
{
    long double product = 1;
    for (int i = 0; i < d; i++)
        product *= x - i;
    return product;
}

/* Coefficient of x^(rho + shift) in the equation applied to x^rho. */
static long double applied(long double p[5][6], int order, long double rho, int shift)
{
    long double sum = 0;
    for (int d = 0; d <= order; d++)
        if (d + shift >= 0 && d + shift < 6)
            sum += p[d][d + shift] * falling(rho, d);
    return sum;
}

void series_recursion_extend(series_recursion *r, int k)
{
    const int lowest = r->singular ? -r->order / 2 : -r->order;
    for (; r->known <= k; r->known++)
        for (int j = 0; j < (r->singular ? r->order : 1); j++) {
            series_row *row = &r->rows[(size_t)j * (size_t)r->room + (size_t)r->known];
            const long double rho = r->known + (r->singular ? j / 2.0L : 0);
            row->lead = applied(r->p, r->order, rho, lowest);
            for (int i = 0; i < SERIES_LAGS; i++) {
                row->steady[i] = applied(r->p, r->order, rho - 1 - i, lowest + 1 + i);
                row->inertial[i] = applied(r->q, r->order, rho - 1 - i, lowest + 1 + i);
            }
            if (r->known == 1 && r->singular && r->order == 4) {
                /* 0/0 for two of the exponents; with the common factor cancelled (App. B-1) */
                const long double e = j / 2.0L;
                row->lead = (e + 1) * (2 * e + 1);
                row->steady[0] = 4 * e * e + e + 1;
                row->inertial[0] = 1;
            }
        }
}
