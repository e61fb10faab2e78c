/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The request under way on a connection: what its headers and its body say, and its way to an
 * answer. */
#ifndef HTTP_API_REQUEST_H
#define HTTP_API_REQUEST_H

#include "cache/cache.h"
#include "http/api/route.h"
#include "http/api/target.h"
#include "http/transport/connections.h"
#include "http/transport/stream.h"

#define REQUEST_ID_SIZE 72

typedef struct request {
    connection *connection; /* its own, for as long as that lives */
    method method;
    route route;
    target target;
    char url[96]; /* its path, for messages: printable, cut */
    /* headers that matter; libmicrohttpd's, valid as long as the request */
    const char *origin, *if_none_match, *accept, *accept_method;
    const char *traceparent;  /* W3C Trace Context; NULL: none, or none that can be read */
    char id[REQUEST_ID_SIZE]; /* X-Request-Id; empty until one is needed */
    bool close;               /* the connection ends with the answer */
    bool is_lines;            /* the body is application/x-ndjson */
    bool counted;             /* among service.batches */
    bool given_id;            /* the client gave it: it is always returned */
    unsigned client;          /* who asks (service/client.h) */
    strbuf body;
    size_t body_counted; /* bytes counted by memory_take_body */
    uint64_t body_seen;  /* bytes received, kept or not */
    problem refusal;     /* status 0: none so far */
    /* the way to an answer (solve_handler.c) */
    waiter waiter;
    atomic_int handover; /* between the event thread and the thread that wakes it */
    entry *outcome;      /* referenced */
    stream *stream;      /* referenced; NULL: the answer comes in one piece */
    strbuf canonical;
    double read_us;
    bool collapsed;
    double began_us;
} request;

/* Returns the memory for the requests of one connection, or NULL. */
request *request_open(connection *p);
void request_close(request *r);
/* Empties it for the next request; buffers are kept for reuse. */
void request_reset(request *r);
/* Ends it: drops what it refers to, and buffers that are too large to keep. */
void request_release(request *r);

#endif
