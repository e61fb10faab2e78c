/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What slot.c and cache.c know of an entry and nobody else does; slot.c also makes and ends
 * entries. */
#ifndef CACHE_SLOT_H
#define CACHE_SLOT_H

#include <stddef.h>

#include "cache/entry.h"

typedef enum slot_kind { SLOT_NONE, SLOT_CANONICAL, SLOT_RAW, SLOT_FLIGHT } slot_kind;

/* A place in the cache's table. */
typedef struct slot {
    struct slot *next;
    cache_key key;
    slot_kind kind;
    void *owner; /* struct cached, or flight */
} slot;

/* So many bodies of one answer are recognised by their bytes; the oldest gives way. A fixed
 * number, so that spellings without end of one request cannot grow the cache. */
#define RAW_SLOTS 4

struct cached {
    entry entry; /* first: an entry and its record are one allocation */
    atomic_uint references, body_holds;
    slot canonical, raw[RAW_SLOTS]; /* the cache's, under its lock, as is all that follows */
    unsigned raw_next;
    struct cached *newer, *older;
    struct order *in; /* NULL: not stored */
    size_t cost;
};

static inline struct cached *cached_of(entry *e)
{
    return (struct cached *)((char *)e - offsetof(struct cached, entry));
}

#endif
