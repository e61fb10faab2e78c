/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The running daemon: what all of src/http shares. */
#ifndef HTTP_TRANSPORT_SERVER_H
#define HTTP_TRANSPORT_SERVER_H

#include <microhttpd.h>

#include "cache/store.h"
#include "http/service/access.h"
#include "http/service/thread_pool.h"
#include "http/transport/listen.h"
#include "http/service/metrics.h"
#include "http/transport/connections.h"
#include "http/service/settings.h"

typedef struct server {
    const settings *settings;
    listen_at at;
    struct MHD_Daemon *daemon;
    struct MHD_Response *no_memory; /* sent when nothing else can be made */
    cache *cache;
    store *store;        /* NULL: no store is store */
    access_list *access; /* NULL: everybody may ask */
    thread_pool *thread_pool;
    connections *connections;
    metrics *metrics;
    size_t queue_depth;
    atomic_int batches; /* under way */
    size_t accepted;    /* connections handed to libmicrohttpd */
    uint32_t id_prefix; /* of request ids, so that two runs' ids differ */
    atomic_uint id_next;
    atomic_uint_fast64_t logged; /* requests that went well and might be logged */
    _Atomic bool draining;       /* no new connections; answers close theirs */
    _Atomic bool stopping;       /* nobody may wait any more */
} server;

/* Binds and gets all ready. False with a sentence in `fault`; end with server_free in either
 * case. `settings` must outlive the server. */
bool server_start(server *s, const settings *settings, char fault[256]);
/* Accepts and serves until a signal comes from `signals` (signalfd); then refuses new work and
 * finishes what is under way, at the latest after drain_timeout_s or at a second signal. True
 * when nothing was cut short. */
bool server_run(server *s, int signals);
/* Whether a worker is at work still. Some of the mechanics cannot be interrupted. */
bool server_solving(server *s);
void server_free(server *s);

#endif
