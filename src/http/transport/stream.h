/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * An answer that is sent in pieces as they come. The event thread asks for the next piece;
 * where there is none yet, the connection is suspended until stream_wake.
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
    STREAM_WAIT,  /* nothing now: stream_wake will be called */
    STREAM_END,   /* all was sent */
    STREAM_BROKEN /* the rest cannot be sent: the connection is cut, so that it shows */
} stream_turn;

/* The beginning of what owns it. */
typedef struct stream {
    /* On the event thread: adds the next piece to `out`. */
    stream_turn (*next)(struct stream *s);
    /* On the event thread: no more pieces are wanted. What is under way is given up. */
    void (*end)(struct stream *s);
    void (*free)(struct stream *s); /* with the last reference */
    struct connection *connection;  /* of use to the event thread only */
    strbuf out;
    int64_t wait_until_ms; /* by clock_ms(): the latest that STREAM_WAIT may take */
    /* Why nobody shall wait any more (never freed), or NULL: `next` ends with it. */
    _Atomic(const char *) given_up;
    /* stream.c's own */
    size_t sent;
    atomic_int handover;
    atomic_uint references;
} stream;

/* With one reference, the caller's; the functions must be set. */
void stream_init(stream *s, struct connection *p);
void stream_ref(stream *s);
void stream_unref(stream *s);
/* There may be something for `next`. From any thread that holds a reference. */
void stream_wake(stream *s);
void stream_give_up(stream *s, const char *why);
/* Its response, which holds a reference of its own; NULL when memory ran out. */
struct MHD_Response *stream_response(stream *s);

#endif
