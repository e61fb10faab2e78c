/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "endpoints/table.h"

#include <string.h>

static const endpoint *const mechanics[] = {MECHANICS, NULL};

const endpoint *table_find(const endpoint *const *table, const char *path)
{
    for (int i = 0; table[i] != NULL; i++)
        if (strcmp(table[i]->path, path) == 0)
            return table[i];
    return NULL;
}

const endpoint *mechanics_find(const char *path)
{
    return table_find(mechanics, path);
}
