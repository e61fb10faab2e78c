/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cache/store.h"

#include <errno.h>
#include <fcntl.h>
#include <openssl/crypto.h>
#include <openssl/hmac.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <strum/version.h>

#include "cache/redis.h"

/* After so many failures in a row the store is left alone: for the first time so long, then
 * twice as long whenever it fails again, up to the last. */
#define AWAY_AFTER    3
#define AWAY_FIRST_MS 1000
#define AWAY_LAST_MS  30000

/* A shorter secret could be guessed. */
#define SECRET_MIN 16

/* A stored value: the mark, the seal of key, solver and body, the body. */
static const char mark[8] = "strum 1\n";
#define HEAD (sizeof mark + sizeof(cache_key))

struct store {
    store_options options;
    char host[256], port[128];
    char solver[72];         /* the version, number, numerics and build whose answers are store */
    strbuf secret, password; /* empty: none */
    pthread_mutex_t lock;    /* of what follows; never held while the store is waited for */
    redis_place at;
    store_counters count;
    int failures; /* in a row */
    bool probing; /* somebody tries whether it is back */
    enum { TOLD_NOTHING, TOLD_THERE, TOLD_AWAY } told;
    int64_t back_ms, pause_ms; /* when to try again, and the next pause */
    int idle_count;
    int idle[]; /* open connections */
};

/* ---- one command, over a connection of its own ---- */

typedef struct visit {
    int fd;
    bool probe; /* decides whether the store is back */
    redis_place at;
} visit;

static bool enter(store *s, visit *v)
{
    pthread_mutex_lock(&s->lock);
    const bool away = s->count.away;
    const bool good = !away || (!s->probing && redis_now_ms() >= s->back_ms);
    if (good) {
        *v = (visit){.fd = !away && s->idle_count ? s->idle[--s->idle_count] : -1,
                     .probe = away,
                     .at = s->at};
        s->probing |= away;
    }
    pthread_mutex_unlock(&s->lock);
    return good;
}

/* Under the lock. */
static void go_away(store *s)
{
    s->count.away = true;
    s->back_ms = redis_now_ms() + s->pause_ms;
    s->pause_ms = 2 * s->pause_ms < AWAY_LAST_MS ? 2 * s->pause_ms : AWAY_LAST_MS;
    while (s->idle_count)
        close(s->idle[--s->idle_count]);
}

/* Ends a visit; v->fd, where there is one, can be used again. */
static void leave(store *s, const visit *v, bool good, const char *why)
{
    int spare = v->fd;
    pthread_mutex_lock(&s->lock);
    s->failures = good ? 0 : s->failures + 1;
    s->count.errors += !good;
    if (v->probe) {
        s->probing = false;
        if (good) {
            s->count.away = false;
            s->pause_ms = AWAY_FIRST_MS;
            s->at = v->at;
        }
    }
    if (!good && (v->probe || (!s->count.away && s->failures >= AWAY_AFTER)))
        go_away(s);
    if (spare >= 0 && !s->count.away && s->idle_count < s->options.connections) {
        s->idle[s->idle_count++] = spare;
        spare = -1;
    }
    const bool away = s->count.away, told = s->told == (away ? TOLD_AWAY : TOLD_THERE);
    s->told = away ? TOLD_AWAY : TOLD_THERE;
    pthread_mutex_unlock(&s->lock);
    if (spare >= 0)
        close(spare);
    if (!told && s->options.turned)
        s->options.turned(away, why);
}

/* A connection, or -1. The name is looked up by a probe only: that may take longer. */
static int dial(store *s, visit *v, int64_t until, char why[REDIS_WHY])
{
    const store_options *o = &s->options;
    const int fd = v->probe ? redis_find(s->host, s->port, o->wait_ms, &v->at, why)
                            : redis_connect(&v->at, until, why);
    if (fd < 0 || !s->password.size)
        return fd;
    const key_part words[] = {{"AUTH", 4}, {s->password.data, s->password.size}};
    strbuf none = {0};
    const redis_reply got =
        redis_ask(fd, words, 2, 0, v->probe ? redis_now_ms() + o->wait_ms : until, &none, why);
    strbuf_clear(&none);
    if (got == REDIS_DONE)
        return fd;
    close(fd);
    return -1;
}

static redis_reply ask(store *s, const key_part *words, size_t count, strbuf *value)
{
    visit v;
    char why[REDIS_WHY] = "it did not take the password"; /* unless another is given */
    if (!enter(s, &v))
        return REDIS_BROKEN;
    int64_t until = redis_now_ms() + s->options.wait_ms;
    redis_reply got = REDIS_BROKEN;
    if (v.fd >= 0)
        got = redis_ask(v.fd, words, count, HEAD + STORE_BODY_MAX, until, value, why);
    /* The store may have closed what lay idle: that is no failure of it yet. */
    if (got == REDIS_BROKEN && redis_now_ms() <= until) {
        strbuf_clear(value);
        if (v.fd >= 0)
            close(v.fd);
        v.fd = dial(s, &v, until, why);
        if (v.probe)
            until = redis_now_ms() + s->options.wait_ms;
        if (v.fd >= 0)
            got = redis_ask(v.fd, words, count, HEAD + STORE_BODY_MAX, until, value, why);
    }
    if (v.fd >= 0 && (got == REDIS_BROKEN || got == REDIS_TOO_LARGE)) {
        close(v.fd);
        v.fd = -1;
    }
    leave(s, &v, got != REDIS_BROKEN && got != REDIS_REFUSED, why);
    return got;
}

/* ---- values ---- */

/* Builds of one version may differ: only this very program's answers are for it. Where it
 * cannot be read, the version has to do. */
static void name_solver(store *s)
{
    cache_key digest = {{0}};
    char hex[KEY_HEX_SIZE];
    struct stat file;
    const int fd = open("/proc/self/exe", O_RDONLY | O_CLOEXEC);
    if (fd >= 0 && fstat(fd, &file) == 0) {
        const size_t size = (size_t)file.st_size;
        void *program = mmap(NULL, size, PROT_READ, MAP_PRIVATE, fd, 0);
        if (program != MAP_FAILED) {
            (void)key_of_parts(&(key_part){program, size}, 1, &digest);
            munmap(program, size);
        }
    }
    if (fd >= 0)
        close(fd);
    key_hex(&digest, hex);
    const char *numerics = evaluation_numerics();
    snprintf(s->solver, sizeof s->solver, "%.24s-%d-%.16s-%.16s", strum_version(),
             strum_solver(), numerics != NULL ? numerics : "unknown", hex);
}

typedef struct name {
    char bytes[sizeof "strum::" + sizeof((store *)0)->solver + KEY_HEX_SIZE];
} name;

static key_part name_of(const store *s, const cache_key *key, name *n)
{
    char hex[KEY_HEX_SIZE];
    key_hex(key, hex);
    snprintf(n->bytes, sizeof n->bytes, "strum:%s:%s", s->solver, hex);
    return (key_part){n->bytes, strlen(n->bytes)};
}

/* Nobody makes it without the secret; without a secret it tells damage from answers, and one
 * key's answer from another's. */
static bool seal(const store *s, const cache_key *key, const char *body, size_t size,
                 cache_key *sealed)
{
    const key_part parts[] = {
        {mark, sizeof mark}, {s->solver, strlen(s->solver)}, {key, sizeof *key}, {body, size}};
    cache_key digest;
    return key_of_parts(parts, 4, &digest) &&
           HMAC(EVP_sha256(), s->secret.size ? s->secret.data : "", (int)s->secret.size,
                digest.bytes, sizeof digest, sealed->bytes, NULL);
}

/* The body alone is left of a value that is as we write them. */
static bool unwrap(const store *s, const cache_key *key, strbuf *value)
{
    cache_key sealed;
    if (value->size <= HEAD || memcmp(value->data, mark, sizeof mark) != 0 ||
        !seal(s, key, value->data + HEAD, value->size - HEAD, &sealed) ||
        CRYPTO_memcmp(value->data + sizeof mark, &sealed, sizeof sealed) != 0)
        return false;
    value->size -= HEAD;
    memmove(value->data, value->data + HEAD, value->size + 1);
    return true;
}

static void count(store *s, uint64_t *counter)
{
    pthread_mutex_lock(&s->lock);
    ++*counter;
    pthread_mutex_unlock(&s->lock);
}

entry *store_find(store *s, const cache_key *key)
{
    if (!s)
        return NULL;
    name n;
    strbuf value = {0};
    entry *e = NULL;
    const redis_reply got =
        ask(s, (const key_part[]){{"GET", 3}, name_of(s, key, &n)}, 2, &value);
    if (got == REDIS_NOTHING) {
        count(s, &s->count.misses);
    } else if (got == REDIS_TOO_LARGE || got == REDIS_DONE ||
               (got == REDIS_VALUE && !unwrap(s, key, &value))) {
        count(s, &s->count.rejected);
    } else if (got == REDIS_VALUE && (e = entry_new(key, 200, &value))) {
        e->from_store = true;
        count(s, &s->count.hits);
    }
    strbuf_clear(&value);
    return e;
}

void store_keep(store *s, const entry *e)
{
    cache_key sealed;
    if (!s || e->size > STORE_BODY_MAX || !seal(s, &e->key, e->body, e->size, &sealed))
        return;
    name n;
    char seconds[24];
    strbuf value = {0}, none = {0};
    strbuf_add(&value, mark, sizeof mark);
    strbuf_add(&value, &sealed, sizeof sealed);
    strbuf_add(&value, e->body, e->size);
    const int digits =
        snprintf(seconds, sizeof seconds, "%lld", (long long)s->options.expiry_s);
    const key_part words[] = {{"SET", 3},
                              name_of(s, &e->key, &n),
                              {value.data, value.size},
                              {"EX", 2},
                              {seconds, (size_t)digits}};
    if (!value.failed && ask(s, words, s->options.expiry_s ? 5 : 3, &none) == REDIS_DONE)
        count(s, &s->count.writes);
    strbuf_clear(&value);
    strbuf_clear(&none);
}

/* ---- the whole ---- */

/* The first line of a file; an empty path has none. */
static bool read_line(const char *setting, const char *path, size_t least, strbuf *line,
                      char fault[256])
{
    char got[512] = "";
    FILE *file = *path ? fopen(path, "re") : NULL;
    const char *why = NULL;
    if (!*path)
        return true;
    if (!file || (!fgets(got, sizeof got, file) && ferror(file)))
        why = strerror(errno);
    if (file)
        fclose(file);
    const size_t size = strcspn(got, "\r\n");
    if (!why && (size < least || size == sizeof got - 1))
        why = "its first line is too short or too long";
    strbuf_add(line, got, size);
    if (!why && line->failed)
        why = "out of memory";
    if (why)
        snprintf(fault, 256, "%s: %.150s: %s", setting, path, why);
    return !why;
}

store *store_new(const store_options *options, char fault[256])
{
    store *s = calloc(1, sizeof *s + (size_t)options->connections * sizeof *s->idle);
    if (!s) {
        snprintf(fault, 256, "store: out of memory");
        return NULL;
    }
    s->options = *options;
    snprintf(s->host, sizeof s->host, "%s", options->host);
    snprintf(s->port, sizeof s->port, "%s", options->port);
    pthread_mutex_init(&s->lock, NULL);
    /* The first who asks tries whether it is there. */
    s->count.away = true;
    s->pause_ms = AWAY_FIRST_MS;
    name_solver(s);
    if (read_line("store_secret_file", options->secret_file, SECRET_MIN, &s->secret, fault) &&
        read_line("store_password_file", options->password_file, 1, &s->password, fault))
        return s;
    store_free(s);
    return NULL;
}

void store_free(store *s)
{
    if (!s)
        return;
    while (s->idle_count)
        close(s->idle[--s->idle_count]);
    strbuf_clear(&s->secret);
    strbuf_clear(&s->password);
    pthread_mutex_destroy(&s->lock);
    free(s);
}

store_counters store_count(store *s)
{
    pthread_mutex_lock(&s->lock);
    const store_counters counted = s->count;
    pthread_mutex_unlock(&s->lock);
    return counted;
}
