/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The watchdog of a service manager is fed only while every event thread answers: each gets a
 * connection of its own, inside this process, with GET /livez. Silence from one of them, and the
 * manager restarts the daemon. All on the main thread.
 */
#ifndef HTTP_TRANSPORT_HEARTBEAT_H
#define HTTP_TRANSPORT_HEARTBEAT_H

#include <microhttpd.h>
#include <stddef.h>
#include <stdint.h>

#define HEARTBEAT_THREADS 64

typedef struct heartbeat {
    int64_t period_ms; /* 0: nobody asks for it */
    int64_t due_ms;    /* the next one, by clock_ms() */
    int threads;
    int asked; /* connections open */
    int fds[HEARTBEAT_THREADS];
} heartbeat;

void heartbeat_start(heartbeat *h, int64_t event_threads);
/* Returns for how long heartbeat_tick has nothing to do; -1: for ever. */
int heartbeat_wait_ms(const heartbeat *h);
/* Asks what is due to be asked, and tells the manager when all have answered. Returns the number
 * of connections it handed to `daemon`. */
size_t heartbeat_tick(heartbeat *h, struct MHD_Daemon *daemon);
/* Asks no more. */
void heartbeat_stop(heartbeat *h);
/* While the daemon drains, which has an end of its own: tells the manager without asking. */
void heartbeat_draining(heartbeat *h);

#endif
