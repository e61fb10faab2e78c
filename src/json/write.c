/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "json/write.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "json/utf8.h"

/* A value begins: a comma before it where one stands already, and after it comes one. */
static void begin_value(json_writer *json)
{
    if (json->comma)
        strbuf_add(json->out, ",", 1);
    json->comma = true;
}

void json_open_object(json_writer *json)
{
    begin_value(json);
    strbuf_add(json->out, "{", 1);
    json->comma = false;
}

void json_close_object(json_writer *json)
{
    strbuf_add(json->out, "}", 1);
    json->comma = true;
}

void json_open_array(json_writer *json)
{
    begin_value(json);
    strbuf_add(json->out, "[", 1);
    json->comma = false;
}

void json_close_array(json_writer *json)
{
    strbuf_add(json->out, "]", 1);
    json->comma = true;
}

/* Nearly every string is one of ours: ASCII that stands for itself. */
static bool is_plain(const char *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        const unsigned char byte = (unsigned char)bytes[i];
        if (byte < 0x20 || byte >= 0x80 || byte == '"' || byte == '\\')
            return false;
    }
    return true;
}

/* ,"plain": at once. */
static void add_plain(json_writer *json, const char *bytes, size_t size, bool key)
{
    strbuf *out = json->out;
    if (!strbuf_reserve(out, size + 4))
        return;
    char *at = out->data + out->size;
    if (json->comma)
        *at++ = ',';
    *at++ = '"';
    memcpy(at, bytes, size);
    at += size;
    *at++ = '"';
    if (key)
        *at++ = ':';
    *at = '\0';
    out->size = (size_t)(at - out->data);
    json->comma = !key;
}

void json_key(json_writer *json, const char *key)
{
    const size_t size = strlen(key);
    if (is_plain(key, size)) {
        add_plain(json, key, size, true);
        return;
    }
    json_string_n(json, key, size);
    strbuf_add(json->out, ":", 1);
    json->comma = false;
}

void json_number(json_writer *json, double value)
{
    if (!isfinite(value)) {
        json->out->failed = true;
        return;
    }
    char buffer[1 + JSON_NUMBER_MAX] = ",";
    const size_t size = json_print_double(value, buffer + 1);
    if (json->comma)
        strbuf_add(json->out, buffer, size + 1);
    else
        strbuf_add(json->out, buffer + 1, size);
    json->comma = true;
}

void json_integer(json_writer *json, int64_t value)
{
    char buffer[32]; /* every digit of 2^64 takes 20 */
    char *const end = buffer + sizeof buffer;
    uint64_t rest = value < 0 ? 0 - (uint64_t)value : (uint64_t)value;
    char *at = end;
    do
        *--at = (char)('0' + rest % 10);
    while ((rest /= 10) > 0);
    if (value < 0)
        *--at = '-';
    begin_value(json);
    strbuf_add(json->out, at, (size_t)(end - at));
}

void json_flag(json_writer *json, bool value)
{
    begin_value(json);
    strbuf_add_string(json->out, value ? "true" : "false");
}

void json_string(json_writer *json, const char *string)
{
    json_string_n(json, string, strlen(string));
}

/* What stands for a byte that cannot stand for itself in a string. */
static void add_escape(strbuf *out, unsigned char byte)
{
    static const char named[] = "\"\"\\\\\bb\ff\nn\rr\tt"; /* byte, letter, ... */
    for (const char *n = named; *n != '\0'; n += 2)
        if ((unsigned char)*n == byte) {
            strbuf_add(out, (const char[]){'\\', n[1]}, 2);
            return;
        }
    strbuf_format(out, "\\u%04x", byte);
}

void json_string_n(json_writer *json, const char *bytes, size_t size)
{
    if (is_plain(bytes, size)) {
        add_plain(json, bytes, size, false);
        return;
    }
    strbuf *out = json->out;
    begin_value(json);
    strbuf_add(out, "\"", 1);
    const char *const end = bytes + size;
    const char *plain = bytes; /* start of the run that needs no change */
    for (const char *at = bytes; at < end;) {
        const unsigned char byte = (unsigned char)*at;
        const bool itself = byte >= 0x20 && byte != '"' && byte != '\\';
        const size_t length = utf8_size(at, end);
        if (length > 0 && itself) {
            at += length;
            continue;
        }
        strbuf_add(out, plain, (size_t)(at - plain));
        /* An answer is valid UTF-8 whatever a client sent: U+FFFD for what is not. */
        if (length == 0)
            strbuf_add_string(out, "\xEF\xBF\xBD");
        else
            add_escape(out, byte);
        plain = ++at;
    }
    strbuf_add(out, plain, (size_t)(end - plain));
    strbuf_add(out, "\"", 1);
}

void json_complex(json_writer *json, double _Complex value)
{
    json_open_object(json);
    json_put_number(json, "re", creal(value));
    json_put_number(json, "im", cimag(value));
    json_close_object(json);
}

void json_raw(json_writer *json, const char *bytes, size_t size)
{
    begin_value(json);
    strbuf_add(json->out, bytes, size);
}

void json_put_number(json_writer *json, const char *key, double value)
{
    json_key(json, key);
    json_number(json, value);
}

void json_put_integer(json_writer *json, const char *key, int64_t value)
{
    json_key(json, key);
    json_integer(json, value);
}

void json_put_flag(json_writer *json, const char *key, bool value)
{
    json_key(json, key);
    json_flag(json, value);
}

void json_put_string(json_writer *json, const char *key, const char *string)
{
    json_key(json, key);
    json_string(json, string);
}

void json_put_complex(json_writer *json, const char *key, double _Complex value)
{
    json_key(json, key);
    json_complex(json, value);
}
