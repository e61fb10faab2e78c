/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the daemon answers: one row an endpoint. */
#include <string.h>

#include "endpoints/endpoint.h"

extern const endpoint absorber_optimize, catenary_frequencies, forced_tension, inclined_modes,
    taut_matrix, taut_modes, validation;

const endpoint *const endpoints[] = {
    &catenary_frequencies, &forced_tension,    &inclined_modes, &taut_modes,
    &taut_matrix,          &absorber_optimize, &validation,     NULL,
};

const endpoint *endpoint_find(const char *path)
{
    for (int i = 0; endpoints[i] != NULL; i++)
        if (strcmp(endpoints[i]->path, path) == 0)
            return endpoints[i];
    return NULL;
}
