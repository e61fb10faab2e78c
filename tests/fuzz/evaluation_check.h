/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What must hold of every asking, whatever was asked. The input of fuzzers that use it: a first
 * line with the endpoint's path (any other line chooses one too, so that mutations of it are
 * not wasted), then the body or the query string.
 */
#ifndef FUZZ_EVALUATION_CHECK_H
#define FUZZ_EVALUATION_CHECK_H

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "validation/registry.h"

/* What is estimated to take longer (without sanitizers) is read and keyed, but not solved: a
 * fuzzer lives by its runs per second. FUZZ_COST_US in the environment sets another bound. */
#define COST_US 500.0

/* Estimates can be wrong, so that an answer takes minutes. The daemon gives it up then, and so
 * does the fuzzer, after so many seconds: an endpoint that does not notice is a finding. */
#define GIVE_UP_S 2
static _Atomic bool cancel;
static _Atomic time_t begun; /* 0: nothing is being solved */

static inline time_t now_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec;
}

static inline void *give_up(void *unused)
{
    for (;;) {
        nanosleep(&(struct timespec){.tv_nsec = 200000000}, NULL);
        if (begun != 0 && now_s() > begun + GIVE_UP_S)
            cancel = true;
    }
    return unused;
}

static inline bool solve(const evaluation *a, strbuf *answer, problem *p)
{
    static pthread_t thread;
    if (thread == 0 && pthread_create(&thread, NULL, give_up, NULL) != 0)
        return false;
    observer w = {.cancel = &cancel};
    cancel = false;
    begun = now_s();
    const bool good = evaluation_answer(a, "key", &w, answer, p);
    begun = 0;
    return good;
}

/* The daemon's own defaults. */
static const json_limits limits = {.depth = 16, .values = 20000};

static inline void must(bool good, const char *what, const strbuf *shown)
{
    if (good)
        return;
    fprintf(stderr, "fuzz: %s\n%s\n", what, shown != NULL && shown->data ? shown->data : "");
    abort();
}

static inline double cost_bound_us(void)
{
    static double bound;
    if (bound == 0) {
        const char *set = getenv("FUZZ_COST_US");
        bound = set != NULL ? strtod(set, NULL) : COST_US;
    }
    return bound;
}

/* The endpoint of the first line, which is taken off. */
static inline const endpoint *take_endpoint(const uint8_t **data, size_t *size)
{
    const uint8_t *end = *size > 0 ? memchr(*data, '\n', *size) : NULL;
    const size_t length = end != NULL ? (size_t)(end - *data) : 0;
    char path[64] = "";
    unsigned hash = 5381;
    for (size_t i = 0; i < length; i++)
        hash = 33 * hash + (*data)[i];
    if (length < sizeof path)
        memcpy(path, *data, length);
    if (end != NULL) {
        *size -= length + 1;
        *data = end + 1;
    }
    const endpoint *e = endpoint_find(path);
    size_t count = 0;
    while (endpoints[count] != NULL)
        count++;
    return e != NULL ? e : endpoints[hash % count];
}

static inline void check_json(const strbuf *document, int values, const char *what)
{
    const json_limits wide = {.depth = JSON_DEPTH_MAX, .values = values};
    cJSON *read;
    problem fault = {0};
    must(json_read(document->data, document->size, &wide, &read, &fault), what, document);
    cJSON_Delete(read);
}

/* A refusal is JSON, and says that the fault is in what was asked. */
static inline void check_refusal(problem *p)
{
    strbuf out = {0};
    problem_write(p, NULL, &out);
    must(p->status == 400 || p->status == 405 || p->status == 413 || p->status == 422,
         "refused with a strange status", &out);
    check_json(&out, 1 << 12, "a refusal is not JSON");
    strbuf_clear(&out);
    problem_clear(p);
}

/* The bytes of the echo: numbers must not pass through another printer. */
static inline strbuf echo_of(const strbuf *answer)
{
    static const char before[] = "{\"request\":";
    must(answer->size > sizeof before && memcmp(answer->data, before, sizeof before - 1) == 0,
         "an answer does not begin with its request", answer);
    strbuf echo = {0};
    int depth = 0;
    for (const char *at = answer->data + sizeof before - 1; *at != '\0'; at++) {
        strbuf_add(&echo, at, 1);
        depth += (*at == '{') - (*at == '}'); /* no string of a request holds a brace */
        if (depth == 0)
            break;
    }
    return echo;
}

/* Asked again as it was echoed, a question has the same key. */
static inline void check_echo(const endpoint *e, const evaluation *a, const strbuf *answer)
{
    problem p = {0};
    strbuf first = {0}, second = {0}, echo = echo_of(answer);
    evaluation *again = evaluation_read(e, echo.data, echo.size, &limits, &p);
    if (again == NULL)
        problem_write(&p, NULL, &second);
    must(again != NULL, "an echo is refused", second.data != NULL ? &second : &echo);
    evaluation_canonical(a, &first);
    evaluation_canonical(again, &second);
    must(first.size == second.size && memcmp(first.data, second.data, first.size) == 0,
         "an echo has another key", &echo);
    evaluation_free(again);
    strbuf_clear(&echo);
    strbuf_clear(&first);
    strbuf_clear(&second);
}

/* Takes over `a`; NULL: it was refused with `p`. */
static inline void check_asking(const endpoint *e, evaluation *a, problem *p)
{
    if (a == NULL) {
        check_refusal(p);
        return;
    }
    must(p->status == 0, "taken with a fault", NULL);
    if (evaluation_cost_us(a) <= cost_bound_us()) {
        strbuf answer = {0};
        if (solve(a, &answer, p)) {
            check_json(&answer, 1 << 20, "an answer is not JSON");
            check_echo(e, a, &answer);
        } else if (p->status == 503 && cancel) {
            problem_clear(p);
        } else {
            check_refusal(p);
        }
        strbuf_clear(&answer);
    }
    evaluation_free(a);
}

#endif
