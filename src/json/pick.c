/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "json/pick.h"

#include <stdint.h>
#include <string.h>

/* One walk over a text. */
typedef struct walk {
    const char *end;
    json_pick *picks;
    const char *rest[JSON_PICKS_MAX]; /* of each pointer: what still leads on */
} walk;

bool json_pointer_valid(const char *pointer)
{
    if (*pointer != '\0' && *pointer != '/')
        return false;
    for (const char *at = pointer; *at != '\0'; at++)
        if (*at == '~' && at[1] != '0' && at[1] != '1')
            return false;
    return true;
}

/* ---- values ---- */

static const char *past_space(const char *at, const char *end)
{
    while (at < end && (*at == ' ' || *at == '\t' || *at == '\n' || *at == '\r'))
        at++;
    return at;
}

/* The end of the string that begins at `at`. */
static const char *past_string(const char *at, const char *end)
{
    for (at++; at < end && *at != '"'; at++)
        if (*at == '\\')
            at++;
    return at < end ? at + 1 : end;
}

static const char *past_value(const char *at, const char *end)
{
    size_t depth = 0;
    while (at < end) {
        if (*at == '"') {
            at = past_string(at, end);
        } else if (*at == '{' || *at == '[') {
            depth++;
            at++;
        } else if (*at == '}' || *at == ']') {
            if (depth == 0)
                return at;
            depth--;
            at++;
        } else if (depth == 0) {
            at += strcspn(at, ",]} \t\r\n");
            return at < end ? at : end;
        } else {
            at++;
        }
        if (depth == 0)
            return at;
    }
    return end;
}

/* A member or an item, and what follows. */
typedef struct child {
    const char *name; /* NULL: an item */
    size_t name_size;
    const char *value;
} child;

/* The child at or after `at`; false at the end of its container. */
static bool next_child(const char *at, const char *end, bool object, child *c)
{
    at = past_space(at, end);
    if (at < end && *at == ',')
        at = past_space(at + 1, end);
    if (at >= end || *at == '}' || *at == ']')
        return false;
    *c = (child){.value = at};
    if (object) {
        const char *after = past_string(at, end);
        c->name = at + 1;
        c->name_size = (size_t)(after - at) - 2;
        c->value = past_space(past_space(after, end) + 1, end);
    }
    return c->value < end;
}

/* ---- the walk ---- */

/* Does the first token of `rest` name this child? */
static bool names(const char *rest, const child *c, uint64_t index)
{
    const char *token = rest + 1;
    if (c->name == NULL) {
        uint64_t number = 0;
        size_t digits = strcspn(token, "/");
        if (digits == 0 || digits > 15 || (digits > 1 && *token == '0'))
            return false;
        for (; digits > 0; digits--, token++) {
            if (*token < '0' || *token > '9')
                return false;
            number = number * 10 + (uint64_t)(*token - '0');
        }
        return number == index;
    }
    for (size_t i = 0; i < c->name_size; i++, token++) {
        char wanted = *token;
        if (wanted == '\0' || wanted == '/')
            return false;
        if (wanted == '~')
            wanted = *++token == '0' ? '~' : '/';
        if (wanted != c->name[i])
            return false;
    }
    return *token == '\0' || *token == '/';
}

/* Takes the pointers whose next token names this child one token on; returns which they are. */
static uint64_t step_in(walk *w, uint64_t going, const child *c, uint64_t index)
{
    uint64_t in = 0;
    for (uint64_t left = going; left != 0; left &= left - 1) {
        const int i = __builtin_ctzll(left);
        if (!names(w->rest[i], c, index))
            continue;
        in |= (uint64_t)1 << i;
        w->rest[i] += 1 + strcspn(w->rest[i] + 1, "/");
    }
    return in;
}

/* Walks the value at `at`, which the pointers of `active` lead to; returns its end. As deep as the
 * pointers are. */
static const char *walk_value(walk *w, const char *at, uint64_t active)
{
    const char *start = at;
    const bool object = *at == '{', container = object || *at == '[';
    uint64_t going = 0;
    for (uint64_t left = active; left != 0; left &= left - 1) {
        const int i = __builtin_ctzll(left);
        if (*w->rest[i] != '\0')
            going |= (uint64_t)1 << i;
    }
    const uint64_t wanted = active & ~going;
    child c;
    if (container && going != 0) {
        at++;
        for (uint64_t index = 0; going != 0 && next_child(at, w->end, object, &c); index++) {
            const uint64_t in = step_in(w, going, &c, index);
            at = in != 0 ? walk_value(w, c.value, in) : past_value(c.value, w->end);
            going &= ~in;
        }
    }
    /* Where it ends matters to what holds it. */
    const char *end = past_value(start, w->end);
    for (uint64_t left = wanted | going; left != 0; left &= left - 1) {
        const int i = __builtin_ctzll(left);
        json_pick *p = &w->picks[i];
        if (wanted & (uint64_t)1 << i) {
            p->value = start;
            p->size = (size_t)(end - start);
        } else {
            p->inside = start;
            p->inside_size = (size_t)(end - start);
            p->inside_pointer = (size_t)(w->rest[i] - p->pointer);
        }
    }
    return end;
}

void json_pick_all(const char *text, size_t size, json_pick *picks, size_t count)
{
    walk w = {.end = text + size, .picks = picks};
    const char *at = past_space(text, w.end);
    for (size_t i = 0; i < count; i++) {
        picks[i] = (json_pick){.pointer = picks[i].pointer};
        w.rest[i] = picks[i].pointer;
    }
    if (at < w.end && count > 0)
        walk_value(&w, at, count < 64 ? ((uint64_t)1 << count) - 1 : ~(uint64_t)0);
}

void json_children(const char *text, size_t size,
                   bool (*see)(void *context, const char *name, size_t size), void *context)
{
    const char *end = text + size, *at = past_space(text, end);
    if (at >= end || (*at != '{' && *at != '['))
        return;
    const bool object = *at++ == '{';
    child c;
    while (next_child(at, end, object, &c) && see(context, c.name, c.name_size))
        at = past_value(c.value, end);
}
