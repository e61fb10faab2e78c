/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/numerics/legendre.h"

#include <gsl/gsl_integration.h>
#include <math.h>

void legendre_at(double x, int count, double *p, double *q)
{
    /* P_{k-1}, P_k, P_{k+1} by the three-term recurrence. */
    double before = 0, now = 1;
    for (int k = 0; k < count; k++) {
        const double next = ((2 * k + 1) * x * now - k * before) / (k + 1);
        const double norm = sqrt(k + 0.5);
        p[k] = norm * now;
        q[k] = norm * (next - before) / (2 * k + 1);
        before = now;
        now = next;
    }
}

static void factors_of(int k, double *factors)
{
    const double norm = sqrt(k + 0.5);
    factors[0] = (2 * k + 1) / (k + 1.0);
    factors[1] = k / (k + 1.0);
    factors[2] = norm;
    factors[3] = norm / (2 * k + 1);
}

void legendre_factors(int count, double *factors)
{
    for (int k = 0; k < count; k++)
        factors_of(k, factors + 4 * k);
}

void legendre_at_with(const double *factors, double x, int count, double *p, double *q)
{
    double before = 0, now = 1;
    for (int k = 0; k < count; k++, factors += 4) {
        const double next = factors[0] * x * now - factors[1] * before;
        p[k] = factors[2] * now;
        q[k] = factors[3] * (next - before);
        before = now;
        now = next;
    }
}

#define GAUSS_TABULATED_MAX 1024

/* Sizes whose nodes GSL holds as constants; others cost it a Newton iteration per node. */
static size_t gauss_size(int needed)
{
    static const int tabulated[] = {32, 64, 96, 128, 256, 512, GAUSS_TABULATED_MAX};
    for (size_t i = 0; i < sizeof tabulated / sizeof *tabulated; i++)
        if (needed <= tabulated[i])
            return (size_t)tabulated[i];
    return (size_t)(needed + needed % 2);
}

/* GSL computes the nodes that it does not hold as constants to 1e-10 only: Newton's method
 * mends one. */
static void polish_node(int n, double *x, double *w)
{
    double slope = 0;
    for (int pass = 0; pass < 2; pass++) {
        double before = 0, now = 1; /* P_{k-1}, P_k */
        for (int k = 0; k < n; k++) {
            const double next = ((2 * k + 1) * *x * now - k * before) / (k + 1);
            before = now;
            now = next;
        }
        slope = n * (before - *x * now) / ((1 - *x) * (1 + *x));
        *x -= now / slope;
    }
    *w = 2 / ((1 - *x) * (1 + *x) * slope * slope);
}

/* Nodes and weights; of the half x > 0 with doubled weights. */
static strum_status gauss_nodes(size_t n, bool half, legendre *b)
{
    gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc(n);
    if (table == NULL)
        return STRUM_ERR_MEMORY;
    for (int i = 0; i < b->points; i++) {
        const size_t from = half ? n / 2 + (size_t)i : (size_t)i;
        (void)gsl_integration_glfixed_point(-1, 1, from, &b->x[i], &b->w[i], table);
        if (n > GAUSS_TABULATED_MAX)
            polish_node((int)n, &b->x[i], &b->w[i]);
        if (half)
            b->w[i] *= 2;
    }
    gsl_integration_glfixed_table_free(table);
    return STRUM_OK;
}

strum_status legendre_make(int count, double pole, bool half, arena *a, legendre *b)
{
    /* n Gauss points are exact to degree 2n-1; the weight adds the degree at which its own
     * Legendre series has fallen to 1e-17, which Bernstein's ellipse through the pole gives. */
    const double weight_degree = 39 / asinh(pole);
    const size_t n = gauss_size((int)ceil(count + 1 + fmin(weight_degree, 1500) / 2));
    const size_t points = half ? n / 2 : n;
    b->count = count;
    b->points = (int)points;
    b->x = arena_doubles(a, 4 * points);
    b->p = arena_doubles(a, 2 * points * (size_t)count);
    if (b->x == NULL || b->p == NULL)
        return STRUM_ERR_MEMORY;
    b->w = b->x + points;
    b->q = b->p + points * (size_t)count;
    const strum_status status = gauss_nodes(n, half, b);
    double *before = b->w + points, *now = before + points; /* P_{k-1}, P_k */
    for (size_t i = 0; i < points; i++)
        now[i] = 1;
    for (int k = 0; k < count; k++) {
        double factors[4], *p = b->p + (size_t)k * points, *q = b->q + (size_t)k * points;
        factors_of(k, factors);
        for (size_t i = 0; i < points; i++) {
            const double next = factors[0] * b->x[i] * now[i] - factors[1] * before[i];
            p[i] = factors[2] * now[i];
            q[i] = factors[3] * (next - before[i]);
            before[i] = now[i];
            now[i] = next;
        }
    }
    return status;
}
