/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A growing run of bytes. Running out of memory sets `failed` and is checked once, at the end.
 */
#ifndef JSON_TEXT_H
#define JSON_TEXT_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

typedef struct text {
    char *data; /* owned; always NUL-terminated when not NULL */
    size_t size, room;
    bool failed;
} text;

void text_add(text *out, const void *bytes, size_t size);
void text_add_string(text *out, const char *string);
void text_format(text *out, const char *format, ...) __attribute__((format(printf, 2, 3)));
void text_format_list(text *out, const char *format, va_list arguments)
    __attribute__((format(printf, 2, 0)));
/* Frees the bytes; `out` is as new ({0}). */
void text_clear(text *out);

#endif
