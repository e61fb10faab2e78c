/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A second cache level that several daemons share: a server of the Redis protocol. It may be
 * stopped, slow or lying; then nothing is found in it. All functions may be called from any
 * thread, but each may take the time that it is given: not from a thread that others wait for.
 */
#ifndef CACHE_SHARED_H
#define CACHE_SHARED_H

#include "cache/cache.h"

/* The largest answer that is shared: a larger one is solved anew by everyone. */
#define SHARED_BODY_MOST ((size_t)4 << 20)

typedef struct shared shared;

typedef struct shared_options {
    const char *host, *port;   /* copied; host empty: `port` is the path of a local socket */
    const char *secret_file;   /* empty: none; who can write to the store is trusted */
    const char *password_file; /* empty: none */
    int wait_ms;               /* most time for one command, connecting included */
    int64_t expiry_s;          /* 0: what is stored stays until the server drops it */
    int connections;           /* kept open when idle */
    void (*turned)(bool away, const char *why); /* it was given up, or is there (again) */
} shared_options;

/* Reads the files; connects later. NULL with a sentence in `fault`. */
shared *shared_new(const shared_options *options, char fault[256]);
void shared_free(shared *s);

/* The answer of a key, for the caller; NULL: none is there, or none that can be trusted. With
 * `s` NULL there is no store. */
entry *shared_find(shared *s, const cache_key *key);
/* Stores an answer (status 200, not transient) for others. */
void shared_keep(shared *s, const entry *e);

typedef struct shared_counters {
    uint64_t hits, misses, writes, errors, rejected;
    bool away; /* it has failed, and is left alone for a while */
} shared_counters;
shared_counters shared_count(shared *s);

#endif
