/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * How many natural frequencies lie below s: by Sylvester's law of inertia, the negative pivots of
 * K - s^2 M in the unknowns strains, displacements of nodes and forces between elements, less one
 * for each force and each held displacement. Eliminated from element to element, so that the work
 * grows with the length only.
 */
#ifndef CORE_CABLE_INERTIA_H
#define CORE_CABLE_INERTIA_H

#include "core/cable/stiffness.h"

/* `*safe`: no pivot was near 0; where it is false s should be moved a little. */
strum_status inertia_count(const stiffness *k, double s, work *w, long *below, bool *safe);

#endif
