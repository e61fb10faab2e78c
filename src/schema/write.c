/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A filled request, written: the echo for people, the canonical bytes for the key. */
#include <math.h>
#include <string.h>

#include "schema/parts.h"

/* ---- echo ---- */

static void echo_members(const schema *s, const void *request, json_writer *json);

static void echo_number(double value, json_writer *json)
{
    if (value == INFINITY)
        json_string(json, "infinite");
    else
        json_number(json, value);
}

static void echo_variable(const variable_value *value, json_writer *json)
{
    if (value->name.text[0] == '\0') {
        echo_number(value->value, json);
        return;
    }
    json_open_object(json);
    json_put_string(json, "variable", value->name.text);
    json_put_number(json, "scale", value->scale);
    json_put_number(json, "offset", value->value);
    json_close_object(json);
}

static void echo_object(const schema *s, const void *object, const char *type,
                        json_writer *json)
{
    json_open_object(json);
    if (type != NULL)
        json_put_string(json, "type", type);
    echo_members(s, object, json);
    json_close_object(json);
}

/* Item i of a list row. */
static void echo_item(const field *f, const void *value, size_t i, json_writer *json)
{
    if (f->kind == FIELD_NUMBERS) {
        json_number(json, ((const numbers_value *)value)->items[i]);
    } else if (f->kind == FIELD_COMPLEXES) {
        json_complex(json, ((const complexes_value *)value)->items[i]);
    } else if (f->kind == FIELD_OBJECTS) {
        const char *items = ((const objects_value *)value)->items;
        echo_object(f->schema, items + i * f->schema->size, NULL, json);
    } else {
        const object_item *item =
            (const object_item *)((const objects_value *)value)->items + i;
        const variant *v = &f->variants[item->variant];
        echo_object(v->schema, item->object, v->type, json);
    }
}

static size_t list_count(const field *f, const void *value)
{
    return f->kind == FIELD_NUMBERS     ? ((const numbers_value *)value)->count
           : f->kind == FIELD_COMPLEXES ? ((const complexes_value *)value)->count
                                        : ((const objects_value *)value)->count;
}

/* In the table's order, whatever the client's was. */
static void echo_choices(const field *f, const choices_value *value, json_writer *json)
{
    json_open_array(json);
    for (int i = 0; f->choices[i] != NULL; i++)
        if (value->bits & (uint64_t)1 << i)
            json_string(json, f->choices[i]);
    json_close_array(json);
}

static void echo_value(const field *f, const void *value, json_writer *json)
{
    switch (f->kind) {
    case FIELD_NUMBER:
        if (f->flags & FIELD_VARIABLE)
            echo_variable(value, json);
        else
            echo_number(*(const double *)value, json);
        break;
    case FIELD_INTEGER:
        json_integer(json, *(const int64_t *)value);
        break;
    case FIELD_FLAG:
        json_flag(json, *(const bool *)value);
        break;
    case FIELD_CHOICE:
        json_string(json, f->choices[*(const int *)value]);
        break;
    case FIELD_CHOICES:
        echo_choices(f, value, json);
        break;
    case FIELD_NAME:
        json_string(json, ((const name_value *)value)->text);
        break;
    case FIELD_OBJECT:
        echo_object(f->schema, value, NULL, json);
        break;
    default:
        json_open_array(json);
        for (size_t i = 0; i < list_count(f, value); i++)
            echo_item(f, value, i, json);
        json_close_array(json);
        break;
    }
}

static void echo_members(const schema *s, const void *request, json_writer *json)
{
    for (int row = 0; s->fields[row].kind != FIELD_END; row++) {
        const field *f = &s->fields[row];
        if (given_rows(request) & row_bit(row)) {
            json_key(json, f->name);
            echo_value(f, (const char *)request + f->offset, json);
        }
    }
}

void schema_echo(const schema *s, const void *request, json_writer *json)
{
    echo_object(s, request, NULL, json);
}

/* ---- canonical bytes ----
 *
 * members: { name, NUL, value }..., NUL (no name is empty: it ends them)
 * value: a tag, then
 *   'n' 8 bytes of the double, little-endian     'i' 8 bytes of the integer
 *   'f' 1 byte                                   's' text, NUL
 *   'v' text, NUL, scale, offset                 'l' 8 bytes of the count, that many values
 *   'c' re, im                                   'o' members    't' type, NUL, members
 */

static void add_word(strbuf *out, uint64_t word)
{
    unsigned char bytes[8];
    for (int i = 0; i < 8; i++)
        bytes[i] = (unsigned char)(word >> (8 * i));
    strbuf_add(out, bytes, sizeof bytes);
}

static void add_double(strbuf *out, double value)
{
    value += 0.0; /* -0 is 0 */
    uint64_t word;
    memcpy(&word, &value, sizeof word);
    add_word(out, word);
}

static void add_tag(strbuf *out, char tag)
{
    strbuf_add(out, &tag, 1);
}

static void add_name(strbuf *out, const char *name)
{
    strbuf_add(out, name, strlen(name) + 1);
}

static void canonical_members(const schema *s, const void *request, strbuf *out);

static void canonical_number(const field *f, const void *value, strbuf *out)
{
    const variable_value *v = value;
    if (!(f->flags & FIELD_VARIABLE)) {
        add_tag(out, 'n');
        add_double(out, *(const double *)value);
    } else if (v->name.text[0] == '\0') {
        add_tag(out, 'n');
        add_double(out, v->value);
    } else {
        add_tag(out, 'v');
        add_name(out, v->name.text);
        add_double(out, v->scale);
        add_double(out, v->value);
    }
}

static void canonical_item(const field *f, const void *value, size_t i, strbuf *out)
{
    if (f->kind == FIELD_NUMBERS) {
        add_tag(out, 'n');
        add_double(out, ((const numbers_value *)value)->items[i]);
    } else if (f->kind == FIELD_COMPLEXES) {
        const double _Complex z = ((const complexes_value *)value)->items[i];
        add_tag(out, 'c');
        add_double(out, creal(z));
        add_double(out, cimag(z));
    } else if (f->kind == FIELD_OBJECTS) {
        const char *items = ((const objects_value *)value)->items;
        add_tag(out, 'o');
        canonical_members(f->schema, items + i * f->schema->size, out);
    } else {
        const object_item *item =
            (const object_item *)((const objects_value *)value)->items + i;
        add_tag(out, 't');
        add_name(out, f->variants[item->variant].type);
        canonical_members(f->variants[item->variant].schema, item->object, out);
    }
}

static void canonical_choices(const field *f, const choices_value *value, strbuf *out)
{
    add_tag(out, 'l');
    add_word(out, (uint64_t)__builtin_popcountll(value->bits));
    for (int i = 0; f->choices[i] != NULL; i++)
        if (value->bits & (uint64_t)1 << i) {
            add_tag(out, 's');
            add_name(out, f->choices[i]);
        }
}

static void canonical_value(const field *f, const void *value, strbuf *out)
{
    switch (f->kind) {
    case FIELD_NUMBER:
        canonical_number(f, value, out);
        break;
    case FIELD_INTEGER:
        add_tag(out, 'i');
        add_word(out, (uint64_t)(*(const int64_t *)value));
        break;
    case FIELD_FLAG:
        add_tag(out, 'f');
        add_tag(out, *(const bool *)value);
        break;
    case FIELD_CHOICE:
        add_tag(out, 's');
        add_name(out, f->choices[*(const int *)value]);
        break;
    case FIELD_CHOICES:
        canonical_choices(f, value, out);
        break;
    case FIELD_NAME:
        add_tag(out, 's');
        add_name(out, ((const name_value *)value)->text);
        break;
    case FIELD_OBJECT:
        add_tag(out, 'o');
        canonical_members(f->schema, value, out);
        break;
    default:
        add_tag(out, 'l');
        add_word(out, list_count(f, value));
        for (size_t i = 0; i < list_count(f, value); i++)
            canonical_item(f, value, i, out);
        break;
    }
}

static void canonical_members(const schema *s, const void *request, strbuf *out)
{
    for (int row = 0; s->fields[row].kind != FIELD_END; row++) {
        const field *f = &s->fields[row];
        if (given_rows(request) & row_bit(row)) {
            add_name(out, f->name);
            canonical_value(f, (const char *)request + f->offset, out);
        }
    }
    add_tag(out, '\0');
}

void schema_canonical(const schema *s, const void *request, strbuf *out)
{
    canonical_members(s, request, out);
}
