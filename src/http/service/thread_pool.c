/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/service/thread_pool.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <sys/resource.h> /* setpriority: on Linux of a thread */

#include "http/service/clock.h"

/* The numerics keep their arrays on the heap; the default stack of 8 MiB per thread would only
 * count against limits. */
#define WORKER_STACK (1 << 20)
/* Event threads have 0: a worker gets a tenth of their share of a core that both want. The
 * worker of cheap jobs stands between them: it must not wait for a core that a costly job has. */
#define WORKER_NICE       10
#define CHEAP_WORKER_NICE 0

/* A lane with work may be passed over so many times in a row. */
#define PATIENCE 3
/* While a job waits for memory. */
#define MEMORY_PERIOD_MS 100

/* Jobs by their turns: that of a job is its client's last one, or the lane's present, plus its cost
 * (start-time fair queueing: Goyal, Vin and Cheng 1996, with finish tags). */
typedef struct job_queue {
    job *first, *last;
    double now, turn_of[CLIENTS];
    int passed; /* times passed over while a job waited that might have begun */
} job_queue;

/* Requests refused for want of a place, since when. */
typedef struct queue_limit {
    size_t queued, queued_of[CLIENTS];
    int64_t full_since_ms;
} queue_limit;

struct thread_pool {
    pthread_mutex_t lock;
    pthread_cond_t work, cheap_work; /* of the workers, of the one for cheap jobs */
    thread_pool_options options;
    job_queue lanes[LANES];
    queue_limit cheap, costly; /* LANE_CHEAP; LANE_COSTLY and LANE_LONG */
    size_t busy, longs;        /* workers for all lanes at work; on long jobs */
    bool cheap_busy, ending;
    bool starved; /* the last job looked at had no memory to begin */
    thread_pool_counters count;
    pthread_t threads[];
};

static bool is_long(thread_pool_lane lane)
{
    return lane == LANE_LONG || lane == LANE_BATCH_LONG;
}

static size_t long_limit(const thread_pool *c)
{
    return c->options.workers > 1 ? (size_t)c->options.workers - 1 : 1;
}

static bool may_begin(const thread_pool *c, thread_pool_lane lane)
{
    return c->lanes[lane].first && (!is_long(lane) || c->longs < long_limit(c));
}

/* Counts the memory of a lane's first job, which is taken next; false: there is none for it now. */
static bool has_memory(thread_pool *c, thread_pool_lane lane)
{
    const thread_pool_options *o = &c->options;
    c->starved = o->begin && !o->begin(o->memory, c->lanes[lane].first->bytes);
    return !c->starved;
}

/* Waits for a signal, or a while if all that keeps a job from beginning is memory. */
static void wait_for_work(thread_pool *c, pthread_cond_t *work)
{
    if (!c->starved) {
        pthread_cond_wait(work, &c->lock);
        return;
    }
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += MEMORY_PERIOD_MS * 1000000;
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    pthread_cond_timedwait(work, &c->lock, &until);
}

/* ---- the queues ---- */

static queue_limit *limit_of(thread_pool *c, thread_pool_lane lane)
{
    return lane == LANE_CHEAP                         ? &c->cheap
           : lane == LANE_COSTLY || lane == LANE_LONG ? &c->costly
                                                      : NULL;
}

static void insert(job_queue *q, job *j)
{
    job **place = &q->first;
    if (q->first && q->last->turn <= j->turn)
        place = &q->last->next;
    while (*place && (*place)->turn <= j->turn)
        place = &(*place)->next;
    j->next = *place;
    *place = j;
    if (!j->next)
        q->last = j;
}

static void add(thread_pool *c, job *j)
{
    job_queue *q = &c->lanes[j->lane];
    j->turn = fmax(q->now, q->turn_of[j->client]) + j->cost_us;
    q->turn_of[j->client] = j->turn;
    insert(q, j);
    c->count.queued[j->lane]++;
    c->count.backlog_us[j->lane] += j->cost_us;
    /* Both: the one for cheap jobs may be at work on a longer one. */
    if (j->lane == LANE_CHEAP)
        pthread_cond_signal(&c->cheap_work);
    pthread_cond_signal(&c->work);
}

static job *take_from(thread_pool *c, thread_pool_lane lane)
{
    job_queue *q = &c->lanes[lane];
    job *j = q->first;
    q->first = j->next;
    q->now = fmax(q->now, j->turn - j->cost_us);
    c->count.queued[lane]--;
    /* Sums of rounded numbers: nothing is left of them when nothing waits. */
    c->count.backlog_us[lane] = q->first ? fmax(c->count.backlog_us[lane] - j->cost_us, 0) : 0;
    queue_limit *limit = limit_of(c, lane);
    if (limit) {
        limit->queued--;
        limit->queued_of[j->client]--;
        /* A single free place does not count: under a lasting overload it is taken at once. */
        if (limit->queued <= c->options.depth / 2)
            limit->full_since_ms = 0;
    }
    return j;
}

/* The first lane but `without` whose first job may begin, or LANES. */
static int another_with_memory(thread_pool *c, int without)
{
    const bool starved = c->starved;
    for (int i = 0; i < LANES && without != LANES; i++)
        if (i != without && may_begin(c, (thread_pool_lane)i) &&
            has_memory(c, (thread_pool_lane)i))
            return i;
    c->starved = starved;
    return LANES;
}

/* Returns the next job of a worker for all lanes, or NULL. */
static job *take(thread_pool *c)
{
    int next = LANES;
    for (int i = LANES - 1; i >= 0; i--)
        if (may_begin(c, (thread_pool_lane)i) &&
            (next == LANES || c->lanes[next].passed < PATIENCE))
            next = i;
    if (next == LANES || !has_memory(c, (thread_pool_lane)next))
        next = another_with_memory(c, next);
    if (next == LANES)
        return NULL;
    for (int i = next + 1; i < LANES; i++)
        c->lanes[i].passed += may_begin(c, (thread_pool_lane)i);
    c->lanes[next].passed = 0;
    return take_from(c, (thread_pool_lane)next);
}

/* ---- the workers ---- */

/* Under the lock, which it releases meanwhile. */
static void work_on(thread_pool *c, job *j)
{
    const bool takes_long = is_long(j->lane);
    const size_t bytes = j->bytes;
    c->longs += takes_long;
    c->count.working++;
    pthread_mutex_unlock(&c->lock);
    j->work(j); /* j may be freed by this */
    pthread_mutex_lock(&c->lock);
    c->count.working--;
    c->count.done++;
    c->longs -= takes_long;
    if (c->options.end)
        c->options.end(c->options.memory, bytes);
    /* A worker that waits may now begin a long one. */
    if (takes_long && (c->lanes[LANE_LONG].first || c->lanes[LANE_BATCH_LONG].first))
        pthread_cond_signal(&c->work);
}

/* If the call fails, only the order among threads is lost. */
static void step_back(int nice)
{
    (void)setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + nice);
}

static bool has_work(const thread_pool *c)
{
    for (int i = 0; i < LANES; i++)
        if (c->lanes[i].first)
            return true;
    return false;
}

static void *worker(void *argument)
{
    thread_pool *c = argument;
    step_back(WORKER_NICE);
    pthread_mutex_lock(&c->lock);
    for (;;) {
        job *j = take(c);
        if (j) {
            c->busy++;
            work_on(c, j);
            c->busy--;
        } else if (c->ending && !has_work(c)) {
            break;
        } else {
            wait_for_work(c, &c->work);
        }
    }
    pthread_cond_broadcast(&c->work);
    pthread_mutex_unlock(&c->lock);
    return NULL;
}

static void *cheap_worker(void *argument)
{
    thread_pool *c = argument;
    step_back(CHEAP_WORKER_NICE);
    pthread_mutex_lock(&c->lock);
    for (;;) {
        c->cheap_busy = c->lanes[LANE_CHEAP].first && has_memory(c, LANE_CHEAP);
        if (c->cheap_busy)
            work_on(c, take_from(c, LANE_CHEAP));
        else if (c->ending && !c->lanes[LANE_CHEAP].first)
            break;
        else
            wait_for_work(c, &c->cheap_work);
    }
    pthread_mutex_unlock(&c->lock);
    return NULL;
}

static bool start(thread_pool *c, const pthread_attr_t *attributes, void *(*run)(void *))
{
    if (pthread_create(&c->threads[c->count.workers], attributes, run, c) != 0)
        return false;
    c->count.workers++;
    return true;
}

thread_pool *thread_pool_new(const thread_pool_options *options)
{
    thread_pool *c = calloc(1, sizeof *c + ((size_t)options->workers + 1) * sizeof *c->threads);
    if (!c)
        return NULL;
    c->options = *options;
    c->count.depth = options->depth;
    pthread_mutex_init(&c->lock, NULL);
    pthread_cond_init(&c->work, NULL);
    pthread_cond_init(&c->cheap_work, NULL);
    pthread_attr_t attributes;
    bool good = pthread_attr_init(&attributes) == 0;
    if (good) {
        pthread_attr_setstacksize(&attributes, WORKER_STACK);
        for (int i = 0; i < options->workers && good; i++)
            good = start(c, &attributes, worker);
        good = good && (options->cheap_us <= 0 || start(c, &attributes, cheap_worker));
        pthread_attr_destroy(&attributes);
    }
    if (!good) {
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
    pthread_cond_broadcast(&c->cheap_work);
    pthread_mutex_unlock(&c->lock);
    for (int i = 0; i < c->count.workers; i++)
        pthread_join(c->threads[i], NULL);
    pthread_cond_destroy(&c->cheap_work);
    pthread_cond_destroy(&c->work);
    pthread_mutex_destroy(&c->lock);
    free(c);
}

/* ---- from outside ---- */

/* One client may take so many times what it leaves free, so that there are places for others
 * (dynamic thresholds: Choudhury and Hahne 1998). */
#define PLACES_FOR_ONE_LEFT 4

static bool has_place(const queue_limit *limit, size_t depth, unsigned client)
{
    return limit->queued < depth &&
           limit->queued_of[client] <= PLACES_FOR_ONE_LEFT * (depth - limit->queued);
}

bool thread_pool_queue(thread_pool *c, job *j)
{
    pthread_mutex_lock(&c->lock);
    j->lane = j->cost_us < c->options.cheap_us   ? LANE_CHEAP
              : j->cost_us < THREAD_POOL_LONG_US ? LANE_COSTLY
                                                 : LANE_LONG;
    queue_limit *limit = limit_of(c, j->lane);
    /* An idle worker takes a job at once: it does not wait in the queue. */
    const size_t idle =
        (size_t)c->options.workers - c->busy + (j->lane == LANE_CHEAP && !c->cheap_busy);
    const bool room = has_place(limit, c->options.depth + idle, j->client);
    if (room) {
        limit->queued++;
        limit->queued_of[j->client]++;
        add(c, j);
    } else {
        c->count.refused++;
        limit->full_since_ms = limit->full_since_ms ? limit->full_since_ms : clock_ms();
    }
    pthread_mutex_unlock(&c->lock);
    return room;
}

void thread_pool_queue_batch(thread_pool *c, job *j)
{
    pthread_mutex_lock(&c->lock);
    j->lane = j->cost_us < THREAD_POOL_LONG_US ? LANE_BATCH : LANE_BATCH_LONG;
    add(c, j);
    pthread_mutex_unlock(&c->lock);
}

thread_pool_counters thread_pool_count(thread_pool *c)
{
    pthread_mutex_lock(&c->lock);
    thread_pool_counters count = c->count;
    const int64_t cheap = c->cheap.full_since_ms, costly = c->costly.full_since_ms;
    count.full_since_ms = cheap && (!costly || cheap < costly) ? cheap : costly;
    pthread_mutex_unlock(&c->lock);
    return count;
}

double thread_pool_backlog_s(thread_pool *c)
{
    pthread_mutex_lock(&c->lock);
    const double *us = c->count.backlog_us;
    const double all = us[LANE_CHEAP] + us[LANE_COSTLY] + us[LANE_LONG];
    const double seconds =
        fmax(all / c->options.workers, us[LANE_LONG] / (double)long_limit(c)) * 1e-6;
    pthread_mutex_unlock(&c->lock);
    return seconds;
}

const char *thread_pool_lane_name(thread_pool_lane lane)
{
    static const char *const names[LANES] = {"cheap", "costly", "long", "batch", "batch_long"};
    return names[lane];
}
