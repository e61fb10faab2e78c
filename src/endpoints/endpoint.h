/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What an endpoint is: a path, the table of its fields, and the function that answers. Adding
 * one means adding a file with a `const endpoint`, a row in MECHANICS (table.h) and its
 * answer's schema in api/openapi.yaml.
 */
#ifndef ENDPOINTS_ENDPOINT_H
#define ENDPOINTS_ENDPOINT_H

#include <stdatomic.h>

#include <strum/options.h>

#include "schema/schema.h"

/* How far a long computation has come. */
typedef struct progress {
    int64_t evaluations;
    double best;      /* of what is sought; NAN: none so far */
    const char *what; /* is counted and sought, in a few words; may be NULL */
} progress;

/* Who looks on while an answer is made, and what is learnt beside it. */
typedef struct observer {
    const _Atomic bool *cancel; /* may be NULL; true: nobody waits any more */
    /* May be NULL. From the thread that solves; however often it is called, it costs little. */
    void (*progress)(struct observer *w, const progress *so_far);
    double solve_us; /* set: the time spent in the endpoint */
    double cpu_us;   /* set: of that, the time of the processor */
    bool transient;  /* set: see below */
    bool cancelled;  /* set: `cancel` was seen to be true */
} observer;

/* What an answer is written into, and what may end it early. */
typedef struct answer {
    json_writer *result;        /* write exactly one value: the "result" */
    strbuf *warnings;           /* owned by the caller; use answer_warn */
    const char *theory;         /* set: what the answer rests on, with source ("meta.theory") */
    const _Atomic bool *cancel; /* may be NULL; true: nobody waits any more */
    observer *observer;         /* may be NULL; use answer_progress */
    /* Set: a limit of time cut it short, so that it might come out otherwise another time. It
     * is sent, with a warning that says so, and never stored. */
    bool transient;
    problem *problem; /* say here why there is no answer (422 impossible, 503 cancelled, 500) */
} answer;

/* Tells whoever looks on; `best` NAN: none so far, `what` may be NULL. */
void answer_progress(const answer *a, int64_t evaluations, double best, const char *what);
/* Nobody waits any more, or the answer has already become too large to be sent: poll this where the work is long, and give up with 503. */
bool answer_cancelled(const answer *a);
/* What a solve of the library takes, so that it ends once nobody waits. */
strum_options answer_options(const answer *a);
void answer_warn(answer *a, const char *format, ...) __attribute__((format(printf, 2, 3)));

typedef struct endpoint {
    const char *path;  /* "/v1/catenary/frequencies" */
    const char *title; /* one line */
    const schema *request;
    bool query;     /* may be asked by GET: no nested lists */
    bool variables; /* FIELD_VARIABLE rows may name variables */
    /* Computes dependent defaults (FIELD_GIVE) and checks across fields; adds every fault to
     * `p`. */
    void (*prepare)(void *request, schema_arena *arena, problem *p);
    /* Estimated work in microseconds: decides between answering at once and handing to the
     * thread_pool. */
    double (*cost_us)(const void *request);
    /* May be NULL: estimated memory (bytes) that a solve holds beside its answer; else it follows
     * from `cost_us`, for pencils of matrices that are filled as they are computed. */
    double (*solve_bytes)(const void *request);
    /* May be NULL: a careful estimate, never above its size, of the part of the answer that grows
     * with the request (bytes), and the field that decides it. */
    double (*answer_bytes)(const void *request, const char **pointer);
    /* Writes the result; false with a->problem set when there is none. Pure: depends on
     * `request` only. */
    bool (*answer)(const void *request, answer *a);
} endpoint;

/* What a number takes in an answer, at least: few have less than half the digits of a double. */
#define ANSWER_NUMBER_BYTES 10

/* ---- one asking: what http and cache see of all this ---- */

/* A request that was read, checked and completed. Owned by the caller; ended by evaluation_free. */
typedef struct evaluation evaluation;

/* Bytes that an answer may have, and that one solve may hold, of every thread; 0, as at first: no
 * limit. A request whose answer would have more is refused when it is read where that is known,
 * else when it is answered. */
void evaluation_limit(size_t answer_bytes, size_t solve_bytes);

/* From a JSON body / from query pairs. NULL with `p` filled when refused. */
evaluation *evaluation_read(const endpoint *e, const char *body, size_t size,
                            const json_limits *limits, problem *p);
/* From a part of a document that json_read has read; pointers are those into the part. */
evaluation *evaluation_read_item(const endpoint *e, const cJSON *item, problem *p);
evaluation *evaluation_read_query(const endpoint *e, const query_pair *pairs, size_t count,
                                  problem *p);
void evaluation_free(evaluation *a);

/* The digest of this machine's numerics (strum_numerics), found at the first call; NULL when there
 * is no memory to find it. */
const char *evaluation_numerics(void);
/* Canonical bytes: endpoint, version and number of the solver, the digest of the numerics, and
 * every field; their hash is the answer's key. */
void evaluation_canonical(const evaluation *a, strbuf *out);
/* The endpoint's estimate, made once when the request was complete. */
double evaluation_cost_us(const evaluation *a);
/* Estimated memory that the solve and its answer hold meanwhile; at most the limit set for one. */
size_t evaluation_solve_bytes(const evaluation *a);
/* Writes {"request", "result", "warnings", "meta": {"key", "solver", "solver_number",
 * "numerics", "theory"}}. False with `p` filled when there is no answer. `w` may be NULL. */
bool evaluation_answer(const evaluation *a, const char *key, observer *w, strbuf *out,
                       problem *p);

#endif
