/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Stored answers, bounded in bytes; and single flight: of equal requests under way at once, one
 * is solved and all are told. All functions may be called from any thread.
 *
 * A new answer is kept in a window of an eighth of the bytes, the least recently used first out.
 * Who leaves the window stays if there is room, or if it was asked for more often lately than the
 * least recently used of the others, which then goes (W-TinyLFU: Einziger, Friedman and Manes
 * 2017). So a batch that is larger than the cache drives nothing out that is asked for again and
 * again, and a part of it is still there the next time.
 */
#ifndef CACHE_CACHE_H
#define CACHE_CACHE_H

#include "cache/entry.h"

/* ---- the cache ---- */

/* What an entry is counted as beside its body, and what each of its prebuilt. */
#define CACHE_ENTRY_OVERHEAD    896
#define CACHE_PREBUILT_OVERHEAD 1792

typedef struct cache cache;

typedef struct cache_counters {
    uint64_t hits, misses, joins, solves, cancels, evictions;
    size_t entries, bytes, cap, flights;
    /* Flights that nobody waits for and that are not ended yet, and since when the oldest of
     * them is one (CLOCK_MONOTONIC_COARSE in milliseconds). */
    size_t abandoned;
    int64_t abandoned_since_ms;
} cache_counters;

/* At most `cap` bytes, its own tables included; 0 stores nothing. NULL when memory ran out. */
cache *cache_new(size_t cap);
/* No flight may be under way. */
void cache_free(cache *c);
cache_counters cache_count(cache *c);

/* Bytes of the bodies stored; without the lock. */
size_t cache_body_bytes(const cache *c);

typedef enum cache_level { CACHE_CANONICAL, CACHE_RAW } cache_level;
/* The stored answer of a key, referenced for the caller, or NULL. */
entry *cache_find(cache *c, cache_level level, const cache_key *key);

/* Counts one more prebuilt of `e`. */
void cache_count_prebuilt(cache *c, entry *e);

/* The raw key of a body that asks `owner` (whatever tells them apart: an endpoint; NULL: an
 * item of a batch): SipHash-2-4 under a secret of this cache, so that nobody can make two
 * bodies share one. A fifth of what SHA-256 takes, on the way of every stored answer. */
void cache_key_of_body(const cache *c, const void *owner, const char *body, size_t size,
                       cache_key *key);

/* ---- single flight ---- */

typedef struct flight flight;

/* A request that waits for an answer. Owned by the caller, which keeps it until `on_done`. */
typedef struct waiter {
    cache_key raw; /* of the bytes it asked with; a stored answer is found by it next time */
    /* The answer, referenced for the waiter; NULL: memory ran out. From any thread. */
    void (*on_done)(struct waiter *w, entry *outcome);
    /* Progress callback; may be NULL. Called with the cache lock held: must be short and must
     * not call any function of this file. */
    void (*on_progress)(struct waiter *w, const progress *so_far);
    struct waiter *next; /* the rest is the cache's */
    flight *flight;
} waiter;

typedef enum cache_role {
    ROLE_HIT,      /* *hit is the stored answer, referenced for the caller */
    ROLE_FOLLOWER, /* another request solves it: on_done of `w` will be called */
    ROLE_LEADER, /* the caller must solve it and call cache_complete(*lead), which calls on_done
                    of `w` too */
    ROLE_NONE    /* memory ran out */
} cache_role;

cache_role cache_acquire(cache *c, const cache_key *key, waiter *w, entry **hit, flight **lead);
/* Returns a flag that is true while every request has stopped waiting: endpoints poll it. A request
 * that asks again before the flight ends clears it and waits for the same solve. */
const _Atomic bool *flight_cancel(const flight *f);
/* A worker has taken the flight up. */
void cache_begin(cache *c, flight *f);
/* Whether `w` waits for a flight that no worker has taken up. */
bool cache_is_queued(cache *c, const waiter *w);
/* Calls on_progress of every request that waits for the flight. */
void cache_publish_progress(cache *c, flight *f, const progress *so_far);
/* Ends a flight: stores `outcome` (if its status is 200 and it fits) and calls on_done of every
 * request that waits. The caller keeps its own reference; NULL says that memory ran out. Returns
 * false, the flight going on, if `outcome` was given up and a request waits again: solve it anew. */
bool cache_complete(cache *c, flight *f, entry *outcome);
/* `w` stops waiting; the last one to do so cancels the flight. Returns true when on_done will
 * not be called, and the caller must do its work; false when it is being called. */
bool cache_release(cache *c, waiter *w);

#endif
