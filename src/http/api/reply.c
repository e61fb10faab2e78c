/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/api/reply.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "http/api/assets.h"
#include "http/api/browser.h"
#include "http/service/clock.h"
#include "http/service/log.h"

#define JSON_TYPE    "application/json"
#define PROBLEM_TYPE "application/problem+json"
#define CHALLENGE    "Bearer realm=\"strum\""

static void header(struct MHD_Response *response, const char *name, const char *value)
{
    /* Fails without memory only; an answer without one of these headers is still right. */
    (void)MHD_add_response_header(response, name, value);
}

/* ---- other origins' pages (CORS) ---- */

static bool cors_add(const connection *p, struct MHD_Response *response)
{
    const char *origins = p->service->settings->cors_origins;
    if (!*origins)
        return false;
    header(response, "Vary", "Origin");
    if (!p->request->origin || !list_has(origins, p->request->origin))
        return false;
    header(response, "Access-Control-Allow-Origin", p->request->origin);
    header(response, "Access-Control-Expose-Headers",
           "ETag, Content-Location, Cache-Status, Server-Timing, X-Request-Id, traceparent, "
           "Retry-After");
    return true;
}

/* ---- the one way out ---- */

static void log_request(const connection *p, int status, size_t size)
{
    const request *r = p->request;
    const int64_t which = p->service->settings->log_requests;
    if (which == LOG_NONE || (which == LOG_ERRORS && (status < 500 || status == 501)) ||
        (which == LOG_REFUSALS && status < 400))
        return;
    /* There may be too many successful requests to log them all. */
    if (status < 400 &&
        atomic_fetch_add_explicit(&p->service->logged, 1, memory_order_relaxed) %
                (uint64_t)p->service->settings->log_sample !=
            0)
        return;
    log_line line;
    json_writer *json = log_open(&line, status < 500 ? "info" : "error", "request");
    json_put_string(json, "id", r->id);
    if (r->traceparent)
        json_put_string(json, "traceparent", r->traceparent);
    json_put_string(json, "path", r->url);
    json_put_integer(json, "status", status);
    json_put_integer(json, "bytes", (int64_t)size);
    json_put_number(json, "ms", trunc(clock_us() - r->began_us) / 1000);
    log_close(&line);
}

static void make_id(connection *p)
{
    if (!p->request->id[0])
        snprintf(p->request->id, sizeof p->request->id, "%08x-%08x", p->service->id_prefix,
                 atomic_fetch_add(&p->service->id_next, 1));
}

/* Sends `response` unchanged. */
static enum MHD_Result queue(connection *p, int status, struct MHD_Response *response,
                             size_t size)
{
    const request *r = p->request;
    metrics_request(p->service->metrics, r->route.index, status, size,
                    clock_us() - r->began_us);
    connection_enter(p, CONNECTION_SENDING, p->service->settings->request_timeout_s);
    return MHD_queue_response(p->mhd, (unsigned)status, response);
}

/* The time until the queue has had its turn; nobody waits in it beyond solve_timeout_s. */
static int retry_after_s(const service *s)
{
    const double least = (double)s->settings->retry_after_s;
    const double backlog =
        fmin(thread_pool_backlog_s(s->thread_pool), s->settings->solve_timeout_s);
    return (int)ceil(fmax(least, backlog));
}

/* Adds the headers that depend on the request, sends the response and drops it. */
static enum MHD_Result finish(connection *p, int status, struct MHD_Response *response,
                              size_t size)
{
    if (!response)
        return queue(p, 503, p->service->no_memory, 0);
    make_id(p);
    header(response, "X-Request-Id", p->request->id);
    if (p->request->traceparent)
        header(response, "traceparent", p->request->traceparent);
    cors_add(p, response);
    if (status == 503) {
        char seconds[24];
        snprintf(seconds, sizeof seconds, "%d", retry_after_s(p->service));
        header(response, "Retry-After", seconds);
    }
    if (p->request->close || p->service->draining)
        header(response, "Connection", "close");
    log_request(p, status, size);
    const enum MHD_Result result = queue(p, status, response, size);
    MHD_destroy_response(response);
    return result;
}

static struct MHD_Response *take_text(strbuf *body)
{
    struct MHD_Response *response =
        body->failed || !body->data
            ? NULL
            : MHD_create_response_from_buffer(body->size, body->data, MHD_RESPMEM_MUST_FREE);
    if (response)
        *body = (strbuf){0};
    strbuf_clear(body);
    return response;
}

/* ---- answers ---- */

static void release_entry(void *e)
{
    entry_unref(e);
}

static void release_body(void *e)
{
    entry_release_body(e);
}

/* Prebuilt responses: what is sent from a question's own address, and from an answer's. */
enum { FOR_QUESTION, FOR_KEY };

static int prebuilt_for(const request *r)
{
    return r->route.endpoint ? FOR_QUESTION : FOR_KEY;
}

/* Adds the headers of an answer that depend only on the address asked. */
static void describe(const service *s, int address, struct MHD_Response *response,
                     const entry *e)
{
    char value[128];
    if (e->transient) {
        header(response, "Cache-Control", "no-store");
        return;
    }
    snprintf(value, sizeof value, "\"%s\"", e->hex);
    header(response, "ETag", value);
    snprintf(value, sizeof value, "/v1/results/%s", e->hex);
    header(response, "Content-Location", value);
    /* An answer's key moves with the answer, so what stands at /v1/results/{key} never changes.
     * The same question may have another answer after an upgrade: it is asked again, which
     * costs one round trip (ETag, 304). With tokens no shared cache may keep either. */
    const char *const value_of[2][2] = {
        {"no-cache", "public, max-age=31536000, immutable"},
        {"private, no-cache", "private, max-age=31536000, immutable"}};
    header(response, "Cache-Control", value_of[s->access != NULL][address]);
}

static void drop_response(void *ready)
{
    MHD_destroy_response(ready);
}

static struct MHD_Response *prebuild(const service *s, entry *e, int address)
{
    struct MHD_Response *ready = MHD_create_response_from_buffer_with_free_callback_cls(
        e->size, e->body, release_body, e);
    if (!ready)
        return NULL;
    entry_hold_body(e);
    header(ready, "Content-Type", JSON_TYPE);
    describe(s, address, ready, e);
    header(ready, "Cache-Status", "strum; hit");
    if (*s->settings->cors_origins)
        header(ready, "Vary", "Origin");
    return ready;
}

struct MHD_Response *reply_prebuilt(const service *s, entry *e, int address)
{
    _Atomic(void *) *place = &e->prebuilt[address];
    void *ready = atomic_load_explicit(place, memory_order_acquire);
    if (ready)
        return ready;
    struct MHD_Response *mine = prebuild(s, e, address);
    e->prebuilt_drop = drop_response;
    /* Another event thread may have been faster. */
    if (mine && !atomic_compare_exchange_strong(place, &ready, mine)) {
        MHD_destroy_response(mine);
        return ready;
    }
    if (mine)
        cache_count_prebuilt(s->cache, e);
    return mine;
}

/* If-None-Match: a list of tags, weak ones too (RFC 9110 13.1.2), or "*". */
static bool already_has(const char *list, const char *hex)
{
    if (!list)
        return false;
    for (const char *at = list; *at;) {
        at += strspn(at, ", \t");
        if (*at == '*')
            return true;
        if (strncmp(at, "W/", 2) == 0)
            at += 2;
        const size_t span = strcspn(at, ",");
        if (span >= KEY_HEX_SIZE + 1 && at[0] == '"' && at[KEY_HEX_SIZE] == '"' &&
            strncmp(at + 1, hex, KEY_HEX_SIZE - 1) == 0)
            return true;
        at += span;
    }
    return false;
}

static void timing(const connection *p, struct MHD_Response *response, const entry *e)
{
    char value[192];
    int size = snprintf(value, sizeof value, "read;dur=%.3f, queue;dur=%.3f, %s;dur=%.3f",
                        p->request->read_us / 1000, e->queue_us / 1000,
                        e->from_store ? "store" : "solve", e->solve_us / 1000);
    if (!e->from_store)
        snprintf(value + size, sizeof value - (size_t)size, ", cpu;dur=%.3f, estimate;dur=%.3f",
                 e->cpu_us / 1000, e->estimate_us / 1000);
    header(response, "Server-Timing", value);
}

/* RFC 9211: the cache nearest to where answers are made comes first. */
static void cache_status(struct MHD_Response *response, const entry *e, reply_source source)
{
    char value[64];
    snprintf(value, sizeof value, "%sstrum; %s",
             e->from_store && source != REPLY_HIT ? "strum-store; hit, " : "",
             source == REPLY_HIT         ? "hit"
             : source == REPLY_COLLAPSED ? "fwd=miss; collapsed"
             : e->stored                 ? "fwd=miss; stored"
                                         : "fwd=miss");
    header(response, "Cache-Status", value);
}

enum MHD_Result reply_entry(connection *p, entry *e, reply_source source)
{
    const request *r = p->request;
    if (!e)
        return queue(p, 503, p->service->no_memory, 0);
    const bool plain = source == REPLY_HIT && e->stored && !r->if_none_match && !r->given_id &&
                       !r->traceparent && !r->close &&
                       (!r->origin || !*p->service->settings->cors_origins) &&
                       !p->service->draining && p->service->settings->log_requests != LOG_ALL;
    struct MHD_Response *ready = plain ? reply_prebuilt(p->service, e, prebuilt_for(r)) : NULL;
    if (ready) {
        const enum MHD_Result result = queue(p, 200, ready, e->size);
        entry_unref(e);
        return result;
    }
    const bool good = e->status == 200;
    const bool has = good && !e->transient && already_has(r->if_none_match, e->hex);
    /* A 304 has no body, but libmicrohttpd adds the length of its response: it must be that of the
     * 200 then (RFC 9110 8.6). */
    struct MHD_Response *response = MHD_create_response_from_buffer_with_free_callback_cls(
        e->size, e->body, release_entry, e);
    if (!response) {
        entry_unref(e);
        return queue(p, 503, p->service->no_memory, 0);
    }
    if (!has)
        header(response, "Content-Type", good ? JSON_TYPE : PROBLEM_TYPE);
    if (good) {
        describe(p->service, prebuilt_for(r), response, e);
        cache_status(response, e, source);
        if (source != REPLY_HIT)
            timing(p, response, e);
    } else {
        header(response, "Cache-Control", "no-store");
    }
    const int status = has ? 304 : e->status;
    return finish(p, status, response, has ? 0 : e->size); /* the response has the reference */
}

/* ---- the rest ---- */

enum MHD_Result reply_text(connection *p, int status, const char *type, strbuf *body)
{
    const size_t size = body->size;
    struct MHD_Response *response = take_text(body);
    if (response) {
        header(response, "Content-Type", type);
        header(response, "Cache-Control", "no-store");
    }
    return finish(p, status, response, size);
}

/* The page loads from this daemon only, and no other page may frame it. */
#define POLICY                                                                                 \
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "    \
    "connect-src 'self'; base-uri 'none'; frame-ancestors 'none'; "

static void guard_page(struct MHD_Response *response, bool has_form)
{
    header(response, "Content-Security-Policy",
           has_form ? POLICY "form-action 'self'" : POLICY "form-action 'none'");
    header(response, "X-Content-Type-Options", "nosniff");
    /* With no-referrer a browser would send the form with Origin: null. */
    header(response, "Referrer-Policy", has_form ? "same-origin" : "no-referrer");
}

enum MHD_Result reply_page(connection *p, int status, strbuf *body)
{
    const size_t size = body->size;
    struct MHD_Response *response = take_text(body);
    if (response) {
        header(response, "Content-Type", "text/html; charset=utf-8");
        header(response, "Cache-Control", "no-store");
        if (status == 401)
            header(response, "WWW-Authenticate", CHALLENGE);
        guard_page(response, true);
    }
    return finish(p, status, response, size);
}

enum MHD_Result reply_go(connection *p, const char *path, const char *cookie)
{
    struct MHD_Response *response =
        MHD_create_response_from_buffer(0, "", MHD_RESPMEM_PERSISTENT);
    if (response) {
        header(response, "Location", path);
        header(response, "Cache-Control", "no-store");
        if (cookie)
            header(response, "Set-Cookie", cookie);
    }
    return finish(p, 303, response, 0);
}

enum MHD_Result reply_stream(connection *p, stream *s, const char *type)
{
    struct MHD_Response *response = stream_response(s);
    if (response) {
        header(response, "Content-Type", type);
        header(response, "Cache-Control", "no-store");
        header(response, "X-Accel-Buffering", "no"); /* nginx: pieces are passed on at once */
    } else {
        s->end(s);
    }
    return finish(p, 200, response, 0);
}

/* "gzip" among the codings, unless with a weight of 0 (RFC 9110 12.5.3). */
static bool takes_gzip(connection *p)
{
    const char *list = MHD_lookup_connection_value(p->mhd, MHD_HEADER_KIND, "Accept-Encoding");
    const char *at = list ? strstr(list, "gzip") : NULL;
    if (!at)
        return false;
    at += strcspn(at, ",;");
    if (*at != ';')
        return true;
    at += 1 + strspn(at + 1, " \t");
    return strncmp(at, "q=", 2) != 0 || strtod(at + 2, NULL) > 0;
}

enum MHD_Result reply_asset(connection *p, const asset *a)
{
    const bool has = already_has(p->request->if_none_match, a->hex), packed = takes_gzip(p);
    const unsigned char *bytes = packed ? a->gzip : a->bytes;
    const size_t size = (size_t)((packed ? a->gzip_end : a->bytes_end) - bytes);
    struct MHD_Response *response =
        MHD_create_response_from_buffer(size, (void *)(uintptr_t)bytes, MHD_RESPMEM_PERSISTENT);
    if (response) {
        char tag[80];
        /* Weak: the compressed bytes are other bytes. */
        snprintf(tag, sizeof tag, "W/\"%s\"", a->hex);
        header(response, "ETag", tag);
        header(response, "Cache-Control",
               p->service->access ? "private, no-cache" : "no-cache");
        header(response, "Vary", "Accept-Encoding");
        if (packed && !has)
            header(response, "Content-Encoding", "gzip");
        if (!has)
            header(response, "Content-Type", a->type);
        guard_page(response, false);
    }
    return finish(p, has ? 304 : 200, response, has ? 0 : size);
}

enum MHD_Result reply_problem(connection *p, problem *why)
{
    strbuf body = {0};
    const int status = why->status ? why->status : 500;
    problem_write(why, NULL, &body);
    problem_clear(why);
    const size_t size = body.size;
    struct MHD_Response *response = take_text(&body);
    if (response) {
        header(response, "Content-Type", PROBLEM_TYPE);
        header(response, "Cache-Control", "no-store");
        if (status == 401)
            header(response, "WWW-Authenticate", CHALLENGE);
        if (status == 405) {
            char allow[64];
            method_list(p->request->route.methods, allow);
            header(response, "Allow", allow);
        }
    }
    return finish(p, status, response, size);
}

enum MHD_Result reply_refusal(connection *p, int status, const char *format, ...)
{
    char detail[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(detail, sizeof detail, format, arguments);
    va_end(arguments);
    problem why = {0};
    problem_set(&why, status, "%s", detail);
    return reply_problem(p, &why);
}

enum MHD_Result reply_options(connection *p, unsigned methods)
{
    char list[64];
    method_list(methods, list);
    struct MHD_Response *response =
        MHD_create_response_from_buffer(0, "", MHD_RESPMEM_PERSISTENT);
    if (response) {
        header(response, "Allow", list);
        if (methods & METHOD_QUERY)
            header(response, "Accept-Query", JSON_TYPE);
        if (p->request->accept_method && p->request->origin &&
            list_has(p->service->settings->cors_origins, p->request->origin)) {
            header(response, "Access-Control-Allow-Methods", list);
            header(response, "Access-Control-Allow-Headers",
                   "Accept, Authorization, Content-Type, If-None-Match, traceparent, "
                   "X-Request-Id");
            header(response, "Access-Control-Max-Age", "86400");
        }
    }
    return finish(p, 204, response, 0);
}

struct MHD_Response *reply_no_memory(void)
{
    static const char body[] = "{\"type\":\"about:blank\",\"title\":\"Service Unavailable\","
                               "\"status\":503,\"detail\":\"out of memory\"}";
    struct MHD_Response *response = MHD_create_response_from_buffer(
        sizeof body - 1, (void *)(uintptr_t)body, MHD_RESPMEM_PERSISTENT);
    if (response) {
        header(response, "Content-Type", PROBLEM_TYPE);
        header(response, "Retry-After", "1");
    }
    return response;
}
