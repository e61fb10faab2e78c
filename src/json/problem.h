/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A refusal (RFC 9457, application/problem+json): a status, a sentence, and every faulty field
 * at once, each by JSON pointer (RFC 6901) with the reason. Gathered by reader, schema,
 * endpoint and http alike; written once.
 */
#ifndef JSON_PROBLEM_H
#define JSON_PROBLEM_H

#include "json/strbuf.h"
#include "json/write.h"

/* A hostile document can hold a fault in every byte: beyond this many entries, or bytes of
 * them, faults are only counted. */
#define PROBLEM_ENTRIES_MAX 256
#define PROBLEM_BYTES_MAX   65536

typedef struct problem_entry {
    char *pointer, *detail; /* owned */
} problem_entry;

typedef struct problem {
    int status;             /* HTTP status; 0: no problem so far */
    char *detail;           /* owned; may be NULL */
    problem_entry *entries; /* owned */
    size_t count, room;
    size_t bytes;   /* of the entries' texts */
    size_t omitted; /* faults beyond the limits, counted only */
    bool failed;    /* memory ran out while gathering: the status is 500 */
} problem;

/* Sets status and sentence; the first caller wins. */
void problem_set(problem *p, int status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* Adds a faulty field, and sets status 400 when none is set. `pointer` "" means the whole
 * document. */
void problem_add(problem *p, const char *pointer, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* Lets the pointers begin with `prefix`: what was read is a part of a larger document. */
void problem_place(problem *p, const char *prefix);
/* Memory ran out: status 500 whatever was gathered, for it may be incomplete. */
void problem_out_of_memory(problem *p);
/* The document {"type", "title", "status", "detail", "instance"?, "errors": [{"pointer",
 * "detail"}]}. */
void problem_write(const problem *p, const char *instance, strbuf *out);
/* The reason phrase of a status (RFC 9110); "Error" for one that is not used here. */
const char *problem_title(int status);
/* Frees what it holds; `p` is as new ({0}). */
void problem_clear(problem *p);

#endif
