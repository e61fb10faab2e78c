/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/service/thread_pool.h"

#include <pthread.h>
#include <stdlib.h>
#include <sys/resource.h> /* setpriority: on Linux of a thread */

#include "http/service/clock.h"

/* The numerics keep their arrays on the heap; the default stack of 8 MiB per thread would only
 * count against limits. */
#define WORKER_STACK (1 << 20)
/* Event threads have 0: a worker gets a tenth of their share of a core that both want. */
#define WORKER_NICE 10

/* Requests taken before one background job is taken. */
#define BACKGROUND_AFTER 3

typedef struct job_queue {
    job *first, **last;
} job_queue;

struct thread_pool {
    pthread_mutex_t lock;
    pthread_cond_t work;
    job_queue requests, background;
    int turns; /* requests taken since the last background job */
    bool ending;
    thread_pool_counters count;
    pthread_t threads[];
};

static void job_queue_add(job_queue *q, job *j)
{
    j->next = NULL;
    *q->last = j;
    q->last = &j->next;
}

static job *job_queue_take(job_queue *q)
{
    job *j = q->first;
    q->first = j->next;
    if (!q->first)
        q->last = &q->first;
    return j;
}

static size_t background_limit(const thread_pool *c)
{
    return c->count.workers > 1 ? (size_t)c->count.workers - 1 : 1;
}

static job *take_request(thread_pool *c)
{
    c->turns++;
    c->count.queued--;
    /* A single free place does not count: under a lasting overload it is taken at once. */
    if (c->count.queued <= c->count.depth / 2)
        c->count.full_since_ms = 0;
    return job_queue_take(&c->requests);
}

/* Returns the next job, or NULL. */
static job *take(thread_pool *c, bool *background)
{
    const bool may = c->background.first && c->count.background < background_limit(c);
    *background = may && (!c->requests.first || c->turns >= BACKGROUND_AFTER);
    if (*background) {
        c->turns = 0;
        c->count.background++;
        return job_queue_take(&c->background);
    }
    return c->requests.first ? take_request(c) : NULL;
}

static void *worker(void *argument)
{
    thread_pool *c = argument;
    bool background;
    /* Event threads go first, so that a stored answer does not wait for one being solved. If
     * the call fails, only that order is lost. */
    (void)setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + WORKER_NICE);
    pthread_mutex_lock(&c->lock);
    for (;;) {
        job *j = take(c, &background);
        if (!j) {
            if (c->ending && !c->background.first)
                break;
            pthread_cond_wait(&c->work, &c->lock);
            continue;
        }
        c->count.working++;
        pthread_mutex_unlock(&c->lock);
        j->work(j); /* j may be freed by this */
        pthread_mutex_lock(&c->lock);
        c->count.working--;
        c->count.done++;
        if (background)
            c->count.background--;
    }
    pthread_cond_broadcast(&c->work);
    pthread_mutex_unlock(&c->lock);
    return NULL;
}

thread_pool *thread_pool_new(int workers, size_t depth)
{
    thread_pool *c = calloc(1, sizeof *c + (size_t)workers * sizeof *c->threads);
    if (!c)
        return NULL;
    c->requests.last = &c->requests.first;
    c->background.last = &c->background.first;
    c->count.depth = depth;
    pthread_mutex_init(&c->lock, NULL);
    pthread_cond_init(&c->work, NULL);
    pthread_attr_t attributes;
    if (pthread_attr_init(&attributes) == 0) {
        pthread_attr_setstacksize(&attributes, WORKER_STACK);
        while (c->count.workers < workers &&
               pthread_create(&c->threads[c->count.workers], &attributes, worker, c) == 0)
            c->count.workers++;
        pthread_attr_destroy(&attributes);
    }
    if (c->count.workers < workers) {
        thread_pool_free(c);
        return NULL;
    }
    return c;
}

void thread_pool_free(thread_pool *c)
{
    if (!c)
        return;
    pthread_mutex_lock(&c->lock);
    c->ending = true;
    pthread_cond_broadcast(&c->work);
    pthread_mutex_unlock(&c->lock);
    for (int i = 0; i < c->count.workers; i++)
        pthread_join(c->threads[i], NULL);
    pthread_cond_destroy(&c->work);
    pthread_mutex_destroy(&c->lock);
    free(c);
}

bool thread_pool_reserve(thread_pool *c)
{
    pthread_mutex_lock(&c->lock);
    /* An idle worker takes a job at once: it does not wait in the queue. */
    const size_t idle = (size_t)c->count.workers - c->count.working;
    const bool room = c->count.queued < c->count.depth + idle;
    if (room)
        c->count.queued++;
    else
        c->count.refused++;
    if (!room && !c->count.full_since_ms)
        c->count.full_since_ms = clock_ms();
    pthread_mutex_unlock(&c->lock);
    return room;
}

void thread_pool_queue(thread_pool *c, job *j)
{
    pthread_mutex_lock(&c->lock);
    job_queue_add(&c->requests, j);
    pthread_cond_signal(&c->work);
    pthread_mutex_unlock(&c->lock);
}

void thread_pool_queue_background(thread_pool *c, job *j)
{
    pthread_mutex_lock(&c->lock);
    job_queue_add(&c->background, j);
    pthread_cond_signal(&c->work);
    pthread_mutex_unlock(&c->lock);
}

thread_pool_counters thread_pool_count(thread_pool *c)
{
    pthread_mutex_lock(&c->lock);
    const thread_pool_counters count = c->count;
    pthread_mutex_unlock(&c->lock);
    return count;
}
