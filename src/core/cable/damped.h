/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Complex modes of the reduced cable. In its undamped modes the characteristic matrix is
 *     P(lambda) = I + i K_loss + lambda C + lambda^2 diag(mu):
 * all roots at once from the real quadratic pencil in 1/lambda, so that the low ones are the
 * accurate ones; then Newton on each, and on from it with structural loss.
 */
#ifndef CORE_CABLE_DAMPED_H
#define CORE_CABLE_DAMPED_H

#include <complex.h>

#include "core/cable/reduced.h"

typedef struct {
    double _Complex lambda;
    double _Complex *vector; /* in the undamped modes */
} damped_root;

typedef struct damped {
    const reduced *reduced;
    int n;
    double *damping, *loss; /* n x n; loss NULL: none */
    /* Of dampers alone: rows of what each moves with, and its damping; rank 0: with drag. */
    double *part, *constant;
    int rank;
    damped_root *roots; /* Im > 0, ascending */
    int count;
    damped_root *real; /* overdamped, by size */
    int real_count;
} damped;

/* Whether anything damps. */
bool damped_needed(const motion *m);
/* The first `want` roots and some more to the last digits. */
strum_status damped_make(const reduced *r, int want, arena *memory, damped *d);

/* The unit of the determinant of P, or of a function with the same zeros and the undamped
 * frequencies as poles; `poles`: whether it has them. */
bool damped_has_poles(const damped *d);
strum_status damped_phase(const damped *d, double _Complex lambda, double _Complex *room,
                          work *w, double _Complex *phase);
size_t damped_phase_room(const damped *d);

#endif
