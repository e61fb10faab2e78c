/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Worker threads and the bounded queues before them, in lanes by estimated cost.
 *
 * One worker more than asked for takes cheap jobs only, so that these never wait for costly
 * ones. In a lane clients take turns, so that each has an equal share of the work, and one client
 * leaves places in the queue to others. Long jobs (THREAD_POOL_LONG_US) occupy at most workers - 1 workers, at least one.
 */
#ifndef HTTP_SERVICE_THREAD_POOL_H
#define HTTP_SERVICE_THREAD_POOL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "http/service/client.h"

/* Jobs estimated to take at least this long may not occupy every worker. */
#define THREAD_POOL_LONG_US 1e5

/* By priority. A lane whose jobs were passed over three times in a row comes next. */
typedef enum thread_pool_lane {
    LANE_CHEAP,      /* requests estimated to take less than cheap_us */
    LANE_COSTLY,     /* other requests */
    LANE_LONG,       /* requests of THREAD_POOL_LONG_US and more */
    LANE_BATCH,      /* batches' turns */
    LANE_BATCH_LONG, /* batches' items of THREAD_POOL_LONG_US and more */
    LANES
} thread_pool_lane;

/* A job, embedded in the object it works on; the caller keeps it until `work` is called. */
typedef struct job {
    void (*work)(struct job *j);
    double cost_us;  /* estimate */
    size_t bytes;    /* of memory while it is at work, estimate */
    unsigned client; /* below CLIENTS */
    /* the rest is the pool's */
    double turn;
    struct job *next;
    thread_pool_lane lane;
} job;

typedef struct thread_pool thread_pool;

typedef struct thread_pool_options {
    int workers;     /* at least 1; one more is started for cheap jobs if cheap_us > 0 */
    size_t depth;    /* maximum number of jobs waiting, of cheap and of other requests each */
    double cheap_us; /* jobs estimated to take less are cheap */
    /* May be NULL: whether a job of so many bytes may begin, asked again ten times a second while
     * it may not; and its end. With `memory`, under the lock of the pool: short. */
    bool (*begin)(void *memory, size_t bytes);
    void (*end)(void *memory, size_t bytes);
    void *memory;
} thread_pool_options;

/* Returns NULL when memory or a thread cannot be had. */
thread_pool *thread_pool_new(const thread_pool_options *options);
/* Finishes all jobs queued, then ends the threads. */
void thread_pool_free(thread_pool *c);

/* Queues a request's job in the lane of its cost; returns false when there is no place. A place
 * that an idle worker would take at once does not count. */
bool thread_pool_queue(thread_pool *c, job *j);
/* Queues a turn of a batch or a long item of one, which needs no place. */
void thread_pool_queue_batch(thread_pool *c, job *j);

typedef struct thread_pool_counters {
    int workers;              /* the one for cheap jobs included */
    size_t working, depth;    /* workers at work; the limit on each queue */
    size_t queued[LANES];     /* jobs that no worker has begun */
    double backlog_us[LANES]; /* their estimated cost */
    uint64_t done, refused;
    int64_t full_since_ms; /* first refusal since the queue was half empty, by clock_ms(); 0:
                              none */
} thread_pool_counters;
thread_pool_counters thread_pool_count(thread_pool *c);
/* Returns the estimated time in seconds until the requests queued now have had their turn. */
double thread_pool_backlog_s(thread_pool *c);
/* "cheap", "costly", ... for metrics. */
const char *thread_pool_lane_name(thread_pool_lane lane);

#endif
