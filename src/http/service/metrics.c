/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/service/metrics.h"

#include <inttypes.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

#include <strum/version.h>

#include "http/service/clock.h"
#include "http/service/log.h"

/* The statuses this daemon answers with; the last row counts any other. */
static const int statuses[] = {200, 204, 303, 304, 400, 401, 403, 404,
                               405, 413, 415, 422, 500, 501, 503, 0};
#define STATUSES (sizeof statuses / sizeof *statuses)

/* Latency buckets: upper bounds in microseconds; the last bucket takes the rest. */
static const uint64_t bounds_us[] = {100,     250,     500,     1000,    2500,   5000,
                                     10000,   25000,   50000,   100000,  250000, 500000,
                                     1000000, 2500000, 5000000, 10000000};
#define BOUNDS (sizeof bounds_us / sizeof *bounds_us)

typedef struct route_metrics {
    atomic_uint_fast64_t requests[STATUSES], took[BOUNDS + 1], took_us;
} route_metrics;

struct metrics {
    const char *(*path)(size_t index);
    size_t count;
    atomic_uint_fast64_t bytes, solve_us, solve_steps, solve_failures;
    route_metrics routes[];
};

metrics *metrics_new(size_t routes, const char *(*path)(size_t index))
{
    metrics *m = calloc(1, sizeof *m + routes * sizeof *m->routes);
    if (!m)
        return NULL;
    m->path = path;
    m->count = routes;
    return m;
}

void metrics_free(metrics *m)
{
    free(m);
}

static void add(atomic_uint_fast64_t *counter, uint64_t amount)
{
    atomic_fetch_add_explicit(counter, amount, memory_order_relaxed);
}

void metrics_request(metrics *m, size_t index, int status, size_t bytes, double us)
{
    route_metrics *r = &m->routes[index];
    size_t i = 0, bucket = 0;
    while (statuses[i] != status && statuses[i] != 0)
        i++;
    while (bucket < BOUNDS && us > (double)bounds_us[bucket])
        bucket++;
    add(&r->requests[i], 1);
    add(&r->took[bucket], 1);
    add(&r->took_us, (uint64_t)us);
    add(&m->bytes, bytes);
}

void metrics_solve(metrics *m, int status, double us, int64_t steps)
{
    add(&m->solve_us, (uint64_t)us);
    add(&m->solve_steps, (uint64_t)steps);
    add(&m->solve_failures, status != 200);
}

static void value(strbuf *out, const char *name, const char *kind, const char *help,
                  uint64_t number)
{
    strbuf_format(out, "# HELP strum_%s %s\n# TYPE strum_%s %s\nstrum_%s %" PRIu64 "\n", name,
                  help, name, kind, name, number);
}

static void write_requests(const metrics *m, strbuf *out)
{
    strbuf_add_string(out, "# HELP strum_requests_total Answers sent, by route and status.\n"
                           "# TYPE strum_requests_total counter\n");
    for (size_t index = 0; index < m->count; index++) {
        for (size_t i = 0; i < STATUSES; i++) {
            const uint64_t count = m->routes[index].requests[i];
            char status[16] = "other";
            if (statuses[i])
                snprintf(status, sizeof status, "%d", statuses[i]);
            if (count)
                strbuf_format(out,
                              "strum_requests_total{route=\"%s\",status=\"%s\"} %" PRIu64 "\n",
                              m->path(index), status, count);
        }
    }
}

/* Whole microseconds as seconds: exact, whatever the locale. */
static void write_seconds(uint64_t us, strbuf *out)
{
    strbuf_format(out, "%" PRIu64 ".%06" PRIu64 "\n", us / 1000000, us % 1000000);
}

static void write_latency(const metrics *m, strbuf *out)
{
    strbuf_add_string(out,
                      "# HELP strum_request_seconds Time from a request's headers to the first "
                      "byte of its answer.\n# TYPE strum_request_seconds histogram\n");
    for (size_t index = 0; index < m->count; index++) {
        const route_metrics *r = &m->routes[index];
        const char *path = m->path(index);
        uint64_t below[BOUNDS + 1], total = 0;
        for (size_t i = 0; i <= BOUNDS; i++)
            below[i] = total += r->took[i];
        if (!total)
            continue;
        for (size_t i = 0; i < BOUNDS; i++)
            strbuf_format(out,
                          "strum_request_seconds_bucket{route=\"%s\",le=\"%g\"} %" PRIu64 "\n",
                          path, (double)bounds_us[i] * 1e-6, below[i]);
        strbuf_format(out,
                      "strum_request_seconds_bucket{route=\"%s\",le=\"+Inf\"} %" PRIu64 "\n",
                      path, total);
        strbuf_format(out, "strum_request_seconds_count{route=\"%s\"} %" PRIu64 "\n", path,
                      total);
        strbuf_format(out, "strum_request_seconds_sum{route=\"%s\"} ", path);
        write_seconds(r->took_us, out);
    }
}

static void write_store(store_counters c, strbuf *out)
{
    value(out, "store_hits_total", "counter", "Answers found in the shared store.", c.hits);
    value(out, "store_misses_total", "counter", "Answers that the shared store did not have.",
          c.misses);
    value(out, "store_writes_total", "counter", "Answers put into the shared store.", c.writes);
    value(out, "store_errors_total", "counter",
          "Commands that the shared store did not answer in time, or refused.", c.errors);
    value(out, "store_rejected_total", "counter",
          "Values of the shared store that were damaged or forged, and not used.", c.rejected);
    value(out, "store_away", "gauge", "1: the shared store has failed and is left alone.",
          c.away);
}

static void write_lanes(const thread_pool_counters *w, strbuf *out)
{
    strbuf_add_string(out, "# HELP strum_lane_jobs Work that waits for a worker, by lane.\n"
                           "# TYPE strum_lane_jobs gauge\n");
    for (int i = 0; i < LANES; i++)
        strbuf_format(out, "strum_lane_jobs{lane=\"%s\"} %zu\n",
                      thread_pool_lane_name((thread_pool_lane)i), w->queued[i]);
    strbuf_add_string(out, "# HELP strum_lane_seconds Its estimated cost.\n"
                           "# TYPE strum_lane_seconds gauge\n");
    for (int i = 0; i < LANES; i++) {
        strbuf_format(out, "strum_lane_seconds{lane=\"%s\"} ",
                      thread_pool_lane_name((thread_pool_lane)i));
        write_seconds((uint64_t)w->backlog_us[i], out);
    }
}

void metrics_write(const metrics *m, const metrics_snapshot *now, strbuf *out)
{
    const cache_counters c = now->cache;
    const thread_pool_counters w = now->pool;
    const size_t queued = w.queued[LANE_CHEAP] + w.queued[LANE_COSTLY] + w.queued[LANE_LONG];
    write_requests(m, out);
    write_latency(m, out);
    value(out, "response_bytes_total", "counter", "Bytes of answers' bodies.", m->bytes);
    value(out, "cache_hits_total", "counter", "Requests answered from memory.", c.hits);
    value(out, "cache_misses_total", "counter", "Requests whose answer was not in memory.",
          c.misses);
    value(out, "cache_joins_total", "counter",
          "Requests that waited for an equal one under way.", c.joins);
    value(out, "solves_total", "counter", "Answers computed.", c.solves);
    strbuf_add_string(out,
                      "# HELP strum_solve_seconds_total Time spent computing answers.\n"
                      "# TYPE strum_solve_seconds_total counter\nstrum_solve_seconds_total ");
    write_seconds(m->solve_us, out);
    value(out, "solve_steps_total", "counter",
          "Steps of long computations: trial points of optimisations, forcing frequencies.",
          m->solve_steps);
    value(out, "solve_failures_total", "counter",
          "Computations that ended without an answer: impossible, given up, or failed.",
          m->solve_failures);
    value(out, "cancels_total", "counter",
          "Answers given up: all clients had disconnected or timed out.", c.cancels);
    value(out, "abandoned", "gauge", "Computations that nobody waits for, not ended yet.",
          c.abandoned);
    strbuf_add_string(out, "# HELP strum_abandoned_seconds Age of the oldest of them.\n"
                           "# TYPE strum_abandoned_seconds gauge\nstrum_abandoned_seconds ");
    write_seconds(c.abandoned ? (uint64_t)(clock_ms() - c.abandoned_since_ms) * 1000 : 0, out);
    value(out, "cache_evictions_total", "counter", "Answers dropped for room.", c.evictions);
    value(out, "cache_entries", "gauge", "Answers stored.", c.entries);
    value(out, "cache_bytes", "gauge", "Memory of stored answers, bookkeeping included.",
          c.bytes);
    value(out, "cache_limit_bytes", "gauge", "Maximum memory for stored answers.", c.cap);
    if (now->has_store)
        write_store(now->store, out);
    value(out, "flights", "gauge", "Answers being computed or waiting for it.", c.flights);
    value(out, "workers", "gauge", "Worker threads.", (uint64_t)w.workers);
    value(out, "workers_busy", "gauge", "Workers that solve.", w.working);
    value(out, "queue_depth", "gauge", "Requests that wait for a worker.", queued);
    value(out, "queue_limit", "gauge",
          "Requests that may wait for a worker, of cheap and of other ones each.", w.depth);
    write_lanes(&w, out);
    value(out, "queue_refused_total", "counter", "Requests refused for a full queue.",
          w.refused);
    value(out, "memory_bytes", "gauge",
          "Memory of requests under way: bodies, solves (estimated), answers not sent yet.",
          now->memory);
    value(out, "memory_limit_bytes", "gauge", "Maximum of it.", now->memory_limit);
    value(out, "requests_busy", "gauge", "Requests under way.", now->busy);
    value(out, "log_lines_dropped_total", "counter",
          "Lines of the log dropped, since its reader did not take them in time.",
          log_dropped());
    strbuf_format(out,
                  "# HELP strum_build_info The version.\n# TYPE strum_build_info gauge\n"
                  "strum_build_info{version=\"%s\"} 1\n",
                  strum_version());
}
