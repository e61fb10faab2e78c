/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/api/batch_item.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "validation/registry.h"

/* ---- reading ---- */

static void read_id(const cJSON *id, batch_item *item, problem *p)
{
    const double number = cJSON_IsNumber(id) ? id->valuedouble : 0.5;
    strbuf text = {0};
    json_writer json = {.out = &text};
    if (cJSON_IsString(id) && *id->valuestring && strlen(id->valuestring) <= BATCH_ID_MAX) {
        json_string(&json, id->valuestring);
    } else if (number == floor(number) && fabs(number) <= 9007199254740991.0) {
        json_integer(&json, (int64_t)number);
    } else {
        problem_add(p, "/id",
                    "expected a text of 1 to %d bytes, or a whole number up to 2^53 - 1",
                    BATCH_ID_MAX);
        return;
    }
    if (text.failed) {
        strbuf_clear(&text);
        problem_out_of_memory(p);
    }
    item->id = text.data;
}

static bool is_repeated(const batch_item *item, const char *pointer)
{
    for (size_t i = 0; i < item->count; i++)
        if (strcmp(item->fields[i], pointer) == 0)
            return true;
    return false;
}

static void read_field(const cJSON *one, size_t index, batch_item *item, problem *p)
{
    char place[32];
    snprintf(place, sizeof place, "/fields/%zu", index);
    const char *pointer = cJSON_IsString(one) ? one->valuestring : NULL;
    if (pointer == NULL || strlen(pointer) > BATCH_FIELD_MAX || !json_pointer_valid(pointer)) {
        problem_add(
            p, place,
            "expected a JSON pointer (RFC 6901) of up to %d bytes into the answer, such as "
            "/result or /result/modes/0",
            BATCH_FIELD_MAX);
    } else if (is_repeated(item, pointer)) {
        problem_add(p, place, "given more than once");
    } else if ((item->fields[item->count] = strdup(pointer)) == NULL) {
        problem_out_of_memory(p);
    } else {
        item->count++;
    }
}

static void read_fields(const cJSON *fields, batch_item *item, problem *p)
{
    const int count = cJSON_GetArraySize(fields);
    if (!cJSON_IsArray(fields) || count < 1 || count > JSON_PICKS_MAX) {
        problem_add(p, "/fields", "expected a list of 1 to %d JSON pointers into the answer",
                    JSON_PICKS_MAX);
        return;
    }
    item->chosen = true;
    item->fields = calloc((size_t)count, sizeof *item->fields);
    if (item->fields == NULL) {
        problem_out_of_memory(p);
        return;
    }
    size_t index = 0;
    for (const cJSON *one = fields->child; one != NULL; one = one->next)
        read_field(one, index++, item, p);
}

static const endpoint *read_path(const page *pages, const cJSON *path, problem *p)
{
    if (!cJSON_IsString(path)) {
        problem_add(p, "/path", "needed: the path of an endpoint, such as %s",
                    endpoints[0]->path);
        return NULL;
    }
    const endpoint *e = endpoint_find(path->valuestring);
    if (e == NULL) {
        const char *near = route_near(pages, path->valuestring);
        const bool is_endpoint = near && endpoint_find(near);
        problem_add(p, "/path", "no endpoint%s%s", is_endpoint ? "; did you mean " : "",
                    is_endpoint ? near : "");
    }
    return e;
}

const endpoint *batch_item_read(const page *pages, const cJSON *document, batch_item *item,
                                const cJSON **asked, problem *p)
{
    *asked = NULL;
    if (!cJSON_IsObject(document)) {
        problem_add(p, "", "an item is an object with \"path\" and \"request\"");
        return NULL;
    }
    const cJSON *path = NULL;
    for (const cJSON *one = document->child; one != NULL; one = one->next) {
        if (strcmp(one->string, "path") == 0)
            path = one;
        else if (strcmp(one->string, "request") == 0)
            *asked = one;
        else if (strcmp(one->string, "id") == 0)
            read_id(one, item, p);
        else if (strcmp(one->string, "fields") == 0)
            read_fields(one, item, p);
        else
            json_fault(p, &(json_place){.name = one->string},
                       "unknown; an item has path, request, id and fields");
    }
    const endpoint *e = read_path(pages, path, p);
    if (*asked == NULL)
        problem_add(p, "/request", "needed: what POST would send there");
    return p->status ? NULL : e;
}

void batch_item_free(batch_item *item)
{
    free(item->id);
    for (size_t i = 0; i < item->count; i++)
        free(item->fields[i]);
    free(item->fields);
    *item = (batch_item){0};
}

bool batch_item_is_plain(const batch_item *item)
{
    return item->id == NULL && !item->chosen;
}

/* ---- the line ---- */

/* What is there in place of a field: the names, and the number of them. */
typedef struct missing {
    strbuf *out;
    size_t count;
} missing;

/* Names listed beside a field that is not there. */
#define NAMES_SHOWN 16

static bool list_name(void *context, const char *name, size_t size)
{
    missing *m = context;
    char copy[NAME_MAX_SIZE];
    m->count++;
    if (name == NULL)
        return true;
    if (size < sizeof copy) {
        memcpy(copy, name, size);
        copy[size] = '\0';
        if (m->count <= NAMES_SHOWN)
            strbuf_format(m->out, "%s%s", m->count > 1 ? ", " : "", copy);
    }
    return m->count < NAMES_SHOWN;
}

static void say_missing(const json_pick *pick, size_t index, problem *p)
{
    char place[32];
    snprintf(place, sizeof place, "/fields/%zu", index);
    strbuf names = {0};
    missing m = {.out = &names};
    const char *at = pick->inside != NULL ? pick->inside : "";
    problem_set(p, 422, "the answer does not have every one of the fields");
    json_children(at, pick->inside_size, list_name, &m);
    const int led = (int)pick->inside_pointer;
    const char *where = led > 0 ? pick->pointer : "the answer";
    const int shown = led > 0 ? led : (int)strlen(where);
    if (*at == '[')
        problem_add(p, place, "the answer has no %s; %.*s is a list of %zu items, from 0",
                    pick->pointer, shown, where, m.count);
    else if (*at == '{')
        problem_add(p, place, "the answer has no %s; %.*s has %s%s", pick->pointer, shown,
                    where, names.data != NULL ? names.data : "nothing in it",
                    m.count >= NAMES_SHOWN ? " and more" : "");
    else
        problem_add(p, place, "the answer has no %s; %.*s has nothing below it", pick->pointer,
                    shown, where);
    if (names.failed)
        problem_out_of_memory(p);
    strbuf_clear(&names);
}

/* {"fields": {pointer: value}, "warnings", "key"}: warnings come unasked, for what they say holds of
 * the fields too. */
static void write_chosen(const batch_item *item, const entry *outcome, strbuf *body, problem *p)
{
    json_pick picks[JSON_PICKS_MAX] = {0}, warnings = {.pointer = "/warnings"};
    for (size_t i = 0; i < item->count; i++)
        picks[i].pointer = item->fields[i];
    json_pick_all(outcome->body, outcome->size, picks, item->count);
    json_pick_all(outcome->body, outcome->size, &warnings, 1);
    json_writer json = {.out = body};
    json_open_object(&json);
    json_key(&json, "fields");
    json_open_object(&json);
    for (size_t i = 0; i < item->count; i++) {
        if (picks[i].value == NULL) {
            say_missing(&picks[i], i, p);
            continue;
        }
        json_key(&json, picks[i].pointer);
        json_raw(&json, picks[i].value, picks[i].size);
    }
    json_close_object(&json);
    json_key(&json, "warnings");
    json_raw(&json, warnings.value != NULL ? warnings.value : "[]",
             warnings.value != NULL ? warnings.size : 2);
    json_put_string(&json, "key", outcome->hex);
    json_close_object(&json);
}

/* The object `from` with the id before its members. */
static void put_id(const char *id, const char *from, size_t size, strbuf *out)
{
    strbuf_add_string(out, "{\"id\":");
    strbuf_add_string(out, id);
    strbuf_add(out, ",", 1);
    strbuf_add(out, from + 1, size - 1);
}

entry *batch_item_outcome(const batch_item *item, entry *outcome)
{
    if (outcome == NULL || batch_item_is_plain(item))
        return outcome;
    strbuf body = {0}, line = {0};
    problem why = {0};
    int status = outcome->status;
    if (status == 200 && item->chosen) {
        write_chosen(item, outcome, &body, &why);
        if (why.status != 0) {
            strbuf_clear(&body);
            status = why.status;
            problem_write(&why, NULL, &body);
        }
    } else {
        strbuf_add(&body, outcome->body, outcome->size);
    }
    if (item->id != NULL && !body.failed)
        put_id(item->id, body.data, body.size, &line);
    strbuf *made = item->id != NULL ? &line : &body;
    made->failed |= body.failed;
    entry *mine = entry_new(&outcome->key, status, made);
    strbuf_clear(&body);
    strbuf_clear(&line);
    problem_clear(&why);
    entry_unref(outcome);
    return mine;
}
