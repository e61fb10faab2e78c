/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A uniform elastic cable that hangs between two points: the catenary in closed form, without a
 * division by its weight, so that heavy, neutral, buoyant, taut and vertical need no case of
 * their own. Everything is per unstretched metre. The force at s from its start is
 *     F = (h, v + w s),  and its shape  r' = (1/|F| + 1/EA) F
 * [Irvine, Cable Structures, 1981, section 1.4, with the differences of asinh and of square
 * roots rewritten here].
 */
#ifndef CORE_CABLE_ARC_H
#define CORE_CABLE_ARC_H

typedef struct {
    double weight;      /* w */
    double length;      /* unstretched */
    double flexibility; /* 1/EA */
} cable_arc;

/* From its start to its end, and the derivatives by the force: symmetric. */
typedef struct {
    double x, z;
    double xx, xz, zz;
} cable_arc_reach;

/* (h, v): the force at its start. */
void arc_reach(const cable_arc *a, double h, double v, double *x, double *z);
cable_arc_reach arc_reach_slopes(const cable_arc *a, double h, double v);
/* The stretched length. */
double arc_stretched(const cable_arc *a, double h, double v);
/* INT dS/|F|; infinite where the force vanishes within. */
double arc_inverse_tension(const cable_arc *a, double h, double v);

#endif
