/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cache/key.h"

#include <openssl/evp.h>
#include <pthread.h>
#include <string.h>

#include "json/hex.h"

/* A context for each thread, kept: making one costs more than hashing a short body. */
static pthread_once_t digest_once = PTHREAD_ONCE_INIT;
static pthread_key_t digest_of_thread;
static bool digest_ready;

static void digest_end(void *context)
{
    EVP_MD_CTX_free(context);
}

static void digest_start(void)
{
    digest_ready = pthread_key_create(&digest_of_thread, digest_end) == 0;
}

static EVP_MD_CTX *digest_context(void)
{
    pthread_once(&digest_once, digest_start);
    if (!digest_ready)
        return NULL;
    EVP_MD_CTX *context = pthread_getspecific(digest_of_thread);
    if (context)
        return context;
    context = EVP_MD_CTX_new();
    if (!context || !EVP_DigestInit_ex(context, EVP_sha256(), NULL) ||
        pthread_setspecific(digest_of_thread, context) != 0) {
        EVP_MD_CTX_free(context);
        return NULL;
    }
    return context;
}

bool key_of_parts(const key_part *parts, size_t count, cache_key *key)
{
    EVP_MD_CTX *context = digest_context();
    /* Without a type the context keeps its algorithm: no look-up. */
    if (!context || !EVP_DigestInit_ex(context, NULL, NULL))
        return false;
    for (size_t i = 0; i < count; i++) {
        const uint64_t size = parts[i].size;
        if (!EVP_DigestUpdate(context, &size, sizeof size) ||
            !EVP_DigestUpdate(context, parts[i].bytes, parts[i].size))
            return false;
    }
    return EVP_DigestFinal_ex(context, key->bytes, NULL);
}

bool key_of_evaluation(const evaluation *a, strbuf *canonical, cache_key *key)
{
    canonical->size = 0;
    evaluation_canonical(a, canonical);
    if (canonical->failed)
        return false;
    return key_of_parts(&(key_part){canonical->data, canonical->size}, 1, key);
}

void key_hex(const cache_key *key, char hex[KEY_HEX_SIZE])
{
    static const char digits[] = "0123456789abcdef";
    for (size_t i = 0; i < sizeof key->bytes; i++) {
        hex[2 * i] = digits[key->bytes[i] >> 4];
        hex[2 * i + 1] = digits[key->bytes[i] & 15];
    }
    hex[KEY_HEX_SIZE - 1] = '\0';
}

bool key_parse(const char *hex, cache_key *key)
{
    /* In lower case only: an answer has one address. */
    if (strlen(hex) != KEY_HEX_SIZE - 1 || strspn(hex, "0123456789abcdef") != KEY_HEX_SIZE - 1)
        return false;
    for (size_t i = 0; i < sizeof key->bytes; i++)
        key->bytes[i] = (unsigned char)(hex_digit(hex[2 * i]) << 4 | hex_digit(hex[2 * i + 1]));
    return true;
}
