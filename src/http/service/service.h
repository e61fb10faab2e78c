/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What all requests share, whatever connection they come by. */
#ifndef HTTP_SERVICE_SERVICE_H
#define HTTP_SERVICE_SERVICE_H

#include <stdatomic.h>

#include "cache/store.h"
#include "http/service/access.h"
#include "http/service/memory.h"
#include "http/service/metrics.h"
#include "http/service/settings.h"
#include "http/service/thread_pool.h"

struct MHD_Response;
struct page;

typedef struct service {
    const settings *settings;
    cache *cache;
    store *store;        /* NULL: no shared store is set */
    access_list *access; /* NULL: no token is needed */
    thread_pool *thread_pool;
    metrics *metrics;
    memory_account memory;
    /* Set by the layers above: */
    bool local;                     /* only this machine can reach the listening socket */
    const struct page *pages;       /* the paths served beside the endpoints */
    struct MHD_Response *no_memory; /* sent when no other response can be made */
    atomic_int batches;             /* under way */
    atomic_int batches_of[CLIENTS]; /* of each client */
    uint32_t id_prefix;             /* of request ids, so that two runs' ids differ */
    atomic_uint id_next;
    atomic_uint_fast64_t logged; /* successful requests, counted for log_sample */
    _Atomic bool draining;       /* no new connections; each response closes its connection */
    _Atomic bool stopping;       /* no request may wait any more */
} service;

/* Opens all that `settings` asks for. `routes` and `path` are those of metrics_new. `settings`
 * must outlive the service. Returns false with a sentence in `fault`; end with service_free in
 * either case. */
bool service_start(service *s, const settings *settings, size_t routes,
                   const char *(*path)(size_t index), char fault[256]);
/* Tries the files and addresses that service_start would need: a line in `faults` for each that would
 * keep it from starting, one in `notes` for each that would only be missed. */
void service_check(const settings *settings, strbuf *faults, strbuf *notes);
/* Reads again what may change while requests are served: the tokens. */
void service_reload(service *s);
/* Finishes the work in the queue first. */
void service_free(service *s);
/* Whether a worker still solves: some of the mechanics cannot be interrupted. */
bool service_solving(const service *s);

#endif
