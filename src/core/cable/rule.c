/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/rule.h"

#include <math.h>

#include "core/numerics/gauss.h"
#include "core/numerics/legendre.h"
#include "core/numerics/linalg.h"

/* Products of two functions of the degree times a smooth weight. Few sizes, so that elements
 * share them. */
static int points_for(int degree)
{
    const int needed = degree + 10;
    return needed <= 32 ? 32 : (needed + 15) / 16 * 16;
}

static void fill(motion_rule *r, double *p, double *q)
{
    const int n = r->points;
    for (int i = 0; i < n; i++) {
        legendre_at(r->x[i], n, p, q);
        q[0] = (1 - r->x[i]) / 2;
        for (int k = 0; k < n; k++) {
            const double rotation = k == 1 ? (1 + r->x[i]) / 2 : k == 0 ? q[0] : q[k - 1];
            r->rotation[k * n + i] = r->rotation_at[i * n + k] = rotation;
            r->strain[k * n + i] = r->strain_at[i * n + k] = p[k];
        }
    }
}

/* The polynomial that is 1 at point k is SUM w_k p_j(x_k) p_j; p_j's integral from -1 is q_j, and
 * (x + 1)/sqrt(2) for j = 0. */
static void integrate(motion_rule *r, double *weighted, double *integrals)
{
    const int n = r->points;
    for (int k = 0; k < n; k++)
        for (int j = 0; j < n; j++) {
            weighted[k * n + j] = r->w[k] * r->strain_at[k * n + j];
            integrals[k * n + j] = j == 0 ? (r->x[k] + 1) * sqrt(0.5)
                                          : (j + 1 < n ? r->rotation_at[k * n + j + 1] : 0);
        }
    /* the last function's integral is not in the table */
    for (int q = 0; q < n; q++) {
        const double x = r->x[q], norm = sqrt(n - 0.5);
        const double before = r->strain_at[q * n + n - 2] / sqrt(n - 1.5);
        const double now = r->strain_at[q * n + n - 1] / norm;
        const double next = ((2 * n - 1) * x * now - (n - 1) * before) / n;
        integrals[q * n + n - 1] = norm * (next - before) / (2 * n - 1);
    }
    linalg_multiply('T', 'N', n, n, n, integrals, n, weighted, n, r->integral, n);
    for (int k = 0; k < n; k++)
        for (int q = 0; q < n; q++)
            r->integral_to[q * n + k] = r->integral[k * n + q];
}

static motion_rule *make(int n, arena *memory)
{
    const size_t square = (size_t)n * (size_t)n;
    motion_rule *r = arena_alloc(memory, 1, sizeof *r);
    double *table = arena_room(memory, 8 * square + 2 * (size_t)n);
    if (r == NULL || table == NULL)
        return NULL;
    r->points = n;
    r->rotation = table;
    r->strain = table + square;
    r->rotation_at = r->strain + square;
    r->strain_at = r->rotation_at + square;
    r->integral = r->strain_at + square;
    r->integral_to = r->integral + square;
    r->x = r->integral_to + 3 * square;
    r->w = r->x + n;
    gauss_legendre(n, r->x, r->w);
    fill(r, r->integral, r->integral_to);
    integrate(r, r->integral_to + square, r->integral_to + 2 * square);
    return r;
}

const motion_rule *rule_for(int degree, rule_set *set, arena *memory)
{
    const int points = points_for(degree);
    for (int i = 0; i < set->count; i++)
        if (set->rules[i]->points == points)
            return set->rules[i];
    motion_rule *r = make(points, memory);
    if (r != NULL && set->count < RULE_SIZES)
        set->rules[set->count++] = r;
    return r;
}
