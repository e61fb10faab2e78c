/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One asking: read and completed, keyed, answered. */
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <strum/version.h>

#include "endpoints/endpoint.h"

/* Of the canonical form itself: raised when equal bytes would come to mean something else. */
#define CANONICAL_VERSION "1"

/* The digest of the numerics, once it was found; under the lock. */
static pthread_mutex_t numerics_lock = PTHREAD_MUTEX_INITIALIZER;
static char numerics_digest[STRUM_NUMERICS_SIZE];

struct evaluation {
    const endpoint *endpoint;
    void *request; /* owned by the arena */
    schema_arena *arena;
    double cost_us; /* an estimate may itself solve something: made once */
    size_t solve_bytes;
};

static _Atomic size_t answer_most, solve_most;

void evaluation_limit(size_t answer_bytes, size_t solve_bytes)
{
    atomic_store(&answer_most, answer_bytes);
    atomic_store(&solve_most, solve_bytes);
}

/* Refuses what would have more bytes than may be sent. */
static void check_bytes(const endpoint *e, const void *request, problem *p)
{
    const size_t most = atomic_load(&answer_most);
    const char *pointer = "";
    if (most == 0 || e->answer_bytes == NULL)
        return;
    const double bytes = e->answer_bytes(request, &pointer);
    if (bytes > (double)most)
        problem_add(p, pointer,
                    "asks for an answer of more than %.3g bytes; at most %zu are sent", bytes,
                    most);
}

/* The largest solves measured hold 75 bytes for each microsecond they take (200 modes of a cable of
 * chi from -12.5 to 12.5: 776 MB, 10.6 s). */
#define BYTES_PER_US 75.0
#define SOLVE_LEAST  (256U << 10)

/* A buffer that grows by doubling holds a text once and a half while it is copied. */
static size_t solve_bytes(const endpoint *e, const void *request, double cost_us)
{
    const char *pointer;
    const size_t most = atomic_load(&solve_most);
    const double text = e->answer_bytes ? e->answer_bytes(request, &pointer) : 0;
    const double solve = e->solve_bytes ? e->solve_bytes(request) : BYTES_PER_US * cost_us;
    const double bytes = SOLVE_LEAST + solve + 1.5 * text;
    return most == 0 || bytes < (double)most ? (size_t)fmin(bytes, 1e15) : most;
}

/* Checks across fields, and the evaluation itself; takes the arena. */
static evaluation *evaluation_complete(const endpoint *e, void *request, schema_arena *arena,
                                       problem *p)
{
    if (request != NULL && e->prepare != NULL)
        e->prepare(request, arena, p);
    if (request != NULL && p->status == 0)
        check_bytes(e, request, p);
    evaluation *a = request != NULL && p->status == 0 ? malloc(sizeof *a) : NULL;
    if (a == NULL) {
        schema_free(arena);
        if (p->status == 0)
            problem_out_of_memory(p);
        return NULL;
    }
    *a = (evaluation){
        .endpoint = e, .request = request, .arena = arena, .cost_us = e->cost_us(request)};
    a->solve_bytes = solve_bytes(e, request, a->cost_us);
    return a;
}

evaluation *evaluation_read_item(const endpoint *e, const cJSON *item, problem *p)
{
    schema_arena *arena = NULL;
    void *request = schema_read(e->request, item, e->variables, &arena, p);
    return evaluation_complete(e, request, arena, p);
}

evaluation *evaluation_read(const endpoint *e, const char *body, size_t size,
                            const json_limits *limits, problem *p)
{
    cJSON *document;
    if (!json_read(body, size, limits, &document, p))
        return NULL;
    evaluation *a = evaluation_read_item(e, document, p);
    cJSON_Delete(document);
    return a;
}

evaluation *evaluation_read_query(const endpoint *e, const query_pair *pairs, size_t count,
                                  problem *p)
{
    if (!e->query) {
        problem_set(p, 405, "%s takes nested lists: send JSON by POST", e->path);
        return NULL;
    }
    schema_arena *arena = NULL;
    void *request = schema_read_query(e->request, pairs, count, &arena, p);
    return evaluation_complete(e, request, arena, p);
}

void evaluation_free(evaluation *a)
{
    if (a == NULL)
        return;
    schema_free(a->arena);
    free(a);
}

const char *evaluation_numerics(void)
{
    char found[STRUM_NUMERICS_SIZE];
    pthread_mutex_lock(&numerics_lock);
    if (numerics_digest[0] == '\0' && strum_numerics(found, NULL) == STRUM_OK)
        memcpy(numerics_digest, found, sizeof found);
    const bool known = numerics_digest[0] != '\0';
    pthread_mutex_unlock(&numerics_lock);
    return known ? numerics_digest : NULL;
}

void evaluation_canonical(const evaluation *a, strbuf *out)
{
    strbuf_add(out, a->endpoint->path, strlen(a->endpoint->path) + 1);
    strbuf_add(out, CANONICAL_VERSION, sizeof CANONICAL_VERSION);
    strbuf_add(out, strum_version(), strlen(strum_version()) + 1);
    /* Equal keys mean equal bytes: of this solver, with numerics that round as these do. */
    const char *numerics = evaluation_numerics();
    out->failed |= numerics == NULL;
    strbuf_format(out, "%d %s", strum_solver(), numerics != NULL ? numerics : "");
    strbuf_add(out, "", 1);
    schema_canonical(a->endpoint->request, a->request, out);
}

double evaluation_cost_us(const evaluation *a)
{
    return a->cost_us;
}

size_t evaluation_solve_bytes(const evaluation *a)
{
    return a->solve_bytes;
}

void answer_warn(answer *a, const char *format, ...)
{
    strbuf sentence = {0};
    va_list arguments;
    va_start(arguments, format);
    strbuf_format_list(&sentence, format, arguments);
    va_end(arguments);
    if (sentence.failed) {
        a->warnings->failed = true;
    } else {
        json_writer json = {.out = a->warnings, .comma = a->warnings->size > 0};
        json_string(&json, sentence.data);
    }
    strbuf_clear(&sentence);
}

void answer_progress(const answer *a, int64_t evaluations, double best, const char *what)
{
    if (a->observer != NULL && a->observer->progress != NULL)
        a->observer->progress(a->observer, &(progress){evaluations, best, what});
}

bool answer_cancelled(const answer *a)
{
    if (a->result->out->full)
        return true;
    if (a->cancel == NULL || !atomic_load_explicit(a->cancel, memory_order_relaxed))
        return false;
    if (a->observer != NULL)
        a->observer->cancelled = true;
    return true;
}

static bool is_cancelled(void *a)
{
    return answer_cancelled(a);
}

strum_options answer_options(const answer *a)
{
    strum_options options = STRUM_OPTIONS_INIT;
    options.bytes_max = atomic_load(&solve_most);
    if (a->cancel != NULL) {
        options.cancelled = is_cancelled;
        options.context = (void *)(uintptr_t)a; /* only read */
    }
    return options;
}

static double now_us(clockid_t clock)
{
    struct timespec now;
    (void)clock_gettime(clock, &now);
    return 1e6 * (double)now.tv_sec + 1e-3 * (double)now.tv_nsec;
}

static void write_end(const answer *answered, const char *key, json_writer *json)
{
    json_key(json, "warnings");
    json_open_array(json);
    if (answered->warnings->size > 0)
        json_raw(json, answered->warnings->data, answered->warnings->size);
    json_close_array(json);
    json_key(json, "meta");
    json_open_object(json);
    json_put_string(json, "key", key);
    json_key(json, "solver");
    strbuf solver = {0};
    strbuf_format(&solver, "strum %s", strum_version());
    json_string(json, solver.failed ? "" : solver.data);
    json->out->failed |= solver.failed;
    strbuf_clear(&solver);
    json_put_integer(json, "solver_number", strum_solver());
    const char *numerics = evaluation_numerics();
    json->out->failed |= numerics == NULL;
    json_put_string(json, "numerics", numerics != NULL ? numerics : "");
    if (answered->theory != NULL)
        json_put_string(json, "theory", answered->theory);
    json_close_object(json);
}

bool evaluation_answer(const evaluation *a, const char *key, observer *w, strbuf *out,
                       problem *p)
{
    strbuf warnings = {0};
    json_writer json = {.out = out};
    answer answered = {.result = &json,
                       .warnings = &warnings,
                       .cancel = w != NULL ? w->cancel : NULL,
                       .observer = w,
                       .problem = p};
    json_open_object(&json);
    json_key(&json, "request");
    schema_echo(a->endpoint->request, a->request, &json);
    json_key(&json, "result");
    out->most = atomic_load(&answer_most);
    const double start = now_us(CLOCK_MONOTONIC);
    const double cpu = now_us(CLOCK_THREAD_CPUTIME_ID);
    bool good = a->endpoint->answer(a->request, &answered);
    if (w != NULL) {
        w->solve_us = now_us(CLOCK_MONOTONIC) - start;
        w->cpu_us = now_us(CLOCK_THREAD_CPUTIME_ID) - cpu;
        w->transient = answered.transient;
    }
    if (good) {
        write_end(&answered, key, &json);
        json_close_object(&json);
    }
    if (out->full) {
        problem_clear(p); /* whatever followed from it */
        problem_set(p, 422, "the answer would have more than %zu bytes", out->most);
        good = false;
    }
    out->most = 0;
    if (good && (out->failed || warnings.failed)) {
        problem_set(p, 500,
                    "the answer could not be written: memory ran out, or a result is "
                    "not a finite number");
        good = false;
    }
    if (!good) {
        strbuf_clear(out);
        problem_set(p, 500, "no answer was found, for a reason that was not given");
    }
    strbuf_clear(&warnings);
    return good;
}
