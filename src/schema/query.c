/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A request from a query string: the pairs become the JSON object that the same request would
 * be as a body, and are read as such. What is not what its field wants stays a string, so that
 * the reader reports it with its pointer.
 */
#include <stdlib.h>
#include <string.h>

#include "schema/parts.h"

static cJSON *text_value(const char *value, size_t size)
{
    char copy[256];
    if (size < sizeof copy) {
        memcpy(copy, value, size);
        copy[size] = '\0';
        return cJSON_CreateString(copy);
    }
    char *long_copy = strndup(value, size);
    cJSON *item = long_copy != NULL ? cJSON_CreateString(long_copy) : NULL;
    free(long_copy);
    return item;
}

static const char *after_digits(const char *at, const char *end)
{
    while (at < end && *at >= '0' && *at <= '9')
        at++;
    return at;
}

/* A + that was not escaped arrives as a space. */
static const char *after_sign(const char *at, const char *end)
{
    return at < end && (*at == '-' || *at == '+' || *at == ' ') ? at + 1 : at;
}

/* Where a number ends as programs write it: as JSON does, and +3e6, .5, 5. and 007; NULL: there
 * is none. */
static const char *number_end(const char *at, const char *end)
{
    const char *const integer = after_sign(at, end);
    at = after_digits(integer, end);
    bool digits = at > integer;
    if (at < end && *at == '.') {
        const char *const fraction = at + 1;
        at = after_digits(fraction, end);
        digits |= at > fraction;
    }
    if (!digits || at == end || (*at != 'e' && *at != 'E'))
        return digits ? at : NULL;
    const char *const exponent = after_sign(at + 1, end);
    at = after_digits(exponent, end);
    return at > exponent ? at : NULL;
}

static cJSON *number_value(const char *value, size_t size)
{
    if (number_end(value, value + size) != value + size)
        return text_value(value, size);
    char *copy = strndup(value, size);
    if (copy == NULL)
        return NULL;
    for (char *c = copy; *c != '\0'; c++)
        *c = *c == ' ' ? '+' : *c;
    cJSON *item = cJSON_CreateNumber(strtod(copy, NULL));
    free(copy);
    return item;
}

static cJSON *list_value(const char *value, bool numbers)
{
    cJSON *list = cJSON_CreateArray();
    for (const char *at = value; list != NULL;) {
        const size_t size = strcspn(at, ",");
        cJSON *item = numbers ? number_value(at, size) : text_value(at, size);
        if (item == NULL || !cJSON_AddItemToArray(list, item)) {
            cJSON_Delete(item);
            cJSON_Delete(list);
            return NULL;
        }
        if (at[size] == '\0')
            break;
        at += size + 1;
    }
    return list;
}

static cJSON *field_value(const field *f, const char *value)
{
    switch (f->kind) {
    case FIELD_NUMBER:
    case FIELD_INTEGER:
        return number_value(value, strlen(value));
    case FIELD_NUMBERS:
    case FIELD_COMPLEXES:
    case FIELD_CHOICES:
        return list_value(value, f->kind != FIELD_CHOICES);
    case FIELD_FLAG:
        /* True and False: Python's clients write flags so. */
        if (strcmp(value, "true") == 0 || strcmp(value, "True") == 0)
            return cJSON_CreateTrue();
        if (strcmp(value, "false") == 0 || strcmp(value, "False") == 0)
            return cJSON_CreateFalse();
        break;
    default:
        break;
    }
    return text_value(value, strlen(value));
}

static bool is_list(field_kind kind)
{
    return kind == FIELD_NUMBERS || kind == FIELD_COMPLEXES;
}

/* Adds the field to the object; a list that is named again goes on. Takes over `item`. */
static bool add_field(cJSON *object, const char *name, cJSON *item)
{
    cJSON *before = cJSON_GetObjectItemCaseSensitive(object, name);
    if (item == NULL)
        return false;
    if (!cJSON_IsArray(before) || !cJSON_IsArray(item)) {
        const bool added = cJSON_AddItemToObject(object, name, item);
        if (!added)
            cJSON_Delete(item);
        return added;
    }
    while (item->child != NULL)
        cJSON_AddItemToArray(before, cJSON_DetachItemViaPointer(item, item->child));
    cJSON_Delete(item);
    return true;
}

/* True when the pair may stand in a query string. */
static bool pair_allowed(const schema *s, const query_pair *pair, field_set *seen, problem *p)
{
    const int row = schema_row(s, pair->name, 0);
    if (row < 0)
        return true; /* the reader names it, with what is near */
    const json_place place = {.name = pair->name};
    const field_kind kind = s->fields[row].kind;
    if (*seen & row_bit(row) && !is_list(kind)) {
        json_fault(p, &place, "given more than once");
        return false;
    }
    *seen |= row_bit(row);
    if (kind == FIELD_OBJECT || kind == FIELD_OBJECTS || kind == FIELD_VARIANTS) {
        json_fault(p, &place, "cannot be given in a query string: send JSON by POST");
        return false;
    }
    return true;
}

void *schema_read_query(const schema *s, const query_pair *pairs, size_t count,
                        schema_arena **arena, problem *p)
{
    *arena = NULL;
    cJSON *object = cJSON_CreateObject();
    bool good = object != NULL;
    field_set seen = 0;
    for (size_t i = 0; i < count && good; i++) {
        if (!pair_allowed(s, &pairs[i], &seen, p))
            continue;
        const int row = schema_row(s, pairs[i].name, 0);
        cJSON *item =
            row >= 0 ? field_value(&s->fields[row], pairs[i].value) : cJSON_CreateNull();
        good = add_field(object, pairs[i].name, item);
    }
    if (!good)
        problem_out_of_memory(p);
    void *request = NULL;
    if (good)
        request = schema_read(s, object, false, arena, p);
    cJSON_Delete(object);
    return request;
}
