/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * One mode along the cable: displacement, force and rotation anywhere. The force is that of
 * everything that acts behind a place: F(S) = SUM of inertia, drag, links and supports from S to
 * end 2, which an inextensible cable has too.
 */
#ifndef CORE_CABLE_FIELD_H
#define CORE_CABLE_FIELD_H

#include "core/cable/spectrum.h"

typedef struct field {
    const spectrum *spectrum;
    const spectrum_mode *mode;
    double _Complex *u;       /* [component * points + point] */
    double _Complex *slope;   /* likewise, Legendre coefficients of u' on each element */
    double _Complex *force;   /* forces at the points, with their weights */
    double _Complex *density; /* Legendre coefficients of the force per half length */
    double _Complex *node_u, *node_force; /* [2 node + component]; forces that act there */
    double _Complex *behind; /* F at the end of each element, [2 element + component] */
    double _Complex end[2];  /* F at the beginning of the first */
    double _Complex largest; /* component of the displacement at points and nodes */
} field;

strum_status field_make(const spectrum *s, const spectrum_mode *mode, arena *memory, field *f);

/* Z(lambda) of a damper, or of an absorber along its line. */
double _Complex field_impedance(const motion_link *link, double _Complex lambda);

typedef struct field_point {
    double _Complex u[2], force[2];
    double _Complex rotation, bend; /* bend: its derivative */
    const motion_element *element;
} field_point;

/* At an unstretched place; what lies outside the stretch rests. */
field_point field_at(const field *f, double position);

#endif
