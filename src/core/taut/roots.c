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

/* Frequencies that differ by rounding only are one: there the decay decides. */
static void even_ties(strum_taut_root *roots, size_t count)
{
    for (size_t i = 1; i < count; i++)
        for (size_t k = i;
             k > 0 && roots[k].decay < roots[k - 1].decay &&
             roots[k].frequency - roots[k - 1].frequency <= TAUT_TIE * roots[k].frequency;
             k--) {
            const strum_taut_root kept = roots[k];
            roots[k] = roots[k - 1];
            roots[k - 1] = kept;
        }
}

strum_status taut_roots_miss(strum_taut_roots *out, strum_taut_missing missing,
                             strum_error *fault)
{
    strum_taut_missing *more =
        realloc(out->missing, (out->missing_count + 1) * sizeof *out->missing);
    if (more == NULL)
        return error_set(fault, STRUM_ERR_MEMORY, "no memory for roots");
    out->missing = more;
    out->missing[out->missing_count++] = missing;
    out->lost += missing.fate != STRUM_TAUT_OVERDAMPED;
    return STRUM_OK;
}

void taut_roots_sort(strum_taut_roots *out, bool oscillating)
{
    if (oscillating && out->count > 1) {
        qsort(out->roots, out->count, sizeof *out->roots, by_frequency);
        even_ties(out->roots, out->count);
    }
    if (out->overdamped_count > 1)
        qsort(out->overdamped, out->overdamped_count, sizeof *out->overdamped, by_frequency);
}

void strum_taut_roots_free(strum_taut_roots *roots)
{
    if (roots == NULL)
        return;
    free(roots->roots);
    free(roots->overdamped);
    free(roots->missing);
    free(roots);
}
