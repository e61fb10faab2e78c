/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/peers.h"

#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <sys/socket.h>

#include "http/ask.h"
#include "http/clock.h"
#include "http/server.h"

#define REAPER_PERIOD_MS 100

struct peers {
    pthread_mutex_t lock;
    pthread_cond_t end;
    pthread_t reaper;
    bool ending;
    peer *first;
    atomic_size_t count, opened;
    server *server;
};

/* ---- the reaper ---- */

/* A client that closes its side of a suspended connection is not noticed by libmicrohttpd. */
static bool has_left(const peer *p)
{
    char byte;
    const ssize_t got = recv(p->fd, &byte, 1, MSG_PEEK | MSG_DONTWAIT);
    return got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR);
}

static void look_at(peer *p, int64_t now)
{
    const bool late = now > atomic_load(&p->deadline_ms);
    if (atomic_load(&p->phase) != PEER_WAITING) {
        /* libmicrohttpd sees the end of the stream and closes. */
        if (late)
            shutdown(p->fd, SHUT_RDWR);
    } else if (late || has_left(p)) {
        ask_give_up(p, late ? "it took longer than solve_timeout_s" : "the client left");
    }
}

static void *reap(void *argument)
{
    peers *all = argument;
    pthread_mutex_lock(&all->lock);
    while (!all->ending) {
        struct timespec until;
        clock_gettime(CLOCK_MONOTONIC, &until);
        until.tv_nsec += REAPER_PERIOD_MS * 1000000;
        until.tv_sec += until.tv_nsec / 1000000000;
        until.tv_nsec %= 1000000000;
        pthread_cond_timedwait(&all->end, &all->lock, &until);
        const int64_t now = clock_ms();
        for (peer *p = all->first; p; p = p->next)
            look_at(p, now);
    }
    pthread_mutex_unlock(&all->lock);
    return NULL;
}

peers *peers_new(server *s)
{
    peers *all = calloc(1, sizeof *all);
    if (!all)
        return NULL;
    all->server = s;
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

void peers_free(peers *all)
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

peer *peer_open(server *s, struct MHD_Connection *connection)
{
    const union MHD_ConnectionInfo *info =
        MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CONNECTION_FD);
    peer *p = info ? calloc(1, sizeof *p) : NULL;
    if (!p)
        return NULL;
    p->server = s;
    p->connection = connection;
    p->fd = info->connect_fd;
    peer_enter(p, PEER_IDLE, s->settings->idle_timeout_s + s->settings->request_timeout_s);
    peers *all = s->peers;
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

void peer_close(peer *p)
{
    peers *all = p->server->peers;
    pthread_mutex_lock(&all->lock);
    *(p->previous ? &p->previous->next : &all->first) = p->next;
    if (p->next)
        p->next->previous = p->previous;
    all->count--;
    pthread_mutex_unlock(&all->lock);
    request_clear(&p->request);
    free(p);
}

void peer_enter(peer *p, peer_phase phase, double seconds)
{
    const bool waiting = phase == PEER_WAITING ||
                         atomic_load_explicit(&p->phase, memory_order_relaxed) == PEER_WAITING;
    /* The reaper works on the request of one that waits: not while that changes. */
    if (waiting)
        pthread_mutex_lock(&p->server->peers->lock);
    atomic_store_explicit(&p->deadline_ms, clock_ms() + (int64_t)(seconds * 1000),
                          memory_order_relaxed);
    atomic_store_explicit(&p->phase, phase, memory_order_release);
    if (waiting)
        pthread_mutex_unlock(&p->server->peers->lock);
}

/* ---- all of them ---- */

size_t peers_count(peers *all)
{
    return all->count;
}

size_t peers_opened(peers *all)
{
    return all->opened;
}

size_t peers_busy(peers *all)
{
    size_t busy = 0;
    pthread_mutex_lock(&all->lock);
    for (peer *p = all->first; p; p = p->next)
        busy += atomic_load(&p->phase) != PEER_IDLE;
    pthread_mutex_unlock(&all->lock);
    return busy;
}

void peers_end_idle(peers *all, double seconds)
{
    const settings *set = all->server->settings;
    /* When the deadline of one that has been idle since then is. */
    const int64_t limit =
        clock_ms() + (int64_t)((set->idle_timeout_s + set->request_timeout_s - seconds) * 1000);
    pthread_mutex_lock(&all->lock);
    for (peer *p = all->first; p; p = p->next)
        if (atomic_load(&p->phase) == PEER_IDLE && atomic_load(&p->deadline_ms) <= limit)
            shutdown(p->fd, SHUT_RDWR);
    pthread_mutex_unlock(&all->lock);
}

void peers_end_waiting(peers *all)
{
    pthread_mutex_lock(&all->lock);
    for (peer *p = all->first; p; p = p->next)
        if (atomic_load(&p->phase) == PEER_WAITING)
            ask_give_up(p, "the daemon is shutting down");
    pthread_mutex_unlock(&all->lock);
}
