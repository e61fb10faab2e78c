/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/api/solve_handler.h"

#include <stdlib.h>
#include <string.h>

#include "http/service/clock.h"
#include "http/api/events.h"
#include "http/api/reply.h"

/* A flight for a worker to solve, or only to look up in the shared store. */
typedef struct task {
    job job;
    service *service;
    evaluation *asking; /* owned; NULL: only look it up */
    cache_key key;
    flight *flight;
    double given_us;
} task;

#define NOT_STORED "no answer is stored under this key (any more); ask its question again"

entry *refusal_entry(const cache_key *key, const problem *why)
{
    strbuf body = {0};
    problem_write(why, NULL, &body);
    return entry_new(key, why->status, &body);
}

static entry *unavailable(const cache_key *key, const char *detail)
{
    problem why = {0};
    problem_set(&why, 503, "%s", detail);
    entry *e = refusal_entry(key, &why);
    problem_clear(&why);
    return e;
}

/* Minimum time between two reports of progress. */
#define PROGRESS_MS 250

typedef struct progress_report {
    observer observer;
    cache *cache;
    flight *flight;
    int64_t sent_ms, steps;
} progress_report;

static void report_progress(observer *w, const progress *so_far)
{
    progress_report *t = (progress_report *)(void *)w;
    t->steps = so_far->evaluations;
    const int64_t now = clock_ms();
    if (t->sent_ms && now - t->sent_ms < PROGRESS_MS)
        return;
    t->sent_ms = now;
    cache_publish_progress(t->cache, t->flight, so_far);
}

/* A costly request goes to a worker, and its answer may be in the shared store. */
static bool is_costly(const service *s, const evaluation *a)
{
    return evaluation_cost_us(a) >= s->settings->inline_us;
}

static entry *find_stored(service *s, const cache_key *key)
{
    const double began = clock_us();
    entry *e = store_find(s->store, key);
    if (e)
        e->solve_us = clock_us() - began;
    return e;
}

/* Returns false if the solve was given up and a request waits for it again by now. */
static bool try_flight(service *s, const evaluation *a, const cache_key *key, flight *f,
                       double queue_us)
{
    progress_report t = {{.cancel = flight_cancel(f), .progress = report_progress},
                         .cache = s->cache,
                         .flight = f};
    const bool share = is_costly(s, a);
    cache_begin(s->cache, f);
    entry *e = share && !*t.observer.cancel ? find_stored(s, key) : NULL;
    if (!e) {
        e = entry_solve(a, key, &t.observer);
        if (e)
            metrics_solve(s->metrics, e->status, e->solve_us, t.steps);
    }
    const bool lasting = e && e->status == 200 && !e->transient;
    if (e)
        e->queue_us = queue_us;
    const bool complete = cache_complete(s->cache, f, e);
    if (lasting && share && !e->from_store)
        store_keep(s->store, e);
    entry_unref(e);
    return complete;
}

void solve_flight(service *s, const evaluation *a, const cache_key *key, flight *f,
                  double given_us)
{
    const double queue_us = given_us > 0 ? clock_us() - given_us : 0;
    while (!try_flight(s, a, key, f, queue_us))
        ;
}

/* As solve_flight, for a request that gives only the key. */
static void look_up(service *s, const cache_key *key, flight *f)
{
    entry *e = find_stored(s, key);
    if (!e) {
        problem why = {0};
        problem_set(&why, 404, NOT_STORED);
        e = refusal_entry(key, &why);
        problem_clear(&why);
    }
    cache_complete(s->cache, f, e);
    entry_unref(e);
}

static void task_work(job *j)
{
    task *t = (task *)(void *)j;
    if (t->asking)
        solve_flight(t->service, t->asking, &t->key, t->flight, t->given_us);
    else
        look_up(t->service, &t->key, t->flight);
    evaluation_free(t->asking);
    free(t);
}

/* ---- waiting: the event thread suspends, another thread resumes ---- */

enum { HANDOVER_NONE, HANDOVER_SUSPENDED, HANDOVER_DONE };

static connection *connection_of(waiter *w)
{
    return ((request *)(void *)((char *)w - offsetof(request, waiter)))->connection;
}

static void wake(waiter *w, entry *outcome)
{
    connection *p = connection_of(w);
    p->request->outcome = outcome;
    /* The thread that comes second to the handover resumes. */
    if (atomic_exchange(&p->request->handover, HANDOVER_DONE) == HANDOVER_SUSPENDED)
        MHD_resume_connection(p->mhd);
}

static enum MHD_Result suspend(connection *p)
{
    MHD_suspend_connection(p->mhd);
    connection_enter(p, CONNECTION_WAITING, p->service->settings->solve_timeout_s);
    connection_end_if_stopping(p);
    if (atomic_exchange(&p->request->handover, HANDOVER_SUSPENDED) == HANDOVER_DONE)
        MHD_resume_connection(p->mhd);
    return MHD_YES;
}

void solve_give_up(connection *p, const char *why)
{
    if (p->request->stream) {
        stream_give_up(p->request->stream, why);
        return;
    }
    waiter *w = &p->request->waiter;
    if (!cache_release(p->service->cache, w))
        return;
    static const cache_key none = {{0}};
    w->on_done(w, unavailable(&none, why));
}

void solve_look_in(connection *p, int64_t now_ms)
{
    stream *s = p->request->stream;
    const int64_t at = s ? atomic_load(&s->pulse_at_ms) : 0;
    if (at && now_ms >= at)
        stream_wake(s);
}

static enum MHD_Result reply_outcome(connection *p)
{
    request *r = p->request;
    entry *e = r->outcome;
    if (r->stream)
        return events_reply(p, NULL);
    r->outcome = NULL;
    return reply_entry(p, e, r->collapsed ? REPLY_COLLAPSED : REPLY_SOLVED);
}

static enum MHD_Result wait_outcome(connection *p)
{
    return p->request->stream ? events_reply(p, NULL) : suspend(p);
}

/* ---- the steps ---- */

#define QUERY_PAIRS_MAX 64

typedef struct query_string {
    query_pair pairs[QUERY_PAIRS_MAX];
    size_t count;
    bool too_many;
    strbuf *bytes; /* all of them in a row, each name and value ended by a NUL */
} query_string;

static enum MHD_Result add_pair(void *cls, enum MHD_ValueKind kind, const char *name,
                                const char *value)
{
    (void)kind;
    query_string *q = cls;
    q->too_many = q->count == QUERY_PAIRS_MAX;
    if (q->too_many)
        return MHD_NO;
    value = value ? value : "";
    strbuf_add(q->bytes, name, strlen(name) + 1);
    strbuf_add(q->bytes, value, strlen(value) + 1);
    q->pairs[q->count++] = (query_pair){.name = name, .value = value};
    return MHD_YES;
}

/* Takes over `a` (NULL: only look it up in the store). Returns NULL when memory ran out. */
static task *task_new(service *s, evaluation *a, const cache_key *key, flight *f,
                      unsigned client)
{
    task *t = malloc(sizeof *t);
    if (!t) {
        evaluation_free(a);
        return NULL;
    }
    const double cost_us = a ? evaluation_cost_us(a) : 0;
    *t = (task){.job = {.work = task_work,
                        .cost_us = cost_us,
                        .client = client,
                        .bytes = a ? evaluation_solve_bytes(a) : 0},
                .service = s,
                .asking = a,
                .key = *key,
                .flight = f,
                .given_us = clock_us()};
    return t;
}

/* Queues the flight for a worker; takes over `a` (NULL: only look it up in the store). */
static enum MHD_Result queue_solve(connection *p, evaluation *a, const cache_key *key,
                                   flight *f)
{
    service *s = p->service;
    task *t = task_new(s, a, key, f, p->request->client);
    if (t && thread_pool_queue(s->thread_pool, &t->job))
        return wait_outcome(p);
    entry *full = t ? unavailable(key, "the queue is full; try again later") : NULL;
    cache_complete(s->cache, f, full); /* wakes this request too */
    entry_unref(full);
    if (t)
        evaluation_free(t->asking);
    free(t);
    return reply_outcome(p);
}

void solve_item_later(service *s, evaluation *a, const cache_key *key, flight *f,
                      unsigned client)
{
    task *t = task_new(s, a, key, f, client);
    if (t)
        thread_pool_queue_batch(s->thread_pool, &t->job);
    else
        cache_complete(s->cache, f, NULL);
}

/* POST with Accept: text/event-stream. */
static bool wants_events(const request *r)
{
    return r->method & (METHOD_POST | METHOD_QUERY) && r->accept &&
           strstr(r->accept, "text/event-stream");
}

/* Sends a stored answer. */
static enum MHD_Result reply_hit(connection *p, entry *hit)
{
    if (!wants_events(p->request))
        return reply_entry(p, hit, REPLY_HIT);
    if (p->request->stream || events_open(p)) {
        events_free_waiter(p);
        return events_reply(p, hit);
    }
    entry_unref(hit);
    return reply_entry(p, NULL, REPLY_HIT);
}

static enum MHD_Result solve(connection *p, evaluation *a)
{
    service *s = p->service;
    request *r = p->request;
    cache_key key;
    entry *hit = NULL;
    flight *lead = NULL;
    cache_role turn = ROLE_NONE;
    r->waiter.on_done = wake;
    atomic_store(&r->handover, HANDOVER_NONE);
    waiter *w = wants_events(r) ? events_open(p) : &r->waiter;
    if (w && key_of_evaluation(a, &r->canonical, &key))
        turn = cache_acquire(s->cache, &key, w, &hit, &lead);
    /* Nor is anything solved on this thread while memory is short: it waits with the others. */
    if (turn == ROLE_LEADER && (is_costly(s, a) || !memory_for_small(&s->memory)))
        return queue_solve(p, a, &key, lead);
    if (turn == ROLE_LEADER)
        solve_flight(s, a, &key, lead, 0);
    evaluation_free(a);
    switch (turn) {
    case ROLE_HIT:
        return reply_hit(p, hit);
    case ROLE_FOLLOWER:
        r->collapsed = true;
        return wait_outcome(p);
    case ROLE_LEADER:
        return reply_outcome(p);
    default:
        if (r->stream)
            events_free_waiter(p);
        return reply_entry(p, NULL, REPLY_HIT);
    }
}

/* Takes over `a`; NULL: the request was refused, and `why` says why. */
static enum MHD_Result solve_read(connection *p, evaluation *a, double began_us, problem *why)
{
    p->request->read_us = clock_us() - began_us;
    if (!a)
        return reply_problem(p, why);
    problem_clear(why);
    return solve(p, a);
}

static enum MHD_Result solve_by_query(connection *p)
{
    request *r = p->request;
    const endpoint *e = r->route.endpoint;
    query_string q;
    q.count = 0;
    q.too_many = false;
    q.bytes = &r->canonical; /* free until the canonical form is written */
    q.bytes->size = 0;
    MHD_get_connection_values(p->mhd, MHD_GET_ARGUMENT_KIND, add_pair, &q);
    if (q.too_many)
        return reply_refusal(p, 400,
                             "more than %d parameters; the numbers of a list may stand in one, "
                             "separated by commas",
                             QUERY_PAIRS_MAX);
    if (q.bytes->failed)
        return reply_entry(p, NULL, REPLY_HIT);
    /* Keyed apart from bodies: a body may have the same bytes as a query. */
    cache_key_of_body(p->service->cache, &e->query, q.bytes->data, q.bytes->size,
                      &r->waiter.raw);
    entry *hit = cache_find(p->service->cache, CACHE_RAW, &r->waiter.raw);
    if (hit)
        return reply_entry(p, hit, REPLY_HIT);
    const double began = clock_us();
    problem why = {0};
    return solve_read(p, evaluation_read_query(e, q.pairs, q.count, &why), began, &why);
}

static enum MHD_Result solve_by_body(connection *p)
{
    request *r = p->request;
    const settings *set = p->service->settings;
    cache_key_of_body(p->service->cache, r->route.endpoint, r->body.data, r->body.size,
                      &r->waiter.raw);
    entry *hit = cache_find(p->service->cache, CACHE_RAW, &r->waiter.raw);
    if (hit)
        return reply_hit(p, hit);
    const double began = clock_us();
    const json_limits limits = {.depth = (int)set->json_depth, .values = (int)set->json_values};
    problem why = {0};
    evaluation *a = evaluation_read(r->route.endpoint, r->body.data ? r->body.data : "",
                                    r->body.size, &limits, &why);
    return solve_read(p, a, began, &why);
}

/* Returns whether the request had been waiting; it then has its answer. */
static bool has_waited(connection *p)
{
    if (atomic_load_explicit(&p->phase, memory_order_relaxed) != CONNECTION_WAITING)
        return false;
    connection_enter(p, CONNECTION_READING, p->service->settings->request_timeout_s);
    return true;
}

enum MHD_Result handle_endpoint(connection *p)
{
    if (has_waited(p))
        return reply_outcome(p);
    const bool has_body = p->request->method & (METHOD_POST | METHOD_QUERY);
    return has_body ? solve_by_body(p) : solve_by_query(p);
}

/* Has a worker look in the store, in a flight of its own: a request with the question itself
 * must not get the 404 of this one. */
static enum MHD_Result find_in_store(connection *p, const cache_key *key)
{
    request *r = p->request;
    static const char path[] = "/v1/results/";
    const key_part parts[] = {{path, sizeof path}, {key, sizeof *key}};
    entry *hit = NULL;
    flight *lead = NULL;
    cache_role turn = ROLE_NONE;
    r->waiter.on_done = wake;
    atomic_store(&r->handover, HANDOVER_NONE);
    if (key_of_parts(parts, 2, &r->waiter.raw))
        turn = cache_acquire(p->service->cache, &r->waiter.raw, &r->waiter, &hit, &lead);
    if (turn == ROLE_LEADER)
        return queue_solve(p, NULL, key, lead);
    r->collapsed = turn == ROLE_FOLLOWER;
    return r->collapsed ? wait_outcome(p) : reply_entry(p, hit, REPLY_HIT);
}

enum MHD_Result handle_result(connection *p)
{
    cache_key key;
    if (has_waited(p))
        return reply_outcome(p);
    if (!key_parse(p->request->route.rest, &key))
        return reply_refusal(p, 400, "a key is 64 hexadecimal digits in lower case");
    entry *e = cache_find(p->service->cache, CACHE_CANONICAL, &key);
    if (!e && p->service->store)
        return find_in_store(p, &key);
    return e ? reply_entry(p, e, REPLY_HIT) : reply_refusal(p, 404, NOT_STORED);
}
