/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "json/strbuf.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool strbuf_reserve(strbuf *out, size_t size)
{
    if (out->failed)
        return false;
    if (out->most > 0 && size > out->most - out->size) {
        out->failed = out->full = true;
        return false;
    }
    if (size < out->room - out->size) /* room is 0 or larger than size */
        return true;
    size_t room = out->room > 0 ? out->room : 128;
    while (room - out->size <= size && room <= SIZE_MAX / 2)
        room *= 2;
    char *data = room - out->size > size ? realloc(out->data, room) : NULL;
    if (data == NULL) {
        out->failed = true;
        return false;
    }
    out->data = data;
    out->room = room;
    return true;
}

void strbuf_add(strbuf *out, const void *bytes, size_t size)
{
    if (!strbuf_reserve(out, size))
        return;
    if (size > 0)
        memcpy(out->data + out->size, bytes, size);
    out->size += size;
    out->data[out->size] = '\0';
}

void strbuf_add_string(strbuf *out, const char *string)
{
    strbuf_add(out, string, strlen(string));
}

void strbuf_format(strbuf *out, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    strbuf_format_list(out, format, arguments);
    va_end(arguments);
}

void strbuf_format_list(strbuf *out, const char *format, va_list arguments)
{
    va_list again;
    va_copy(again, arguments);
    const int size = vsnprintf(NULL, 0, format, arguments);
    if (size < 0)
        out->failed = true;
    else if (strbuf_reserve(out, (size_t)size)) {
        (void)vsnprintf(out->data + out->size, (size_t)size + 1, format, again);
        out->size += (size_t)size;
    }
    va_end(again);
}

void strbuf_clear(strbuf *out)
{
    free(out->data);
    *out = (strbuf){0};
}
