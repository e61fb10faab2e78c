/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The cable that hangs free between its ends. Its force F0 at end 1 minimises
 *     Phi(F0) = INT (|F| + F^2/2EA) dS - F0.R,
 * R the vector from end 1 to end 2: a norm of an affine function and a square, hence convex. Its
 * gradient is the error of end 2's place. So there is one shape, whatever the mix of pieces and
 * loads, and Newton's method with steps that are cut finds it from anywhere.
 */
#ifndef CORE_CABLE_FREE_H
#define CORE_CABLE_FREE_H

#include "core/cable/line.h"
#include "core/numerics/status.h"
#include "core/numerics/work.h"

/* The force (h, v) at end 1. `warm`: *h, *v come near it already, from a like cable.
 * STRUM_ERR_IMPOSSIBLE where no such cable hangs. */
strum_status free_solve(const cable_line *line, double span, double rise, bool warm, double *h,
                        double *v, work *w, strum_error *error);

#endif
