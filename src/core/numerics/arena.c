/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/numerics/arena.h"

#include <stdint.h>
#include <stdlib.h>

struct arena_block {
    arena_block *before;
    max_align_t data[];
};

void *arena_alloc(arena *a, size_t count, size_t size)
{
    if (size != 0 && count > (SIZE_MAX - sizeof(arena_block)) / size)
        return NULL;
    arena_block *block = calloc(1, sizeof *block + count * size);
    if (block == NULL)
        return NULL;
    block->before = a->last;
    a->last = block;
    return block->data;
}

double *arena_doubles(arena *a, size_t count)
{
    return arena_alloc(a, count, sizeof(double));
}

void arena_free(arena *a)
{
    while (a->last != NULL) {
        arena_block *before = a->last->before;
        free(a->last);
        a->last = before;
    }
}
