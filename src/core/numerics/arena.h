/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scratch memory of one computation: handed out piecewise, freed at once. */
#ifndef CORE_NUMERICS_ARENA_H
#define CORE_NUMERICS_ARENA_H

#include <stddef.h>

typedef struct arena_block arena_block;
typedef struct arena {
    arena_block *last;
} arena;

/* Zeroed memory that lives until arena_free; NULL when there is none left. */
void *arena_alloc(arena *a, size_t count, size_t size);
double *arena_doubles(arena *a, size_t count);
void arena_free(arena *a);

#endif
