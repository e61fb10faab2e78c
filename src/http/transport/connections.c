/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/transport/connections.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <unistd.h>

#include "http/service/clock.h"

#define REAPER_PERIOD_MS 100

/* A connection that lingers is read for so long, and so many bytes of it. */
#define LINGER_MS        2000
#define LINGER_BYTES     (1 << 20)
#define LINGER_PERIOD_MS 10

typedef struct lingering {
    int fd; /* our own copy: libmicrohttpd closes its own */
    int64_t until_ms;
    size_t bytes;
} lingering;

struct connections {
    pthread_mutex_t lock;
    pthread_cond_t change; /* the end, or one that lingers */
    pthread_t reaper;
    bool ending;
    connection *first;
    size_t lingering_count;
    lingering lingering[CONNECTIONS_LINGER];
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

/* Reads and drops what has come. Returns whether more is waited for. */
static bool drop(lingering *l, int64_t now)
{
    char bytes[16384];
    while (l->bytes < LINGER_BYTES && now < l->until_ms) {
        const ssize_t got = recv(l->fd, bytes, sizeof bytes, MSG_DONTWAIT);
        if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR))
            return false;
        if (got < 0)
            return true;
        l->bytes += (size_t)got;
    }
    return false;
}

static void drop_all(connections *all, int64_t now)
{
    for (size_t i = 0; i < all->lingering_count;) {
        if (drop(&all->lingering[i], now)) {
            i++;
        } else {
            close(all->lingering[i].fd);
            all->lingering[i] = all->lingering[--all->lingering_count];
        }
    }
}

/* Under the lock. */
static void wait_ms(connections *all, int ms)
{
    struct timespec until;
    clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_nsec += (long)ms * 1000000;
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    pthread_cond_timedwait(&all->change, &all->lock, &until);
}

static void *reap(void *argument)
{
    connections *all = argument;
    int64_t due = clock_ms() + REAPER_PERIOD_MS;
    pthread_mutex_lock(&all->lock);
    while (!all->ending) {
        const int64_t left = due - clock_ms();
        wait_ms(all, all->lingering_count ? LINGER_PERIOD_MS : left > 0 ? (int)left : 0);
        const int64_t now = clock_ms();
        drop_all(all, now);
        if (now < due)
            continue;
        due = now + REAPER_PERIOD_MS;
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
    pthread_cond_init(&all->change, &monotonic);
    pthread_condattr_destroy(&monotonic);
    pthread_mutex_init(&all->lock, NULL);
    if (pthread_create(&all->reaper, NULL, reap, all) != 0) {
        pthread_cond_destroy(&all->change);
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
    pthread_cond_signal(&all->change);
    pthread_mutex_unlock(&all->lock);
    pthread_join(all->reaper, NULL);
    while (all->lingering_count > 0)
        close(all->lingering[--all->lingering_count].fd);
    pthread_cond_destroy(&all->change);
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
    pthread_mutex_unlock(&all->lock);
    return p;
}

void connection_linger(connection *p)
{
    p->lingers = true;
}

/* All of the answer is with the kernel. Under the lock. */
static void begin_lingering(const connection *p)
{
    connections *all = p->all;
    if (all->lingering_count == CONNECTIONS_LINGER)
        return;
    const int fd = fcntl(p->fd, F_DUPFD_CLOEXEC, 0);
    if (fd < 0)
        return;
    shutdown(fd, SHUT_WR); /* the client sees the end of the answer */
    all->lingering[all->lingering_count++] =
        (lingering){.fd = fd, .until_ms = clock_ms() + LINGER_MS};
    pthread_cond_signal(&all->change);
}

void connection_close(connection *p)
{
    connections *all = p->all;
    pthread_mutex_lock(&all->lock);
    if (p->lingers)
        begin_lingering(p);
    *(p->previous ? &p->previous->next : &all->first) = p->next;
    if (p->next)
        p->next->previous = p->previous;
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
