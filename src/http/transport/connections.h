/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The connections, and the reaper: a thread that closes those that pass their deadline.
 * libmicrohttpd's own timeout only ends silent connections; a client that sends a byte now and
 * then would stay forever.
 */
#ifndef HTTP_TRANSPORT_CONNECTIONS_H
#define HTTP_TRANSPORT_CONNECTIONS_H

#include <microhttpd.h>
#include <stdatomic.h>
#include <stdint.h>

#include "http/service/service.h"

typedef enum connection_phase {
    CONNECTION_IDLE,    /* between requests, or receiving headers */
    CONNECTION_READING, /* headers received, receiving the body */
    CONNECTION_WAITING, /* suspended until an answer is ready */
    CONNECTION_SENDING
} connection_phase;

struct request; /* known to the layer above only */

typedef struct connection {
    struct request *request; /* the one under way; owned */
    service *service;
    struct connections *all; /* that it is one of */
    struct MHD_Connection *mhd;
    int fd;
    _Atomic int64_t deadline_ms;
    _Atomic connection_phase
        phase;    /* to and from CONNECTION_WAITING under the lock of connections */
    bool lingers; /* connection_linger */
    struct connection *next, *previous;
} connection;

typedef struct connections connections;

/* Maximum number of connections that linger at once, beside those counted by the settings. */
#define CONNECTIONS_LINGER 256

/* What the layer above does with a connection's requests. On the event thread, but for
 * give_up. libmicrohttpd calls thrice for a request: with its headers, with pieces of its body,
 * and when all of it has come (again after a suspended connection is resumed). */
typedef struct handlers {
    /* Returns the memory for the connection's requests, or NULL. */
    struct request *(*open)(connection *p);
    void (*close)(struct request *r); /* frees it */
    enum MHD_Result (*begin)(connection *p, const char *url, const char *verb,
                             const char *version);
    enum MHD_Result (*body)(connection *p, const char *bytes, size_t size);
    enum MHD_Result (*finish)(connection *p);
    void (*end)(connection *p); /* the response was sent, or never will be */
    /* Answers a connection in CONNECTION_WAITING with 503 now, because of `why`. On the event
     * thread, or on another under the lock of connections. */
    void (*give_up)(connection *p, const char *why);
    /* Looks in on a connection in CONNECTION_WAITING, ten times a second, at clock_ms(); where
     * give_up is called. */
    void (*look_in)(connection *p, int64_t now_ms);
} handlers;

/* Returns NULL when memory or threads ran out. `s` and `h` must outlive it. */
connections *connections_new(service *s, const handlers *h);
/* Ends the reaper; all connections must have been closed. */
void connections_free(connections *all);

/* Returns NULL when memory ran out. */
connection *connection_open(connections *all, struct MHD_Connection *mhd);
/* Must be called before the descriptor is closed, so that the reaper no longer uses it. */
void connection_close(connection *p);
/* The answer is sent before the request was read whole: what still comes is read and dropped for a
 * while after the connection's end. Otherwise the kernel resets the connection, and the answer is
 * lost to a client, or a proxy, that sends all before it reads. */
void connection_linger(connection *p);
/* Begins the next phase, which must end within `seconds`. */
void connection_enter(connection *p, connection_phase phase, double seconds);
/* Gives up `p` if the daemon is stopping: to be called once it is in CONNECTION_WAITING. Either
 * this sees that the daemon stops, or connections_end_waiting sees the connection. */
void connection_end_if_stopping(connection *p);

/* The number of connections with a request under way. */
size_t connections_busy(connections *all);
/* Closes connections that have been idle for `seconds`. */
void connections_end_idle(connections *all, double seconds);
/* Answers every waiting connection with 503 now; solves that no client waits for any more are
 * cancelled. */
void connections_end_waiting(connections *all);

#endif
