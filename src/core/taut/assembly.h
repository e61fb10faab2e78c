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
    const taut_component *cable;
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

/* Ready for frequencies up to `highest`; `dynamic` keeps uniform cables as wires. Ended by
 * taut_assembly_free. STRUM_ERR_METHOD above `most` unknowns. */
strum_status taut_assembly_make(const strum_taut *chain, double highest, bool dynamic, int most,
                                taut_assembly *assembly, strum_error *fault);
void taut_assembly_free(taut_assembly *assembly);

#endif
