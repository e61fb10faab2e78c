/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/numerics/gauss.h"

#include <math.h>

/* P_n(x) and P_n'(x) by the three-term recurrence. */
static long double legendre_polynomial(int n, long double x, long double *slope)
{
    long double before = 1, now = x;
    for (int k = 2; k <= n; k++) {
        const long double next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
        before = now;
        now = next;
    }
    *slope = n * (x * now - before) / (x * x - 1);
    return now;
}

void gauss_legendre(int n, double *node, double *weight)
{
    for (int i = 0; i < (n + 1) / 2; i++) {
        /* the i-th zero from the right, to about 1e-4/n */
        long double x = cosl((long double)M_PI * (i + 0.75L) / (n + 0.5L)), slope = 1;
        for (int pass = 0; pass < 6; pass++)
            x -= legendre_polynomial(n, x, &slope) / slope;
        if (2 * i + 1 == n)
            x = 0;
        (void)legendre_polynomial(n, x, &slope);
        node[n - 1 - i] = (double)x;
        node[i] = (double)-x;
        weight[i] = weight[n - 1 - i] = (double)(2 / ((1 - x * x) * slope * slope));
    }
}
