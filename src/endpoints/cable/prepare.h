/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The checks across the fields of a general cable, and the cable of the core that they describe. */
#ifndef ENDPOINTS_CABLE_PREPARE_H
#define ENDPOINTS_CABLE_PREPARE_H

#include "endpoints/cable/fields.h"

/* Fills what is computed; adds every fault across fields. `s`: the table of the request. */
void hung_prepare(const schema *s, hung_input *in, schema_arena *arena, problem *p);
/* 0, or at least 2. */
void hung_check_shape_points(int64_t shape_points, problem *p);

#endif
