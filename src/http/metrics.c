/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/metrics.h"

#include <inttypes.h>
#include <stdlib.h>

#include <strum/status.h>

#include "http/server.h"

/* The statuses this daemon answers with; the last row counts any other. */
static const int statuses[] = {200, 204, 304, 400, 401, 404, 405,
                               413, 415, 422, 500, 501, 503, 0};
#define STATUSES (sizeof statuses / sizeof *statuses)

struct metrics {
    atomic_uint_fast64_t bytes;
    atomic_uint_fast64_t requests[][STATUSES]; /* by route */
};

metrics *metrics_new(void)
{
    return calloc(1, sizeof(metrics) + route_count() * sizeof(((metrics *)0)->requests[0]));
}

void metrics_free(metrics *m)
{
    free(m);
}

void metrics_request(metrics *m, size_t index, int status, size_t bytes)
{
    size_t i = 0;
    while (statuses[i] != status && statuses[i] != 0)
        i++;
    atomic_fetch_add_explicit(&m->requests[index][i], 1, memory_order_relaxed);
    atomic_fetch_add_explicit(&m->bytes, bytes, memory_order_relaxed);
}

static void value(text *out, const char *name, const char *kind, const char *help,
                  uint64_t number)
{
    text_format(out, "# HELP strum_%s %s\n# TYPE strum_%s %s\nstrum_%s %" PRIu64 "\n", name,
                help, name, kind, name, number);
}

static void write_requests(const metrics *m, text *out)
{
    text_add_string(out, "# HELP strum_requests_total Answers sent, by route and status.\n"
                         "# TYPE strum_requests_total counter\n");
    for (size_t index = 0; index < route_count(); index++) {
        for (size_t i = 0; i < STATUSES; i++) {
            const uint64_t count = m->requests[index][i];
            char status[16] = "other";
            if (statuses[i])
                snprintf(status, sizeof status, "%d", statuses[i]);
            if (count)
                text_format(out,
                            "strum_requests_total{route=\"%s\",status=\"%s\"} %" PRIu64 "\n",
                            route_path(index), status, count);
        }
    }
}

void metrics_write(server *s, text *out)
{
    const cache_counters c = cache_count(s->cache);
    const crew_counters w = crew_count(s->crew);
    write_requests(s->metrics, out);
    value(out, "response_bytes_total", "counter", "Bytes of answers' bodies.",
          s->metrics->bytes);
    value(out, "cache_hits_total", "counter", "Requests answered from the store.", c.hits);
    value(out, "cache_misses_total", "counter", "Requests that began to solve.", c.misses);
    value(out, "cache_joins_total", "counter",
          "Requests that waited for an equal one under way.", c.joins);
    value(out, "solves_total", "counter", "Answers computed.", c.solves);
    value(out, "cancels_total", "counter", "Answers given up: nobody waited any more.",
          c.cancels);
    value(out, "cache_evictions_total", "counter", "Answers dropped for room.", c.evictions);
    value(out, "cache_entries", "gauge", "Answers stored.", c.entries);
    value(out, "cache_bytes", "gauge", "Memory of the store, bookkeeping included.", c.bytes);
    value(out, "cache_limit_bytes", "gauge", "Most memory the store may take.", c.cap);
    value(out, "flights", "gauge", "Answers being computed or waiting for it.", c.flights);
    value(out, "workers", "gauge", "Worker threads.", (uint64_t)w.workers);
    value(out, "workers_busy", "gauge", "Workers that solve.", w.working);
    value(out, "queue_depth", "gauge", "Requests that wait for a worker.", w.queued);
    value(out, "queue_limit", "gauge", "Requests that may wait for a worker.", w.depth);
    value(out, "queue_refused_total", "counter", "Requests refused for a full queue.",
          w.refused);
    value(out, "requests_busy", "gauge", "Requests under way.", peers_busy(s->peers));
    text_format(out,
                "# HELP strum_build_info The version.\n# TYPE strum_build_info gauge\n"
                "strum_build_info{version=\"%s\"} 1\n",
                strum_version());
}
