/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The equations of small motion as a first-order system, y' = A(lambda) y, by collocation at Gauss
 * points: a second method for modes, which shares nothing with the first but the static state.
 *     u' = e t + (1 + e0) th n,   e = (F.t + Q0 th)/EA,
 *     F' = [lambda^2 m + lambda c] u,
 *     th' = M/EI,   M' = (1 + e0)(N0 th - F.n) - Q0 e,
 * without bending stiffness th = F.n/N0; out of plane y' = (1 + e0) th and
 *     M' = (1 + e0)(N0 th - F) - EI th0'^2 th.
 */
#ifndef CORE_CABLE_TRANSFER_H
#define CORE_CABLE_TRANSFER_H

#include <complex.h>

#include "core/cable/motion.h"

#define TRANSFER_STATES 6 /* at most: u, F, th, M */
#define TRANSFER_POINTS 16

typedef struct {
    size_t piece;
    double from, half; /* unstretched */
    int states;        /* 2 components of u and F each (one out of plane), and th, M */
} transfer_element;

typedef struct {
    const motion *motion;
    motion_rule rule; /* x, w and integral alone */
    double length, force,
        arm;            /* units of u and F; of M force times arm, the width of a layer */
    double *re, *im;    /* room of the collocation equations */
    double _Complex *a; /* A at the points */
} transfer;

strum_status transfer_begin(const motion *m, arena *memory, transfer *t);
/* y at the end of an element from y at its beginning: states x states, column-major. */
void transfer_of(const transfer *t, const transfer_element *e, double _Complex lambda,
                 double _Complex *y);

/* Solves a x = b for `count` right sides in place; n x n, complex in two parts, column-major with
 * the right sides behind. */
void transfer_solve(int n, int count, double *re, double *im);

#endif
