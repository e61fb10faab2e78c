/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/api/request.h"

#include <stdlib.h>
#include <string.h>

/* A larger buffer is not kept between the requests of a connection. */
#define BUFFER_KEEP 8192

request *request_open(connection *p)
{
    request *r = calloc(1, sizeof *r);
    if (r)
        r->connection = p;
    return r;
}

void request_close(request *r)
{
    problem_clear(&r->refusal);
    strbuf_clear(&r->body);
    strbuf_clear(&r->canonical);
    free(r);
}

void request_reset(request *r)
{
    connection *p = r->connection;
    const strbuf body = r->body, canonical = r->canonical;
    memset(r, 0, sizeof *r);
    r->connection = p;
    r->body = body;
    r->body.size = 0;
    r->canonical = canonical;
}

static void trim(strbuf *buffer)
{
    if (buffer->room > BUFFER_KEEP || buffer->failed)
        strbuf_clear(buffer);
}

void request_release(request *r)
{
    problem_clear(&r->refusal);
    entry_unref(r->outcome);
    r->outcome = NULL;
    stream_unref(r->stream);
    r->stream = NULL;
    trim(&r->body);
    trim(&r->canonical);
}
