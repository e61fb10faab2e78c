/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the daemon answers: the mechanics (endpoints/table.h), and the validation that asks them. */
#ifndef VALIDATION_REGISTRY_H
#define VALIDATION_REGISTRY_H

#include "endpoints/endpoint.h"

/* All endpoints, ended by NULL. */
extern const endpoint *const endpoints[];
/* The endpoint of a path, or NULL. */
const endpoint *endpoint_find(const char *path);

#endif
