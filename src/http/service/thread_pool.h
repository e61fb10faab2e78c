/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Worker threads and the bounded queue before them. */
#ifndef HTTP_SERVICE_THREAD_POOL_H
#define HTTP_SERVICE_THREAD_POOL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A piece of work, embedded in what it is about; the giver keeps it until `work` is called. */
typedef struct job {
    void (*work)(struct job *j);
    struct job *next;
} job;

typedef struct thread_pool thread_pool;

/* NULL when a thread cannot be had. */
thread_pool *thread_pool_new(int workers, size_t depth);
/* Finishes all that was given, then ends the threads. */
void thread_pool_free(thread_pool *c);

/* A place in the queue, to be used by thread_pool_queue; false when it is full. */
bool thread_pool_reserve(thread_pool *c);
void thread_pool_queue(thread_pool *c, job *j);
/* Work that needs no place and gives way: at most all workers but one are at it (with a single
 * worker: that one), and while others wait it gets a quarter of the turns. */
void thread_pool_queue_background(thread_pool *c, job *j);

typedef struct thread_pool_counters {
    int workers;
    size_t depth, queued, working; /* queued: reserved places that no worker has taken up */
    size_t background;             /* of those that work */
    uint64_t done, refused;
    int64_t full_since_ms; /* first refusal since the queue was half empty, by clock_ms(); 0:
                              none */
} thread_pool_counters;
thread_pool_counters thread_pool_count(thread_pool *c);

#endif
