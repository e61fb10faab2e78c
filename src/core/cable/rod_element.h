/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One element of the rod: energy's derivatives, its bubbles eliminated. */
#ifndef CORE_CABLE_ROD_ELEMENT_H
#define CORE_CABLE_ROD_ELEMENT_H

#include "core/cable/rod.h"

/* Functions of an element at Gauss points: two hats, then bubbles. */
typedef struct {
    int degree, points;
    double *x, *w;
    double *value; /* [function * points + point] */
} rod_rule;

/* Right-hand columns: the energy's derivative by the angles, and its mixed ones with the force. */
enum { ROD_GRADIENT, ROD_FORCE_X, ROD_FORCE_Z, ROD_COLUMNS };

/* By the angles of its two nodes, what is left when its bubbles are eliminated; and by the force
 * at end 1. */
typedef struct {
    double hats[2][2];
    double column[2][ROD_COLUMNS];
    double force[2][2]; /* SUM over bubbles of B'K^-1 B, and INT tt'/EA */
    double along[2];    /* of B'K^-1 g */
    double reach[2];    /* INT (1 + e) t */
    bool stable;        /* its bubbles are: as they were taken */
    double tension;     /* largest size of the force */
} rod_condensed;

strum_status rod_rule_make(int degree, arena *memory, rod_rule *rule);
/* `solved`: room for (degree - 1) x 5: of the bubbles, by the two hats and the columns.
 * `room`: for rod_element_room(degree). */
rod_condensed rod_condense(const strum_hanging *cable, const rod_element *e,
                           const rod_rule *rule, double *solved, double *room);
size_t rod_element_room(int degree);
/* From its start to its end, and its stretched length; `room` as above. */
void rod_reach(const strum_hanging *cable, const rod_element *e, const rod_rule *rule,
               double *room, double *x, double *z, double *length);

#endif
