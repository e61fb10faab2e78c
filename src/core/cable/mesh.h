/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where the elements of small motion begin and end, and their degrees. */
#ifndef CORE_CABLE_MESH_H
#define CORE_CABLE_MESH_H

#include "core/cable/motion.h"

typedef struct {
    double from, to; /* unstretched */
    size_t piece;
    int degree, strain_degree;
} mesh_cell;

typedef struct {
    mesh_cell *cells; /* NULL: only count */
    int count;
    bool rod; /* bending stiffness in the static shape */
} mesh;

/* Force at `s` from the start of a piece: its size is the tension. */
double mesh_tension(const cable_piece *piece, double s);

/* The cells of pieces first .. last - 1. */
void mesh_make(const strum_hanging *cable, const motion_choice *choice, mesh *m);

#endif
