/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/transport/server.h"

#include <errno.h>
#include <math.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <sys/random.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "http/transport/clock.h"
#include "http/transport/log.h"
#include "http/api/reply.h"

/* ---- what libmicrohttpd calls ---- */

static void on_connection(void *cls, struct MHD_Connection *mhd, void **context,
                          enum MHD_ConnectionNotificationCode code)
{
    if (code == MHD_CONNECTION_NOTIFY_STARTED) {
        *context = connection_open(cls, mhd);
    } else if (*context) {
        connection_close(*context);
        *context = NULL;
    }
}

static enum MHD_Result on_request(void *cls, struct MHD_Connection *mhd, const char *url,
                                  const char *verb, const char *version, const char *upload,
                                  size_t *upload_size, void **context)
{
    (void)cls;
    connection *p = *context;
    if (!p) {
        const union MHD_ConnectionInfo *info =
            MHD_get_connection_info(mhd, MHD_CONNECTION_INFO_SOCKET_CONTEXT);
        p = info ? info->socket_context : NULL;
        if (!p)
            return MHD_NO; /* there was no memory for the connection */
        *context = p;
        return request_begin(p, url, verb, version);
    }
    if (*upload_size == 0)
        return request_finish(p);
    const enum MHD_Result result = request_body(p, upload, *upload_size);
    *upload_size = 0;
    return result;
}

static void on_completed(void *cls, struct MHD_Connection *mhd, void **context,
                         enum MHD_RequestTerminationCode code)
{
    (void)cls;
    (void)mhd;
    (void)code;
    if (*context)
        request_end(*context);
    *context = NULL;
}

static int hex_value(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    c |= 0x20;
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/* Decodes in place. %00 stays as it is, for libmicrohttpd would end the string there: /a%00b
 * would be /a. So does what is no encoding. */
static size_t on_unescape(void *cls, struct MHD_Connection *mhd, char *at)
{
    (void)cls;
    (void)mhd;
    char *to = at;
    for (const char *from = at; *from;) {
        const int high = *from == '%' ? hex_value(from[1]) : -1;
        const int low = high >= 0 ? hex_value(from[2]) : -1;
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

/* Its own notes are about what clients do wrong: they are for those who log every request. */
__attribute__((format(printf, 2, 0))) static void on_note(void *cls, const char *format,
                                                          va_list arguments)
{
    const server *s = cls;
    if (s->settings->log_requests != LOG_ALL)
        return;
    char note[256];
    vsnprintf(note, sizeof note, format, arguments);
    note[strcspn(note, "\n")] = '\0';
    log_say("debug", "libmicrohttpd", "%s", note);
}

/* ---- start ---- */

/* A page or a test that asks a dozen things at once is no overload. */
#define QUEUE_FOR_EACH 16
/* So many connections are accepted in one go. */
#define ACCEPT_BURST 64

/* A descriptor for every connection, and some to spare. */
static void raise_file_limit(int64_t count)
{
    struct rlimit limit;
    const rlim_t wanted = (rlim_t)count + 64;
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= wanted)
        return;
    limit.rlim_cur = wanted < limit.rlim_max ? wanted : limit.rlim_max;
    if (setrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur < wanted)
        log_say("warning", "limit", "only %llu open files allowed, connections = %lld",
                (unsigned long long)limit.rlim_cur, (long long)count);
}

static struct MHD_Daemon *daemon_start(server *s)
{
    const settings *set = s->settings;
    const unsigned pool = set->event_threads > 1 ? (unsigned)set->event_threads : 0;
    const struct MHD_OptionItem options[] = {
        {MHD_OPTION_EXTERNAL_LOGGER, (intptr_t)on_note, s},
        {MHD_OPTION_NOTIFY_CONNECTION, (intptr_t)on_connection, s},
        {MHD_OPTION_NOTIFY_COMPLETED, (intptr_t)on_completed, s},
        {MHD_OPTION_UNESCAPE_CALLBACK, (intptr_t)on_unescape, s},
        /* We stop accepting at the limit; what is accepted in one go then is not refused. */
        {MHD_OPTION_CONNECTION_LIMIT, (intptr_t)set->connections + ACCEPT_BURST, NULL},
        {MHD_OPTION_CONNECTION_MEMORY_LIMIT, (intptr_t)set->connection_memory_bytes, NULL},
        /* Whole seconds here; the reaper is exact. */
        {MHD_OPTION_CONNECTION_TIMEOUT, (intptr_t)ceil(set->idle_timeout_s), NULL},
        {pool ? MHD_OPTION_THREAD_POOL_SIZE : MHD_OPTION_END, (intptr_t)pool, NULL},
        {MHD_OPTION_END, 0, NULL}};
    return MHD_start_daemon(
        MHD_USE_EPOLL_INTERNAL_THREAD | MHD_ALLOW_SUSPEND_RESUME | MHD_USE_ERROR_LOG, 0, NULL,
        NULL, on_request, s, MHD_OPTION_ARRAY, options, MHD_OPTION_END);
}

static void note_store(bool away, const char *why)
{
    if (away)
        log_say("warning", "store away", "the shared store is left alone for a while: %s", why);
    else
        log_say("info", "store", "the shared store answers");
}

static store *open_store(const settings *set, int workers, char fault[256])
{
    const bool local = strncmp(set->store, "unix:/", 6) == 0;
    const char *path = local ? set->store + 5 : "";
    char host[256] = "", port[16];
    if (local ? strlen(path) >= sizeof((struct sockaddr_un){0}).sun_path
              : !listen_split(set->store, host, port)) {
        snprintf(fault, 256,
                 "store must be address:port, [address]:port or unix:/path, not "
                 "\"%.100s\"",
                 set->store);
        return NULL;
    }
    return store_new(&(store_options){.host = host,
                                      .port = local ? path : port,
                                      .secret_file = set->store_secret_file,
                                      .password_file = set->store_password_file,
                                      .wait_ms = (int)set->store_timeout_ms,
                                      .expiry_s = set->store_expiry_s,
                                      .connections = workers,
                                      .turned = note_store},
                     fault);
}

bool server_start(server *s, const settings *set, char fault[256])
{
    *s = (server){.settings = set, .at.fd = -1};
    if (*set->token_file && !(s->access = access_read(set->token_file, fault)))
        return false;
    if (!listen_open(set->listen, set->allow_non_loopback || s->access, &s->at, fault))
        return false;
    raise_file_limit(set->connections);
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    const int workers = set->workers ? (int)set->workers : cores > 1 ? (int)cores : 1;
    s->queue_depth =
        set->queue_depth ? (size_t)set->queue_depth : QUEUE_FOR_EACH * (size_t)workers;
    if (*set->store && !(s->store = open_store(set, workers, fault)))
        return false;
    if (getrandom(&s->id_prefix, sizeof s->id_prefix, GRND_NONBLOCK) < 0)
        s->id_prefix = (uint32_t)clock_us();
    snprintf(fault, 256, "out of memory or threads");
    if (!(s->no_memory = reply_no_memory()) || !(s->metrics = metrics_new()) ||
        !(s->cache = cache_new((size_t)set->cache_bytes)) ||
        !(s->thread_pool = thread_pool_new(workers, s->queue_depth)) ||
        !(s->connections = connections_new(s)))
        return false;
    errno = 0;
    if (!(s->daemon = daemon_start(s))) {
        snprintf(fault, 256, "libmicrohttpd does not start: %s", strerror(errno));
        return false;
    }
    return true;
}

/* ---- accept ---- */

/* We accept, not libmicrohttpd: its MHD_quiesce_daemon races with its own event threads for the
 * listening socket's place in their epoll sets, and the loser aborts the process. */
static bool accept_some(server *s)
{
    for (int i = 0; i < ACCEPT_BURST; i++) {
        struct sockaddr_storage address;
        socklen_t size = sizeof address;
        const int fd =
            accept4(s->at.fd, (struct sockaddr *)&address, &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
        if (fd < 0)
            return errno == EAGAIN || errno == EINTR || errno == ECONNABORTED;
        /* Refused, it was closed. */
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

/* A signal, if there is one within `wait_ms` (-1: however long), or 0. With `accepting` new
 * connections are accepted meanwhile. */
static int wait_signal(server *s, int signals, bool accepting, int wait_ms)
{
    for (;;) {
        /* Beyond the limit connections wait in the backlog. */
        const bool full = connections_count(s->connections) >= (size_t)s->settings->connections;
        struct pollfd ready[] = {{.fd = signals, .events = POLLIN},
                                 {.fd = accepting && !full ? s->at.fd : -1, .events = POLLIN}};
        poll(ready, 2, accepting && full ? 10 : wait_ms);
        struct signalfd_siginfo info;
        if (ready[0].revents && read(signals, &info, sizeof info) == sizeof info)
            return (int)info.ssi_signo;
        if (ready[1].revents && !accept_some(s))
            nap(); /* no descriptors or no memory now: later there may be */
        if (!accepting)
            return 0;
    }
}

/* ---- stop ---- */

/* So long an idle connection is left open while draining: its client may just be sending. */
#define IDLE_GRACE_S 1.0
/* What was given up is answered within this time. */
#define LAST_WORDS_S 2.0
/* Within this time an event thread has taken up a new connection. */
#define TAKE_UP_S 1.0

static bool all_gone(server *s, double begin)
{
    const bool taken_up = connections_opened(s->connections) >= s->accepted ||
                          clock_us() > begin + TAKE_UP_S * 1e6;
    return taken_up && connections_count(s->connections) == 0;
}

static bool drain(server *s, int signals, int got)
{
    const double begin = clock_us(), end = begin + s->settings->drain_timeout_s * 1e6;
    atomic_store(&s->draining, true);
    /* Who is connected already is served; who connects from now on is refused, or, where the
     * socket is shared, waits in it for whoever comes after us. */
    while (!s->at.inherited &&
           connections_count(s->connections) < (size_t)s->settings->connections) {
        struct pollfd ready = {.fd = s->at.fd, .events = POLLIN};
        if (poll(&ready, 1, 0) <= 0 || !accept_some(s))
            break;
    }
    close(s->at.fd);
    s->at.fd = -1;
    /* Who reads this line finds it so: not ready, and nothing listens. */
    log_say("info", "draining", "%s", strsignal(got));
    bool clean = true;
    while (!all_gone(s, begin)) {
        if (clock_us() > end || wait_signal(s, signals, false, 10)) {
            clean = connections_busy(s->connections) == 0;
            break;
        }
        connections_end_idle(s->connections, IDLE_GRACE_S);
    }
    /* A suspended connection would make MHD_stop_daemon abort: none may be left, or come. */
    atomic_store(&s->stopping, true);
    const double last = clock_us() + LAST_WORDS_S * 1e6;
    do {
        connections_end_waiting(s->connections);
        nap();
    } while ((connections_busy(s->connections) || server_solving(s)) && clock_us() < last);
    return clean;
}

bool server_solving(server *s)
{
    return thread_pool_count(s->thread_pool).working > 0;
}

bool server_run(server *s, int signals)
{
    return drain(s, signals, wait_signal(s, signals, true, -1));
}

void server_free(server *s)
{
    if (s->daemon)
        MHD_stop_daemon(s->daemon);
    thread_pool_free(s->thread_pool);
    connections_free(s->connections);
    cache_free(s->cache);
    store_free(s->store);
    metrics_free(s->metrics);
    access_free(s->access);
    if (s->no_memory)
        MHD_destroy_response(s->no_memory);
    if (s->at.fd >= 0)
        close(s->at.fd);
}
