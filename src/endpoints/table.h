/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mechanics that are answered: one row an endpoint. What answers about them stands above
 * (validation/registry.h). */
#ifndef ENDPOINTS_TABLE_H
#define ENDPOINTS_TABLE_H

#include "endpoints/endpoint.h"

extern const endpoint absorber_optimize, cable_modes, cable_statics, catenary_frequencies,
    forced_tension, identify_tension, inclined_modes, taut_matrix, taut_modes;

/* Rows of a table, in the order in which they are shown. */
#define MECHANICS                                                                              \
    &catenary_frequencies, &forced_tension, &inclined_modes, &cable_statics, &cable_modes,     \
        &taut_modes, &taut_matrix, &absorber_optimize, &identify_tension

/* The endpoint of a path in a table that NULL ends, or NULL. */
const endpoint *table_find(const endpoint *const *table, const char *path);
/* The endpoint of a path among the mechanics, or NULL. */
const endpoint *mechanics_find(const char *path);

#endif
