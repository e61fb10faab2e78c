/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Worker threads and the bounded queue before them. */
#ifndef HTTP_SERVICE_THREAD_POOL_H
#define HTTP_SERVICE_THREAD_POOL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A job, embedded in the object it works on; the caller keeps it until `work` is called. */
typedef struct job {
    void (*work)(struct job *j);
    struct job *next;
} job;

typedef struct thread_pool thread_pool;

/* Returns NULL when memory or a thread cannot be had. */
thread_pool *thread_pool_new(int workers, size_t depth);
/* Finishes all jobs queued, then ends the threads. */
void thread_pool_free(thread_pool *c);

/* Reserves a place in the queue for thread_pool_queue; returns false when it is full. */
bool thread_pool_reserve(thread_pool *c);
void thread_pool_queue(thread_pool *c, job *j);
/* Queues a low-priority job; it needs no reservation. At most workers - 1 (at least 1) of them
 * run at once; while requests wait, one job in four is low-priority. */
void thread_pool_queue_background(thread_pool *c, job *j);

typedef struct thread_pool_counters {
    int workers;
    size_t depth, queued, working; /* queued: reserved places whose job no worker has begun */
    size_t background;             /* of those working */
    uint64_t done, refused;
    int64_t full_since_ms; /* first refusal since the queue was half empty, by clock_ms(); 0:
                              none */
} thread_pool_counters;
thread_pool_counters thread_pool_count(thread_pool *c);

#endif
