/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds parts of a JSON text by JSON pointers (RFC 6901), all of them together and without
 * building a document: a byte is read once for each value on the way to it. The text is valid and ends
 * with a NUL: one that our own writer made. */
#ifndef JSON_PICK_H
#define JSON_PICK_H

#include <stdbool.h>
#include <stddef.h>

#define JSON_PICKS_MAX 64

typedef struct json_pick {
    const char *pointer; /* given */
    /* found: the bytes of the value; NULL: there is none */
    const char *value;
    size_t size;
    /* Where there is none: the innermost value on the way, and how many bytes of the pointer lead
     * to it. */
    const char *inside;
    size_t inside_size, inside_pointer;
} json_pick;

/* Is it a pointer at all: "", or "/" before each token, ~ only as ~0 and ~1? */
bool json_pointer_valid(const char *pointer);

/* At most JSON_PICKS_MAX of them. Names of the text match as they are written: none of ours has an
 * escape. */
void json_pick_all(const char *text, size_t size, json_pick *picks, size_t count);

/* Calls `see` for each name of an object (NULL for each item of an array) in the text, until it
 * returns false. What is neither has none. */
void json_children(const char *text, size_t size,
                   bool (*see)(void *context, const char *name, size_t size), void *context);

#endif
