/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A line between two points in the frame of its chord: p along it, q across. What a nearly
 * straight cable is longer than its chord is formed as it is, not as the difference of two
 * lengths: 1e-9 of them decides its tension.
 */
#ifndef CORE_CABLE_CHORD_H
#define CORE_CABLE_CHORD_H

#include "core/cable/line.h"

#define CHORD_POINTS 6

typedef struct {
    const cable_line *line;
    double along_x, along_z; /* unit vector from end 1 to end 2 */
    double distance;         /* of the ends */
    double excess;           /* unstretched length - distance */
    double flexibility;      /* SUM l/EA */
    double load;             /* SUM of the sizes of all loads: a scale of forces */
    /* mu: of weightless pieces |F| is taken for sqrt(F^2 + mu^2), without the corner at F = 0; 0
     * but on the way. */
    double rounding;
} cable_chord;

/* How far the line's end lies from end 2, and the derivatives by the force at end 1. */
typedef struct {
    double along, across;
    double pp, pq, qp, qq;
    double tension; /* largest on the way */
} chord_miss;

cable_chord chord_of(const cable_line *line, double span, double rise);
/* Of the force (p, q) at end 1. */
chord_miss chord_reach(const cable_chord *c, double p, double q);
/* The force that a nearly straight line would have: to begin with. */
void chord_guess(const cable_chord *c, double *p, double *q);

static inline void chord_to_world(const cable_chord *c, double p, double q, double *x,
                                  double *z)
{
    *x = p * c->along_x - q * c->along_z;
    *z = p * c->along_z + q * c->along_x;
}

static inline void chord_from_world(const cable_chord *c, double x, double z, double *p,
                                    double *q)
{
    *p = x * c->along_x + z * c->along_z;
    *q = z * c->along_x - x * c->along_z;
}

#endif
