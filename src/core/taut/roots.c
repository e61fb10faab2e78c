/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/taut/roots.h"

#include <stdlib.h>

#include "core/numerics/status.h"

strum_status taut_roots_add(strum_taut_roots *out, strum_taut_root root, bool overdamped,
                            strum_error *fault)
{
    strum_taut_root **list = overdamped ? &out->overdamped : &out->roots;
    size_t *count = overdamped ? &out->overdamped_count : &out->count;
    /* rooms of 0, 16, 32, 64, ... */
    if (*count == 0 || (*count >= 16 && (*count & (*count - 1)) == 0)) {
        strum_taut_root *more = realloc(*list, (*count < 16 ? 16 : 2 * *count) * sizeof **list);
        if (more == NULL)
            return error_set(fault, STRUM_ERR_MEMORY, "no memory for roots");
        *list = more;
    }
    (*list)[(*count)++] = root;
    return STRUM_OK;
}

static int by_frequency(const void *a, const void *b)
{
    const strum_taut_root *x = a, *y = b;
    if (x->frequency != y->frequency)
        return x->frequency < y->frequency ? -1 : 1;
    return (x->decay > y->decay) - (x->decay < y->decay);
}

void taut_roots_sort(strum_taut_roots *out, bool oscillating)
{
    if (oscillating && out->count > 1)
        qsort(out->roots, out->count, sizeof *out->roots, by_frequency);
    if (out->overdamped_count > 1)
        qsort(out->overdamped, out->overdamped_count, sizeof *out->overdamped, by_frequency);
}

void strum_taut_roots_free(strum_taut_roots *roots)
{
    if (roots == NULL)
        return;
    free(roots->roots);
    free(roots->overdamped);
    free(roots);
}
