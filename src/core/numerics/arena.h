/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What one computation may use: memory, handed out piecewise and freed at once, and work. */
#ifndef CORE_NUMERICS_ARENA_H
#define CORE_NUMERICS_ARENA_H

#include <stddef.h>

typedef struct arena_block arena_block;
typedef struct arena {
    arena_block *last;
    /* Of the solve this belongs to: counts the memory, and linalg.h asks it before it begins
     * anything long. NULL: no limit, and once it has ended. */
    struct work *work;
} arena;

/* Zeroed memory that lives until arena_free; NULL when there is none left, or none that the work
 * may use: its status then says so (work_result). */
void *arena_alloc(arena *a, size_t count, size_t size);
double *arena_doubles(arena *a, size_t count);
/* The same with any contents: for large tables that are written before they are read, whose
 * zeroing would cost as much as a tenth of a solve. */
double *arena_room(arena *a, size_t count);
void arena_free(arena *a);

#endif
