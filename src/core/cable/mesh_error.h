/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the discretisation leaves of a mode, by the last coefficients on each element: an estimate
 * of the relative error of its frequency. */
#ifndef CORE_CABLE_MESH_ERROR_H
#define CORE_CABLE_MESH_ERROR_H

#include "core/cable/motion.h"

double mesh_error(const motion *m, const double *v);

#endif
