/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "json/problem.h"

#include <stdlib.h>
#include <string.h>

void problem_out_of_memory(problem *p)
{
    p->failed = true;
    p->status = 500;
}

void problem_set(problem *p, int status, const char *format, ...)
{
    if (p->status != 0)
        return;
    p->status = status;
    strbuf detail = {0};
    va_list arguments;
    va_start(arguments, format);
    strbuf_format_list(&detail, format, arguments);
    va_end(arguments);
    if (detail.failed) {
        strbuf_clear(&detail);
        problem_out_of_memory(p);
    }
    p->detail = detail.data;
}

/* Room for one more entry. */
static bool reserve_entry(problem *p)
{
    if (p->count < p->room)
        return true;
    const size_t room = p->room > 0 ? 2 * p->room : 8;
    problem_entry *entries = realloc(p->entries, room * sizeof *entries);
    if (entries == NULL)
        return false;
    p->entries = entries;
    p->room = room;
    return true;
}

void problem_add(problem *p, const char *pointer, const char *format, ...)
{
    if (p->status == 0)
        p->status = 400;
    if (p->count >= PROBLEM_ENTRIES_MAX || p->bytes >= PROBLEM_BYTES_MAX) {
        p->omitted++;
        return;
    }
    strbuf detail = {0};
    va_list arguments;
    va_start(arguments, format);
    strbuf_format_list(&detail, format, arguments);
    va_end(arguments);
    char *copy = strdup(pointer);
    if (detail.failed || copy == NULL || !reserve_entry(p)) {
        strbuf_clear(&detail);
        free(copy);
        problem_out_of_memory(p);
        return;
    }
    p->bytes += detail.size + strlen(copy);
    p->entries[p->count++] = (problem_entry){.pointer = copy, .detail = detail.data};
}

void problem_place(problem *p, const char *prefix)
{
    for (size_t i = 0; i < p->count; i++) {
        strbuf placed = {0};
        strbuf_format(&placed, "%s%s", prefix, p->entries[i].pointer);
        if (placed.failed) {
            strbuf_clear(&placed);
            problem_out_of_memory(p);
            return;
        }
        free(p->entries[i].pointer);
        p->entries[i].pointer = placed.data;
    }
}

const char *problem_title(int status)
{
    static const struct {
        int status;
        const char *title;
    } titles[] = {
        {400, "Bad Request"},
        {401, "Unauthorized"},
        {403, "Forbidden"},
        {404, "Not Found"},
        {405, "Method Not Allowed"},
        {406, "Not Acceptable"},
        {408, "Request Timeout"},
        {411, "Length Required"},
        {412, "Precondition Failed"},
        {413, "Content Too Large"},
        {414, "URI Too Long"},
        {415, "Unsupported Media Type"},
        {417, "Expectation Failed"},
        {421, "Misdirected Request"},
        {422, "Unprocessable Content"},
        {429, "Too Many Requests"},
        {431, "Request Header Fields Too Large"},
        {500, "Internal Server Error"},
        {501, "Not Implemented"},
        {503, "Service Unavailable"},
        {504, "Gateway Timeout"},
        {505, "HTTP Version Not Supported"},
    };
    for (size_t i = 0; i < sizeof titles / sizeof titles[0]; i++)
        if (titles[i].status == status)
            return titles[i].title;
    return "Error";
}

/* The sentence: what was set, or one about the entries. */
static void write_detail(const problem *p, json_writer *json)
{
    strbuf detail = {0};
    const size_t faults = p->count + p->omitted;
    if (p->failed)
        strbuf_add_string(&detail, "memory ran out");
    else if (p->detail != NULL)
        strbuf_add_string(&detail, p->detail);
    else if (faults == 1)
        strbuf_add_string(&detail, "the request has a fault: see errors");
    else if (faults > 0)
        strbuf_format(&detail, "the request has %zu faults: see errors", faults);
    else
        strbuf_add_string(&detail, problem_title(p->status));
    if (p->omitted > 0)
        strbuf_format(&detail, " (the first %zu of them)", p->count);
    if (detail.failed)
        json->out->failed = true;
    else
        json_put_string(json, "detail", detail.data);
    strbuf_clear(&detail);
}

void problem_write(const problem *p, const char *instance, strbuf *out)
{
    json_writer json = {.out = out};
    json_open_object(&json);
    json_put_string(&json, "type", "about:blank");
    json_put_string(&json, "title", problem_title(p->status));
    json_put_integer(&json, "status", p->status);
    write_detail(p, &json);
    if (instance != NULL)
        json_put_string(&json, "instance", instance);
    json_key(&json, "errors");
    json_open_array(&json);
    for (size_t i = 0; i < p->count && !p->failed; i++) {
        json_open_object(&json);
        json_put_string(&json, "pointer", p->entries[i].pointer);
        json_put_string(&json, "detail", p->entries[i].detail);
        json_close_object(&json);
    }
    json_close_array(&json);
    json_close_object(&json);
}

void problem_clear(problem *p)
{
    for (size_t i = 0; i < p->count; i++) {
        free(p->entries[i].pointer);
        free(p->entries[i].detail);
    }
    free(p->entries);
    free(p->detail);
    *p = (problem){0};
}
