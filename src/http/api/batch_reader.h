/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The items of a batch's body: those of a JSON array, or one a line (NDJSON). Looks only for
 * the end of each item, so that a faulty item is refused in its place, and only one item at a
 * time is parsed. */
#ifndef HTTP_API_BATCH_READER_H
#define HTTP_API_BATCH_READER_H

#include "json/problem.h"

typedef struct batch_reader {
    const char *at, *end; /* into the body */
    bool lines;
} batch_reader;

/* Returns false with `p` filled if the body is not an array, or one that does not end. *count is their number. */
bool batch_reader_open(batch_reader *it, const char *body, size_t size, bool lines,
                       size_t *count, problem *p);
/* The next one; false when there is none. */
bool batch_reader_next(batch_reader *it, const char **item, size_t *size);

#endif
