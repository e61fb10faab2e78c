/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CORE_TAUT_SHAPE_H
#define CORE_TAUT_SHAPE_H

#include "core/taut/taut.h"

struct strum_taut_shape {
    strum_taut *chain; /* a counted reference */
    work *work;        /* while it is made */
    taut_at at;
    double *x;   /* of the count + 1 stations, left of each component and at the right end */
    cplx *y, *v; /* there; the same block as x */
    double *nodes;
    size_t node_count, node_room;
    strum_taut_antinode *antinodes;
    size_t antinode_count, antinode_room;
};

/* y and V at distance x into component i. */
void taut_shape_inside(const strum_taut_shape *shape, size_t i, double x, cplx *y, cplx *v);
/* The same at x from the left end of the chain. */
void taut_shape_point(const strum_taut_shape *shape, double x, strum_taut_point *point);
/* Fills nodes and antinodes of a root without damping; scales nothing. */
strum_status taut_shape_survey(strum_taut_shape *shape, strum_error *error);

/* ---- of nodes.c, for the components ---- */

static inline bool taut_signs_differ(double a, double b)
{
    return (signbit(a) != 0) != (signbit(b) != 0);
}
/* STRUM_ERR_METHOD where a shape would have so many nodes that nobody can use them. */
strum_status taut_nodes_fit(double count, strum_error *error);
strum_status taut_node_add(strum_taut_shape *shape, double x, strum_error *error);
strum_status taut_antinode_add(strum_taut_shape *shape, double x, double amplitude,
                               strum_error *error);
/* Is station i a held end, or nothing but points between? */
bool taut_at_held_end(const strum_taut_shape *shape, size_t i);
/* The node of a straight piece, `from` into component i and `length` long, if it has one. */
strum_status taut_straight_survey(strum_taut_shape *shape, size_t i, double from, double y_from,
                                  double length, double y_to, strum_error *error);
/* Where y or V changes sign between two distances into component i (Illinois' rule). */
double taut_crossing(const strum_taut_shape *shape, size_t i, bool force, double lo, double hi);

#endif
