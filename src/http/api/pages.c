/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/api/pages.h"

#include <strum/version.h>

#include <string.h>

#include "http/api/assets.h"
#include "http/service/clock.h"
#include "commit.h"
#include "http/api/reply.h"

/* After the queue has been full for this time, load balancers are told to send elsewhere. */
#define FULL_MS 5000

static enum MHD_Result say_status(connection *p, const char *status)
{
    strbuf body = {0};
    json_writer json = {.out = &body};
    json_open_object(&json);
    json_put_string(&json, "status", status);
    json_close_object(&json);
    return reply_text(p, 200, "application/json", &body);
}

enum MHD_Result page_livez(connection *p)
{
    return say_status(p, "alive");
}

enum MHD_Result page_readyz(connection *p)
{
    service *s = p->service;
    const thread_pool_counters pool = thread_pool_count(s->thread_pool);
    const cache_counters known = cache_count(s->cache);
    const int64_t full_since = pool.full_since_ms;
    if (s->draining)
        return reply_refusal(p, 503, "shutting down");
    if (full_since && clock_ms() - full_since > FULL_MS)
        return reply_refusal(p, 503, "the queue has been full for over %d s", FULL_MS / 1000);
    strbuf body = {0};
    json_writer json = {.out = &body};
    json_open_object(&json);
    json_put_string(&json, "status", "ready");
    json_put_integer(&json, "workers", pool.workers);
    json_put_integer(&json, "working", (int64_t)pool.working);
    json_put_number(&json, "backlog_s", thread_pool_backlog_s(s->thread_pool));
    json_put_integer(&json, "abandoned", (int64_t)known.abandoned);
    json_put_number(&json, "abandoned_s",
                    known.abandoned ? (double)(clock_ms() - known.abandoned_since_ms) / 1000
                                    : 0);
    json_close_object(&json);
    return reply_text(p, 200, "application/json", &body);
}

enum MHD_Result page_version(connection *p)
{
    strbuf body = {0};
    json_writer json = {.out = &body};
    json_open_object(&json);
    json_put_string(&json, "name", "strumd");
    json_put_string(&json, "version", STRUM_DAEMON_VERSION);
    json_put_string(&json, "commit", COMMIT);
    json_put_string(&json, "solver", strum_version());
    json_put_integer(&json, "solver_number", strum_solver());
    json_put_string(&json, "numerics", evaluation_numerics());
    json_put_string(&json, "libmicrohttpd", MHD_get_version());
    json_close_object(&json);
    return reply_text(p, 200, "application/json", &body);
}

enum MHD_Result page_metrics(connection *p)
{
    strbuf body = {0};
    service *s = p->service;
    metrics_snapshot now = {.cache = cache_count(s->cache),
                            .pool = thread_pool_count(s->thread_pool),
                            .has_store = s->store,
                            .busy = connections_busy(p->all),
                            .memory = memory_used(&s->memory),
                            .memory_limit = s->memory.limit};
    if (now.has_store)
        now.store = store_count(s->store);
    metrics_write(s->metrics, &now, &body);
    return reply_text(p, 200, "text/plain; version=0.0.4; charset=utf-8", &body);
}

enum MHD_Result page_asset(connection *p)
{
    for (const asset *a = assets; a->path; a++)
        if (strcmp(a->path, p->request->url) == 0)
            return reply_asset(p, a);
    return reply_refusal(p, 404, "nothing is at %s%s", p->request->url,
                         assets->path ? "" : "; this strumd was built without its pages");
}
