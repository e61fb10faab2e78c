/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/numerics/legendre.h"

#include <math.h>

#include "core/numerics/gauss.h"

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

strum_status legendre_make(int count, double pole, bool half, arena *a, legendre *b)
{
    /* n Gauss points are exact to degree 2n-1; the weight adds the degree at which its own
     * Legendre series has fallen to 1e-17, which Bernstein's ellipse through the pole gives. */
    const double weight_degree = 39 / asinh(pole);
    const int n = gauss_size((int)ceil(count + 1 + fmin(weight_degree, 1500) / 2));
    const size_t points = (size_t)(half ? n / 2 : n);
    b->count = count;
    b->points = (int)points;
    b->x = arena_doubles(a, 4 * points);
    b->p = arena_room(a, 2 * points * (size_t)count);
    if (b->x == NULL || b->p == NULL)
        return STRUM_ERR_MEMORY;
    b->w = b->x + points;
    b->q = b->p + points * (size_t)count;
    if (half)
        gauss_legendre_half(n, b->x, b->w);
    else
        gauss_legendre(n, b->x, b->w);
    for (size_t i = 0; half && i < points; i++) /* for the nodes below 0 too */
        b->w[i] *= 2;
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
    return STRUM_OK;
}
