/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/numerics/arena.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

#include "core/numerics/work.h"

struct arena_block {
    arena_block *before;
    size_t size; /* of all of it */
    max_align_t data[];
};

static void *take(arena *a, size_t count, size_t size, bool zeroed)
{
    if (size != 0 && count > (SIZE_MAX - sizeof(arena_block)) / size)
        return NULL;
    const size_t whole = sizeof(arena_block) + count * size;
    if (!work_take(a->work, whole))
        return NULL;
    arena_block *block = zeroed ? calloc(1, whole) : malloc(whole);
    if (block == NULL) {
        work_give_back(a->work, whole);
        return NULL;
    }
    block->size = whole;
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
        work_give_back(a->work, a->last->size);
        free(a->last);
        a->last = before;
    }
}
