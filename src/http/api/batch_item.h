/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An item of a batch, {"path", "request", "id", "fields"}, and the line that it gets: with an id,
 * that stands first in it; with fields, only the parts of the answer that they point to. */
#ifndef HTTP_API_BATCH_ITEM_H
#define HTTP_API_BATCH_ITEM_H

#include "cache/entry.h"
#include "http/api/route.h"
#include "json/pick.h"

/* Characters of an id, and of each of the fields (JSON_PICKS_MAX of them). */
#define BATCH_ID_MAX    128
#define BATCH_FIELD_MAX 256
/* Values of an item beside those of its request, and of the levels around that. */
#define BATCH_ITEM_VALUES (JSON_PICKS_MAX + 5)
#define BATCH_ITEM_DEPTH  2

typedef struct batch_item {
    char *id;      /* as JSON; owned; NULL: none */
    char **fields; /* owned; `count` of them, each owned */
    size_t count;
    bool chosen; /* fields were given */
} batch_item;

/* Reads everything but the request, which is returned in *asked; every fault goes into `p`. Returns
 * the endpoint, or NULL with the faults. `item` is to be freed in either case. */
const endpoint *batch_item_read(const page *pages, const cJSON *document, batch_item *item,
                                const cJSON **asked, problem *p);
void batch_item_free(batch_item *item);

/* Is the line the answer as it stands? */
bool batch_item_is_plain(const batch_item *item);
/* What the line is made of, in place of `outcome`, whose reference it takes over (NULL stays NULL);
 * NULL when memory ran out. */
entry *batch_item_outcome(const batch_item *item, entry *outcome);

#endif
