/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/service/service.h"

#include <stdio.h>
#include <string.h>
#include <sys/random.h>
#include <sys/un.h>
#include <unistd.h>

#include "endpoints/endpoint.h"
#include "http/service/address.h"
#include "http/service/clock.h"
#include "http/service/log.h"

/* A page or a test that sends a dozen requests at once is no overload. */
#define QUEUE_PER_WORKER 16

static void note_store(bool away, const char *why)
{
    if (away)
        log_say("warning", "store away", "the shared store is left alone for a while: %s", why);
    else
        log_say("info", "store", "the shared store answers");
}

static store *open_store(const settings *set, int workers, char fault[256])
{
    const bool local = strncmp(set->store, "unix:/", 6) == 0;
    const char *path = local ? set->store + 5 : "";
    char host[256] = "", port[16];
    if (local ? strlen(path) >= sizeof((struct sockaddr_un){0}).sun_path
              : !address_split(set->store, host, port)) {
        snprintf(fault, 256,
                 "store must be address:port, [address]:port or unix:/path, not "
                 "\"%.100s\"",
                 set->store);
        return NULL;
    }
    return store_new(&(store_options){.host = host,
                                      .port = local ? path : port,
                                      .secret_file = set->store_secret_file,
                                      .password_file = set->store_password_file,
                                      .wait_ms = (int)set->store_timeout_ms,
                                      .expiry_s = set->store_expiry_s,
                                      .connections = workers,
                                      .turned = note_store},
                     fault);
}

bool service_start(service *s, const settings *set, size_t routes,
                   const char *(*path)(size_t index), char fault[256])
{
    *s = (service){.settings = set};
    evaluation_limit_answers((size_t)set->answer_bytes);
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    const int workers = set->workers ? (int)set->workers : cores > 1 ? (int)cores : 1;
    const size_t depth =
        set->queue_depth ? (size_t)set->queue_depth : QUEUE_PER_WORKER * (size_t)workers;
    if (*set->token_file && !(s->access = access_read(set->token_file, fault)))
        return false;
    if (*set->store && !(s->store = open_store(set, workers, fault)))
        return false;
    if (getrandom(&s->id_prefix, sizeof s->id_prefix, GRND_NONBLOCK) < 0)
        s->id_prefix = (uint32_t)clock_us();
    snprintf(fault, 256, "out of memory or threads");
    return (s->metrics = metrics_new(routes, path)) &&
           (s->cache = cache_new((size_t)set->cache_bytes)) &&
           (s->thread_pool = thread_pool_new(workers, depth));
}

bool service_solving(const service *s)
{
    return thread_pool_count(s->thread_pool).working > 0;
}

void service_free(service *s)
{
    thread_pool_free(s->thread_pool);
    cache_free(s->cache);
    store_free(s->store);
    metrics_free(s->metrics);
    access_free(s->access);
}
