/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stored answers: who is kept and who goes; and single flight. */
#include <malloc.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cache/slot.h"
#include "http/api/reply.h"

#include "check.h"

/* ---- allocations that fail: the linker leads them here (meson.build) ---- */

static _Atomic long allocations_left = -1; /* -1: all succeed */

static bool refuse_memory(void)
{
    if (allocations_left < 0)
        return false;
    return allocations_left == 0 || allocations_left-- == 0;
}

#include "failing_memory.h"

/* ---- helpers ---- */

static cache_key key_number(uint64_t number)
{
    cache_key key;
    assert_true(key_of_parts(&(key_part){&number, sizeof number}, 1, &key));
    return key;
}

static entry *entry_of_size(const cache_key *key, int status, size_t size)
{
    strbuf body = {0};
    char *fill = malloc(size);
    assert_non_null(fill);
    memset(fill, 'x', size);
    strbuf_add(&body, fill, size);
    free(fill);
    entry *e = entry_new(key, status, &body);
    assert_non_null(e);
    return e;
}

/* One who waits, and what came. */
typedef struct listener {
    waiter waiter;
    atomic_int woken;
    entry *came;
} listener;

static void note(waiter *w, entry *outcome)
{
    listener *l = (listener *)(void *)w;
    l->came = outcome;
    atomic_fetch_add(&l->woken, 1);
}

static listener listener_new(uint64_t raw)
{
    return (listener){.waiter = {.raw = key_number(raw), .on_done = note}};
}

/* Asks for key `number` with a body of its own, as http does, and solves a miss at once. */
static bool ask(cache *c, uint64_t number, size_t size)
{
    const cache_key key = key_number(number);
    listener l = listener_new(number + 1000000);
    entry *hit = NULL;
    flight *lead = NULL;
    const cache_role turn = cache_acquire(c, &key, &l.waiter, &hit, &lead);
    if (turn == ROLE_HIT) {
        assert_int_equal(hit->size, size);
        entry_unref(hit);
        return true;
    }
    assert_int_equal(turn, ROLE_LEADER);
    entry *e = entry_of_size(&key, 200, size);
    cache_complete(c, lead, e);
    assert_int_equal(l.woken, 1);
    assert_ptr_equal(l.came, e);
    entry_unref(l.came);
    entry_unref(e);
    return false;
}

static bool holds(cache *c, uint64_t number)
{
    const cache_key key = key_number(number);
    entry *e = cache_find(c, CACHE_CANONICAL, &key);
    entry_unref(e);
    return e != NULL;
}

/* ---- keys ---- */

static void keys_are_sha_256(void **state)
{
    (void)state;
    /* A part is preceded by its length in 8 bytes: printf '\3\0\0\0\0\0\0\0abc' | sha256sum */
    cache_key key;
    char hex[KEY_HEX_SIZE];
    assert_true(key_of_parts(&(key_part){"abc", 3}, 1, &key));
    key_hex(&key, hex);
    assert_string_equal(hex,
                        "ce91dc5eec0139adf091900d225971d6ad246a845bad791b5693a9d0d55dd391");
    cache_key back;
    assert_true(key_parse(hex, &back));
    assert_memory_equal(&key, &back, sizeof key);
}

static void parts_do_not_run_together(void **state)
{
    (void)state;
    cache_key a, b;
    assert_true(key_of_parts((const key_part[]){{"ab", 2}, {"c", 1}}, 2, &a));
    assert_true(key_of_parts((const key_part[]){{"a", 1}, {"bc", 2}}, 2, &b));
    assert_memory_not_equal(&a, &b, sizeof a);
}

static void malformed_keys_are_refused(void **state)
{
    (void)state;
    cache_key key;
    char hex[KEY_HEX_SIZE + 1];
    memset(hex, 'a', sizeof hex);
    hex[64] = '\0';
    assert_true(key_parse(hex, &key));
    hex[10] = 'A';
    assert_false(key_parse(hex, &key));
    hex[10] = 'g';
    assert_false(key_parse(hex, &key));
    hex[10] = 'a';
    hex[63] = '\0';
    assert_false(key_parse(hex, &key));
    memset(hex, 'a', sizeof hex);
    hex[65] = '\0';
    assert_false(key_parse(hex, &key));
    assert_false(key_parse("", &key));
}

/* ---- who goes ---- */

/* A cache with room for so many entries of 1,000 bytes, an eighth of them in the window. */
static cache *cache_of(size_t entries)
{
    const size_t cost = 1000 + CACHE_ENTRY_OVERHEAD;
    cache *c = cache_new(entries * cost);
    assert_non_null(c);
    const size_t tables = cache_count(c).bytes;
    cache_free(c);
    c = cache_new(entries * cost + tables);
    assert_non_null(c);
    return c;
}

static void all_are_kept_while_there_is_room(void **state)
{
    (void)state;
    cache *c = cache_of(80);
    for (uint64_t i = 1; i <= 80; i++)
        assert_false(ask(c, i, 1000));
    for (uint64_t i = 1; i <= 80; i++)
        assert_true(ask(c, i, 1000));
    assert_int_equal(cache_count(c).evictions, 0);
    cache_free(c);
}

static void what_was_just_asked_can_be_asked_again(void **state)
{
    (void)state;
    cache *c = cache_of(80);
    for (uint64_t i = 1; i <= 1000; i++)
        assert_false(ask(c, i, 1000));
    for (uint64_t i = 991; i <= 1000; i++)
        assert_true(holds(c, i));
    cache_free(c);
}

/* A batch twice as large as the cache, again and again: with the least recently used first out, all
 * would be gone each time. */
static void a_part_of_a_large_batch_is_there_the_next_time(void **state)
{
    (void)state;
    cache *c = cache_of(800);
    int hits = 0;
    for (int round = 0; round < 6; round++) {
        hits = 0;
        for (uint64_t i = 1; i <= 1600; i++)
            hits += ask(c, i, 1000);
    }
    assert_in_range(hits, 560, 800);
    assert_true(cache_count(c).bytes <= cache_count(c).cap);
    cache_free(c);
}

static void a_scan_drives_out_nothing_that_is_asked_for(void **state)
{
    (void)state;
    cache *c = cache_of(800);
    for (int round = 0; round < 3; round++)
        for (uint64_t i = 1; i <= 200; i++)
            ask(c, i, 1000);
    for (uint64_t i = 1000; i <= 6000; i++)
        assert_false(ask(c, i, 1000));
    int hits = 0;
    for (uint64_t i = 1; i <= 200; i++)
        hits += ask(c, i, 1000);
    assert_in_range(hits, 190, 200); /* counters that other keys share may mistake a few */
    cache_free(c);
}

/* Those of yesterday go when others are asked for as often. */
static void a_new_working_set_takes_over(void **state)
{
    (void)state;
    cache *c = cache_of(800);
    for (int round = 0; round < 15; round++)
        for (uint64_t i = 1; i <= 800; i++)
            ask(c, i, 1000);
    int hits = 0;
    for (int round = 0; round < 60; round++) {
        hits = 0;
        for (uint64_t i = 2001; i <= 2600; i++)
            hits += ask(c, i, 1000);
    }
    assert_in_range(hits, 590, 600);
    cache_free(c);
}

static void what_is_larger_than_the_cache_is_answered_and_not_kept(void **state)
{
    (void)state;
    cache *c = cache_new(100000);
    ask(c, 1, 1000);
    assert_false(ask(c, 2, 100000));
    assert_false(ask(c, 2, 100000));
    assert_true(holds(c, 1)); /* it drove nothing out */
    assert_int_equal(cache_count(c).evictions, 0);
    cache_free(c);
    c = cache_new(0);
    assert_false(ask(c, 1, 10));
    assert_false(ask(c, 1, 10));
    assert_int_equal(cache_count(c).entries, 0);
    cache_free(c);
}

static uint64_t random_next(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return *state >> 33;
}

/* What is counted is what is held, whoever was driven out. */
static void the_count_follows_random_use(void **state)
{
    (void)state;
    enum { NUMBERS = 100 };
    uint64_t random = 2026;
    for (int round = 0; round < 20; round++) {
        cache *c = cache_new(20000 + random_next(&random) % 200000);
        assert_non_null(c);
        const size_t tables = cache_count(c).bytes;
        for (int i = 0; i < 2000; i++) {
            const uint64_t number = random_next(&random) % NUMBERS;
            /* The size is a function of the key, as an answer is of its question. */
            ask(c, number, (size_t)(number * number % 97) * 100 + 1);
            assert_true(cache_count(c).bytes <= cache_count(c).cap);
        }
        size_t bytes = tables, entries = 0;
        for (uint64_t number = 0; number < NUMBERS; number++)
            if (holds(c, number)) {
                bytes += (size_t)(number * number % 97) * 100 + 1 + CACHE_ENTRY_OVERHEAD;
                entries++;
            }
        assert_int_equal(cache_count(c).bytes, bytes);
        assert_int_equal(cache_count(c).entries, entries);
        cache_free(c);
    }
}

/* ---- both levels ---- */

static void an_answer_is_found_by_the_bytes_of_its_last_bodies(void **state)
{
    (void)state;
    cache *c = cache_new(1000000);
    const cache_key key = key_number(1);
    for (uint64_t spelling = 0; spelling <= RAW_SLOTS; spelling++) {
        listener l = listener_new(100 + spelling);
        entry *hit = NULL, *by_raw = NULL;
        flight *lead = NULL;
        assert_null(cache_find(c, CACHE_RAW, &l.waiter.raw));
        if (cache_acquire(c, &key, &l.waiter, &hit, &lead) == ROLE_LEADER) {
            assert_int_equal(spelling, 0);
            hit = entry_of_size(&key, 200, 10);
            cache_complete(c, lead, hit);
            entry_unref(l.came);
        }
        by_raw = cache_find(c, CACHE_RAW, &l.waiter.raw);
        assert_ptr_equal(by_raw, hit);
        entry_unref(by_raw);
        entry_unref(hit);
    }
    /* One more than fits: the first spelling was forgotten, the answer was not. */
    const cache_key first = key_number(100);
    assert_null(cache_find(c, CACHE_RAW, &first));
    assert_true(holds(c, 1));
    /* A raw key is no public key. */
    const cache_key last = key_number(100 + RAW_SLOTS);
    assert_null(cache_find(c, CACHE_CANONICAL, &last));
    assert_int_equal(cache_count(c).entries, 1);
    cache_free(c);
}

static void a_body_has_a_key_of_its_own(void **state)
{
    (void)state;
    cache *c = cache_new(1000000), *other = cache_new(1000000);
    const int owners[2] = {0};
    cache_key keys[6];
    cache_key_of_body(c, &owners[0], "abc", 3, &keys[0]);
    cache_key_of_body(c, &owners[1], "abc", 3, &keys[1]);
    cache_key_of_body(c, &owners[0], "abd", 3, &keys[2]);
    cache_key_of_body(c, &owners[0], "abc", 2, &keys[3]);
    cache_key_of_body(c, NULL, NULL, 0, &keys[4]);
    /* another cache has another secret: what collides in one is nothing to the other */
    cache_key_of_body(other, &owners[0], "abc", 3, &keys[5]);
    for (size_t i = 0; i < 6; i++)
        for (size_t j = 0; j < i; j++)
            assert_memory_not_equal(&keys[i], &keys[j], sizeof keys[i]);
    cache_key again;
    cache_key_of_body(c, &owners[0], "abcd", 3, &again);
    assert_memory_equal(&again, &keys[0], sizeof again);
    cache_free(c);
    cache_free(other);
}

/* ---- single flight ---- */

static void refusals_reach_all_and_are_not_kept(void **state)
{
    (void)state;
    cache *c = cache_new(1000000);
    const cache_key key = key_number(7);
    listener first = listener_new(1), second = listener_new(2);
    entry *hit = NULL;
    flight *lead = NULL, *none = NULL;
    assert_int_equal(cache_acquire(c, &key, &first.waiter, &hit, &lead), ROLE_LEADER);
    assert_int_equal(cache_acquire(c, &key, &second.waiter, &hit, &none), ROLE_FOLLOWER);
    entry *refusal = entry_of_size(&key, 422, 50);
    cache_complete(c, lead, refusal);
    assert_ptr_equal(first.came, refusal);
    assert_ptr_equal(second.came, refusal);
    entry_unref(first.came);
    entry_unref(second.came);
    entry_unref(refusal);
    assert_false(holds(c, 7));
    assert_null(cache_find(c, CACHE_RAW, &first.waiter.raw));
    cache_free(c);
}

static void without_memory_all_are_woken_with_nothing(void **state)
{
    (void)state;
    cache *c = cache_new(1000000);
    const cache_key key = key_number(7);
    listener first = listener_new(1), second = listener_new(2);
    entry *hit = NULL;
    flight *lead = NULL, *none = NULL;
    cache_acquire(c, &key, &first.waiter, &hit, &lead);
    cache_acquire(c, &key, &second.waiter, &hit, &none);
    cache_complete(c, lead, NULL);
    assert_int_equal(first.woken, 1);
    assert_int_equal(second.woken, 1);
    assert_null(first.came);
    assert_null(second.came);
    cache_free(c);
}

static void the_last_to_give_up_cancels(void **state)
{
    (void)state;
    cache *c = cache_new(1000000);
    const cache_key key = key_number(7);
    listener first = listener_new(1), second = listener_new(2), third = listener_new(3);
    entry *hit = NULL;
    flight *lead = NULL, *again = NULL;
    assert_int_equal(cache_acquire(c, &key, &first.waiter, &hit, &lead), ROLE_LEADER);
    assert_int_equal(cache_acquire(c, &key, &second.waiter, &hit, &again), ROLE_FOLLOWER);
    assert_true(cache_release(c, &first.waiter));
    assert_false(*flight_cancel(lead));
    assert_true(cache_release(c, &second.waiter));
    assert_true(*flight_cancel(lead));
    assert_false(cache_release(c, &second.waiter)); /* already */
    assert_int_equal(cache_count(c).abandoned, 1);
    /* Who asks again joins it, and it is given up no more. */
    assert_int_equal(cache_acquire(c, &key, &third.waiter, &hit, &again), ROLE_FOLLOWER);
    assert_false(*flight_cancel(lead));
    assert_int_equal(cache_count(c).abandoned, 0);
    /* The solve had seen the flag by then: it has to be made anew, and only then is it told. */
    entry *late = entry_of_size(&key, 503, 10), *good = entry_of_size(&key, 200, 10);
    late->given_up = true;
    assert_false(cache_complete(c, lead, late));
    assert_int_equal(first.woken + second.woken + third.woken, 0);
    assert_true(cache_complete(c, lead, good));
    assert_int_equal(first.woken + second.woken, 0);
    assert_int_equal(third.woken, 1);
    assert_ptr_equal(third.came, good);
    assert_false(cache_release(c, &third.waiter));
    entry_unref(third.came);
    entry_unref(late);
    entry_unref(good);
    assert_true(holds(c, 7));
    cache_free(c);
}

static void transient_answers_reach_all_and_are_not_kept(void **state)
{
    (void)state;
    cache *c = cache_new(100000);
    const cache_key key = key_number(7);
    listener first = listener_new(1), second = listener_new(2);
    entry *hit = NULL;
    flight *lead = NULL;
    assert_int_equal(cache_acquire(c, &key, &first.waiter, &hit, &lead), ROLE_LEADER);
    assert_int_equal(cache_acquire(c, &key, &second.waiter, &hit, &lead), ROLE_FOLLOWER);
    entry *e = entry_of_size(&key, 200, 10);
    e->transient = true;
    cache_complete(c, lead, e);
    assert_ptr_equal(first.came, e);
    assert_ptr_equal(second.came, e);
    assert_false(e->stored);
    assert_false(holds(c, 7));
    assert_int_equal(cache_count(c).solves, 1);
    entry_unref(first.came);
    entry_unref(second.came);
    entry_unref(e);
    cache_free(c);
}

typedef struct crowd {
    cache *cache;
    pthread_barrier_t start;
    atomic_int leads, joins, hits;
} crowd;

static void *one_of_the_crowd(void *argument)
{
    crowd *all = argument;
    for (uint64_t round = 0; round < 200; round++) {
        const cache_key key = key_number(round);
        listener l = listener_new(round);
        entry *hit = NULL;
        flight *lead = NULL;
        pthread_barrier_wait(&all->start);
        switch (cache_acquire(all->cache, &key, &l.waiter, &hit, &lead)) {
        case ROLE_LEADER: {
            atomic_fetch_add(&all->leads, 1);
            entry *e = entry_of_size(&key, 200, 100);
            cache_complete(all->cache, lead, e);
            entry_unref(e);
            break;
        }
        case ROLE_FOLLOWER:
            atomic_fetch_add(&all->joins, 1);
            while (!atomic_load(&l.woken))
                sched_yield();
            break;
        default:
            atomic_fetch_add(&all->hits, 1);
            l.came = hit;
        }
        entry_unref(l.came);
        /* Nobody asks for the next before all have the answer to this one. */
        pthread_barrier_wait(&all->start);
    }
    return NULL;
}

static void equal_requests_of_many_threads_are_solved_once(void **state)
{
    (void)state;
    enum { THREADS = 8, ROUNDS = 200 };
    crowd all = {.cache = cache_new(50000)}; /* too small for all rounds: it evicts meanwhile */
    pthread_t threads[THREADS];
    pthread_barrier_init(&all.start, NULL, THREADS);
    for (int i = 0; i < THREADS; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, one_of_the_crowd, &all), 0);
    for (int i = 0; i < THREADS; i++)
        pthread_join(threads[i], NULL);
    assert_int_equal(all.leads, ROUNDS);
    assert_int_equal(all.leads + all.joins + all.hits, THREADS * ROUNDS);
    const cache_counters count = cache_count(all.cache);
    assert_int_equal(count.solves, ROUNDS);
    assert_int_equal(count.flights, 0);
    assert_true(count.bytes <= count.cap);
    pthread_barrier_destroy(&all.start);
    cache_free(all.cache);
}

/* ---- memory ---- */

static void every_allocation_may_fail(void **state)
{
    (void)state;
    const cache_key key = key_number(1);
    bool all_done = false;
    for (long n = 0; !all_done; n++) {
        assert_true(n < 100);
        strbuf body = {0};
        strbuf_add_string(&body, "an answer");
        listener l = listener_new(2);
        entry *hit = NULL;
        flight *lead = NULL;
        allocations_left = n;
        cache *c = cache_new(100000);
        entry *e = entry_new(&key, 200, &body);
        if (c && e && cache_acquire(c, &key, &l.waiter, &hit, &lead) == ROLE_LEADER) {
            cache_complete(c, lead, e);
            assert_ptr_equal(l.came, e);
            all_done = allocations_left > 0;
        }
        allocations_left = -1;
        assert_null(body.data); /* taken or freed */
        entry_unref(l.came);
        entry_unref(e);
        cache_free(c);
    }
}

/* The bytes that are counted are at least those that are taken, prebuilt included. Sanitizers'
 * allocators do not say. */
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
static void no_more_memory_is_taken_than_is_counted(void **state)
{
    (void)state;
    char origins[] = "https://example.org";
    const settings set = {.cors_origins = origins};
    const size_t before = mallinfo2().uordblks;
    cache *c = cache_new(8 << 20);
    const service s = {.settings = &set, .cache = c};
    for (uint64_t i = 0; i < 5000; i++) {
        const cache_key key = key_number(i);
        listener l = listener_new(i);
        entry *hit = NULL;
        flight *lead = NULL;
        assert_int_equal(cache_acquire(c, &key, &l.waiter, &hit, &lead), ROLE_LEADER);
        entry *e = entry_of_size(&key, 200, (size_t)(i % 40) * 100 + 1);
        cache_complete(c, lead, e);
        for (int address = 0; address < ENTRY_PREBUILT; address++)
            if (i % 3 > (uint64_t)address) /* none, one or all */
                assert_non_null(reply_prebuilt(&s, e, address));
        entry_unref(l.came);
        entry_unref(e);
        const size_t taken = mallinfo2().uordblks - before;
        assert_true(taken <= cache_count(c).bytes);
        assert_true(cache_count(c).bytes <= 8 << 20);
    }
    assert_true(cache_count(c).evictions > 0);
    cache_free(c);
}
#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keys_are_sha_256),
        cmocka_unit_test(parts_do_not_run_together),
        cmocka_unit_test(malformed_keys_are_refused),
        cmocka_unit_test(all_are_kept_while_there_is_room),
        cmocka_unit_test(what_was_just_asked_can_be_asked_again),
        cmocka_unit_test(a_part_of_a_large_batch_is_there_the_next_time),
        cmocka_unit_test(a_scan_drives_out_nothing_that_is_asked_for),
        cmocka_unit_test(a_new_working_set_takes_over),
        cmocka_unit_test(what_is_larger_than_the_cache_is_answered_and_not_kept),
        cmocka_unit_test(the_count_follows_random_use),
        cmocka_unit_test(an_answer_is_found_by_the_bytes_of_its_last_bodies),
        cmocka_unit_test(a_body_has_a_key_of_its_own),
        cmocka_unit_test(refusals_reach_all_and_are_not_kept),
        cmocka_unit_test(without_memory_all_are_woken_with_nothing),
        cmocka_unit_test(the_last_to_give_up_cancels),
        cmocka_unit_test(transient_answers_reach_all_and_are_not_kept),
        cmocka_unit_test(equal_requests_of_many_threads_are_solved_once),
        cmocka_unit_test(every_allocation_may_fail),
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
        cmocka_unit_test(no_more_memory_is_taken_than_is_counted),
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
