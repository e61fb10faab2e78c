/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An answer as it is kept and sent: immutable, shared by reference. Any thread may use it. */
#ifndef CACHE_ENTRY_H
#define CACHE_ENTRY_H

#include <stdatomic.h>

#include "cache/key.h"

#define ENTRY_PREBUILT 2

/* Ends a prebuilt. */
typedef void entry_drop(void *prebuilt);

/* An answer, or a refusal that several requests wait for: immutable and shared by reference. */
typedef struct entry {
    cache_key key;
    char hex[KEY_HEX_SIZE];
    int status; /* HTTP status; only 200 is stored */
    char *body; /* owned; JSON (application/problem+json unless the status is 200) */
    size_t size;
    double queue_us, solve_us;  /* spent waiting for a worker, and in endpoint or store */
    double cpu_us, estimate_us; /* of the endpoint: time of the processor, and its estimate */
    bool stored;                /* set by cache_complete, before anybody is woken */
    bool transient;             /* might come out otherwise another time: never stored */
    bool given_up;              /* a refusal: nobody waited any more */
    bool from_store;            /* from the shared store: solved elsewhere */
    /* What http has made ready for sending the entry again, once it was asked for again: dropped
     * with the last reference. It may point into `body` as long as it holds the body
     * (entry_hold_body). */
    _Atomic(void *) prebuilt[ENTRY_PREBUILT];
    _Atomic(entry_drop *) prebuilt_drop; /* of each; always the same */
} entry;

/* Bytes of all bodies that exist. */
size_t entry_bytes(void);
/* Takes over the bytes of `body` (which is as new afterwards). NULL when memory ran out. */
entry *entry_new(const cache_key *key, int status, strbuf *body);
entry *entry_ref(entry *e);
void entry_unref(entry *e); /* NULL is fine */
void entry_hold_body(entry *e);
void entry_release_body(entry *e);

/* Answers `a` (200), or says why not (the problem's status). NULL when memory ran out. */
entry *entry_solve(const evaluation *a, const cache_key *key, observer *w);

#endif
