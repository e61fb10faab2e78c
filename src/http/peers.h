/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The connections, and the reaper: a thread that cuts those which take too long.
 * libmicrohttpd's own timeout is one of silence only; a client that drips a byte now and then
 * would stay for ever.
 */
#ifndef HTTP_PEERS_H
#define HTTP_PEERS_H

#include "http/request.h"

typedef enum peer_phase {
    PEER_IDLE,    /* between requests, or a request's headers are under way */
    PEER_READING, /* headers are there, the body is under way */
    PEER_WAITING, /* suspended until an answer is there */
    PEER_SENDING
} peer_phase;

/* A connection and the request under way on it: owned by the connection. */
typedef struct peer {
    request request;
    struct server *server;
    struct MHD_Connection *connection;
    int fd;
    _Atomic int64_t deadline_ms;
    _Atomic peer_phase phase; /* to and from PEER_WAITING under the lock of peers */
    struct peer *next, *previous;
} peer;

typedef struct peers peers;

/* NULL when memory or threads ran out. */
peers *peers_new(struct server *s);
/* Ends the reaper; all connections must have been closed. */
void peers_free(peers *all);

/* A new connection; NULL when memory ran out. */
peer *peer_open(struct server *s, struct MHD_Connection *connection);
/* Must be called before the descriptor is closed: the reaper then no longer uses it. */
void peer_close(peer *p);
/* The next phase, to end within `seconds`. */
void peer_enter(peer *p, peer_phase phase, double seconds);

/* How many there are, how many there ever were, and how many have a request under way. */
size_t peers_count(peers *all);
size_t peers_opened(peers *all);
size_t peers_busy(peers *all);
/* Ends connections that are idle and have been for `seconds`. */
void peers_end_idle(peers *all, double seconds);
/* Gives up all waiting: each gets 503 at once, and what nobody waits for any more is cancelled.
 */
void peers_end_waiting(peers *all);

#endif
