/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The beam of beam.h with the tension that a shallow sag makes: one rank-one term
 * lambda^2 (integral of y)^2 in the energy (Irvine and Caughey 1974, with bending and springs). */
#ifndef CORE_IDENTIFY_SAG_H
#define CORE_IDENTIFY_SAG_H

#include "core/identify/beam.h"

/* Mode n by frequency, lambda2 > 0. */
beam_mode sag_solve(int n, double u, const beam_end ends[2], double lambda2);

#endif
