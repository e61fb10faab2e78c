/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * An answer sent in pieces as they become ready. The event thread asks for the next piece; if
 * there is none yet, the connection is suspended until stream_wake.
 */
#ifndef HTTP_TRANSPORT_STREAM_H
#define HTTP_TRANSPORT_STREAM_H

#include <microhttpd.h>
#include <stdatomic.h>
#include <stdint.h>

#include "json/strbuf.h"

struct connection;

typedef enum stream_turn {
    STREAM_PIECE, /* something was added to `out` */
    STREAM_WAIT,  /* nothing yet: stream_wake will be called */
    STREAM_END,   /* all was sent */
    STREAM_BROKEN /* the rest cannot be sent: the connection is cut, so that the client notices */
} stream_turn;

/* The first member of the object that owns it. */
typedef struct stream {
    /* On the event thread: adds the next piece to `out`. */
    stream_turn (*next)(struct stream *s);
    /* On the event thread: no more pieces are wanted; work under way is given up. */
    void (*end)(struct stream *s);
    void (*free)(struct stream *s); /* with the last reference */
    struct connection *connection;  /* of use to the event thread only */
    strbuf out;
    int64_t wait_until_ms; /* by clock_ms(): the latest that STREAM_WAIT may take */
    /* By clock_ms(): when a stream that waits is woken whatever happens; 0: never. */
    _Atomic int64_t pulse_at_ms;
    /* Why waiting was given up (never freed), or NULL: `next` then sends it and ends. */
    _Atomic(const char *) given_up;
    /* stream.c's own */
    size_t sent;
    uint64_t sent_of_all;
    int64_t handed_at_ms, reader_ms; /* when the last piece was handed on; time it all took */
    atomic_int handover;
    atomic_uint references;
} stream;

/* Starts with one reference, the caller's; the functions must be set. */
void stream_init(stream *s, struct connection *p);
void stream_ref(stream *s);
void stream_unref(stream *s);
/* Says that `next` may have a piece. From any thread that holds a reference. */
void stream_wake(stream *s);
void stream_give_up(stream *s, const char *why);
/* Returns its response, which holds a reference of its own, or NULL when memory ran out. */
struct MHD_Response *stream_response(stream *s);

#endif
