/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/transport/stream.h"

#include <math.h>
#include <string.h>

#include "http/service/clock.h"
#include "http/transport/connections.h"

/* Maximum number of bytes copied to libmicrohttpd in one go. */
#define STREAM_BLOCK 16384

enum { HANDOVER_NONE, HANDOVER_SUSPENDED, HANDOVER_WOKEN };

void stream_init(stream *s, connection *p)
{
    s->connection = p;
    s->references = 1;
    s->wait_until_ms = clock_ms() + (int64_t)(p->service->settings->solve_timeout_s * 1000);
}

void stream_ref(stream *s)
{
    atomic_fetch_add(&s->references, 1);
}

void stream_unref(stream *s)
{
    if (!s || atomic_fetch_sub(&s->references, 1) > 1)
        return;
    strbuf_clear(&s->out);
    s->free(s);
}

void stream_wake(stream *s)
{
    /* A suspended connection stays until it is resumed. */
    if (atomic_exchange(&s->handover, HANDOVER_WOKEN) == HANDOVER_SUSPENDED)
        MHD_resume_connection(s->connection->mhd);
}

void stream_give_up(stream *s, const char *why)
{
    atomic_store(&s->given_up, why);
    stream_wake(s);
}

static void suspend(stream *s)
{
    connection *p = s->connection;
    MHD_suspend_connection(p->mhd);
    connection_enter(p, CONNECTION_WAITING, (double)(s->wait_until_ms - clock_ms()) / 1000);
    connection_end_if_stopping(p);
    int none = HANDOVER_NONE;
    if (!atomic_compare_exchange_strong(&s->handover, &none, HANDOVER_SUSPENDED))
        MHD_resume_connection(p->mhd);
}

/* Seconds that the client has for the next piece: request_timeout_s, or less where all pieces so
 * far took nearly as long as the minimum rate allows them. */
static double time_for_piece(stream *s)
{
    const settings *set = s->connection->service->settings;
    const int64_t now = clock_ms();
    if (s->handed_at_ms != 0)
        s->reader_ms += now - s->handed_at_ms;
    s->handed_at_ms = 0;
    if (set->stream_bytes_per_s == 0)
        return set->request_timeout_s;
    const double used = (double)s->reader_ms / 1000;
    const double allowed =
        set->request_timeout_s + (double)s->sent_of_all / (double)set->stream_bytes_per_s;
    return fmin(set->request_timeout_s, fmax(0, allowed - used));
}

static ssize_t read_piece(void *cls, uint64_t position, char *to, size_t room)
{
    (void)position;
    stream *s = cls;
    connection_enter(s->connection, CONNECTION_SENDING, time_for_piece(s));
    while (s->sent == s->out.size) {
        s->out.size = s->sent = 0;
        /* What comes after this is seen by `next`, or wakes the stream. */
        atomic_store(&s->handover, HANDOVER_NONE);
        const stream_turn turn = s->next(s);
        if (turn == STREAM_BROKEN || s->out.failed)
            return MHD_CONTENT_READER_END_WITH_ERROR;
        if (turn == STREAM_END)
            return MHD_CONTENT_READER_END_OF_STREAM;
        if (turn == STREAM_WAIT) {
            suspend(s);
            return 0;
        }
    }
    const size_t left = s->out.size - s->sent, size = left < room ? left : room;
    memcpy(to, s->out.data + s->sent, size);
    s->sent += size;
    s->sent_of_all += size;
    s->handed_at_ms = clock_ms();
    return (ssize_t)size;
}

static void end(void *cls)
{
    stream *s = cls;
    s->end(s);
    stream_unref(s);
}

struct MHD_Response *stream_response(stream *s)
{
    struct MHD_Response *response =
        MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, STREAM_BLOCK, read_piece, s, end);
    if (response)
        stream_ref(s);
    return response;
}
