/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/api/batch.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "http/api/solve_handler.h"
#include "http/service/clock.h"
#include "http/api/batch_item.h"
#include "http/api/batch_reader.h"
#include "http/api/reply.h"

/* Limits on items started but not yet sent: their number, and the bytes of their answers. */
#define WINDOW       64
#define WINDOW_BYTES (1 << 20)
/* After this time on a batch a worker takes the next job in the queue. */
#define TURN_US 1000
/* Maximum number of workers on one batch. */
#define RUNNERS 16
/* Lines are collected up to this many bytes before they are sent. */
#define LINES_SIZE 16384

typedef enum slot_state {
    SLOT_FREE,
    SLOT_BEGUN,   /* a worker reads it */
    SLOT_WAITING, /* its waiter is in the cache */
    SLOT_DONE
} slot_state;

/* An item of the window. */
typedef struct slot {
    waiter waiter;
    struct batch *batch;
    size_t index;
    const char *bytes; /* of the item */
    size_t size;
    slot_state state;
    batch_item item; /* the worker's until it waits or is done */
    entry *outcome;  /* referenced; NULL when done: memory ran out */
} slot;

typedef struct runner {
    job job;
    struct batch *batch;
    bool running;
} runner;

typedef struct batch {
    stream stream;
    service *service;
    unsigned client;
    strbuf body;
    pthread_mutex_t lock; /* of what follows */
    batch_reader items;
    size_t begun, sent, total, bytes;
    bool ended;
    slot slots[WINDOW];
    size_t runner_count;
    runner runners[RUNNERS];
} batch;

static slot *slot_of(batch *b, size_t index)
{
    return &b->slots[index % WINDOW];
}

/* ---- an item, on a worker ---- */

static void finish(slot *s, entry *outcome)
{
    batch *b = s->batch;
    outcome = batch_item_outcome(&s->item, outcome);
    pthread_mutex_lock(&b->lock);
    s->outcome = outcome;
    s->state = SLOT_DONE;
    b->bytes += outcome ? outcome->size : 0;
    const bool first = s->index == b->sent;
    pthread_mutex_unlock(&b->lock);
    if (first)
        stream_wake(&b->stream);
}

static void wake(waiter *w, entry *outcome)
{
    slot *s = (slot *)(void *)w;
    batch *b = s->batch;
    finish(s, outcome);
    stream_unref(&b->stream);
}

static evaluation *read_item(slot *s, problem *p)
{
    const settings *set = s->batch->service->settings;
    const json_limits limits = {.depth = (int)set->json_depth + BATCH_ITEM_DEPTH,
                                .values = (int)set->json_values + BATCH_ITEM_VALUES};
    cJSON *document;
    const cJSON *asked;
    if (!json_read(s->bytes, s->size, &limits, &document, p))
        return NULL;
    const endpoint *e =
        batch_item_read(s->batch->service->pages, document, &s->item, &asked, p);
    /* By the bytes of an item that is not plain no answer may be found: its line is another. */
    static const char not_plain;
    if (!batch_item_is_plain(&s->item))
        cache_key_of_body(s->batch->service->cache, &not_plain, s->bytes, s->size,
                          &s->waiter.raw);
    evaluation *a = NULL;
    if (e) {
        a = evaluation_read_item(e, asked, p);
        problem_place(p, "/request");
    }
    cJSON_Delete(document);
    return a;
}

/* Joins the flight for this answer, or leads it if there is none yet. Takes over `a`. */
static void solve(slot *s, evaluation *a)
{
    batch *b = s->batch;
    strbuf canonical = {0};
    cache_key key;
    entry *hit = NULL;
    flight *lead = NULL;
    cache_role turn = ROLE_NONE;
    const size_t index = s->index;
    stream_ref(&b->stream); /* the waiter's */
    if (key_of_evaluation(a, &canonical, &key))
        turn = cache_acquire(b->service->cache, &key, &s->waiter, &hit, &lead);
    strbuf_clear(&canonical);
    if (turn == ROLE_HIT || turn == ROLE_NONE) {
        finish(s, hit);
        stream_unref(&b->stream);
        evaluation_free(a);
        return;
    }
    pthread_mutex_lock(&b->lock);
    /* If it was woken already, it may be sent, and the slot may hold another item. */
    const bool waits = s->index == index && s->state == SLOT_BEGUN;
    if (waits)
        s->state = SLOT_WAITING;
    /* If the batch ended meanwhile, that thread did not see this item wait. */
    const bool late = waits && b->ended && cache_release(b->service->cache, &s->waiter);
    pthread_mutex_unlock(&b->lock);
    if (late)
        stream_unref(&b->stream);
    /* A long one waits for its turn among the long ones, and the next item begins. */
    if (turn == ROLE_LEADER && evaluation_cost_us(a) >= THREAD_POOL_LONG_US) {
        solve_item_later(b->service, a, &key, lead, b->client);
        return;
    }
    if (turn == ROLE_LEADER)
        solve_flight(b->service, a, &key, lead, 0);
    evaluation_free(a);
}

static void work_item(slot *s)
{
    batch *b = s->batch;
    s->waiter = (waiter){.on_done = wake};
    cache_key_of_body(b->service->cache, NULL, s->bytes, s->size, &s->waiter.raw);
    entry *hit = cache_find(b->service->cache, CACHE_RAW, &s->waiter.raw);
    if (hit) {
        finish(s, hit);
        return;
    }
    problem why = {0};
    evaluation *a = read_item(s, &why);
    if (a)
        solve(s, a);
    else
        finish(s, refusal_entry(&s->waiter.raw, &why));
    problem_clear(&why);
}

/* ---- the workers of a batch ---- */

static bool has_room(const batch *b)
{
    return !b->ended && b->begun < b->total && b->begun < b->sent + WINDOW &&
           (b->bytes < WINDOW_BYTES || b->begun == b->sent);
}

/* Returns the next item, or NULL: the runner then has ended. */
static slot *begin_item(batch *b, runner *r)
{
    slot *s = NULL;
    pthread_mutex_lock(&b->lock);
    if (has_room(b)) {
        s = slot_of(b, b->begun);
        batch_item_free(&s->item);
        *s = (slot){.batch = b, .index = b->begun++, .state = SLOT_BEGUN};
        (void)batch_reader_next(&b->items, &s->bytes, &s->size);
    } else {
        r->running = false;
    }
    pthread_mutex_unlock(&b->lock);
    return s;
}

static void run(job *j)
{
    runner *r = (runner *)(void *)j;
    batch *b = r->batch;
    const double until = clock_us() + TURN_US;
    for (slot *s; (s = begin_item(b, r));) {
        work_item(s);
        if (clock_us() > until) {
            thread_pool_queue_batch(b->service->thread_pool, j);
            return;
        }
    }
    stream_unref(&b->stream);
}

/* Starts a worker for each item that may begin. Under the lock. */
static void start_runners(batch *b)
{
    size_t left = b->total - b->begun;
    for (size_t i = 0; i < b->runner_count && has_room(b) && left > 0; i++) {
        runner *r = &b->runners[i];
        if (r->running)
            continue;
        r->running = true;
        left--;
        stream_ref(&b->stream);
        thread_pool_queue_batch(b->service->thread_pool, &r->job);
    }
}

/* ---- the event thread ---- */

static void write_line(size_t index, const slot *s, const entry *outcome, const char *given_up,
                       strbuf *out)
{
    if (outcome && outcome->status == 200) {
        strbuf_add(out, outcome->body, outcome->size);
    } else {
        /* A problem object whose first member is the index. */
        problem why = {0};
        strbuf body = {0};
        problem_set(&why, 503, "%s", given_up ? given_up : "out of memory");
        if (!outcome)
            problem_write(&why, NULL, &body);
        problem_clear(&why);
        strbuf_format(out, "{\"index\":%zu,", index);
        if (!outcome && s && s->item.id)
            strbuf_format(out, "\"id\":%s,", s->item.id);
        if (outcome)
            strbuf_add(out, outcome->body + 1, outcome->size - 1);
        else if (body.failed)
            out->failed = true;
        else
            strbuf_add(out, body.data + 1, body.size - 1);
        strbuf_clear(&body);
    }
    strbuf_add(out, "\n", 1);
}

/* No client wants the items under way any more. */
static void end(stream *st)
{
    batch *b = (batch *)(void *)st;
    size_t given_up = 0;
    pthread_mutex_lock(&b->lock);
    b->ended = true;
    for (size_t i = 0; i < WINDOW; i++)
        if (b->slots[i].state == SLOT_WAITING &&
            cache_release(b->service->cache, &b->slots[i].waiter))
            given_up++;
    pthread_mutex_unlock(&b->lock);
    while (given_up-- > 0)
        stream_unref(st);
}

/* The batch cannot go on: each item that has no line yet says so in its place. What was solved by
 * then is still sent. */
static stream_turn write_rest(batch *b, const char *given_up)
{
    strbuf *out = &b->stream.out;
    pthread_mutex_lock(&b->lock);
    while (b->sent < b->total && out->size < LINES_SIZE) {
        slot *s = slot_of(b, b->sent);
        const bool begun = b->sent < b->begun, done = begun && s->state == SLOT_DONE;
        const bool read = begun && s->state != SLOT_BEGUN;
        write_line(b->sent, read ? s : NULL, done ? s->outcome : NULL, given_up, out);
        b->sent++;
    }
    pthread_mutex_unlock(&b->lock);
    return STREAM_PIECE;
}

/* The item whose turn it is took too long: it says so, and the batch goes on without it. False when
 * it is none that waits for its answer: then no worker came to it at all. */
static bool give_up_one(batch *b, const char *why)
{
    stream *st = &b->stream;
    bool left = false, begun;
    pthread_mutex_lock(&b->lock);
    slot *s = slot_of(b, b->sent);
    begun = b->sent < b->begun;
    if (begun && s->state == SLOT_WAITING && cache_release(b->service->cache, &s->waiter)) {
        left = true;
        write_line(b->sent, s, NULL, why, &st->out);
        s->state = SLOT_FREE;
        b->sent++;
    }
    pthread_mutex_unlock(&b->lock);
    if (left)
        stream_unref(st); /* the waiter's */
    return begun;
}

static stream_turn next(stream *st)
{
    batch *b = (batch *)(void *)st;
    const char *given_up = atomic_load(&st->given_up);
    if (given_up && !b->ended && clock_ms() >= st->wait_until_ms && b->sent < b->total &&
        give_up_one(b, given_up)) {
        atomic_store(&st->given_up, NULL);
        given_up = NULL;
        st->wait_until_ms =
            clock_ms() + (int64_t)(b->service->settings->solve_timeout_s * 1000);
    }
    if (b->sent == b->total || (b->ended && !given_up))
        return STREAM_END;
    if (given_up && !b->ended)
        end(st);
    if (given_up)
        return write_rest(b, given_up);
    pthread_mutex_lock(&b->lock);
    for (slot *s = slot_of(b, b->sent); s->state == SLOT_DONE && st->out.size < LINES_SIZE;
         s = slot_of(b, b->sent)) {
        write_line(b->sent, s, s->outcome, NULL, &st->out);
        b->bytes -= s->outcome ? s->outcome->size : 0;
        entry_unref(s->outcome);
        s->outcome = NULL;
        s->state = SLOT_FREE;
        b->sent++;
    }
    start_runners(b);
    pthread_mutex_unlock(&b->lock);
    if (st->out.size == 0)
        return STREAM_WAIT;
    st->wait_until_ms = clock_ms() + (int64_t)(b->service->settings->solve_timeout_s * 1000);
    return STREAM_PIECE;
}

static void free_batch(stream *st)
{
    batch *b = (batch *)(void *)st;
    for (size_t i = 0; i < WINDOW; i++) {
        entry_unref(b->slots[i].outcome);
        batch_item_free(&b->slots[i].item);
    }
    pthread_mutex_destroy(&b->lock);
    strbuf_clear(&b->body);
    free(b);
}

static batch *batch_new(connection *p)
{
    batch *b = calloc(1, sizeof *b);
    if (!b)
        return NULL;
    service *s = p->service;
    b->stream.next = next;
    b->stream.end = end;
    b->stream.free = free_batch;
    stream_init(&b->stream, p);
    b->service = s;
    b->client = p->request->client;
    /* The items point into it, for longer than the request may last. */
    b->body = p->request->body;
    p->request->body = (strbuf){0};
    pthread_mutex_init(&b->lock, NULL);
    const size_t workers = (size_t)thread_pool_count(s->thread_pool).workers;
    b->runner_count = workers < RUNNERS ? workers : RUNNERS;
    for (size_t i = 0; i < b->runner_count; i++)
        b->runners[i] = (runner){.job = {.work = run,
                                         .cost_us = TURN_US,
                                         .client = p->request->client,
                                         .bytes = WINDOW_BYTES},
                                 .batch = b};
    return b;
}

/* Counts a batch whose body has come; returns false beyond the limit, of which one client has at
 * most three quarters. */
static bool count_batch(connection *p)
{
    service *s = p->service;
    const int64_t all = s->settings->batches, one = all - all / 4;
    p->request->counted = true; /* until dispatch_end */
    const int64_t before = atomic_fetch_add(&s->batches, 1);
    return atomic_fetch_add(&s->batches_of[p->request->client], 1) < one && before < all;
}

enum MHD_Result batch_answer(connection *p)
{
    const int64_t limit = p->service->settings->batch_items;
    if (!count_batch(p))
        return reply_refusal(p, 503, "too many batches are under way; try again later");
    batch *b = batch_new(p);
    problem why = {0};
    if (!b)
        return reply_entry(p, NULL, REPLY_HIT);
    p->request->stream = &b->stream; /* ends with the request */
    if (!batch_reader_open(&b->items, b->body.data ? b->body.data : "", b->body.size,
                           p->request->is_lines, &b->total, &why))
        return reply_problem(p, &why);
    if (b->total > (size_t)limit)
        return reply_refusal(p, 413, "%zu items; a batch has at most %lld", b->total,
                             (long long)limit);
    return reply_stream(p, &b->stream, "application/x-ndjson");
}
