/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A second cache level that several daemons share: a server of the Redis protocol. It may be
 * stopped, slow or lying; then nothing is found in it. All functions may be called from any
 * thread, but each may take the time that it is given: not from a thread that others wait for.
 */
#ifndef CACHE_STORE_H
#define CACHE_STORE_H

#include "cache/cache.h"

/* The largest answer that is shared: a larger one is solved anew by everyone. */
#define STORE_BODY_MAX ((size_t)4 << 20)

typedef struct store store;

typedef struct store_options {
    const char *host, *port;   /* copied; host empty: `port` is the path of a local socket */
    const char *secret_file;   /* empty: none; who can write to the store is trusted */
    const char *password_file; /* empty: none */
    int wait_ms;               /* most time for one command, connecting included */
    int64_t expiry_s;          /* 0: what is stored stays until the server drops it */
    int connections;           /* kept open when idle */
    void (*turned)(bool away, const char *why); /* it was given up, or is there (again) */
} store_options;

/* Reads the files; connects later. NULL with a sentence in `fault`. */
store *store_new(const store_options *options, char fault[256]);
void store_free(store *s);

/* The answer of a key, for the caller; NULL: none is there, or none that can be trusted. With
 * `s` NULL there is no store. */
entry *store_find(store *s, const cache_key *key);
/* Stores an answer (status 200, not transient) for others. */
void store_keep(store *s, const entry *e);

typedef struct store_counters {
    uint64_t hits, misses, writes, errors, rejected;
    bool away; /* it has failed, and is left alone for a while */
} store_counters;
store_counters store_count(store *s);

#endif
