/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The connections, and the reaper: a thread that cuts those which take too long.
 * libmicrohttpd's own timeout is one of silence only; a client that drips a byte now and then
 * would stay for ever.
 */
#ifndef HTTP_TRANSPORT_CONNECTIONS_H
#define HTTP_TRANSPORT_CONNECTIONS_H

#include "http/api/request.h"

typedef enum connection_phase {
    CONNECTION_IDLE,    /* between requests, or a request's headers are under way */
    CONNECTION_READING, /* headers are there, the body is under way */
    CONNECTION_WAITING, /* suspended until an answer is there */
    CONNECTION_SENDING
} connection_phase;

/* A connection and the request under way on it: owned by the connection. */
typedef struct connection {
    request request;
    struct server *server;
    struct MHD_Connection *mhd;
    int fd;
    _Atomic int64_t deadline_ms;
    _Atomic connection_phase
        phase; /* to and from CONNECTION_WAITING under the lock of connections */
    struct connection *next, *previous;
} connection;

typedef struct connections connections;

/* NULL when memory or threads ran out. */
connections *connections_new(struct server *s);
/* Ends the reaper; all connections must have been closed. */
void connections_free(connections *all);

/* A new connection; NULL when memory ran out. */
connection *connection_open(struct server *s, struct MHD_Connection *mhd);
/* Must be called before the descriptor is closed: the reaper then no longer uses it. */
void connection_close(connection *p);
/* The next phase, to end within `seconds`. */
void connection_enter(connection *p, connection_phase phase, double seconds);

/* How many there are, how many there ever were, and how many have a request under way. */
size_t connections_count(connections *all);
size_t connections_opened(connections *all);
size_t connections_busy(connections *all);
/* Ends connections that are idle and have been for `seconds`. */
void connections_end_idle(connections *all, double seconds);
/* Gives up all waiting: each gets 503 at once, and what nobody waits for any more is cancelled.
 */
void connections_end_waiting(connections *all);

#endif
