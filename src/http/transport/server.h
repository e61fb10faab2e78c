/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The listening socket, its connections, and their end: what the process owns. */
#ifndef HTTP_TRANSPORT_SERVER_H
#define HTTP_TRANSPORT_SERVER_H

#include "http/transport/connections.h"
#include "http/transport/heartbeat.h"
#include "http/transport/listen.h"

typedef struct server {
    service *service;
    const handlers *handlers;
    listen_at at;
    struct MHD_Daemon *daemon;
    connections *connections;
    /* Connections ever handed to libmicrohttpd (the main thread alone counts them), those that its
     * threads took up, those that ended, and those that it dropped without a word, since there was
     * no memory. */
    size_t accepted;
    atomic_size_t taken_up, ended;
    size_t lost;
    int64_t waits_since_ms; /* some are not taken up since then; 0: all are */
    heartbeat heartbeat;
} server;

/* Binds and gets all ready. Returns false with a sentence in `fault`; end with server_free in
 * either case. `service` and `handlers` must outlive the server. */
bool server_start(server *s, service *service, const handlers *handlers, char fault[256]);
/* Accepts and serves until a signal comes from `signals` (signalfd), SIGHUP aside, which
 * has it read its tokens again; then refuses new
 * connections and finishes the requests under way, within drain_timeout_s or until a second
 * signal. Returns true if none was cut short. */
bool server_run(server *s, int signals);
void server_free(server *s);

#endif
