/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/service/service.h"

#include <netdb.h> /* getaddrinfo */
#include <stdio.h>
#include <string.h>
#include <sys/random.h>
#include <sys/socket.h>
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

/* Says nothing: service_check says it. */
static void keep_quiet(bool away, const char *why)
{
    (void)away;
    (void)why;
}

static store *open_store(const settings *set, int workers,
                         void (*turned)(bool away, const char *why), char fault[256])
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
                                      .turned = turned},
                     fault);
}

bool service_start(service *s, const settings *set, size_t routes,
                   const char *(*path)(size_t index), char fault[256])
{
    *s = (service){.settings = set};
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    const int workers = set->workers ? (int)set->workers : cores > 1 ? (int)cores : 1;
    const size_t depth =
        set->queue_depth ? (size_t)set->queue_depth : QUEUE_PER_WORKER * (size_t)workers;
    if (*set->token_file && !(s->access = access_read(set->token_file, fault)))
        return false;
    if (*set->store && !(s->store = open_store(set, workers, note_store, fault)))
        return false;
    if (getrandom(&s->id_prefix, sizeof s->id_prefix, GRND_NONBLOCK) < 0)
        s->id_prefix = (uint32_t)clock_us();
    s->memory.limit = set->memory_bytes ? (size_t)set->memory_bytes : memory_default();
    evaluation_limit((size_t)set->answer_bytes, memory_solve_most(s->memory.limit));
    snprintf(fault, 256, "out of memory or threads");
    return (s->metrics = metrics_new(routes, path)) &&
           (s->cache = cache_new((size_t)set->cache_bytes)) && (s->memory.cache = s->cache) &&
           (s->thread_pool = thread_pool_new(&(thread_pool_options){.workers = workers,
                                                                    .depth = depth,
                                                                    .cheap_us = set->cheap_us,
                                                                    .begin = memory_begin_solve,
                                                                    .end = memory_end_solve,
                                                                    .memory = &s->memory}));
}

static void add_fault(strbuf *faults, const char *fault)
{
    strbuf_format(faults, "%s\n", fault);
}

/* Whether the store's name can be resolved. */
static bool resolves(const char *address, char fault[256])
{
    char host[256], port[16];
    struct addrinfo hints = {.ai_socktype = SOCK_STREAM}, *found = NULL;
    if (!address_split(address, host, port))
        return true; /* the path of a local socket */
    const int error = getaddrinfo(host, port, &hints, &found);
    if (error)
        snprintf(fault, 256, "store: %.100s: %s", host, gai_strerror(error));
    else
        freeaddrinfo(found);
    return error == 0;
}

static void check_store(const settings *set, strbuf *faults, strbuf *notes)
{
    char fault[256];
    static const cache_key none = {{0}};
    store *s = open_store(set, 1, keep_quiet, fault);
    if (!s || !resolves(set->store, fault)) {
        add_fault(faults, fault);
    } else {
        entry_unref(store_find(s, &none));
        if (store_count(s).errors)
            strbuf_format(notes,
                          "store: %.100s does not answer now; strumd starts and solves "
                          "without it\n",
                          set->store);
    }
    store_free(s);
}

void service_check(const settings *set, strbuf *faults, strbuf *notes)
{
    char fault[256];
    access_list *access = *set->token_file ? access_read(set->token_file, fault) : NULL;
    if (*set->token_file && !access)
        add_fault(faults, fault);
    access_free(access);
    if (*set->store)
        check_store(set, faults, notes);
}

void service_reload(service *s)
{
    char fault[256];
    if (!s->access)
        log_say("info", "reload", "no token_file is set: nothing to read again");
    else if (access_reload(s->access, fault))
        log_say("info", "reload", "the tokens were read again");
    else
        log_say("error", "reload", "%s; the tokens read before still hold", fault);
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
