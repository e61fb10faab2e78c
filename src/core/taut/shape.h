/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CORE_TAUT_SHAPE_H
#define CORE_TAUT_SHAPE_H

#include "core/taut/taut.h"

struct strum_taut_shape {
    strum_taut *chain; /* a counted reference */
    taut_at at;
    double *x;   /* of the count + 1 stations, left of each component and at the right end */
    cplx *y, *v; /* there; the same block as x */
    double *nodes;
    size_t node_count, node_room;
    strum_taut_antinode *antinodes;
    size_t antinode_count, antinode_room;
};

/* Of state.c, which nodes.c and shape.c stand on: y and V at distance x into component i. */
void taut_shape_inside(const strum_taut_shape *shape, size_t i, double x, cplx *y, cplx *v);
/* The same at x from the left end of the chain. */
void taut_shape_point(const strum_taut_shape *shape, double x, strum_taut_point *point);
/* Fills nodes and antinodes of a root without damping; scales nothing. */
strum_status taut_shape_survey(strum_taut_shape *shape, strum_error *fault);

#endif
