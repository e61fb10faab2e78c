/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What requests under way may hold together, beside the cache: bodies, solves, and answers that
 * are not sent yet. */
#ifndef HTTP_SERVICE_MEMORY_H
#define HTTP_SERVICE_MEMORY_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

#include "cache/cache.h"

typedef struct memory_account {
    size_t limit;
    atomic_size_t bodies, solves;
    cache *cache; /* answers that it counts are not counted here */
} memory_account;

/* Half of what this process may use: the smallest memory.max of its control groups (version 2), or
 * the machine's memory. */
size_t memory_default(void);

/* Bytes in use now. */
size_t memory_used(const memory_account *m);
/* Counts `bytes` more of a body of which `before` are counted; false: there is no room, and the
 * body is not small. */
bool memory_take_body(memory_account *m, size_t before, size_t bytes);
void memory_give_body(memory_account *m, size_t bytes);
/* For a thread_pool: whether a job that needs `bytes` may begin now. One may when nothing else
 * is at work, or it would never be. It is counted until memory_end_solve. */
bool memory_begin_solve(void *account, size_t bytes);
void memory_end_solve(void *account, size_t bytes);
/* Whether a small solve may begin now. */
bool memory_for_small(const memory_account *m);
/* The most that one solve may hold where all may hold `limit`. */
size_t memory_solve_most(size_t limit);

#endif
