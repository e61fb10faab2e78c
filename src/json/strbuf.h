/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A growing run of bytes. Running out of memory, or of the bytes it may have, sets `failed` and is
 * checked once, at the end. */
#ifndef JSON_STRBUF_H
#define JSON_STRBUF_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

typedef struct strbuf {
    char *data; /* owned; always NUL-terminated when not NULL */
    size_t size, room;
    size_t most; /* bytes that it may have; 0: no limit */
    bool failed;
    bool full; /* failed for that limit */
} strbuf;

/* Room for `size` more bytes, at data + size, and the NUL; false without memory. */
bool strbuf_reserve(strbuf *out, size_t size);
void strbuf_add(strbuf *out, const void *bytes, size_t size);
void strbuf_add_string(strbuf *out, const char *string);
void strbuf_format(strbuf *out, const char *format, ...) __attribute__((format(printf, 2, 3)));
void strbuf_format_list(strbuf *out, const char *format, va_list arguments)
    __attribute__((format(printf, 2, 0)));
/* Frees the bytes; `out` is as new ({0}). */
void strbuf_clear(strbuf *out);

#endif
