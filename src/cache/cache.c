/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cache/stored.h"

#include <pthread.h>
#include <assert.h>
#include <sodium/crypto_shorthash_siphash24.h>
#include <sodium/randombytes.h>
#include <stdlib.h>
#include <string.h>

struct flight {
    spot spot;
    waiter *waiters;
    _Atomic bool cancel;
};

struct cache {
    /* One lock: what it guards takes about 0.1 us. */
    pthread_mutex_t lock;
    spot **buckets;
    unsigned shift;  /* 64 - log2(number of buckets) */
    uint64_t spread; /* odd and secret: nobody can choose bodies that share a bucket */
    unsigned char secret[crypto_shorthash_siphashx24_KEYBYTES]; /* of cache_key_of_body */
    struct stored *newest, *oldest;
    cache_counters count;
};

/* ---- the table ---- */

static spot **bucket_of(cache *c, const cache_key *key)
{
    uint64_t first;
    memcpy(&first, key->bytes, sizeof first);
    return &c->buckets[first * c->spread >> c->shift];
}

static spot *spot_find(cache *c, spot_kind kind, const cache_key *key)
{
    for (spot *l = *bucket_of(c, key); l; l = l->next)
        if (l->kind == kind && memcmp(&l->key, key, sizeof *key) == 0)
            return l;
    return NULL;
}

static void spot_add(cache *c, spot *l, spot_kind kind, const cache_key *key, void *owner)
{
    spot **bucket = bucket_of(c, key);
    *l = (spot){.next = *bucket, .key = *key, .kind = kind, .owner = owner};
    *bucket = l;
}

static void spot_remove(cache *c, spot *l)
{
    if (l->kind == SPOT_NONE)
        return;
    spot **place = bucket_of(c, &l->key);
    while (*place != l)
        place = &(*place)->next;
    *place = l->next;
    l->kind = SPOT_NONE;
}

/* ---- order of use ---- */

static void order_remove(cache *c, struct stored *s)
{
    *(s->newer ? &s->newer->older : &c->newest) = s->older;
    *(s->older ? &s->older->newer : &c->oldest) = s->newer;
}

static void order_add(cache *c, struct stored *s)
{
    s->newer = NULL;
    s->older = c->newest;
    *(c->newest ? &c->newest->newer : &c->oldest) = s;
    c->newest = s;
}

static struct stored *touch(cache *c, spot *l)
{
    struct stored *s = l->owner;
    if (c->newest != s) {
        order_remove(c, s);
        order_add(c, s);
    }
    return s;
}

/* ---- storing ---- */

static void recognise(cache *c, struct stored *s, const cache_key *raw)
{
    if (spot_find(c, SPOT_RAW, raw))
        return;
    spot *l = &s->raw[s->raw_next++ % RAW_SPOTS];
    spot_remove(c, l);
    spot_add(c, l, SPOT_RAW, raw, s);
}

/* Takes the entry out; its last user frees it. */
static void evict(cache *c, struct stored *s)
{
    spot_remove(c, &s->canonical);
    for (size_t i = 0; i < RAW_SPOTS; i++)
        spot_remove(c, &s->raw[i]);
    order_remove(c, s);
    c->count.bytes -= s->cost;
    c->count.entries--;
    entry_unref(&s->entry);
}

static void store(cache *c, entry *e)
{
    struct stored *s = stored_of(e);
    const size_t cost = e->size + CACHE_ENTRY_OVERHEAD;
    if (cost > c->count.cap || spot_find(c, SPOT_CANONICAL, &e->key))
        return;
    while (c->oldest && c->count.bytes + cost > c->count.cap) {
        evict(c, c->oldest);
        c->count.evictions++;
    }
    if (c->count.bytes + cost > c->count.cap)
        return;
    entry_ref(e);
    e->stored = true;
    s->cost = cost;
    spot_add(c, &s->canonical, SPOT_CANONICAL, &e->key, s);
    order_add(c, s);
    c->count.bytes += cost;
    c->count.entries++;
}

entry *cache_find(cache *c, cache_level level, const cache_key *key)
{
    entry *found = NULL;
    pthread_mutex_lock(&c->lock);
    spot *l = spot_find(c, level == CACHE_RAW ? SPOT_RAW : SPOT_CANONICAL, key);
    if (l) {
        found = entry_ref(&touch(c, l)->entry);
        c->count.hits++;
    }
    pthread_mutex_unlock(&c->lock);
    return found;
}

void cache_key_of_body(const cache *c, const void *owner, const char *body, size_t size,
                       cache_key *key)
{
    const uint64_t rest[2] = {(uintptr_t)owner, size};
    static_assert(sizeof rest + crypto_shorthash_siphashx24_BYTES == sizeof key->bytes,
                  "the hash and what else tells bodies apart fill a key");
    crypto_shorthash_siphashx24(key->bytes, (const unsigned char *)body, size, c->secret);
    memcpy(key->bytes + crypto_shorthash_siphashx24_BYTES, rest, sizeof rest);
}

/* ---- single flight ---- */

static void wait_for(flight *f, waiter *w)
{
    w->next = f->waiters;
    w->flight = f;
    f->waiters = w;
}

static flight *take_off(cache *c, const cache_key *key)
{
    flight *f = calloc(1, sizeof *f);
    if (!f)
        return NULL;
    spot_add(c, &f->spot, SPOT_FLIGHT, key, f);
    c->count.misses++;
    c->count.flights++;
    return f;
}

cache_turn cache_enter(cache *c, const cache_key *key, waiter *w, entry **hit, flight **lead)
{
    cache_turn turn;
    pthread_mutex_lock(&c->lock);
    spot *stored = spot_find(c, SPOT_CANONICAL, key);
    spot *flying = stored ? NULL : spot_find(c, SPOT_FLIGHT, key);
    if (flying && atomic_load(&((flight *)flying->owner)->cancel)) {
        /* Its answer will be that it was given up: begin again beside it. */
        spot_remove(c, flying);
        flying = NULL;
    }
    if (stored) {
        struct stored *s = touch(c, stored);
        recognise(c, s, &w->raw);
        *hit = entry_ref(&s->entry);
        c->count.hits++;
        turn = TURN_HIT;
    } else if (flying) {
        wait_for(flying->owner, w);
        c->count.joins++;
        turn = TURN_JOIN;
    } else if ((*lead = take_off(c, key))) {
        wait_for(*lead, w);
        turn = TURN_LEAD;
    } else {
        turn = TURN_NONE;
    }
    pthread_mutex_unlock(&c->lock);
    return turn;
}

const _Atomic bool *flight_cancel(const flight *f)
{
    return &f->cancel;
}

void cache_tell(cache *c, flight *f, const progress *so_far)
{
    pthread_mutex_lock(&c->lock);
    for (waiter *w = f->waiters; w; w = w->next)
        if (w->hear)
            w->hear(w, so_far);
    pthread_mutex_unlock(&c->lock);
}

void cache_land(cache *c, flight *f, entry *outcome)
{
    pthread_mutex_lock(&c->lock);
    spot_remove(c, &f->spot);
    c->count.flights--;
    if (outcome && outcome->status == 200) {
        if (!outcome->transient)
            store(c, outcome);
        c->count.solves += !outcome->shared;
    }
    spot *l = outcome ? spot_find(c, SPOT_CANONICAL, &outcome->key) : NULL;
    for (waiter *w = f->waiters; w; w = w->next) {
        if (l)
            recognise(c, l->owner, &w->raw);
        w->flight = NULL;
    }
    pthread_mutex_unlock(&c->lock);
    for (waiter *w = f->waiters, *next; w; w = next) {
        next = w->next; /* a woken waiter may be gone at once */
        w->wake(w, entry_ref(outcome));
    }
    free(f);
}

bool cache_abandon(cache *c, waiter *w)
{
    pthread_mutex_lock(&c->lock);
    flight *f = w->flight;
    if (f) {
        waiter **place = &f->waiters;
        while (*place != w)
            place = &(*place)->next;
        *place = w->next;
        w->flight = NULL;
        if (!f->waiters) {
            atomic_store(&f->cancel, true);
            c->count.cancels++;
        }
    }
    pthread_mutex_unlock(&c->lock);
    return f != NULL;
}

/* ---- the whole ---- */

cache *cache_new(size_t cap)
{
    cache *c = calloc(1, sizeof *c);
    unsigned bits = 4;
    /* A bucket for every entry of a usual size, or so. */
    while (bits < 24 && ((size_t)CACHE_ENTRY_OVERHEAD << bits) < cap)
        bits++;
    spot **buckets = calloc((size_t)1 << bits, sizeof *buckets);
    if (!c || !buckets || pthread_mutex_init(&c->lock, NULL) != 0) {
        free(buckets);
        free(c);
        return NULL;
    }
    c->buckets = buckets;
    c->shift = 64 - bits;
    randombytes_buf(&c->spread, sizeof c->spread);
    randombytes_buf(c->secret, sizeof c->secret);
    c->spread |= 1;
    c->count.cap = cap;
    c->count.bytes = sizeof *c + (sizeof *buckets << bits);
    return c;
}

void cache_free(cache *c)
{
    if (!c)
        return;
    while (c->oldest)
        evict(c, c->oldest);
    pthread_mutex_destroy(&c->lock);
    free(c->buckets);
    free(c);
}

cache_counters cache_count(cache *c)
{
    pthread_mutex_lock(&c->lock);
    const cache_counters count = c->count;
    pthread_mutex_unlock(&c->lock);
    return count;
}
