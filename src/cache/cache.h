/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Stored answers, least recently used first out, bounded in bytes; and single flight: of equal
 * requests under way at once, one is solved and all are told. All functions may be called from
 * any thread.
 */
#ifndef CACHE_CACHE_H
#define CACHE_CACHE_H

#include "cache/key.h"

/* ---- entries ---- */

#define ENTRY_PREBUILT 2

/* An answer, or a refusal that several requests wait for: immutable and shared by reference. */
typedef struct entry {
    cache_key key;
    char hex[KEY_HEX_SIZE];
    int status; /* HTTP status; only 200 is stored */
    char *body; /* owned; JSON (application/problem+json unless the status is 200) */
    size_t size;
    double queue_us, solve_us; /* spent waiting for a worker, and in endpoint or store */
    bool stored;               /* set by cache_complete, before anybody is woken */
    bool transient;            /* might come out otherwise another time: never stored */
    bool from_store;           /* from the shared store: solved elsewhere */
    /* What http has made ready for sending the entry again: set before the entry is shared,
     * dropped with the last reference. It may point into `body` as long as it holds the body
     * (entry_hold_body). */
    void *prebuilt[ENTRY_PREBUILT];
    void (*prebuilt_drop)(void *face);
} entry;

/* Takes over the bytes of `body` (which is as new afterwards). NULL when memory ran out. */
entry *entry_new(const cache_key *key, int status, strbuf *body);
entry *entry_ref(entry *e);
void entry_unref(entry *e); /* NULL is fine */
void entry_hold_body(entry *e);
void entry_release_body(entry *e);

/* Answers `a` (200), or says why not (the problem's status). NULL when memory ran out. */
entry *entry_solve(const evaluation *a, const cache_key *key, observer *w);

/* ---- the cache ---- */

/* What an entry is counted as beside its body: its own struct, and what its prebuilt take. */
#define CACHE_ENTRY_OVERHEAD 3584

typedef struct cache cache;

typedef struct cache_counters {
    uint64_t hits, misses, joins, solves, cancels, evictions;
    size_t entries, bytes, cap, flights;
} cache_counters;

/* At most `cap` bytes, its own tables included; 0 stores nothing. NULL when memory ran out. */
cache *cache_new(size_t cap);
/* No flight may be under way. */
void cache_free(cache *c);
cache_counters cache_count(cache *c);

typedef enum cache_level { CACHE_CANONICAL, CACHE_RAW } cache_level;
/* The stored answer of a key, referenced for the caller, or NULL. */
entry *cache_find(cache *c, cache_level level, const cache_key *key);

/* The raw key of a body that asks `owner` (whatever tells them apart: an endpoint; NULL: an
 * item of a batch): SipHash-2-4 under a secret of this cache, so that nobody can make two
 * bodies share one. A fifth of what SHA-256 takes, on the way of every stored answer. */
void cache_key_of_body(const cache *c, const void *owner, const char *body, size_t size,
                       cache_key *key);

/* ---- single flight ---- */

typedef struct flight flight;

/* One who waits for an answer. Owned by the caller, who keeps it until `on_done` is called. */
typedef struct waiter {
    cache_key raw; /* of the bytes it asked with; a stored answer is found by it next time */
    /* The answer, referenced for the waiter; NULL: memory ran out. From any thread. */
    void (*on_done)(struct waiter *w, entry *outcome);
    /* How far it is; may be NULL. Under the cache's lock: short, and no call of this file. */
    void (*on_progress)(struct waiter *w, const progress *so_far);
    struct waiter *next; /* the rest is the cache's */
    flight *flight;
} waiter;

typedef enum cache_role {
    ROLE_HIT,      /* *hit is the stored answer, referenced for the caller */
    ROLE_FOLLOWER, /* somebody solves it: `w` will be woken */
    ROLE_LEADER, /* the caller must solve it and call cache_complete(*lead); `w` is woken too */
    ROLE_NONE    /* memory ran out */
} cache_role;

cache_role cache_acquire(cache *c, const cache_key *key, waiter *w, entry **hit, flight **lead);
/* True once nobody waits for the flight any more: what endpoints poll. */
const _Atomic bool *flight_cancel(const flight *f);
/* Lets all who wait for the flight hear. */
void cache_publish_progress(cache *c, flight *f, const progress *so_far);
/* Ends a flight: stores `outcome` (if its status is 200 and it fits), wakes all who wait. The
 * caller keeps its own reference; NULL says that memory ran out. */
void cache_complete(cache *c, flight *f, entry *outcome);
/* `w` gives up waiting; the last one to do so cancels the flight. True: it will not be woken,
 * the caller must do what waking would have done. False: it is being woken. */
bool cache_release(cache *c, waiter *w);

#endif
