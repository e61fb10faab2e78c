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
    cache_key digests[TOKENS_MAX];
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

static bool add_line(tokens *a, char *line, const char **why)
{
    line[strcspn(line, " \t\r\n")] = '\0';
    if (*line == '\0' || *line == '#')
        return true;
    *why = strlen(line) < TOKEN_MIN                  ? "a token has at least 16 characters"
           : a->count == TOKENS_MAX                  ? "more than 1024 tokens"
           : !digest_of(line, &a->digests[a->count]) ? "out of memory"
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

/* Compares with all tokens, each completely: the time reveals nothing about a guess. */
static bool is_known(access_list *a, const cache_key *given)
{
    bool found = false;
    pthread_rwlock_rdlock(&a->lock);
    for (size_t i = 0; i < a->now->count; i++)
        found |= CRYPTO_memcmp(&a->now->digests[i], given, sizeof *given) == 0;
    pthread_rwlock_unlock(&a->lock);
    return found;
}

bool access_allows(access_list *a, const char *authorization)
{
    if (!a)
        return true;
    if (!authorization || strncasecmp(authorization, "Bearer ", 7) != 0)
        return false;
    cache_key given;
    const char *token = authorization + 7 + strspn(authorization + 7, " ");
    return digest_of(token, &given) && is_known(a, &given);
}
