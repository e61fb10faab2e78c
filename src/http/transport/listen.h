/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The listening socket. */
#ifndef HTTP_TRANSPORT_LISTEN_H
#define HTTP_TRANSPORT_LISTEN_H

#include <stdbool.h>

#define LISTEN_NAME_SIZE 80

typedef struct listen_at {
    int fd;
    bool loopback;               /* only this machine can reach it */
    bool inherited;              /* other processes accept from it too: it outlives us */
    int port;                    /* the one taken if 0 was asked for */
    char name[LISTEN_NAME_SIZE]; /* "127.0.0.1:8080", "[::1]:8080" */
} listen_at;

/* Takes the socket passed by a service manager or a parent (systemd's protocol: descriptor 3,
 * LISTEN_FDS=1 and our LISTEN_PID). Otherwise binds "address:port" or "[address]:port". An
 * address that other machines can reach is refused unless `allow_any`. Returns false with
 * a sentence in `fault`. */
bool listen_open(const char *where, bool allow_any, listen_at *at, char fault[256]);
/* Tries whether listen_open could bind there, now or when it is free: a daemon may run. */
bool listen_check(const char *where, bool allow_any, char fault[256]);

#endif
