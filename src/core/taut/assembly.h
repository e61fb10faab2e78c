/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The second method's chain: displacements as unknowns, assembled from stiffness, damping and
 * mass matrices of each component (from its energies, not from its transfer matrix). Cables are
 * spectral elements, or, where only w^2 matters, exact dynamic stiffnesses.
 */
#ifndef CORE_TAUT_ASSEMBLY_H
#define CORE_TAUT_ASSEMBLY_H

#include "core/taut/taut.h"

/* A uniform cable kept for its dynamic stiffness: nodes at its ends and at an inner point that
 * no mode has for a node of both its parts. */
typedef struct taut_wire {
    double length, slowness, impedance; /* as of a cable component */
    int node[3];
    double lever; /* of the left node: y = lever times its unknown */
} taut_wire;

typedef struct taut_assembly {
    int size, band;    /* unknowns; largest distance of two that meet */
    int last;          /* the unknown at the right end */
    double *k, *c, *m; /* lower bands: row i, column i - band + j at i (band + 1) + j */
    taut_wire *wires;
    int wire_count;
} taut_assembly;

/* Degree of the spectral elements. */
#define TAUT_DEGREE 12

/* Gauss-Lobatto nodes on [-1, 1], weights, and derivatives of the Lagrange polynomials. */
typedef struct taut_lobatto {
    double x[TAUT_DEGREE + 1], weight[TAUT_DEGREE + 1], slope[TAUT_DEGREE + 1][TAUT_DEGREE + 1];
} taut_lobatto;

void taut_lobatto_make(taut_lobatto *lobatto);

/* Where assembling stands: the unknown at the left, y = lever times it. */
typedef struct taut_cursor {
    taut_assembly *a; /* its k NULL: only measured */
    const taut_lobatto *lobatto;
    int node, next;
    double lever;
    double highest; /* rad/s */
    bool dynamic;   /* uniform cables become wires */
} taut_cursor;

/* ---- what a component's `place` is made of (elements.c) ---- */

/* An element of n local unknowns: the first is the cursor's, the others are new; the last one
 * becomes the cursor's. Matrices n x n by rows, NULL for zero. */
void taut_element_place(taut_cursor *at, int n, const double *k, const double *c,
                        const double *m);

/* A cable of linear tension by spectral elements; `foundation`: on the elastic foundation
 * T'^2/(16 T) that the WKB matrix stands for. */
typedef struct taut_element_cable {
    double length, tension_0, tension_1, mass, drag;
    bool foundation;
} taut_element_cable;
void taut_elements_place(taut_cursor *at, const taut_element_cable *cable);

/* A uniform cable, kept for its dynamic stiffness. */
void taut_wire_place(taut_cursor *at, double length, double slowness, double impedance);

/* ---- the whole chain (assembly.c) ---- */

/* Ready for frequencies up to `highest`; `dynamic` keeps uniform cables as wires. Ended by
 * taut_assembly_free. STRUM_ERR_METHOD above `most` unknowns. */
strum_status taut_assembly_make(const strum_taut *chain, double highest, bool dynamic, int most,
                                taut_assembly *assembly, strum_error *error);
void taut_assembly_free(taut_assembly *assembly);

#endif
