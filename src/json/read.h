/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Guarded reading of JSON. cJSON parses; before it, our own scan refuses what cJSON would let
 * through: invalid UTF-8, control characters, \u0000, lone surrogates, numbers outside JSON's
 * grammar (01, 1., 0x1), numbers beyond a double (1e400), a byte order mark, bytes after the
 * document, and what is beyond the limits. Duplicate keys are all named with their pointers.
 */
#ifndef JSON_READ_H
#define JSON_READ_H

#include <cjson/cJSON.h>

#include "json/problem.h"

typedef struct json_limits {
    int depth;  /* of nested arrays and objects; JSON_DEPTH_MAX at most */
    int values; /* of values in the whole document */
} json_limits;

/* A larger limit counts as this one: reading recurses, and its stack must stay small. */
#define JSON_DEPTH_MAX 256
/* Characters of a number; cJSON cuts what is longer. */
#define JSON_NUMBER_CHARACTERS 63

/* Reads a document. On success *document is the caller's (cJSON_Delete). Otherwise *document is
 * NULL and `p` says why: 400 with line, column and byte; 413 for limits; 500 when memory ran
 * out. */
bool json_read(const char *bytes, size_t size, const json_limits *limits, cJSON **document,
               problem *p);

/* The end of the JSON number at `at` (which ends before `end`), or NULL when none stands there.
 */
const char *json_number_end(const char *at, const char *end);

/* The place of a value in a document, kept on the stack while reading: the innermost first. */
typedef struct json_place {
    const struct json_place *parent; /* NULL: the document */
    const char *name;                /* of a member, or NULL: */
    size_t index;                    /* of an item */
} json_place;

/* Appends the JSON pointer of a place (NULL: the document, ""). */
void json_pointer(const json_place *place, strbuf *out);
/* problem_add at a place. */
void json_fault(problem *p, const json_place *place, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
