/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/service/access.h"

#include <errno.h>
#include <openssl/crypto.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "cache/key.h"

/* A shorter token could be guessed: 16 characters of base64 are 96 bits. */
#define TOKEN_MIN 16
/* Each request is compared with all of them. */
#define TOKENS_MAX 1024

typedef struct tokens {
    size_t count;
    cache_key digests[TOKENS_MAX], cookies[TOKENS_MAX]; /* of the tokens, of their cookies */
} tokens;

struct access_list {
    pthread_rwlock_t lock; /* of `now` */
    tokens *now;
    char path[];
};

static bool digest_of(const char *token, cache_key *digest)
{
    return key_of_parts(&(key_part){token, strlen(token)}, 1, digest);
}

static bool cookie_of(const char *token, char value[ACCESS_COOKIE_SIZE])
{
    static const char use[] = "strum cookie";
    const key_part parts[] = {{use, sizeof use}, {token, strlen(token)}};
    cache_key key;
    if (!key_of_parts(parts, 2, &key))
        return false;
    key_hex(&key, value);
    return true;
}

/* Adds the digests of a token and of its cookie. */
static bool add_token(tokens *a, const char *token)
{
    char cookie[ACCESS_COOKIE_SIZE];
    return digest_of(token, &a->digests[a->count]) && cookie_of(token, cookie) &&
           digest_of(cookie, &a->cookies[a->count]);
}

static bool add_line(tokens *a, char *line, const char **why)
{
    line[strcspn(line, " \t\r\n")] = '\0';
    if (*line == '\0' || *line == '#')
        return true;
    *why = strlen(line) < TOKEN_MIN ? "a token has at least 16 characters"
           : a->count == TOKENS_MAX ? "more than 1024 tokens"
           : !add_token(a, line)    ? "out of memory"
                                    : NULL;
    a->count++;
    return *why == NULL;
}

static tokens *read_tokens(const char *path, char fault[256])
{
    tokens *a = calloc(1, sizeof *a);
    FILE *file = fopen(path, "re");
    const char *why = !a ? "out of memory" : !file ? strerror(errno) : NULL;
    char *line = NULL;
    size_t room = 0, number = 0;
    while (!why && (number++, getline(&line, &room, file) >= 0))
        add_line(a, line, &why);
    if (!why && ferror(file))
        why = strerror(errno);
    else if (!why && a->count == 0)
        why = "no token is in it";
    if (line)
        OPENSSL_cleanse(line, room);
    free(line);
    if (file)
        fclose(file);
    if (!why)
        return a;
    snprintf(fault, 256, "token_file: %.150s:%zu: %s", path, number, why);
    free(a);
    return NULL;
}

access_list *access_read(const char *path, char fault[256])
{
    const size_t size = strlen(path) + 1;
    tokens *now = read_tokens(path, fault);
    access_list *a = now ? malloc(sizeof *a + size) : NULL;
    if (!a) {
        if (now)
            snprintf(fault, 256, "token_file: out of memory");
        free(now);
        return NULL;
    }
    memcpy(a->path, path, size);
    a->now = now;
    pthread_rwlock_init(&a->lock, NULL);
    return a;
}

bool access_reload(access_list *a, char fault[256])
{
    tokens *now = read_tokens(a->path, fault);
    if (!now)
        return false;
    pthread_rwlock_wrlock(&a->lock);
    tokens *before = a->now;
    a->now = now;
    pthread_rwlock_unlock(&a->lock);
    free(before);
    return true;
}

void access_free(access_list *a)
{
    if (!a)
        return;
    pthread_rwlock_destroy(&a->lock);
    free(a->now);
    free(a);
}

/* Compares with all tokens, or all cookies, each completely: the time reveals nothing about a
 * guess. */
static bool is_known(access_list *a, bool cookie, const char *guess)
{
    cache_key given;
    bool found = false;
    if (!digest_of(guess, &given))
        return false;
    pthread_rwlock_rdlock(&a->lock);
    const cache_key *digests = cookie ? a->now->cookies : a->now->digests;
    for (size_t i = 0; i < a->now->count; i++)
        found |= CRYPTO_memcmp(&digests[i], &given, sizeof given) == 0;
    pthread_rwlock_unlock(&a->lock);
    return found;
}

bool access_allows(access_list *a, const char *authorization)
{
    if (!a)
        return true;
    if (!authorization || strncasecmp(authorization, "Bearer ", 7) != 0)
        return false;
    return is_known(a, false, authorization + 7 + strspn(authorization + 7, " "));
}

bool access_cookie(access_list *a, const char *token, char value[ACCESS_COOKIE_SIZE])
{
    return is_known(a, false, token) && cookie_of(token, value);
}

bool access_allows_cookie(access_list *a, const char *cookies)
{
    if (!a)
        return true;
    static const char name[] = ACCESS_COOKIE "=";
    for (const char *at = cookies; at && *at; at += strspn(at, "; ")) {
        const size_t size = strcspn(at, ";");
        if (size == sizeof name - 1 + ACCESS_COOKIE_SIZE - 1 &&
            strncmp(at, name, sizeof name - 1) == 0) {
            char value[ACCESS_COOKIE_SIZE];
            memcpy(value, at + sizeof name - 1, ACCESS_COOKIE_SIZE - 1);
            value[ACCESS_COOKIE_SIZE - 1] = '\0';
            return is_known(a, true, value);
        }
        at += size;
    }
    return false;
}
