/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Where a line touches its bed, for a given force along it.
 *
 * Coordinates of the bed: t along it, n across. Reactions are normal to it, so that the force
 * along, F_t, does not depend on contact; given at end 1 it is known everywhere, and the height is
 * an obstacle problem in one unknown function, monotone in the force F_n with which the line
 * leaves end 1. From contact to contact the line leaves by one parameter, from high to low: the
 * force of a joint that the bed does not bear, then the length that lies. The largest at which
 * the line beyond just touches, or ends where end 2 is, is the solution's.
 */
#ifndef CORE_CABLE_TOUCH_H
#define CORE_CABLE_TOUCH_H

#include "core/cable/line.h"
#include "core/numerics/work.h"

typedef struct {
    const cable_line *line;
    double cosine, sine;       /* of the slope */
    double height_1, height_2; /* of the ends above the bed, normal to it */
    double along_2;            /* of end 2 from end 1 */
    double load;               /* a scale of forces */
    work *work;
} bed_frame;

/* A place of the line, and the force behind any step that it makes there. */
typedef struct {
    size_t piece;
    double s; /* from the start of the piece */
    double t, n;
    double height;
} bed_state;

/* It lands at `from`, inside a piece or (at_joint) at the start of one, and leaves at `to`. */
typedef struct {
    bed_state from; /* before the step of a joint */
    bed_state to;
    bool at_joint;
    double reaction; /* of the bed on the joint at `to`, where it leaves there */
} bed_contact;

typedef struct {
    bed_state start; /* at end 1; n is found */
    bed_contact *contacts;
    size_t count, room;
} bed_touch;

/* Forces in the frame of the bed and back. */
static inline void bed_from_world(const bed_frame *f, double x, double z, double *t, double *n)
{
    *t = x * f->cosine + z * f->sine;
    *n = z * f->cosine - x * f->sine;
}
static inline void bed_to_world(const bed_frame *f, double t, double n, double *x, double *z)
{
    *x = t * f->cosine - n * f->sine;
    *z = t * f->sine + n * f->cosine;
}

/* The step of the force at the start of a piece. */
void bed_step(const bed_frame *f, size_t piece, double *t, double *n);
/* Moves by `length` through the piece it is in; returns the way along the bed. */
double bed_move(const bed_frame *f, bed_state *at, double length);

/* All contacts for the force `t` along the bed at end 1. False: no memory for so many, or stopped
 * (the work's status says so). */
bool touch_solve(const bed_frame *f, double t, bed_touch *touch);

#endif
