/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * One request, from its first header to its answer. libmicrohttpd calls three times: with the
 * headers (request_begin), with pieces of the body (request_body), and when all is there
 * (request_finish; again after a suspended connection is resumed).
 */
#ifndef HTTP_API_REQUEST_H
#define HTTP_API_REQUEST_H

#include <microhttpd.h>

#include "cache/cache.h"
#include "http/api/route.h"
#include "http/transport/stream.h"

#define REQUEST_ID_SIZE 72

typedef struct request {
    method method;
    route route;
    char url[96]; /* for messages: printable, cut */
    /* headers that matter; libmicrohttpd's, valid as long as the request */
    const char *origin, *if_none_match, *accept, *accept_method;
    const char *traceparent;  /* W3C Trace Context; NULL: none, or none that can be read */
    char id[REQUEST_ID_SIZE]; /* X-Request-Id; empty until one is needed */
    bool close;               /* the connection ends with the answer */
    bool is_lines;            /* the body is application/x-ndjson */
    bool counted;             /* among server.batches */
    bool given_id;            /* the client gave it: it is always returned */
    strbuf body;
    uint64_t body_seen; /* bytes that came, kept or not */
    problem refusal;    /* status 0: none so far */
    /* the way to an answer (ask.c) */
    waiter waiter;
    atomic_int handover; /* between the event thread and whoever wakes it */
    entry *outcome;      /* referenced */
    stream *stream;      /* referenced; NULL: the answer comes in one piece */
    strbuf canonical;
    double read_us;
    bool collapsed;
    double began_us;
} request;

struct connection;

enum MHD_Result request_begin(struct connection *p, const char *url, const char *verb,
                              const char *version);
enum MHD_Result request_body(struct connection *p, const char *bytes, size_t size);
enum MHD_Result request_finish(struct connection *p);
/* The answer was sent, or never will be. */
void request_end(struct connection *p);
/* Frees what requests of this connection kept for reuse. */
void request_clear(request *r);

#endif
