/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/transport/server.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include "http/service/clock.h"
#include "http/service/log.h"
#include "http/service/notify.h"
#include "json/hex.h"

/* ---- what libmicrohttpd calls ---- */

static void on_connection(void *cls, struct MHD_Connection *mhd, void **context,
                          enum MHD_ConnectionNotificationCode code)
{
    server *s = cls;
    if (code == MHD_CONNECTION_NOTIFY_STARTED) {
        s->taken_up++;
        *context = connection_open(s->connections, mhd);
        return;
    }
    if (*context)
        connection_close(*context);
    *context = NULL;
    s->ended++;
}

static enum MHD_Result on_request(void *cls, struct MHD_Connection *mhd, const char *url,
                                  const char *verb, const char *version, const char *upload,
                                  size_t *upload_size, void **context)
{
    const server *s = cls;
    const handlers *h = s->handlers;
    connection *p = *context;
    if (!p) {
        const union MHD_ConnectionInfo *info =
            MHD_get_connection_info(mhd, MHD_CONNECTION_INFO_SOCKET_CONTEXT);
        p = info ? info->socket_context : NULL;
        if (!p)
            return MHD_NO; /* there was no memory for the connection */
        *context = p;
        return h->begin(p, url, verb, version);
    }
    if (*upload_size == 0)
        return h->finish(p);
    const enum MHD_Result result = h->body(p, upload, *upload_size);
    *upload_size = 0;
    return result;
}

static void on_completed(void *cls, struct MHD_Connection *mhd, void **context,
                         enum MHD_RequestTerminationCode code)
{
    const server *s = cls;
    (void)mhd;
    (void)code;
    if (*context)
        s->handlers->end(*context);
    *context = NULL;
}

/* Decodes in place. %00 is left as it is, because libmicrohttpd would end the string there
 * (/a%00b would be /a), and so are sequences that are no encoding. */
static size_t on_unescape(void *cls, struct MHD_Connection *mhd, char *at)
{
    (void)cls;
    (void)mhd;
    char *to = at;
    for (const char *from = at; *from;) {
        const int high = *from == '%' ? hex_digit(from[1]) : -1;
        const int low = high >= 0 ? hex_digit(from[2]) : -1;
        if (low >= 0 && high + low > 0) {
            *to++ = (char)(high << 4 | low);
            from += 3;
        } else {
            *to++ = *from++;
        }
    }
    *to = '\0';
    return (size_t)(to - at);
}

/* libmicrohttpd notes mistakes of clients: logged only if every request is. */
__attribute__((format(printf, 2, 0))) static void on_note(void *cls, const char *format,
                                                          va_list arguments)
{
    const server *s = cls;
    if (s->service->settings->log_requests != LOG_ALL)
        return;
    char note[256];
    vsnprintf(note, sizeof note, format, arguments);
    note[strcspn(note, "\n")] = '\0';
    log_say("debug", "libmicrohttpd", "%s", note);
}

/* ---- start ---- */

/* Maximum number of connections accepted in one go. */
#define ACCEPT_BURST 64

/* Asks for a descriptor for each connection, and some to spare. */
static void raise_file_limit(int64_t count)
{
    struct rlimit limit;
    const rlim_t wanted = (rlim_t)count + CONNECTIONS_LINGER + 64;
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= wanted)
        return;
    limit.rlim_cur = wanted < limit.rlim_max ? wanted : limit.rlim_max;
    if (setrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur < wanted)
        log_say("warning", "limit", "only %llu open files allowed, connections = %lld",
                (unsigned long long)limit.rlim_cur, (long long)count);
}

static struct MHD_Daemon *daemon_start(server *s)
{
    const settings *set = s->service->settings;
    const unsigned pool = set->event_threads > 1 ? (unsigned)set->event_threads : 0;
    const struct MHD_OptionItem options[] = {
        {MHD_OPTION_EXTERNAL_LOGGER, (intptr_t)on_note, s},
        {MHD_OPTION_NOTIFY_CONNECTION, (intptr_t)on_connection, s},
        {MHD_OPTION_NOTIFY_COMPLETED, (intptr_t)on_completed, s},
        {MHD_OPTION_UNESCAPE_CALLBACK, (intptr_t)on_unescape, s},
        /* Out of reach: at its own limit, libmicrohttpd 0.9.75 leaves a mutex locked, and its event
         * thread waits for it for ever. accept_some keeps the bound. */
        {MHD_OPTION_CONNECTION_LIMIT, INT_MAX, NULL},
        {MHD_OPTION_CONNECTION_MEMORY_LIMIT, (intptr_t)set->connection_memory_bytes, NULL},
        /* libmicrohttpd takes whole seconds; the reaper is exact. */
        {MHD_OPTION_CONNECTION_TIMEOUT, (intptr_t)ceil(set->idle_timeout_s), NULL},
        {pool ? MHD_OPTION_THREAD_POOL_SIZE : MHD_OPTION_END, (intptr_t)pool, NULL},
        {MHD_OPTION_END, 0, NULL}};
    return MHD_start_daemon(
        MHD_USE_EPOLL_INTERNAL_THREAD | MHD_ALLOW_SUSPEND_RESUME | MHD_USE_ERROR_LOG, 0, NULL,
        NULL, on_request, s, MHD_OPTION_ARRAY, options, MHD_OPTION_END);
}

bool server_start(server *s, service *with, const handlers *h, char fault[256])
{
    const settings *set = with->settings;
    *s = (server){.service = with, .handlers = h, .at.fd = -1};
    if (!listen_open(set->listen, set->allow_non_loopback || with->access, &s->at, fault))
        return false;
    with->local = s->at.loopback;
    raise_file_limit(set->connections);
    if (!(s->connections = connections_new(with, h))) {
        snprintf(fault, 256, "out of memory or threads");
        return false;
    }
    errno = 0;
    if (!(s->daemon = daemon_start(s))) {
        snprintf(fault, 256, "libmicrohttpd does not start: %s", strerror(errno));
        return false;
    }
    return true;
}

/* ---- accept ---- */

/* A connection accepted is taken up by an event thread within this time, or was lost. */
#define LOST_MS 10000

/* Connections handed over that no event thread has taken up yet. */
static size_t count_pending(const server *s)
{
    const size_t known = s->taken_up + s->lost;
    return s->accepted > known ? s->accepted - known : 0;
}

/* Connections accepted and not yet ended. */
static size_t count_open(const server *s)
{
    const size_t ended = s->ended; /* first: an end seen has its beginning */
    return s->taken_up - ended + count_pending(s);
}

/* Without memory libmicrohttpd closes a connection and tells nobody: it must not be counted for
 * ever. */
static void forget_lost(server *s)
{
    const size_t pending = count_pending(s);
    if (!pending)
        s->waits_since_ms = 0;
    else if (!s->waits_since_ms)
        s->waits_since_ms = clock_ms();
    else if (clock_ms() > s->waits_since_ms + LOST_MS)
        s->lost += pending;
}

static bool is_full(server *s)
{
    forget_lost(s);
    return count_open(s) >= (size_t)s->service->settings->connections;
}

/* We accept, not libmicrohttpd: its MHD_quiesce_daemon races with its own event threads for the
 * listening socket's place in their epoll sets, and the loser aborts the process. */
static bool accept_some(server *s)
{
    for (int i = 0; i < ACCEPT_BURST && !is_full(s); i++) {
        struct sockaddr_storage address;
        socklen_t size = sizeof address;
        const int fd =
            accept4(s->at.fd, (struct sockaddr *)&address, &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
        if (fd < 0)
            return errno == EAGAIN || errno == EINTR || errno == ECONNABORTED;
        /* libmicrohttpd closes a connection that it refuses. */
        if (!MHD_add_connection(s->daemon, fd, (struct sockaddr *)&address, size))
            return false;
        s->accepted++;
    }
    return true;
}

static void nap(void)
{
    nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
}

/* The shorter of two times for poll, of which -1 is endless. */
static int shorter(int a, int b)
{
    return a < 0 || (b >= 0 && b < a) ? b : a;
}

/* How often the end of a connection is looked for while there are too many. */
#define FULL_MS 10

/* Returns a signal that comes within `wait_ms` (-1: no limit), or 0. With `accepting`, accepts
 * new connections meanwhile. */
static int wait_signal(server *s, int signals, bool accepting, int wait_ms)
{
    for (;;) {
        /* Beyond the limit connections wait in the backlog. */
        const bool full = is_full(s);
        struct pollfd ready[] = {{.fd = signals, .events = POLLIN},
                                 {.fd = accepting && !full ? s->at.fd : -1, .events = POLLIN}};
        const int beat_ms = heartbeat_wait_ms(&s->heartbeat);
        poll(ready, 2, shorter(shorter(wait_ms, beat_ms), accepting && full ? FULL_MS : -1));
        struct signalfd_siginfo info;
        if (ready[0].revents && read(signals, &info, sizeof info) == sizeof info) {
            if (info.ssi_signo != SIGHUP)
                return (int)info.ssi_signo;
            service_reload(s->service);
        }
        if (ready[1].revents && !accept_some(s))
            nap(); /* no descriptors or no memory now: later there may be */
        if (!accepting)
            return 0;
        s->accepted += heartbeat_tick(&s->heartbeat, s->daemon);
    }
}

/* ---- stop ---- */

/* While draining, an idle connection stays open this long: its client may be about to send. */
#define IDLE_GRACE_S 1.0
/* Requests given up are answered within this time. */
#define LAST_WORDS_S 2.0
/* An event thread takes up a new connection within this time. */
#define TAKE_UP_S 1.0

static bool all_gone(server *s, double begin)
{
    const bool taken_up = count_pending(s) == 0 || clock_us() > begin + TAKE_UP_S * 1e6;
    return taken_up && s->taken_up == s->ended;
}

static bool drain(server *s, int signals, int got)
{
    const double begin = clock_us(), end = begin + s->service->settings->drain_timeout_s * 1e6;
    atomic_store(&s->service->draining, true);
    heartbeat_stop(&s->heartbeat);
    notify_manager("STOPPING=1");
    /* Clients already connected are served. Clients that connect from now on are refused, or,
     * where the socket is shared, wait in it for the next process. */
    while (!s->at.inherited && !is_full(s)) {
        struct pollfd ready = {.fd = s->at.fd, .events = POLLIN};
        if (poll(&ready, 1, 0) <= 0 || !accept_some(s))
            break;
    }
    close(s->at.fd);
    s->at.fd = -1;
    /* When this line is read it is true: not ready, and nothing listens. */
    log_say("info", "draining", "%s", strsignal(got));
    bool clean = true;
    while (!all_gone(s, begin)) {
        if (clock_us() > end || wait_signal(s, signals, false, 10)) {
            clean = connections_busy(s->connections) == 0;
            break;
        }
        heartbeat_draining(&s->heartbeat);
        connections_end_idle(s->connections, IDLE_GRACE_S);
    }
    /* MHD_stop_daemon aborts if a connection is suspended: none may be left, and none may come. */
    atomic_store(&s->service->stopping, true);
    const double last = clock_us() + LAST_WORDS_S * 1e6;
    do {
        connections_end_waiting(s->connections);
        nap();
    } while ((connections_busy(s->connections) || service_solving(s->service)) &&
             clock_us() < last);
    return clean;
}

bool server_run(server *s, int signals)
{
    heartbeat_start(&s->heartbeat, s->service->settings->event_threads);
    notify_manager("READY=1");
    return drain(s, signals, wait_signal(s, signals, true, -1));
}

void server_free(server *s)
{
    heartbeat_stop(&s->heartbeat);
    if (s->daemon)
        MHD_stop_daemon(s->daemon);
    connections_free(s->connections);
    if (s->at.fd >= 0)
        close(s->at.fd);
}
