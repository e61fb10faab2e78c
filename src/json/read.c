/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Index: json_read -> scan_document -> scan_value -> scan_object, scan_array, scan_string,
 * json_number_end; then check_value -> check_names on what cJSON made of it.
 */
#include "json/read.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "json/hex.h"
#include "json/utf8.h"

typedef struct scan {
    const char *start, *at, *end;
    int depth, values; /* still allowed */
    bool long_numbers; /* there are some that cJSON does not read */
    int status;        /* of the fault */
    const char *fault; /* static strbuf */
} scan;

static bool scan_fail(scan *s, int status, const char *fault)
{
    s->status = status;
    s->fault = fault;
    return false;
}

static char peek(const scan *s)
{
    return s->at < s->end ? *s->at : '\0';
}

static void skip_space(scan *s)
{
    while (s->at < s->end &&
           (*s->at == ' ' || *s->at == '\n' || *s->at == '\r' || *s->at == '\t'))
        s->at++;
}

static const char *digits_end(const char *at, const char *end)
{
    while (at < end && *at >= '0' && *at <= '9')
        at++;
    return at;
}

const char *json_number_end(const char *at, const char *end)
{
    if (at < end && *at == '-')
        at++;
    const char *integer = at;
    at = digits_end(at, end);
    if (at == integer || (*integer == '0' && at > integer + 1))
        return NULL;
    if (at < end && *at == '.') {
        const char *fraction = at + 1;
        at = digits_end(fraction, end);
        if (at == fraction)
            return NULL;
    }
    if (at < end && (*at == 'e' || *at == 'E')) {
        at++;
        if (at < end && (*at == '+' || *at == '-'))
            at++;
        const char *exponent = at;
        at = digits_end(at, end);
        if (at == exponent)
            return NULL;
    }
    return at;
}

static bool scan_number(scan *s)
{
    const char *end = json_number_end(s->at, s->end);
    if (end == NULL)
        return scan_fail(s, 400, "not a number as JSON writes it");
    s->long_numbers |= end - s->at > JSON_NUMBER_CHARACTERS;
    s->at = end;
    return true;
}

/* The code unit of \uXXXX at s->at (its backslash), or -1. */
static int code_unit(const scan *s)
{
    if (s->end - s->at < 6 || s->at[0] != '\\' || s->at[1] != 'u')
        return -1;
    int unit = 0;
    for (int i = 2; i < 6; i++) {
        const int digit = hex_digit(s->at[i]);
        if (digit < 0)
            return -1;
        unit = 16 * unit + digit;
    }
    return unit;
}

static bool scan_escape(scan *s)
{
    if (s->end - s->at >= 2 && s->at[1] != '\0' && strchr("\"\\/bfnrt", s->at[1]) != NULL) {
        s->at += 2;
        return true;
    }
    const int unit = code_unit(s);
    if (unit < 0)
        return scan_fail(s, 400, "no such escape in a string");
    if (unit == 0)
        return scan_fail(s, 400, "\\u0000 is not allowed in a string");
    if (unit < 0xD800 || unit > 0xDFFF) {
        s->at += 6;
        return true;
    }
    scan low = *s;
    low.at += 6;
    const int second = code_unit(&low);
    if (unit > 0xDBFF || second < 0xDC00 || second > 0xDFFF)
        return scan_fail(s, 400, "a lone surrogate in a string");
    s->at += 12;
    return true;
}

static bool scan_string(scan *s)
{
    s->at++;
    while (s->at < s->end) {
        const unsigned char byte = (unsigned char)*s->at;
        if (byte == '"') {
            s->at++;
            return true;
        }
        if (byte == '\\') {
            if (!scan_escape(s))
                return false;
            continue;
        }
        if (byte < 0x20)
            return scan_fail(s, 400, "a control character in a string: escape it");
        const size_t size = utf8_size(s->at, s->end);
        if (size == 0)
            return scan_fail(s, 400, "bytes that are not UTF-8");
        s->at += size;
    }
    return scan_fail(s, 400, "the document ends inside a string");
}

static bool scan_value(scan *s);

/* What follows an item: `close` (true in *closed), or a comma and another item. */
static bool scan_next(scan *s, char close, const char *fault, bool *closed)
{
    skip_space(s);
    if (peek(s) != close && peek(s) != ',')
        return scan_fail(s, 400, fault);
    *closed = *s->at++ == close;
    skip_space(s);
    return true;
}

static bool scan_array(scan *s)
{
    s->at++;
    skip_space(s);
    bool closed = peek(s) == ']';
    if (closed)
        s->at++;
    while (!closed)
        if (!scan_value(s) || !scan_next(s, ']', "expected ',' or ']' in an array", &closed))
            return false;
    return true;
}

static bool scan_object(scan *s)
{
    s->at++;
    skip_space(s);
    bool closed = peek(s) == '}';
    if (closed)
        s->at++;
    while (!closed) {
        if (peek(s) != '"')
            return scan_fail(s, 400, "expected a member name in double quotes");
        if (!scan_string(s))
            return false;
        skip_space(s);
        if (peek(s) != ':')
            return scan_fail(s, 400, "expected ':' after a member name");
        s->at++;
        skip_space(s);
        if (!scan_value(s) || !scan_next(s, '}', "expected ',' or '}' in an object", &closed))
            return false;
    }
    return true;
}

static bool scan_literal(scan *s)
{
    static const char *const literals[] = {"true", "false", "null"};
    for (size_t i = 0; i < sizeof literals / sizeof literals[0]; i++) {
        const size_t size = strlen(literals[i]);
        if ((size_t)(s->end - s->at) >= size && memcmp(s->at, literals[i], size) == 0) {
            s->at += size;
            return true;
        }
    }
    return scan_fail(s, 400,
                     s->at < s->end ? "expected a value" : "the document ends too soon");
}

static bool scan_value(scan *s)
{
    if (s->values-- <= 0)
        return scan_fail(s, 413, "more values than this server takes");
    const char first = peek(s);
    if (first == '"')
        return scan_string(s);
    if (first == '-' || (first >= '0' && first <= '9'))
        return scan_number(s);
    if (first != '{' && first != '[')
        return scan_literal(s);
    if (s->depth-- <= 0)
        return scan_fail(s, 413, "nested deeper than this server takes");
    const bool good = first == '{' ? scan_object(s) : scan_array(s);
    s->depth++;
    return good;
}

static bool scan_document(scan *s)
{
    if (s->end - s->at >= 3 && memcmp(s->at, "\xEF\xBB\xBF", 3) == 0)
        return scan_fail(s, 400, "a byte order mark: send plain UTF-8");
    skip_space(s);
    if (s->at == s->end)
        return scan_fail(s, 400, "the body is empty");
    if (!scan_value(s))
        return false;
    skip_space(s);
    return s->at == s->end || scan_fail(s, 400, "something follows the document");
}

/* Names the fault with its place; columns count characters. */
static void report(const scan *s, problem *p)
{
    size_t line = 1, column = 1;
    for (const char *at = s->start; at < s->at; at++) {
        if (*at == '\n') {
            line++;
            column = 1;
        } else if (((unsigned char)*at & 0xC0) != 0x80) {
            column++;
        }
    }
    problem_set(p, s->status, "%s%s, at line %zu, column %zu (byte %zu)",
                s->status == 400 ? "the body is not JSON: " : "", s->fault, line, column,
                (size_t)(s->at - s->start));
}

/* ---- the parsed document ---- */

void json_pointer(const json_place *place, strbuf *out)
{
    if (place == NULL)
        return;
    json_pointer(place->parent, out);
    if (place->name == NULL) {
        strbuf_format(out, "/%zu", place->index);
        return;
    }
    strbuf_add(out, "/", 1);
    for (const char *c = place->name; *c != '\0'; c++) {
        if (*c == '~')
            strbuf_add(out, "~0", 2);
        else if (*c == '/')
            strbuf_add(out, "~1", 2);
        else
            strbuf_add(out, c, 1);
    }
}

void json_fault(problem *p, const json_place *place, const char *format, ...)
{
    strbuf pointer = {0}, detail = {0};
    va_list arguments;
    va_start(arguments, format);
    strbuf_format_list(&detail, format, arguments);
    va_end(arguments);
    strbuf_add(&pointer, "", 0);
    json_pointer(place, &pointer);
    if (pointer.failed || detail.failed)
        problem_out_of_memory(p);
    else
        problem_add(p, pointer.data, "%s", detail.data);
    strbuf_clear(&pointer);
    strbuf_clear(&detail);
}

static int compare_names(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* Names that an object holds more than once, each reported once. */
static void check_names(const cJSON *object, const json_place *place, problem *p)
{
    const char *few[32];
    const char **names = few;
    size_t count = 0, i = 0;
    for (const cJSON *member = object->child; member != NULL; member = member->next)
        count++;
    if (count > sizeof few / sizeof few[0]) {
        names = malloc(count * sizeof *names);
        if (names == NULL) {
            problem_out_of_memory(p);
            return;
        }
    }
    for (const cJSON *member = object->child; member != NULL; member = member->next)
        names[i++] = member->string;
    qsort(names, count, sizeof *names, compare_names);
    for (i = 1; i < count; i++)
        if (strcmp(names[i - 1], names[i]) == 0 &&
            (i == 1 || strcmp(names[i - 2], names[i]) != 0))
            json_fault(p, &(json_place){.parent = place, .name = names[i]},
                       "given more than once");
    if (names != few)
        free(names);
}

static void check_value(const cJSON *value, const json_place *place, problem *p)
{
    if (cJSON_IsNumber(value) && !isfinite(value->valuedouble))
        json_fault(p, place, "the number is too large for a double (about 1.8e308)");
    if (value->child == NULL)
        return;
    const bool object = cJSON_IsObject(value);
    if (object)
        check_names(value, place, p);
    json_place inner = {.parent = place};
    for (const cJSON *item = value->child; item != NULL; item = item->next, inner.index++) {
        inner.name = object ? item->string : NULL;
        if (item->child != NULL || cJSON_IsNumber(item))
            check_value(item, &inner, p);
    }
}

/* cJSON reads numbers of up to JSON_NUMBER_CHARACTERS: writes longer ones, outside of strings, as
 * the shortest that is the same double, and blanks. `text` is a document that was scanned. */
static void shorten_numbers(char *text, const char *end)
{
    bool inside = false;
    for (char *at = text; at < end; at++) {
        if (inside && *at == '\\') {
            at++;
        } else if (*at == '"') {
            inside = !inside;
        } else if (!inside && (*at == '-' || (*at >= '0' && *at <= '9'))) {
            const char *after = json_number_end(at, end);
            const size_t size = (size_t)(after - at);
            if (size > JSON_NUMBER_CHARACTERS) {
                const double value = strtod(at, NULL);
                char shorter[32];
                /* What is too large for a double is refused later, by its place. */
                const int written = isfinite(value)
                                        ? snprintf(shorter, sizeof shorter, "%.17g", value)
                                        : snprintf(shorter, sizeof shorter, "1e999");
                memset(at, ' ', size);
                memcpy(at, shorter, (size_t)written);
            }
            at += size - 1;
        }
    }
}

bool json_read(const char *bytes, size_t size, const json_limits *limits, cJSON **document,
               problem *p)
{
    *document = NULL;
    scan s = {.start = bytes,
              .at = bytes,
              .end = bytes + size,
              .depth = limits->depth < JSON_DEPTH_MAX ? limits->depth : JSON_DEPTH_MAX,
              .values = limits->values};
    if (!scan_document(&s)) {
        report(&s, p);
        return false;
    }
    char *copy = malloc(size + 1);
    if (copy != NULL) {
        memcpy(copy, bytes, size);
        copy[size] = '\0';
        if (s.long_numbers)
            shorten_numbers(copy, copy + size);
        /* The scan left cJSON nothing to refuse: when it does, memory ran out. */
        *document = cJSON_ParseWithLengthOpts(copy, size + 1, NULL, 1);
        free(copy);
    }
    if (*document == NULL) {
        problem_out_of_memory(p);
        return false;
    }
    check_value(*document, NULL, p);
    if (p->status != 0) {
        cJSON_Delete(*document);
        *document = NULL;
        return false;
    }
    return true;
}
