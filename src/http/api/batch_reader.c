/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/api/batch_reader.h"

#include <string.h>

static const char *skip_space(const char *at, const char *end)
{
    while (at < end && (*at == ' ' || *at == '\t' || *at == '\r' || *at == '\n'))
        at++;
    return at;
}

static const char *string_end(const char *at, const char *end)
{
    for (at++; at < end && *at != '"'; at++)
        if (*at == '\\')
            at++;
    return at;
}

/* The "," or "]" after an item of an array; `end` when it is not there. */
static const char *item_end(const char *at, const char *end)
{
    for (size_t depth = 0; at < end; at++) {
        switch (*at) {
        case '"':
            at = string_end(at, end);
            break;
        case '[':
        case '{':
            depth++;
            break;
        case ',':
            if (depth == 0)
                return at;
            break;
        case ']':
        case '}':
            if (depth == 0)
                return *at == ']' ? at : end;
            depth--;
            break;
        default:;
        }
    }
    return end;
}

bool batch_reader_next(batch_reader *it, const char **item, size_t *size)
{
    it->at = skip_space(it->at, it->end);
    if (it->at >= it->end)
        return false;
    const char *stop = it->lines ? memchr(it->at, '\n', (size_t)(it->end - it->at))
                                 : item_end(it->at, it->end);
    if (!stop || stop > it->end)
        stop = it->end;
    *item = it->at;
    *size = (size_t)(stop - it->at);
    it->at = stop < it->end ? stop + 1 : stop;
    return true;
}

bool batch_reader_open(batch_reader *it, const char *body, size_t size, bool lines,
                       size_t *count, problem *p)
{
    const char *end = body + size;
    *it = (batch_reader){.at = body, .end = end, .lines = lines};
    *count = 0;
    if (!lines) {
        it->at = skip_space(body, end);
        while (end > it->at && skip_space(end - 1, end) == end)
            end--;
        if (end - it->at < 2 || *it->at != '[' || end[-1] != ']') {
            problem_set(p, 400,
                        "a batch is an array of items, or (application/x-ndjson) a line "
                        "for each");
            return false;
        }
        it->at = skip_space(it->at + 1, end);
        if (it->at == end - 1)
            it->at = end;
        it->end = end;
    }
    batch_reader counting = *it;
    const char *item;
    while (batch_reader_next(&counting, &item, &size)) {
        ++*count;
        /* An array's last item, and no other, is followed by its last byte. */
        const bool last = counting.at == end, closed = item + size < end && item[size] == ']';
        if (!lines && last != closed) {
            problem_set(p, 400,
                        "the array of items does not end where it should: after item %zu",
                        *count - 1);
            return false;
        }
    }
    return true;
}
