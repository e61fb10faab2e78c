/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What entry.c and cache.c know of an entry and nobody else does. */
#ifndef CACHE_STORED_H
#define CACHE_STORED_H

#include <stddef.h>

#include "cache/cache.h"

typedef enum spot_kind { SPOT_NONE, SPOT_CANONICAL, SPOT_RAW, SPOT_FLIGHT } spot_kind;

/* A place in the cache's table. */
typedef struct spot {
    struct spot *next;
    cache_key key;
    spot_kind kind;
    void *owner; /* struct stored, or flight */
} spot;

/* So many bodies of one answer are recognised by their bytes; the oldest gives way. A fixed
 * number, so that spellings without end of one request cannot grow the cache. */
#define RAW_SPOTS 4

struct stored {
    entry entry; /* first: an entry and its record are one allocation */
    atomic_uint references, body_holds;
    spot canonical, raw[RAW_SPOTS]; /* the cache's, under its lock, as is all that follows */
    unsigned raw_next;
    struct stored *newer, *older;
    size_t cost;
};

static inline struct stored *stored_of(entry *e)
{
    return (struct stored *)((char *)e - offsetof(struct stored, entry));
}

#endif
