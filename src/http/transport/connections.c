/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/transport/connections.h"

#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <sys/socket.h>

#include "http/service/clock.h"

#define REAPER_PERIOD_MS 100

struct connections {
    pthread_mutex_t lock;
    pthread_cond_t end;
    pthread_t reaper;
    bool ending;
    connection *first;
    atomic_size_t count, opened;
    service *service;
    const handlers *handlers;
};

/* ---- the reaper ---- */

/* libmicrohttpd does not notice a client that closes its side of a suspended connection. */
static bool has_left(const connection *p)
{
    char byte;
    const ssize_t got = recv(p->fd, &byte, 1, MSG_PEEK | MSG_DONTWAIT);
    return got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR);
}

static void inspect(connection *p, int64_t now)
{
    const bool late = now > atomic_load(&p->deadline_ms);
    if (atomic_load(&p->phase) != CONNECTION_WAITING) {
        /* libmicrohttpd sees the end of the stream and closes. */
        if (late)
            shutdown(p->fd, SHUT_RDWR);
    } else if (late || has_left(p)) {
        p->all->handlers->give_up(p, late ? "it took longer than solve_timeout_s"
                                          : "the client left");
    } else {
        p->all->handlers->look_in(p, now);
    }
}

static void *reap(void *argument)
{
    connections *all = argument;
    pthread_mutex_lock(&all->lock);
    while (!all->ending) {
        struct timespec until;
        clock_gettime(CLOCK_MONOTONIC, &until);
        until.tv_nsec += REAPER_PERIOD_MS * 1000000;
        until.tv_sec += until.tv_nsec / 1000000000;
        until.tv_nsec %= 1000000000;
        pthread_cond_timedwait(&all->end, &all->lock, &until);
        const int64_t now = clock_ms();
        for (connection *p = all->first; p; p = p->next)
            inspect(p, now);
    }
    pthread_mutex_unlock(&all->lock);
    return NULL;
}

connections *connections_new(service *s, const handlers *h)
{
    connections *all = calloc(1, sizeof *all);
    if (!all)
        return NULL;
    all->service = s;
    all->handlers = h;
    pthread_condattr_t monotonic;
    pthread_condattr_init(&monotonic);
    pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
    pthread_cond_init(&all->end, &monotonic);
    pthread_condattr_destroy(&monotonic);
    pthread_mutex_init(&all->lock, NULL);
    if (pthread_create(&all->reaper, NULL, reap, all) != 0) {
        pthread_cond_destroy(&all->end);
        pthread_mutex_destroy(&all->lock);
        free(all);
        return NULL;
    }
    return all;
}

void connections_free(connections *all)
{
    if (!all)
        return;
    pthread_mutex_lock(&all->lock);
    all->ending = true;
    pthread_cond_signal(&all->end);
    pthread_mutex_unlock(&all->lock);
    pthread_join(all->reaper, NULL);
    pthread_cond_destroy(&all->end);
    pthread_mutex_destroy(&all->lock);
    free(all);
}

/* ---- one connection ---- */

connection *connection_open(connections *all, struct MHD_Connection *mhd)
{
    const union MHD_ConnectionInfo *info =
        MHD_get_connection_info(mhd, MHD_CONNECTION_INFO_CONNECTION_FD);
    connection *p = info ? calloc(1, sizeof *p) : NULL;
    if (!p)
        return NULL;
    const settings *set = all->service->settings;
    p->service = all->service;
    p->all = all;
    p->mhd = mhd;
    p->fd = info->connect_fd;
    p->request = all->handlers->open(p);
    if (!p->request) {
        free(p);
        return NULL;
    }
    connection_enter(p, CONNECTION_IDLE, set->idle_timeout_s + set->request_timeout_s);
    pthread_mutex_lock(&all->lock);
    p->next = all->first;
    if (all->first)
        all->first->previous = p;
    all->first = p;
    all->count++;
    all->opened++;
    pthread_mutex_unlock(&all->lock);
    return p;
}

void connection_close(connection *p)
{
    connections *all = p->all;
    pthread_mutex_lock(&all->lock);
    *(p->previous ? &p->previous->next : &all->first) = p->next;
    if (p->next)
        p->next->previous = p->previous;
    all->count--;
    pthread_mutex_unlock(&all->lock);
    all->handlers->close(p->request);
    free(p);
}

void connection_enter(connection *p, connection_phase phase, double seconds)
{
    const bool waiting =
        phase == CONNECTION_WAITING ||
        atomic_load_explicit(&p->phase, memory_order_relaxed) == CONNECTION_WAITING;
    /* The reaper works on the request of a waiting connection: not while the phase changes. */
    if (waiting)
        pthread_mutex_lock(&p->all->lock);
    atomic_store_explicit(&p->deadline_ms, clock_ms() + (int64_t)(seconds * 1000),
                          memory_order_relaxed);
    atomic_store_explicit(&p->phase, phase, memory_order_release);
    if (waiting)
        pthread_mutex_unlock(&p->all->lock);
}

void connection_end_if_stopping(connection *p)
{
    if (p->service->stopping)
        p->all->handlers->give_up(p, "the daemon is shutting down");
}

/* ---- all of them ---- */

size_t connections_count(connections *all)
{
    return all->count;
}

size_t connections_opened(connections *all)
{
    return all->opened;
}

size_t connections_busy(connections *all)
{
    size_t busy = 0;
    pthread_mutex_lock(&all->lock);
    for (connection *p = all->first; p; p = p->next)
        busy += atomic_load(&p->phase) != CONNECTION_IDLE;
    pthread_mutex_unlock(&all->lock);
    return busy;
}

void connections_end_idle(connections *all, double seconds)
{
    const settings *set = all->service->settings;
    /* The deadline of a connection that has been idle for exactly that long. */
    const int64_t limit =
        clock_ms() + (int64_t)((set->idle_timeout_s + set->request_timeout_s - seconds) * 1000);
    pthread_mutex_lock(&all->lock);
    for (connection *p = all->first; p; p = p->next)
        if (atomic_load(&p->phase) == CONNECTION_IDLE && atomic_load(&p->deadline_ms) <= limit)
            shutdown(p->fd, SHUT_RDWR);
    pthread_mutex_unlock(&all->lock);
}

void connections_end_waiting(connections *all)
{
    pthread_mutex_lock(&all->lock);
    for (connection *p = all->first; p; p = p->next)
        if (atomic_load(&p->phase) == CONNECTION_WAITING)
            p->all->handlers->give_up(p, "the daemon is shutting down");
    pthread_mutex_unlock(&all->lock);
}
