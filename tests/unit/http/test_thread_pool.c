/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Workers and their bounded queue. */
#include <pthread.h>
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

static void gated_give(thread_pool *c, gated *g)
{
    g->job.work = wait_at_gate;
    sem_init(&g->begun, 0, 0);
    sem_init(&g->let, 0, 0);
    thread_pool_queue(c, &g->job);
}

static void the_queue_is_bounded_and_in_order(void **state)
{
    (void)state;
    gated jobs[5];
    thread_pool *c = thread_pool_new(1, 4);
    assert_non_null(c);
    next_order = 0;
    for (int i = 0; i < 5; i++) { /* one for the worker, four wait */
        assert_true(thread_pool_reserve(c));
        gated_give(c, &jobs[i]);
    }
    sem_wait(&jobs[0].begun);
    assert_false(thread_pool_reserve(c));
    thread_pool_counters count = thread_pool_count(c);
    assert_int_equal(count.workers, 1);
    assert_int_equal(count.working, 1);
    assert_int_equal(count.queued, 4);
    assert_int_equal(count.refused, 1);
    assert_true(count.full_since_ms > 0);
    /* It counts as full until it is half empty. */
    sem_post(&jobs[0].let);
    sem_wait(&jobs[1].begun);
    assert_true(thread_pool_count(c).full_since_ms > 0);
    sem_post(&jobs[1].let);
    sem_wait(&jobs[2].begun);
    assert_int_equal(thread_pool_count(c).queued, 2);
    assert_true(thread_pool_count(c).full_since_ms == 0);
    assert_true(thread_pool_reserve(c));
    gated_give(c, &jobs[0]);
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
    thread_pool *c = thread_pool_new(4, JOBS);
    assert_non_null(c);
    for (int i = 0; i < JOBS; i++) {
        assert_true(thread_pool_reserve(c));
        jobs[i] = (adder){.job.work = add_one, .sum = &sum};
        thread_pool_queue(c, &jobs[i].job);
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

static void background_work_gets_every_fourth_turn(void **state)
{
    (void)state;
    gated first;
    noting jobs[11];
    thread_pool *c = thread_pool_new(1, 100);
    noted_count = 0;
    assert_true(thread_pool_reserve(c));
    gated_give(c, &first);
    sem_wait(&first.begun); /* the worker is busy until all have been given */
    for (int i = 0; i < 11; i++) {
        jobs[i] = (noting){.job.work = note, .letter = i < 3 ? 'b' : 'r'};
        if (i >= 3)
            assert_true(thread_pool_reserve(c));
        (i < 3 ? thread_pool_queue_background : thread_pool_queue)(c, &jobs[i].job);
    }
    sem_post(&first.let);
    thread_pool_free(c);
    noted[noted_count] = '\0';
    assert_string_equal(noted, "rrbrrrbrrrb"); /* `first` had a turn before them */
}

static void background_work_leaves_a_worker_to_others(void **state)
{
    (void)state;
    gated background[3], request;
    thread_pool *c = thread_pool_new(2, 1);
    for (int i = 0; i < 3; i++) {
        background[i].job.work = wait_at_gate;
        sem_init(&background[i].begun, 0, 0);
        sem_init(&background[i].let, 0, 0);
        thread_pool_queue_background(c, &background[i].job);
    }
    sem_wait(&background[0].begun);
    /* Only one is begun, and there is a worker for this, whatever else waits. */
    assert_true(thread_pool_reserve(c));
    gated_give(c, &request);
    sem_wait(&request.begun);
    assert_int_equal(thread_pool_count(c).background, 1);
    assert_int_equal(sem_trywait(&background[1].begun), -1);
    for (int i = 0; i < 3; i++)
        sem_post(&background[i].let);
    sem_post(&request.let);
    thread_pool_free(c); /* finishes the third too */
    assert_int_equal(sem_trywait(&background[2].begun), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_queue_is_bounded_and_in_order),
        cmocka_unit_test(background_work_gets_every_fourth_turn),
        cmocka_unit_test(background_work_leaves_a_worker_to_others),
        cmocka_unit_test(many_workers_do_every_job_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
