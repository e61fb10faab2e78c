/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CORE_SUSPENDED_STRAIN_H
#define CORE_SUSPENDED_STRAIN_H

#include "core/suspended/roots.h"

/* The `want` lowest in-plane modes of an undamped cable by Galerkin's method with `size`
 * functions each of the transverse displacement w and of the strain e; independent of the force
 * form in unknowns, equations and boundary conditions, at any stiffness. */
strum_status strain_roots(const strum_cable *cable, const mapping *x, int size, int want,
                          arena *a, root_list *list);

#endif
