/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CORE_ABSORBER_CLIMB_H
#define CORE_ABSORBER_CLIMB_H

#include "core/absorber/search.h"

/* From `t` to the best place near, in at most `rounds` rounds, the first within `reach` of
 * `t`; ends where a round gains less than `gain` of what there is. Returns the objective
 * there. */
double absorber_climb(search *s, double *t, double reach, int rounds, double gain);

#endif
