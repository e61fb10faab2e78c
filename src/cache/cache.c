/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cache/cache.h"

#include <pthread.h>
#include <assert.h>
#include <sodium/crypto_shorthash_siphash24.h>
#include <sodium/randombytes.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "cache/frequency.h"
#include "cache/slot.h"

struct flight {
    slot slot;
    waiter *waiters;
    _Atomic bool cancel;
    bool begun;
    /* While `cancel` is set: */
    int64_t abandoned_ms;
    struct flight *before, *after; /* in the order in which they were abandoned */
};

/* Entries by their use. */
typedef struct order {
    struct cached *newest, *oldest;
    size_t bytes;
} order;

struct cache {
    /* One lock: what it guards takes about 0.1 us. */
    pthread_mutex_t lock;
    slot **buckets;
    unsigned shift;  /* 64 - log2(number of buckets) */
    uint64_t spread; /* odd and secret: nobody can choose bodies that share a bucket */
    unsigned char secret[crypto_shorthash_siphashx24_KEYBYTES]; /* of cache_key_of_body */
    order window, kept;
    size_t window_cap, kept_cap;
    frequency frequency; /* of public keys */
    flight *abandoned_first, *abandoned_last;
    cache_counters count;
    atomic_size_t body_bytes;
};

/* ---- the table ---- */

static slot **bucket_of(cache *c, const cache_key *key)
{
    uint64_t first;
    memcpy(&first, key->bytes, sizeof first);
    return &c->buckets[first * c->spread >> c->shift];
}

static slot *slot_find(cache *c, slot_kind kind, const cache_key *key)
{
    for (slot *l = *bucket_of(c, key); l; l = l->next)
        if (l->kind == kind && memcmp(&l->key, key, sizeof *key) == 0)
            return l;
    return NULL;
}

static void slot_add(cache *c, slot *l, slot_kind kind, const cache_key *key, void *owner)
{
    slot **bucket = bucket_of(c, key);
    *l = (slot){.next = *bucket, .key = *key, .kind = kind, .owner = owner};
    *bucket = l;
}

static void slot_remove(cache *c, slot *l)
{
    if (l->kind == SLOT_NONE)
        return;
    slot **place = bucket_of(c, &l->key);
    while (*place != l)
        place = &(*place)->next;
    *place = l->next;
    l->kind = SLOT_NONE;
}

/* ---- order of use ---- */

static void order_remove(struct cached *s)
{
    order *o = s->in;
    *(s->newer ? &s->newer->older : &o->newest) = s->older;
    *(s->older ? &s->older->newer : &o->oldest) = s->newer;
    o->bytes -= s->cost;
    s->in = NULL;
}

static void order_add(order *o, struct cached *s)
{
    s->in = o;
    s->newer = NULL;
    s->older = o->newest;
    *(o->newest ? &o->newest->newer : &o->oldest) = s;
    o->newest = s;
    o->bytes += s->cost;
}

/* A key was asked for. */
static void note(cache *c, const cache_key *key)
{
    const size_t least = 1024;
    frequency_note(&c->frequency, key,
                   8 * (c->count.entries > least ? c->count.entries : least));
}

static struct cached *touch(cache *c, slot *l)
{
    struct cached *s = l->owner;
    note(c, &s->entry.key);
    if (s->in->newest != s) {
        order *o = s->in;
        order_remove(s);
        order_add(o, s);
    }
    return s;
}

/* ---- storing ---- */

static void recognise(cache *c, struct cached *s, const cache_key *raw)
{
    if (slot_find(c, SLOT_RAW, raw))
        return;
    slot *l = &s->raw[s->raw_next++ % RAW_SLOTS];
    slot_remove(c, l);
    slot_add(c, l, SLOT_RAW, raw, s);
}

/* Takes the entry out; its last user frees it. */
static void evict(cache *c, struct cached *s)
{
    slot_remove(c, &s->canonical);
    for (size_t i = 0; i < RAW_SLOTS; i++)
        slot_remove(c, &s->raw[i]);
    order_remove(s);
    c->count.bytes -= s->cost;
    c->count.entries--;
    atomic_fetch_sub_explicit(&c->body_bytes, s->entry.size, memory_order_relaxed);
    entry_unref(&s->entry);
}

static void drive_out(cache *c, struct cached *s)
{
    evict(c, s);
    c->count.evictions++;
}

/* Whether all that would have to go for `s` was asked for less often. */
static bool deserves_room(const cache *c, const struct cached *s)
{
    const unsigned often = frequency_of(&c->frequency, &s->entry.key);
    size_t left = c->kept.bytes;
    for (const struct cached *v = c->kept.oldest; v && left + s->cost > c->kept_cap;
         v = v->newer) {
        if (frequency_of(&c->frequency, &v->entry.key) >= often)
            return false;
        left -= v->cost;
    }
    return left + s->cost <= c->kept_cap;
}

/* Moves what the window has too much to the others, or out. */
static void settle(cache *c)
{
    while (c->window.oldest && c->window.bytes > c->window_cap) {
        struct cached *s = c->window.oldest;
        if (!deserves_room(c, s)) {
            drive_out(c, s);
            continue;
        }
        order_remove(s);
        while (c->kept.bytes + s->cost > c->kept_cap)
            drive_out(c, c->kept.oldest);
        order_add(&c->kept, s);
    }
    /* What was kept has grown. */
    while (c->kept.bytes > c->kept_cap)
        drive_out(c, c->kept.oldest);
}

static void store(cache *c, entry *e)
{
    struct cached *s = cached_of(e);
    const size_t cost = e->size + CACHE_ENTRY_OVERHEAD;
    if (cost > c->kept_cap || slot_find(c, SLOT_CANONICAL, &e->key))
        return;
    entry_ref(e);
    s->cost = cost;
    slot_add(c, &s->canonical, SLOT_CANONICAL, &e->key, s);
    order_add(&c->window, s);
    c->count.bytes += cost;
    c->count.entries++;
    atomic_fetch_add_explicit(&c->body_bytes, e->size, memory_order_relaxed);
    settle(c);
    e->stored = s->in != NULL;
}

void cache_count_prebuilt(cache *c, entry *e)
{
    struct cached *s = cached_of(e);
    pthread_mutex_lock(&c->lock);
    if (s->in) {
        s->cost += CACHE_PREBUILT_OVERHEAD;
        s->in->bytes += CACHE_PREBUILT_OVERHEAD;
        c->count.bytes += CACHE_PREBUILT_OVERHEAD;
        settle(c);
    }
    pthread_mutex_unlock(&c->lock);
}

entry *cache_find(cache *c, cache_level level, const cache_key *key)
{
    entry *found = NULL;
    pthread_mutex_lock(&c->lock);
    slot *l = slot_find(c, level == CACHE_RAW ? SLOT_RAW : SLOT_CANONICAL, key);
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

static void abandon(cache *c, flight *f)
{
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC_COARSE, &now);
    f->abandoned_ms = (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
    f->before = c->abandoned_last;
    *(f->before ? &f->before->after : &c->abandoned_first) = f;
    c->abandoned_last = f;
    c->count.abandoned++;
    c->count.cancels++;
    atomic_store(&f->cancel, true);
}

/* An abandoned flight has ended, or somebody waits for it again. */
static void forget(cache *c, flight *f)
{
    *(f->before ? &f->before->after : &c->abandoned_first) = f->after;
    *(f->after ? &f->after->before : &c->abandoned_last) = f->before;
    c->count.abandoned--;
}

static flight *take_off(cache *c, const cache_key *key)
{
    flight *f = calloc(1, sizeof *f);
    if (!f)
        return NULL;
    slot_add(c, &f->slot, SLOT_FLIGHT, key, f);
    c->count.misses++;
    c->count.flights++;
    return f;
}

cache_role cache_acquire(cache *c, const cache_key *key, waiter *w, entry **hit, flight **lead)
{
    cache_role turn;
    pthread_mutex_lock(&c->lock);
    slot *stored = slot_find(c, SLOT_CANONICAL, key);
    slot *flying = stored ? NULL : slot_find(c, SLOT_FLIGHT, key);
    if (stored) {
        struct cached *s = touch(c, stored);
        recognise(c, s, &w->raw);
        *hit = entry_ref(&s->entry);
        c->count.hits++;
        turn = ROLE_HIT;
    } else if (flying) {
        flight *f = flying->owner;
        /* Somebody waits again. If the solve has seen the flag, cache_complete says so. */
        if (atomic_load(&f->cancel)) {
            forget(c, f);
            atomic_store(&f->cancel, false);
        }
        wait_for(f, w);
        c->count.joins++;
        turn = ROLE_FOLLOWER;
    } else if ((*lead = take_off(c, key))) {
        note(c, key);
        wait_for(*lead, w);
        turn = ROLE_LEADER;
    } else {
        turn = ROLE_NONE;
    }
    pthread_mutex_unlock(&c->lock);
    return turn;
}

const _Atomic bool *flight_cancel(const flight *f)
{
    return &f->cancel;
}

void cache_begin(cache *c, flight *f)
{
    pthread_mutex_lock(&c->lock);
    f->begun = true;
    pthread_mutex_unlock(&c->lock);
}

bool cache_is_queued(cache *c, const waiter *w)
{
    pthread_mutex_lock(&c->lock);
    const bool queued = w->flight && !w->flight->begun;
    pthread_mutex_unlock(&c->lock);
    return queued;
}

void cache_publish_progress(cache *c, flight *f, const progress *so_far)
{
    pthread_mutex_lock(&c->lock);
    for (waiter *w = f->waiters; w; w = w->next)
        if (w->on_progress)
            w->on_progress(w, so_far);
    pthread_mutex_unlock(&c->lock);
}

bool cache_complete(cache *c, flight *f, entry *outcome)
{
    pthread_mutex_lock(&c->lock);
    if (outcome && outcome->given_up && f->waiters) {
        pthread_mutex_unlock(&c->lock);
        return false;
    }
    slot_remove(c, &f->slot);
    c->count.flights--;
    if (atomic_load(&f->cancel))
        forget(c, f);
    if (outcome && outcome->status == 200) {
        if (!outcome->transient)
            store(c, outcome);
        c->count.solves += !outcome->from_store;
    }
    slot *l = outcome ? slot_find(c, SLOT_CANONICAL, &outcome->key) : NULL;
    for (waiter *w = f->waiters; w; w = w->next) {
        if (l)
            recognise(c, l->owner, &w->raw);
        w->flight = NULL;
    }
    pthread_mutex_unlock(&c->lock);
    for (waiter *w = f->waiters, *next; w; w = next) {
        next = w->next; /* a woken waiter may be gone at once */
        w->on_done(w, entry_ref(outcome));
    }
    free(f);
    return true;
}

bool cache_release(cache *c, waiter *w)
{
    pthread_mutex_lock(&c->lock);
    flight *f = w->flight;
    if (f) {
        waiter **place = &f->waiters;
        while (*place != w)
            place = &(*place)->next;
        *place = w->next;
        w->flight = NULL;
        if (!f->waiters)
            abandon(c, f);
    }
    pthread_mutex_unlock(&c->lock);
    return f != NULL;
}

/* ---- the whole ---- */

/* Bytes of an entry, and counters of its use that go with each. */
#define USUAL_COST         2048
#define COUNTERS_EACH_LOG2 4

cache *cache_new(size_t cap)
{
    cache *c = calloc(1, sizeof *c);
    unsigned bits = 4;
    /* A bucket for every entry of a usual size, or so. */
    while (bits < 24 && ((size_t)USUAL_COST << bits) < cap)
        bits++;
    slot **buckets = calloc((size_t)1 << bits, sizeof *buckets);
    if (!c || !buckets || !frequency_init(&c->frequency, bits + COUNTERS_EACH_LOG2) ||
        pthread_mutex_init(&c->lock, NULL) != 0) {
        if (c)
            frequency_free(&c->frequency);
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
    c->count.bytes = sizeof *c + (sizeof *buckets << bits) + ((size_t)1 << (bits + COUNTERS_EACH_LOG2));
    const size_t room = cap > c->count.bytes ? cap - c->count.bytes : 0;
    c->window_cap = room / 8;
    c->kept_cap = room - c->window_cap;
    return c;
}

void cache_free(cache *c)
{
    if (!c)
        return;
    while (c->window.oldest)
        evict(c, c->window.oldest);
    while (c->kept.oldest)
        evict(c, c->kept.oldest);
    pthread_mutex_destroy(&c->lock);
    frequency_free(&c->frequency);
    free(c->buckets);
    free(c);
}

size_t cache_body_bytes(const cache *c)
{
    return atomic_load_explicit(&c->body_bytes, memory_order_relaxed);
}

cache_counters cache_count(cache *c)
{
    pthread_mutex_lock(&c->lock);
    cache_counters count = c->count;
    count.abandoned_since_ms = c->abandoned_first ? c->abandoned_first->abandoned_ms : 0;
    pthread_mutex_unlock(&c->lock);
    return count;
}
