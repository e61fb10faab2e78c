/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Characteristic roots of a discretised cable, before they are chosen and numbered. */
#ifndef CORE_SUSPENDED_ROOTS_H
#define CORE_SUSPENDED_ROOTS_H

#include "core/suspended/in_plane.h"

typedef struct root {
    double _Complex s; /* motion ~ e^{s t}; Im s >= 0 */
    double natural; /* where the damping is proportional to the mass: its undamped frequency */
    strum_symmetry symmetry;
    double _Complex *vector; /* coefficients; NULL when not asked for */
    int length;              /* of the vector */
    double _Complex constant[2];
} root;

typedef struct root_list {
    root *items; /* memory of the arena that was handed in */
    int count;
} root_list;

/* Makes room for `more` roots. */
strum_status root_list_grow(root_list *list, int more, arena *a);

/* s^2 + rate s + w^2 = 0: one root with Im > 0, or two real ones. Appends them (one of them
 * carries the vector) to `list`, which has room. */
void roots_of_natural(double w, double rate, const root *model, root_list *list);

/* One discretisation, and the roots that are wanted of it. */
typedef struct root_search {
    const strum_cable *cable;
    const mapping *x;
    strum_plane plane;
    in_plane_form form; /* out of plane: the clamped form stands for the force's dual problem */
    int size, block;    /* functions of it, and of a smaller one that is solved besides */
    int want;           /* roots of each symmetry class, from the lowest */
    bool vectors;
} root_search;

/* The matrices of one part at its full size; leading blocks are smaller discretisations. */
typedef struct in_plane_assembly {
    in_plane_part part;
    double *complementary;  /* K: complementary form, beside the part's compliance A */
    double *mass, *damping; /* M and D: mixed form */
} in_plane_assembly;

/* True when the damping matrix is a multiple of the mass matrix; then the undamped modes are
 * the modes. */
bool in_plane_proportional(const strum_cable *cable);

/* What every form begins with: the basis, the frame at its nodes (both memory of `functions`),
 * and the part of a symmetry class, with its compliance in `scratch`; the part itself is memory
 * of `a`. `frame` refers to `basis`. */
strum_status in_plane_begin(const root_search *q, strum_symmetry symmetry, arena *functions,
                            arena *a, arena *scratch, legendre *basis, in_plane_frame *frame,
                            in_plane_part *part);

/* The part is memory of `a`, the matrices and constants of `scratch`. */
strum_status in_plane_assemble(const root_search *q, strum_symmetry symmetry, arena *a,
                               arena *scratch, in_plane_assembly *assembly);

/* Roots of the leading block of unknowns with k < size: the lowest wanted where the problem is
 * symmetric, all of them where it is quadratic. Appended to `list`; memory is the arena's. */
strum_status in_plane_roots(const root_search *q, const in_plane_assembly *assembly, int size,
                            bool vectors, arena *a, root_list *list);

/* Out of plane: W = sum a_k q_k(x), k >= 1, or the dual (natural) problem in the transverse
 * force. Frequencies of unit mass. */
strum_status out_of_plane_roots(const root_search *q, arena *a, root_list *list,
                                root_list *inner);

#endif
