/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/numerics/gauss.h"

#include <math.h>
#include <stddef.h>

#include "gauss_tables.h"

#define TABLES (sizeof gauss_tables / sizeof *gauss_tables)

int gauss_size(int needed)
{
    for (size_t i = 0; i < TABLES; i++)
        if (needed <= gauss_tables[i].size)
            return gauss_tables[i].size;
    return needed + needed % 2;
}

/* P_n(x) and P_n'(x) by the three-term recurrence. */
static long double polynomial(int n, long double x, long double *slope)
{
    long double before = 1, now = x;
    for (int k = 1; k < n; k++) {
        const long double next = ((2 * k + 1) * x * now - k * before) / (k + 1);
        before = now;
        now = next;
    }
    *slope = n * (x * now - before) / (x * x - 1);
    return now;
}

void gauss_legendre_half(int n, double *node, double *weight)
{
    for (size_t t = 0; t < TABLES; t++)
        if (gauss_tables[t].size == n) {
            for (int i = 0; i < n / 2; i++) {
                node[i] = gauss_tables[t].half[i][0];
                weight[i] = gauss_tables[t].half[i][1];
            }
            return;
        }
    for (int i = 0; i < n / 2; i++) {
        /* the zero number n/2 - i from the right, to about 1e-3/n^2 */
        long double x = cosl((long double)M_PI * (n / 2 - i - 0.25L) / (n + 0.5L)), slope;
        for (int pass = 0; pass < 3; pass++)
            x -= polynomial(n, x, &slope) / slope;
        (void)polynomial(n, x, &slope);
        node[i] = (double)x;
        weight[i] = (double)(2 / ((1 - x * x) * slope * slope));
    }
}

void gauss_legendre(int n, double *node, double *weight)
{
    gauss_legendre_half(n, node + n / 2, weight + n / 2);
    for (int i = 0; i < n / 2; i++) {
        node[i] = -node[n - 1 - i];
        weight[i] = weight[n - 1 - i];
    }
}
