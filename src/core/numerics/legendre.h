/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Legendre functions on [-1, 1] at Gauss points: orthonormal polynomials p_k = sqrt(k + 1/2)
 * P_k and their integrals q_k, q_k' = p_k. q_k vanishes at both ends for k >= 1; q_0 =
 * x/sqrt(2) is odd, so that p_k has the parity of k and q_k the other one.
 */
#ifndef CORE_NUMERICS_LEGENDRE_H
#define CORE_NUMERICS_LEGENDRE_H

#include <stdbool.h>

#include "core/numerics/arena.h"
#include "core/numerics/status.h"

typedef struct legendre {
    int count;     /* functions k = 0 .. count-1 */
    int points;    /* Gauss points kept */
    double *x, *w; /* nodes and weights */
    double *p, *q; /* p[k * points + i] */
} legendre;

/* Tables for `count` functions with enough points to integrate products of two of them times a
 * weight that is analytic inside the ellipse through +-i `pole` (in x). `half` keeps the points
 * x > 0 with doubled weights, for integrands that are even. Memory is the arena's. */
strum_status legendre_make(int count, double pole, bool half, arena *a, legendre *b);

/* p_k(x) and q_k(x) for k < count at one point. */
void legendre_at(double x, int count, double *p, double *q);

/* The factors of the recurrence, for who evaluates at many points: four doubles a function. */
void legendre_factors(int count, double *factors);
void legendre_at_with(const double *factors, double x, int count, double *p, double *q);

#endif
