/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Workers and their bounded queue. */
#include <math.h>
#include <pthread.h>
#include <sched.h>
#include <semaphore.h>
#include <stdatomic.h>

#include "http/service/thread_pool.h"

#include "check.h"

/* A job that says when it begins and ends when it is let. */
typedef struct gated {
    job job;
    sem_t begun, let;
    int order;
} gated;

static atomic_int next_order;

static void wait_at_gate(job *j)
{
    gated *g = (gated *)(void *)j;
    g->order = atomic_fetch_add(&next_order, 1);
    sem_post(&g->begun);
    sem_wait(&g->let);
}

/* Estimates of each lane, with CHEAP_US the limit of cheap ones. */
#define CHEAP_US 1000.0
enum { CHEAP = 1, COSTLY = 5000, LONG = 200000 };

static thread_pool *pool_of(int workers, size_t depth)
{
    return thread_pool_new(
        &(thread_pool_options){.workers = workers, .depth = depth, .cheap_us = CHEAP_US});
}

static void gated_init(gated *g, double cost_us)
{
    g->job = (job){.work = wait_at_gate, .cost_us = cost_us};
    sem_init(&g->begun, 0, 0);
    sem_init(&g->let, 0, 0);
}

static bool gated_give(thread_pool *c, gated *g, double cost_us)
{
    gated_init(g, cost_us);
    return thread_pool_queue(c, &g->job);
}

static bool has_begun(gated *g)
{
    return sem_trywait(&g->begun) == 0;
}

static void the_queue_is_bounded_and_in_order(void **state)
{
    (void)state;
    gated jobs[5], more;
    thread_pool *c = pool_of(1, 4);
    assert_non_null(c);
    next_order = 0;
    for (int i = 0; i < 5; i++) /* one for the worker, four wait */
        assert_true(gated_give(c, &jobs[i], COSTLY));
    sem_wait(&jobs[0].begun);
    assert_false(gated_give(c, &more, COSTLY));
    assert_false(gated_give(c, &more, LONG));
    thread_pool_counters count = thread_pool_count(c);
    assert_int_equal(count.workers, 2);
    assert_int_equal(count.working, 1);
    assert_int_equal(count.queued[LANE_COSTLY], 4);
    assert_true(count.backlog_us[LANE_COSTLY] == 4 * COSTLY);
    assert_true(fabs(thread_pool_backlog_s(c) - 4 * COSTLY * 1e-6) < 1e-12);
    assert_int_equal(count.refused, 2);
    assert_true(count.full_since_ms > 0);
    /* It counts as full until it is half empty. */
    sem_post(&jobs[0].let);
    sem_wait(&jobs[1].begun);
    assert_true(thread_pool_count(c).full_since_ms > 0);
    sem_post(&jobs[1].let);
    sem_wait(&jobs[2].begun);
    assert_int_equal(thread_pool_count(c).queued[LANE_COSTLY], 2);
    assert_true(thread_pool_count(c).full_since_ms == 0);
    assert_true(gated_give(c, &jobs[0], COSTLY));
    /* What was given is finished before the thread_pool ends. */
    for (int i = 0; i < 5; i++)
        if (i != 1)
            sem_post(&jobs[i].let);
    thread_pool_free(c);
    for (int i = 2; i < 5; i++)
        assert_int_equal(jobs[i].order, i);
    assert_int_equal(jobs[0].order, 5);
}

typedef struct adder {
    job job;
    atomic_int *sum;
} adder;

static void add_one(job *j)
{
    atomic_fetch_add(((adder *)(void *)j)->sum, 1);
}

static void many_workers_do_every_job_once(void **state)
{
    (void)state;
    enum { JOBS = 2000 };
    static adder jobs[JOBS];
    atomic_int sum = 0;
    thread_pool *c = pool_of(4, JOBS);
    static const double costs[] = {CHEAP, COSTLY, LONG};
    assert_non_null(c);
    for (int i = 0; i < JOBS; i++) {
        jobs[i] = (adder){.job = {.work = add_one, .cost_us = costs[i % 3]}, .sum = &sum};
        if (i % 2)
            assert_true(thread_pool_queue(c, &jobs[i].job));
        else
            thread_pool_queue_batch(c, &jobs[i].job);
    }
    thread_pool_free(c);
    assert_int_equal(sum, JOBS);
}

/* The order in which jobs begin on one worker, a letter each. */
typedef struct noting {
    job job;
    char letter;
} noting;

static char noted[64];
static size_t noted_count;

static void note(job *j)
{
    noted[noted_count++] = ((noting *)(void *)j)->letter;
}

static void a_lane_passed_over_three_times_comes_next(void **state)
{
    (void)state;
    gated first;
    noting jobs[11];
    thread_pool *c = pool_of(1, 100);
    noted_count = 0;
    assert_true(gated_give(c, &first, COSTLY));
    sem_wait(&first.begun); /* the worker is busy until all have been given */
    for (int i = 0; i < 11; i++) {
        jobs[i] =
            (noting){.job = {.work = note, .cost_us = COSTLY}, .letter = i < 3 ? 'b' : 'r'};
        if (i < 3)
            thread_pool_queue_batch(c, &jobs[i].job);
        else
            assert_true(thread_pool_queue(c, &jobs[i].job));
    }
    sem_post(&first.let);
    thread_pool_free(c);
    noted[noted_count] = '\0';
    assert_string_equal(noted, "rrrbrrrbrrb");
}

static void clients_take_turns(void **state)
{
    (void)state;
    gated first;
    noting jobs[6];
    thread_pool *c = pool_of(1, 100);
    noted_count = 0;
    assert_true(gated_give(c, &first, COSTLY));
    sem_wait(&first.begun);
    for (int i = 0; i < 6; i++) {
        jobs[i] = (noting){.job = {.work = note, .cost_us = COSTLY, .client = i < 4 ? 1 : 2},
                           .letter = i < 4 ? 'a' : 'b'};
        assert_true(thread_pool_queue(c, &jobs[i].job));
    }
    sem_post(&first.let);
    thread_pool_free(c);
    noted[noted_count] = '\0';
    assert_string_equal(noted, "ababaa");
}

static void a_client_leaves_places_to_others(void **state)
{
    (void)state;
    enum { DEPTH = 20 };
    gated first;
    static noting jobs[DEPTH + 1];
    thread_pool *c = pool_of(1, DEPTH);
    noted_count = 0;
    assert_true(gated_give(c, &first, COSTLY));
    sem_wait(&first.begun);
    int places = 0;
    for (int i = 0; i <= DEPTH; i++) {
        jobs[i] = (noting){.job = {.work = note, .cost_us = COSTLY, .client = 1}};
        places += thread_pool_queue(c, &jobs[i].job);
    }
    assert_int_equal(places, 17); /* the most with n - 1 <= 4 (20 - (n - 1)) */
    noting other = {.job = {.work = note, .cost_us = COSTLY, .client = 2}};
    assert_true(thread_pool_queue(c, &other.job));
    sem_post(&first.let);
    thread_pool_free(c);
}

static void a_batch_uses_every_worker(void **state)
{
    (void)state;
    gated turns[3], cheap;
    thread_pool *c = pool_of(2, 1);
    for (int i = 0; i < 3; i++) {
        gated_init(&turns[i], COSTLY);
        thread_pool_queue_batch(c, &turns[i].job);
    }
    sem_wait(&turns[0].begun);
    sem_wait(&turns[1].begun);
    assert_false(has_begun(&turns[2]));
    /* There is still a worker for this. */
    assert_true(gated_give(c, &cheap, CHEAP));
    sem_wait(&cheap.begun);
    assert_int_equal(thread_pool_count(c).working, 3);
    for (int i = 0; i < 3; i++)
        sem_post(&turns[i].let);
    sem_post(&cheap.let);
    thread_pool_free(c); /* finishes the third too */
    assert_true(has_begun(&turns[2]));
}

static void long_jobs_leave_a_worker_to_others(void **state)
{
    (void)state;
    gated requests[2], items[2], costly;
    thread_pool *c = pool_of(3, 10);
    for (int i = 0; i < 2; i++) {
        assert_true(gated_give(c, &requests[i], LONG));
        gated_init(&items[i], LONG);
        thread_pool_queue_batch(c, &items[i].job);
    }
    while (thread_pool_count(c).working < 2)
        sched_yield();
    assert_true(gated_give(c, &costly, COSTLY));
    sem_wait(&costly.begun);
    assert_int_equal(thread_pool_count(c).working, 3);
    sem_post(&costly.let);
    for (int i = 0; i < 2; i++) {
        sem_post(&requests[i].let);
        sem_post(&items[i].let);
    }
    /* A worker that could not begin a long one hears when it may. */
    for (int i = 0; i < 2; i++) {
        sem_wait(&requests[i].begun);
        sem_wait(&items[i].begun);
    }
    thread_pool_free(c);
}

/* Every worker is held, and more wait: a cheap job begins all the same. */
static void cheap_jobs_wait_for_no_other(void **state)
{
    (void)state;
    gated costly[4], cheap[2];
    thread_pool *c = pool_of(2, 2);
    for (int i = 0; i < 4; i++)
        assert_true(gated_give(c, &costly[i], COSTLY));
    assert_false(gated_give(c, &cheap[0], COSTLY));
    for (int i = 0; i < 2; i++)
        assert_true(gated_give(c, &cheap[i], CHEAP));
    sem_wait(&cheap[0].begun);
    sem_post(&cheap[0].let);
    sem_wait(&cheap[1].begun);
    sem_post(&cheap[1].let);
    for (int i = 0; i < 4; i++)
        sem_post(&costly[i].let);
    thread_pool_free(c);
}

/* Memory for one job at a time. */
static atomic_int jobs_with_memory;

static bool begin_one(void *memory, size_t bytes)
{
    assert_ptr_equal(memory, &jobs_with_memory);
    assert_int_equal(bytes, 7);
    int none = 0;
    return atomic_compare_exchange_strong(&jobs_with_memory, &none, 1);
}

static void end_one(void *memory, size_t bytes)
{
    (void)memory;
    (void)bytes;
    jobs_with_memory = 0;
}

static void a_job_without_memory_waits(void **state)
{
    (void)state;
    gated jobs[2];
    thread_pool *c = thread_pool_new(&(thread_pool_options){.workers = 2,
                                                            .depth = 2,
                                                            .begin = begin_one,
                                                            .end = end_one,
                                                            .memory = &jobs_with_memory});
    jobs_with_memory = 1; /* others have it */
    for (int i = 0; i < 2; i++) {
        gated_init(&jobs[i], COSTLY);
        jobs[i].job.bytes = 7;
        assert_true(thread_pool_queue(c, &jobs[i].job));
    }
    assert_int_equal(thread_pool_count(c).working, 0);
    jobs_with_memory = 0; /* nobody signals this */
    sem_wait(&jobs[0].begun);
    assert_int_equal(thread_pool_count(c).working, 1);
    sem_post(&jobs[0].let);
    sem_wait(&jobs[1].begun);
    sem_post(&jobs[1].let);
    thread_pool_free(c);
}

static void no_worker_is_kept_where_nothing_is_cheap(void **state)
{
    (void)state;
    gated held, other;
    thread_pool *c = thread_pool_new(&(thread_pool_options){.workers = 1, .depth = 1});
    assert_int_equal(thread_pool_count(c).workers, 1);
    assert_true(gated_give(c, &held, 0));
    sem_wait(&held.begun);
    assert_true(gated_give(c, &other, 0));
    assert_int_equal(thread_pool_count(c).queued[LANE_COSTLY], 1);
    sem_post(&held.let);
    sem_post(&other.let);
    thread_pool_free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_queue_is_bounded_and_in_order),
        cmocka_unit_test(a_lane_passed_over_three_times_comes_next),
        cmocka_unit_test(clients_take_turns),
        cmocka_unit_test(a_client_leaves_places_to_others),
        cmocka_unit_test(a_batch_uses_every_worker),
        cmocka_unit_test(long_jobs_leave_a_worker_to_others),
        cmocka_unit_test(cheap_jobs_wait_for_no_other),
        cmocka_unit_test(a_job_without_memory_waits),
        cmocka_unit_test(no_worker_is_kept_where_nothing_is_cheap),
        cmocka_unit_test(many_workers_do_every_job_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
