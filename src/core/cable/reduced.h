/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The cable in a basis of some dozens of motions (krylov.h), with what is attached last: an
 * absorber's mass is one unknown more. First the undamped modes, in which stiffness is 1 and mass
 * 1/omega^2; then what damps.
 */
#ifndef CORE_CABLE_REDUCED_H
#define CORE_CABLE_REDUCED_H

#include "core/cable/krylov.h"

typedef struct reduced {
    const krylov *basis;
    int size, absorbers, n; /* of the basis; unknowns in all */
    double *part;           /* links: how far each vector moves along them, size a link */
    double *mass, *stiff;   /* n x n; stiff NULL: the identity */
    double *mu, *modes;     /* undamped: 1/omega^2 descending, vectors n x n */
} reduced;

strum_status reduced_make(const krylov *basis, arena *memory, reduced *r);
/* All undamped modes of the reduced cable. */
strum_status reduced_undamped(reduced *r, arena *memory);

#endif
