/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Keys: SHA-256 of what was asked. A collision would take about 2^128 work, so equal keys mean
 * equal requests and nothing is compared. Two levels live side by side: the canonical key names
 * a set of parameters (and is public: ETag, /v1/results/{key}); the raw key names the very
 * bytes of a body or query, and finds a stored answer without reading them.
 */
#ifndef CACHE_KEY_H
#define CACHE_KEY_H

#include "endpoints/endpoint.h"

#define KEY_HEX_SIZE 65

typedef struct cache_key {
    unsigned char bytes[32];
} cache_key;

typedef struct key_part {
    const void *bytes;
    size_t size;
} key_part;

/* The key of `count` parts, each preceded by its length, so that no two lists of parts run
 * together. False when memory ran out. */
bool key_of_parts(const key_part *parts, size_t count, cache_key *key);
/* The canonical key of a request; `canonical` is scratch, reused. */
bool key_of_evaluation(const evaluation *a, strbuf *canonical, cache_key *key);

void key_hex(const cache_key *key, char hex[KEY_HEX_SIZE]);
/* From 64 lower-case hex characters; false for anything else. */
bool key_parse(const char *hex, cache_key *key);

#endif
