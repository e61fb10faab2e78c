/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A table as JSON Schema (draft 2020-12, the dialect of OpenAPI 3.1). It says all that the
 * reader checks of single fields and of groups; what an endpoint's prepare checks is not in it.
 */
#include <math.h>
#include <string.h>

#include "schema/parts.h"

static void describe_object(const schema *s, const variant *v, bool variables,
                            json_writer *json);

static void describe_range(const field *f, json_writer *json)
{
    if (!field_bounded(f))
        return;
    if (isfinite(f->min))
        json_put_number(json, f->flags & FIELD_OPEN_MIN ? "exclusiveMinimum" : "minimum",
                        f->min);
    if (isfinite(f->max))
        json_put_number(json, f->flags & FIELD_OPEN_MAX ? "exclusiveMaximum" : "maximum",
                        f->max);
}

/* {"type": "number", range}, or any of the other things that may stand for the number. */
static void describe_number(const field *f, bool variables, json_writer *json)
{
    const bool infinite = f->flags & FIELD_INFINITE;
    const bool variable = variables && f->flags & FIELD_VARIABLE;
    if (infinite || variable) {
        json_key(json, "oneOf");
        json_open_array(json);
        json_open_object(json);
    }
    json_put_string(json, "type", "number");
    describe_range(f, json);
    if (infinite || variable)
        json_close_object(json);
    if (infinite) {
        json_open_object(json);
        json_put_string(json, "const", "infinite");
        json_close_object(json);
    }
    if (variable)
        describe_object(&variable_schema, NULL, false, json);
    if (infinite || variable)
        json_close_array(json);
}

static void describe_complex(const field *f, json_writer *json)
{
    json_key(json, "oneOf");
    json_open_array(json);
    json_open_object(json);
    json_put_string(json, "type", "number");
    if (field_bounded(f)) {
        json_put_number(json, "minimum", -f->max);
        json_put_number(json, "maximum", f->max);
    }
    json_close_object(json);
    /* The bound of the row holds for both parts; the shared table knows none. */
    field parts[] = {complex_schema.fields[0], complex_schema.fields[1], {.kind = FIELD_END}};
    schema bounded = complex_schema;
    bounded.fields = parts;
    for (int i = 0; i < 2 && field_bounded(f); i++) {
        parts[i].min = -f->max;
        parts[i].max = f->max;
    }
    describe_object(&bounded, NULL, false, json);
    json_close_array(json);
}

/* Told apart by the constant `type` of each: OpenAPI's discriminator wants named schemas. */
static void describe_variants(const field *f, bool variables, json_writer *json)
{
    json_open_object(json);
    json_key(json, "oneOf");
    json_open_array(json);
    for (const variant *v = f->variants; v->type != NULL; v++)
        describe_object(v->schema, v, variables, json);
    json_close_array(json);
    json_close_object(json);
}

static void describe_words(const field *f, json_writer *json);

static void describe_list(const field *f, bool variables, json_writer *json)
{
    json_put_string(json, "type", "array");
    if (f->min_items > 0)
        json_put_integer(json, "minItems", (int64_t)f->min_items);
    if (f->max_items > 0)
        json_put_integer(json, "maxItems", (int64_t)f->max_items);
    if (f->kind == FIELD_CHOICES)
        json_put_flag(json, "uniqueItems", true);
    json_key(json, "items");
    if (f->kind == FIELD_VARIANTS) {
        describe_variants(f, variables, json);
        return;
    }
    if (f->kind == FIELD_OBJECTS) {
        describe_object(f->schema, NULL, variables, json);
        return;
    }
    json_open_object(json);
    if (f->kind == FIELD_CHOICES) {
        describe_words(f, json);
    } else if (f->kind == FIELD_COMPLEXES) {
        describe_complex(f, json);
    } else {
        json_put_string(json, "type", f->flags & FIELD_WHOLE ? "integer" : "number");
        describe_range(f, json);
    }
    json_close_object(json);
}

static void describe_words(const field *f, json_writer *json)
{
    json_put_string(json, "type", "string");
    if (f->kind == FIELD_NAME) {
        json_put_string(json, "pattern", "^[A-Za-z_][A-Za-z0-9_]*$");
        json_put_integer(json, "maxLength", NAME_MAX_SIZE - 1);
        return;
    }
    json_key(json, "enum");
    json_open_array(json);
    for (int i = 0; f->choices[i] != NULL; i++)
        json_string(json, f->choices[i]);
    json_close_array(json);
}

static void describe_default(const field *f, json_writer *json)
{
    if (!(f->flags & FIELD_DEFAULT))
        return;
    json_key(json, "default");
    if (f->kind == FIELD_FLAG) {
        json_flag(json, f->fallback != 0);
    } else if (f->kind == FIELD_CHOICE) {
        json_string(json, f->choices[(int)f->fallback]);
    } else if (f->kind == FIELD_OBJECT) {
        json_open_object(json);
        json_close_object(json);
    } else if (f->fallback == INFINITY) {
        json_string(json, "infinite");
    } else {
        json_number(json, f->fallback);
    }
}

static void describe_field(const field *f, bool variables, json_writer *json)
{
    if (f->kind == FIELD_OBJECT) {
        /* The object has a description of its own: an allOf keeps them apart. */
        json_open_object(json);
        json_key(json, "allOf");
        json_open_array(json);
        describe_object(f->schema, NULL, variables, json);
        json_close_array(json);
    } else {
        json_open_object(json);
        if (f->kind == FIELD_NUMBER) {
            describe_number(f, variables, json);
        } else if (f->kind == FIELD_INTEGER) {
            json_put_string(json, "type", "integer");
            describe_range(f, json);
        } else if (f->kind == FIELD_FLAG) {
            json_put_string(json, "type", "boolean");
        } else if (f->kind == FIELD_CHOICE || f->kind == FIELD_NAME) {
            describe_words(f, json);
        } else {
            describe_list(f, variables, json);
        }
    }
    describe_default(f, json);
    json_put_string(json, "description", f->help);
    if (f->unit != NULL)
        json_put_string(json, "x-unit", f->unit);
    if (f->flags & FIELD_ASCENDING)
        json_put_flag(json, "x-ascending", true);
    json_close_object(json);
}

/* ---- groups ---- */

/* "required": [..], left out when there are none. */
static void describe_required(const schema *s, field_set rows, const char *first,
                              json_writer *json)
{
    if (rows == 0 && first == NULL)
        return;
    json_key(json, "required");
    json_open_array(json);
    if (first != NULL)
        json_string(json, first);
    for (int row = 0; s->fields[row].kind != FIELD_END; row++)
        if (rows & row_bit(row))
            json_string(json, s->fields[row].name);
    json_close_array(json);
}

/* One alternative: `required` are there, `absent` are not, and at least one of `some`. */
static void describe_alternative(const schema *s, const char *title, field_set required,
                                 field_set absent, field_set some, json_writer *json)
{
    json_open_object(json);
    json_put_string(json, "title", title);
    describe_required(s, required, NULL, json);
    if ((absent | required) != 0) {
        json_key(json, "properties");
        json_open_object(json);
        for (int row = 0; s->fields[row].kind != FIELD_END; row++)
            if ((absent | required) & row_bit(row))
                json_put_flag(json, s->fields[row].name, (required & row_bit(row)) != 0);
        json_close_object(json);
    }
    if (some != 0) {
        json_key(json, "anyOf");
        json_open_array(json);
        for (int row = 0; s->fields[row].kind != FIELD_END; row++)
            if (some & row_bit(row)) {
                json_open_object(json);
                describe_required(s, row_bit(row), NULL, json);
                json_close_object(json);
            }
        json_close_array(json);
    }
    json_close_object(json);
}

/* Exactly one alternative must hold, also for a request that gives none of the fields: a second
 * group that needs none of its own fields holds only where one of them is given. */
static void describe_group(const schema *s, const alternatives *g, json_writer *json)
{
    bool empty_allowed = false;
    json_open_object(json);
    json_put_string(json, "title", g->words->title);
    json_key(json, "oneOf");
    json_open_array(json);
    for (size_t i = 0; i < g->count; i++) {
        const group one = g->groups[i];
        const field_set required = one.required | one.needed;
        field_set some = 0;
        if (one.required == 0) {
            some = empty_allowed ? one.own : 0;
            empty_allowed = true;
        }
        describe_alternative(s, g->words->groups[i], required, g->own & ~one.own, some, json);
    }
    if (g->words->optional && !empty_allowed)
        describe_alternative(s, "none", 0, g->own, 0, json);
    json_close_array(json);
    json_close_object(json);
}

static void describe_object(const schema *s, const variant *v, bool variables,
                            json_writer *json)
{
    field_set required = 0, grouped = 0;
    const alternatives *all = schema_alternatives(s);
    if (all == NULL) {
        json->out->failed = true;
        return;
    }
    for (const alternatives *g = all; g->words != NULL; g++)
        grouped |= g->own;
    json_open_object(json);
    json_put_string(json, "title", v != NULL ? v->type : s->name);
    if (v != NULL && v->help != NULL)
        json_put_string(json, "description", v->help);
    json_put_string(json, "type", "object");
    json_key(json, "properties");
    json_open_object(json);
    if (v != NULL) {
        json_key(json, "type");
        json_open_object(json);
        json_put_string(json, "const", v->type);
        json_close_object(json);
    }
    for (int row = 0; s->fields[row].kind != FIELD_END; row++) {
        const field *f = &s->fields[row];
        if (f->flags & FIELD_REQUIRED && !(f->flags & FIELD_DEFAULT))
            required |= row_bit(row) & ~grouped;
        json_key(json, f->name);
        describe_field(f, variables, json);
    }
    json_close_object(json);
    describe_required(s, required, v != NULL ? "type" : NULL, json);
    json_put_flag(json, "additionalProperties", false);
    if (grouped != 0) {
        json_key(json, "allOf");
        json_open_array(json);
        for (const alternatives *g = all; g->words != NULL; g++)
            describe_group(s, g, json);
        json_close_array(json);
    }
    json_close_object(json);
}

void schema_describe(const schema *s, bool variables, json_writer *json)
{
    describe_object(s, NULL, variables, json);
}
