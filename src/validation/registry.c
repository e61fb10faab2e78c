/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "validation/registry.h"

#include "endpoints/table.h"

extern const endpoint validation;

const endpoint *const endpoints[] = {MECHANICS, &validation, NULL};

const endpoint *endpoint_find(const char *path)
{
    return table_find(endpoints, path);
}
