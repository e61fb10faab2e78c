/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Counters, and their text for Prometheus (format 0.0.4). */
#ifndef HTTP_SERVICE_METRICS_H
#define HTTP_SERVICE_METRICS_H

#include <stdint.h>

#include "cache/cache.h"
#include "cache/store.h"
#include "http/service/thread_pool.h"
#include "json/strbuf.h"

typedef struct metrics metrics;

/* What others count, at one moment. */
typedef struct metrics_snapshot {
    cache_counters cache;
    thread_pool_counters pool;
    bool has_store;
    store_counters store; /* only if has_store */
    size_t busy;          /* requests under way */
    size_t memory, memory_limit;
} metrics_snapshot;

/* Counters for `routes` routes; `path` gives the label of each. Returns NULL without memory. */
metrics *metrics_new(size_t routes, const char *(*path)(size_t index));
void metrics_free(metrics *m);
/* Counts an answer: its route, status, bytes, and the time from the request's headers to its
 * first byte. */
void metrics_request(metrics *m, size_t index, int status, size_t bytes, double us);
/* Counts a computation: its status, time, and the steps it reported (progress.evaluations). */
void metrics_solve(metrics *m, int status, double us, int64_t steps);
void metrics_write(const metrics *m, const metrics_snapshot *now, strbuf *out);

#endif
