/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/numerics/arena.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

struct arena_block {
    arena_block *before;
    max_align_t data[];
};

static void *take(arena *a, size_t count, size_t size, bool zeroed)
{
    if (size != 0 && count > (SIZE_MAX - sizeof(arena_block)) / size)
        return NULL;
    const size_t bytes = sizeof(arena_block) + count * size;
    arena_block *block = zeroed ? calloc(1, bytes) : malloc(bytes);
    if (block == NULL)
        return NULL;
    block->before = a->last;
    a->last = block;
    return block->data;
}

void *arena_alloc(arena *a, size_t count, size_t size)
{
    return take(a, count, size, true);
}

double *arena_doubles(arena *a, size_t count)
{
    return take(a, count, sizeof(double), true);
}

double *arena_room(arena *a, size_t count)
{
    return take(a, count, sizeof(double), false);
}

void arena_free(arena *a)
{
    while (a->last != NULL) {
        arena_block *before = a->last->before;
        free(a->last);
        a->last = before;
    }
}
