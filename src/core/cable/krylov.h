/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A basis in which the lowest modes, and the answer to forces at the links, are exact to rounding:
 * block Lanczos with K^-1 M in the inner product of K, begun with K^-1 of each link's direction
 * and with generic loads; K times each vector is kept, so that no product with K is needed.
 * Orthogonalised against all, twice.
 */
#ifndef CORE_CABLE_KRYLOV_H
#define CORE_CABLE_KRYLOV_H

#include "core/cable/stiffness.h"

typedef struct krylov {
    const motion *motion;
    stiffness *stiffness;
    size_t n;
    int size, most;     /* vectors */
    int next;           /* whose K^-1 M is taken next */
    int start, started; /* vectors that it begins with */
    bool exhausted;     /* nothing new is left */
    double *q, *z, *y;  /* vectors, K and M times them: n each, one after the other */
    double *links;      /* loads of the links' directions */
    double *x, *load, *room;
} krylov;

/* `most`: vectors that there is room for. */
strum_status krylov_begin(const motion *m, stiffness *k, int generic, int most, arena *memory,
                          krylov *b);
/* Until it has `size` vectors, or nothing new is left. */
strum_status krylov_extend(krylov *b, int size, work *w);
/* One more vector, K^-1 `load` without the span of the others; false where nothing is left. */
bool krylov_add(krylov *b, const double *load);
/* Square of the part of K^-1 `load` outside the basis, in the norm of K; `load` may not be b->load. */
double krylov_left(krylov *b, const double *load);
/* How far K^-1 M of vector `i` reaches out of the basis, in the norm of K. */
double krylov_tail(krylov *b, int i);

#endif
