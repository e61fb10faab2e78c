/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/api/events.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

#include "http/api/reply.h"
#include "http/service/clock.h"

/* Who waits so long is told of the queue. */
#define QUEUE_MS 250
/* In a silence a comment is sent so often: proxies cut silent connections, and a client sees that
 * this one lives. */
#define PULSE_MS 10000

typedef struct events {
    stream stream;
    waiter waiter;
    service *service;
    pthread_mutex_t lock; /* of what follows */
    progress last;        /* a slow client gets only the latest */
    char what[80];
    bool told, done, ended;
    bool said_queued;
    entry *outcome; /* referenced; NULL when done: memory ran out */
} events;

static events *events_of(waiter *w)
{
    return (events *)(void *)((char *)w - offsetof(events, waiter));
}

/* ---- what other threads say ---- */

static void on_progress(waiter *w, const progress *so_far)
{
    events *e = events_of(w);
    pthread_mutex_lock(&e->lock);
    e->last = *so_far;
    snprintf(e->what, sizeof e->what, "%s", so_far->what ? so_far->what : "");
    e->told = true;
    pthread_mutex_unlock(&e->lock);
    stream_wake(&e->stream);
}

static void wake(waiter *w, entry *outcome)
{
    events *e = events_of(w);
    pthread_mutex_lock(&e->lock);
    e->outcome = outcome;
    e->done = true;
    pthread_mutex_unlock(&e->lock);
    stream_wake(&e->stream);
    stream_unref(&e->stream);
}

/* ---- what the event thread sends ---- */

static void write_progress(const events *e, strbuf *out)
{
    json_writer json = {.out = out};
    strbuf_add_string(out, "event: progress\ndata: ");
    json_open_object(&json);
    json_put_integer(&json, "evaluations", e->last.evaluations);
    if (isfinite(e->last.best))
        json_put_number(&json, "best", e->last.best);
    if (e->what[0])
        json_put_string(&json, "text", e->what);
    json_close_object(&json);
    strbuf_add_string(out, "\n\n");
}

/* Bodies have no line ends: our writer makes none. */
static void write_last(const entry *outcome, const char *given_up, strbuf *out)
{
    strbuf_add_string(out, outcome && outcome->status == 200 ? "event: result\ndata: "
                                                             : "event: problem\ndata: ");
    if (outcome) {
        strbuf_add(out, outcome->body, outcome->size);
    } else {
        problem why = {0};
        problem_set(&why, 503, "%s", given_up ? given_up : "out of memory");
        problem_write(&why, NULL, out);
        problem_clear(&why);
    }
    strbuf_add_string(out, "\n\n");
}

static void write_queue(service *s, strbuf *out)
{
    const thread_pool_counters pool = thread_pool_count(s->thread_pool);
    json_writer json = {.out = out};
    strbuf_add_string(out, "event: queue\ndata: ");
    json_open_object(&json);
    json_put_integer(
        &json, "waiting",
        (int64_t)(pool.queued[LANE_CHEAP] + pool.queued[LANE_COSTLY] + pool.queued[LANE_LONG]));
    json_put_number(&json, "backlog_s", thread_pool_backlog_s(s->thread_pool));
    json_close_object(&json);
    strbuf_add_string(out, "\n\n");
}

/* Nothing is new: after some time says that it still waits. Returns whether it did. */
static bool write_pulse(events *e)
{
    const bool first = !e->said_queued;
    e->said_queued = true;
    if (!first)
        strbuf_add_string(&e->stream.out, ": still at it\n\n");
    else if (cache_is_queued(e->service->cache, &e->waiter))
        write_queue(e->service, &e->stream.out);
    return e->stream.out.size > 0;
}

static stream_turn next(stream *s)
{
    events *e = (events *)(void *)s;
    if (e->ended)
        return STREAM_END;
    const char *given_up = atomic_load(&s->given_up);
    stream_turn turn = STREAM_PIECE;
    if (given_up && cache_release(e->service->cache, &e->waiter)) {
        stream_unref(s); /* the waiter's */
        write_last(NULL, given_up, &s->out);
        e->ended = true;
        return turn;
    }
    pthread_mutex_lock(&e->lock);
    if (e->done) {
        write_last(e->outcome, NULL, &s->out);
        e->ended = true;
    } else if (e->told) {
        write_progress(e, &s->out);
        e->told = false;
    } else {
        turn = STREAM_WAIT;
    }
    pthread_mutex_unlock(&e->lock);
    const bool due = turn == STREAM_WAIT && clock_ms() >= atomic_load(&s->pulse_at_ms);
    if (due && write_pulse(e))
        turn = STREAM_PIECE;
    if (due || turn == STREAM_PIECE) {
        e->said_queued = true;
        atomic_store(&s->pulse_at_ms, clock_ms() + PULSE_MS);
    }
    return turn;
}

static void end(stream *s)
{
    events *e = (events *)(void *)s;
    if (cache_release(e->service->cache, &e->waiter))
        stream_unref(s);
}

static void free_events(stream *s)
{
    events *e = (events *)(void *)s;
    entry_unref(e->outcome);
    pthread_mutex_destroy(&e->lock);
    free(e);
}

waiter *events_open(connection *p)
{
    events *e = calloc(1, sizeof *e);
    if (!e)
        return NULL;
    e->stream.next = next;
    e->stream.end = end;
    e->stream.free = free_events;
    stream_init(&e->stream, p);
    stream_ref(&e->stream); /* the waiter's */
    pthread_mutex_init(&e->lock, NULL);
    e->service = p->service;
    e->stream.pulse_at_ms = clock_ms() + QUEUE_MS;
    e->waiter =
        (waiter){.raw = p->request->waiter.raw, .on_done = wake, .on_progress = on_progress};
    p->request->stream = &e->stream;
    return &e->waiter;
}

void events_free_waiter(connection *p)
{
    stream_unref(p->request->stream);
}

enum MHD_Result events_reply(connection *p, entry *known)
{
    events *e = (events *)(void *)p->request->stream;
    pthread_mutex_lock(&e->lock);
    if (known) {
        e->outcome = known;
        e->done = true;
    }
    /* Nothing was sent yet: a refusal can have its status. */
    const bool refused = e->done && (!e->outcome || e->outcome->status != 200);
    entry *refusal = refused ? entry_ref(e->outcome) : NULL;
    pthread_mutex_unlock(&e->lock);
    if (refused)
        return reply_entry(p, refusal, REPLY_SOLVED);
    return reply_stream(p, p->request->stream, "text/event-stream");
}
