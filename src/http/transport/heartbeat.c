/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/transport/heartbeat.h"

#include <fcntl.h>
#include <stdbool.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "http/service/clock.h"
#include "http/service/notify.h"

/* Between two looks for an answer. */
#define LOOK_MS 10

static const char question[] =
    "GET /livez HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";

void heartbeat_start(heartbeat *h, int64_t event_threads)
{
    /* Three chances within the manager's time. */
    *h = (heartbeat){.period_ms = notify_watchdog_ms() / 3,
                     .due_ms = clock_ms(),
                     .threads = (int)event_threads};
}

int heartbeat_wait_ms(const heartbeat *h)
{
    if (!h->period_ms)
        return -1;
    if (h->asked)
        return LOOK_MS;
    const int64_t left = h->due_ms - clock_ms();
    return left > 0 ? (int)left : 0;
}

/* Hands `fd` over so that event thread `i` gets it: libmicrohttpd takes the descriptor modulo the
 * number of its threads. */
static bool hand_over(struct MHD_Daemon *daemon, int fd, int i, int threads)
{
    const struct sockaddr local = {.sa_family = AF_UNIX};
    while (fd >= 0 && fd % threads != i) {
        const int next = fcntl(fd, F_DUPFD_CLOEXEC, fd + 1);
        close(fd);
        fd = next;
    }
    /* It closes what it refuses. */
    return fd >= 0 && MHD_add_connection(daemon, fd, &local, sizeof local) == MHD_YES;
}

static size_t ask(heartbeat *h, struct MHD_Daemon *daemon)
{
    int pair[2];
    size_t handed = 0;
    while (h->asked < h->threads) {
        if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, pair) != 0)
            break;
        h->fds[h->asked] = pair[0];
        const bool good = hand_over(daemon, pair[1], h->asked++, h->threads);
        handed += good;
        if (!good || send(pair[0], question, sizeof question - 1, MSG_NOSIGNAL) < 0)
            break;
    }
    return handed;
}

/* Whether the i-th has answered. A connection that ended without an answer stays unanswered. */
static bool has_answered(heartbeat *h, int i)
{
    static const char good[] = "HTTP/1.1 200 ";
    char head[sizeof good - 1];
    if (h->fds[i] < 0)
        return true;
    if (recv(h->fds[i], head, sizeof head, MSG_DONTWAIT) != sizeof head ||
        memcmp(head, good, sizeof head) != 0)
        return false;
    close(h->fds[i]);
    h->fds[i] = -1;
    return true;
}

size_t heartbeat_tick(heartbeat *h, struct MHD_Daemon *daemon)
{
    if (!h->period_ms)
        return 0;
    const int64_t now = clock_ms();
    int answered = 0;
    for (int i = 0; i < h->asked; i++)
        answered += has_answered(h, i);
    if (h->asked && answered == h->threads) {
        notify_manager("WATCHDOG=1");
        h->asked = 0;
    }
    if (now < h->due_ms)
        return 0;
    /* What was not answered in time may have been refused for want of memory: asked again. */
    heartbeat_stop(h);
    h->due_ms = now + h->period_ms;
    return ask(h, daemon);
}

void heartbeat_stop(heartbeat *h)
{
    while (h->asked > 0)
        if (h->fds[--h->asked] >= 0)
            close(h->fds[h->asked]);
}

void heartbeat_draining(heartbeat *h)
{
    if (!h->period_ms || clock_ms() < h->due_ms)
        return;
    h->due_ms = clock_ms() + h->period_ms;
    notify_manager("WATCHDOG=1");
}
