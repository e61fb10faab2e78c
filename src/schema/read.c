/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Values of a request: from JSON into the struct, every fault at its pointer.
 *
 * Index: schema_read -> read_members -> read_field -> read_number, read_integer, read_choice, read_name,
 * read_numbers, read_complexes, read_objects, read_variants.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "schema/parts.h"
#include "schema/units.h"

/* Integers up to here are the ones a double holds without gaps. */
#define INTEGER_MAX 9007199254740991.0

/* ---- what was found, what was expected ---- */

typedef struct phrase {
    char text[160];
} phrase;

static const char *number_text(double value, char buffer[JSON_NUMBER_MAX + 1])
{
    if (!isfinite(value))
        return "a number too large for a double";
    buffer[json_print_double(value, buffer)] = '\0';
    return buffer;
}

/* The value a client gave, in a few words. */
static phrase found(const cJSON *item)
{
    phrase f = {"an array"};
    char buffer[JSON_NUMBER_MAX + 1];
    if (cJSON_IsString(item))
        (void)snprintf(f.text, sizeof f.text, "the string \"%.60s\"", item->valuestring);
    else if (cJSON_IsNumber(item))
        (void)snprintf(f.text, sizeof f.text, "%s", number_text(item->valuedouble, buffer));
    else if (!cJSON_IsArray(item))
        (void)snprintf(f.text, sizeof f.text, "%s",
                       cJSON_IsObject(item)  ? "an object"
                       : cJSON_IsTrue(item)  ? "true"
                       : cJSON_IsFalse(item) ? "false"
                                             : "null");
    return f;
}

/* "greater than 0 m and at most 100 m" */
static phrase range_text(const field *f)
{
    phrase range = {""};
    char low[JSON_NUMBER_MAX + 1], high[JSON_NUMBER_MAX + 1];
    const bool unit = f->unit != NULL && strcmp(f->unit, "1") != 0;
    const char *space = unit ? " " : "", *name = unit ? f->unit : "";
    const bool lower = isfinite(f->min), upper = isfinite(f->max);
    if (lower)
        (void)snprintf(range.text, sizeof range.text, "%s %s%s%s%s",
                       f->flags & FIELD_OPEN_MIN ? "greater than" : "at least",
                       number_text(f->min, low), space, name, upper ? " and " : "");
    const size_t used = strlen(range.text);
    if (upper)
        (void)snprintf(range.text + used, sizeof range.text - used, "%s %s%s%s",
                       f->flags & FIELD_OPEN_MAX ? "less than" : "at most",
                       number_text(f->max, high), space, name);
    return range;
}

static bool expected(reading *r, const json_place *place, const char *what, const cJSON *item)
{
    json_fault(r->p, place, "expected %s, found %s", what, found(item).text);
    return false;
}

/* ---- numbers ---- */

static bool in_range(const field *f, double value)
{
    if (!field_bounded(f))
        return true;
    return (f->flags & FIELD_OPEN_MIN ? value > f->min : value >= f->min) &&
           (f->flags & FIELD_OPEN_MAX ? value < f->max : value <= f->max);
}

static bool out_of_range(reading *r, const field *f, const cJSON *item, const json_place *place)
{
    json_fault(r->p, place, "must be %s, found %s", range_text(f).text, found(item).text);
    return false;
}

bool read_number(reading *r, const field *f, const cJSON *item, const json_place *place,
                 double *value)
{
    const bool infinite = (f->flags & FIELD_INFINITE) != 0;
    if (infinite && cJSON_IsString(item) && strcmp(item->valuestring, "infinite") == 0) {
        *value = INFINITY;
        return true;
    }
    if (!cJSON_IsNumber(item) || !isfinite(item->valuedouble))
        return expected(r, place, infinite ? "a number or \"infinite\"" : "a number", item);
    if (!in_range(f, item->valuedouble))
        return out_of_range(r, f, item, place);
    *value = item->valuedouble + 0.0; /* -0 is 0 */
    return true;
}

static bool read_whole(reading *r, const field *f, const cJSON *item, const json_place *place,
                       double *value)
{
    if (!cJSON_IsNumber(item) || !(fabs(item->valuedouble) <= INTEGER_MAX) ||
        item->valuedouble != trunc(item->valuedouble))
        return expected(r, place, "a whole number", item);
    return read_number(r, f, item, place, value);
}

static bool read_integer(reading *r, const field *f, const cJSON *item, const json_place *place,
                         int64_t *value)
{
    double number;
    if (!read_whole(r, f, item, place, &number))
        return false;
    *value = (int64_t)number;
    return true;
}

/* A number, or a linear function of a variable whose value, hence range, is known only later.
 */
static bool read_variable(reading *r, const field *f, const cJSON *item,
                          const json_place *place, variable_value *value)
{
    *value = (variable_value){.scale = 1};
    if (!cJSON_IsObject(item))
        return read_number(r, f, item, place, &value->value);
    if (!r->variables) {
        json_fault(r->p, place, "expected a number; this endpoint takes no variables");
        return false;
    }
    variable_members members = {0};
    read_members(r, &variable_schema, item, false, place, &members);
    *value = (variable_value){
        .value = members.offset, .scale = members.scale, .name = members.variable};
    return true;
}

/* ---- words ---- */

static bool read_choice(reading *r, const field *f, const cJSON *item, const json_place *place,
                        int *value)
{
    nearest near = {.wanted = cJSON_IsString(item) ? item->valuestring : ""};
    strbuf known = {0};
    for (int i = 0; f->choices[i] != NULL; i++) {
        if (strcmp(near.wanted, f->choices[i]) == 0) {
            *value = i;
            strbuf_clear(&known);
            return true;
        }
    }
    for (int i = 0; f->choices[i] != NULL; i++) {
        nearest_try(&near, f->choices[i]);
        strbuf_format(&known, "%s\"%s\"", i > 0 ? ", " : "", f->choices[i]);
    }
    if (known.failed)
        problem_out_of_memory(r->p);
    else
        json_fault(r->p, place, "expected one of %s, found %s%s%s%s", known.data,
                   found(item).text, near.name != NULL ? "; did you mean \"" : "",
                   near.name != NULL ? near.name : "", near.name != NULL ? "\"?" : "");
    strbuf_clear(&known);
    return false;
}

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static bool read_name(reading *r, const cJSON *item, const json_place *place, name_value *value)
{
    static const char rule[] =
        "a name of at most 63 letters, digits and underscores, a letter or underscore first";
    if (!cJSON_IsString(item))
        return expected(r, place, rule, item);
    const char *name = item->valuestring;
    const size_t size = strlen(name);
    bool good = size > 0 && size < NAME_MAX_SIZE && is_letter(name[0]);
    for (size_t i = 1; good && i < size; i++)
        good = is_letter(name[i]) || (name[i] >= '0' && name[i] <= '9');
    if (!good)
        return expected(r, place, rule, item);
    memcpy(value->text, name, size + 1);
    return true;
}

/* ---- lists ---- */

/* Checks kind and size of a list and makes room for its items (count may be 0). */
static bool begin_list(reading *r, const field *f, const cJSON *list, const json_place *place,
                       size_t item_size, void **items, size_t *count)
{
    *items = NULL;
    *count = 0;
    if (!cJSON_IsArray(list))
        return expected(r, place, "a list", list);
    size_t n = 0;
    for (const cJSON *item = list->child; item != NULL; item = item->next)
        n++;
    if (n < f->min_items || (f->max_items > 0 && n > f->max_items)) {
        char most[48] = "";
        if (f->max_items > 0)
            (void)snprintf(most, sizeof most, " and at most %zu", f->max_items);
        json_fault(r->p, place, "expected at least %zu%s items, found %zu", f->min_items, most,
                   n);
        return false;
    }
    *items = schema_alloc(r->arena, n * item_size);
    if (*items == NULL) {
        problem_out_of_memory(r->p);
        return false;
    }
    *count = n;
    return true;
}

static bool read_numbers(reading *r, const field *f, const cJSON *list, const json_place *place,
                         numbers_value *value)
{
    void *items;
    if (!begin_list(r, f, list, place, sizeof(double), &items, &value->count))
        return false;
    value->items = items;
    bool good = true;
    json_place at = {.parent = place};
    for (const cJSON *item = list->child; item != NULL; item = item->next, at.index++) {
        double *number = &value->items[at.index];
        const bool read = f->flags & FIELD_WHOLE ? read_whole(r, f, item, &at, number)
                                                 : read_number(r, f, item, &at, number);
        if (good && read && (f->flags & FIELD_ASCENDING) && at.index > 0 &&
            !(number[-1] < *number)) {
            json_fault(r->p, &at, "must be greater than the item before it");
            good = false;
        }
        good = good && read;
    }
    return good;
}

/* Some of the choices, each once. */
static bool read_choices(reading *r, const field *f, const cJSON *list, const json_place *place,
                         choices_value *value)
{
    void *items;
    size_t count;
    if (!begin_list(r, f, list, place, sizeof(int), &items, &count))
        return false;
    bool good = true;
    json_place at = {.parent = place};
    for (const cJSON *item = list->child; item != NULL; item = item->next, at.index++) {
        int choice = 0;
        if (!read_choice(r, f, item, &at, &choice)) {
            good = false;
        } else if (value->bits & (uint64_t)1 << choice) {
            json_fault(r->p, &at, "given more than once");
            good = false;
        } else {
            value->bits |= (uint64_t)1 << choice;
        }
    }
    return good;
}

static bool read_complex(reading *r, const field *f, const cJSON *item, const json_place *place,
                         double _Complex *value)
{
    complex_members members = {0};
    if (cJSON_IsNumber(item))
        members.re = item->valuedouble + 0.0;
    else if (!cJSON_IsObject(item))
        return expected(r, place, "a number or an object with re and im", item);
    else
        read_members(r, &complex_schema, item, false, place, &members);
    *value = CMPLX(members.re, members.im);
    if (field_bounded(f) && !(fabs(members.re) <= f->max && fabs(members.im) <= f->max)) {
        char buffer[JSON_NUMBER_MAX + 1];
        json_fault(r->p, place, "real and imaginary part must be at most %s in magnitude",
                   number_text(f->max, buffer));
        return false;
    }
    return true;
}

static bool read_complexes(reading *r, const field *f, const cJSON *list,
                           const json_place *place, complexes_value *value)
{
    void *items;
    if (!begin_list(r, f, list, place, sizeof(double _Complex), &items, &value->count))
        return false;
    value->items = items;
    json_place at = {.parent = place};
    for (const cJSON *item = list->child; item != NULL; item = item->next, at.index++)
        (void)read_complex(r, f, item, &at, &value->items[at.index]);
    return true;
}

/* ---- objects ---- */

static bool read_object(reading *r, const schema *s, const cJSON *item, const json_place *place,
                        void *value)
{
    if (!cJSON_IsObject(item))
        return expected(r, place, "an object", item);
    read_members(r, s, item, false, place, value);
    return true;
}

static bool read_objects(reading *r, const field *f, const cJSON *list, const json_place *place,
                         objects_value *value)
{
    if (!begin_list(r, f, list, place, f->schema->size, &value->items, &value->count))
        return false;
    json_place at = {.parent = place};
    for (const cJSON *item = list->child; item != NULL; item = item->next, at.index++)
        (void)read_object(r, f->schema, item, &at,
                          (char *)value->items + at.index * f->schema->size);
    return true;
}

/* The variant that the member "type" names, or -1 with a fault. */
static int find_variant(reading *r, const field *f, const cJSON *item, const json_place *place)
{
    const cJSON *type = item->child;
    while (type != NULL && strcmp(type->string, "type") != 0)
        type = type->next;
    nearest near = {.wanted = cJSON_IsString(type) ? type->valuestring : ""};
    for (int i = 0; f->variants[i].type != NULL; i++)
        if (strcmp(near.wanted, f->variants[i].type) == 0)
            return i;
    strbuf known = {0};
    for (int i = 0; f->variants[i].type != NULL; i++) {
        nearest_try(&near, f->variants[i].type);
        strbuf_format(&known, "%s%s", i > 0 ? ", " : "", f->variants[i].type);
    }
    const json_place at = {.parent = place, .name = "type"};
    if (known.failed)
        problem_out_of_memory(r->p);
    else if (type == NULL)
        json_fault(r->p, &at, "missing: one of %s", known.data);
    else
        json_fault(r->p, &at, "expected one of %s, found %s%s%s%s", known.data,
                   found(type).text, near.name != NULL ? "; did you mean \"" : "",
                   near.name != NULL ? near.name : "", near.name != NULL ? "\"?" : "");
    strbuf_clear(&known);
    return -1;
}

static bool read_variants(reading *r, const field *f, const cJSON *list,
                          const json_place *place, objects_value *value)
{
    if (!begin_list(r, f, list, place, sizeof(object_item), &value->items, &value->count))
        return false;
    json_place at = {.parent = place};
    for (const cJSON *item = list->child; item != NULL; item = item->next, at.index++) {
        if (!cJSON_IsObject(item)) {
            (void)expected(r, &at, "an object with a type", item);
            continue;
        }
        const int which = find_variant(r, f, item, &at);
        if (which < 0)
            continue;
        const schema *s = f->variants[which].schema;
        void *object = schema_alloc(r->arena, s->size);
        if (object == NULL) {
            problem_out_of_memory(r->p);
            return false;
        }
        ((object_item *)value->items)[at.index] =
            (object_item){.variant = which, .object = object};
        read_members(r, s, item, true, &at, object);
    }
    return true;
}

/* ---- members ---- */

static bool read_field(reading *r, const field *f, const cJSON *item, const json_place *place,
                       void *value)
{
    switch (f->kind) {
    case FIELD_NUMBER:
        return f->flags & FIELD_VARIABLE ? read_variable(r, f, item, place, value)
                                         : read_number(r, f, item, place, value);
    case FIELD_INTEGER:
        return read_integer(r, f, item, place, value);
    case FIELD_FLAG:
        *(bool *)value = cJSON_IsTrue(item);
        return cJSON_IsBool(item) || expected(r, place, "true or false", item);
    case FIELD_CHOICE:
        return read_choice(r, f, item, place, value);
    case FIELD_CHOICES:
        return read_choices(r, f, item, place, value);
    case FIELD_NAME:
        return read_name(r, item, place, value);
    case FIELD_NUMBERS:
        return read_numbers(r, f, item, place, value);
    case FIELD_COMPLEXES:
        return read_complexes(r, f, item, place, value);
    case FIELD_OBJECT:
        return read_object(r, f->schema, item, place, value);
    case FIELD_OBJECTS:
        return read_objects(r, f, item, place, value);
    case FIELD_VARIANTS:
        return read_variants(r, f, item, place, value);
    case FIELD_END:
        break;
    }
    return false;
}

/* The row that is nearest to a name, never one of another quantity: a unit of another dimension
 * rules it out, one of the same with the same quantity decides. */
static const char *nearest_row(const schema *s, bool typed, const char *name,
                               const name_unit *unit)
{
    nearest near = {.wanted = name};
    for (int row = 0; s->fields[row].kind != FIELD_END; row++) {
        const name_unit other = unit_of_name(s->fields[row].name);
        if (same_dimension(unit, &other) && strcmp(unit->quantity, other.quantity) == 0)
            return s->fields[row].name;
        if (!unit->known || !other.known || same_dimension(unit, &other))
            nearest_try(&near, s->fields[row].name);
    }
    if (typed)
        nearest_try(&near, "type");
    return near.name;
}

static void unknown_member(reading *r, const schema *s, bool typed, const cJSON *item,
                           const json_place *place)
{
    if (r->p->omitted > 0) { /* nobody reads what is near */
        json_fault(r->p, place, "unknown field");
        return;
    }
    const name_unit given = unit_of_name(place->name);
    const char *near = nearest_row(s, typed, place->name, &given);
    const name_unit wanted = unit_of_name(near != NULL ? near : "");
    const double factor = given.factor / wanted.factor;
    const bool number = cJSON_IsNumber(item) && isfinite(item->valuedouble * factor);
    const double value = number ? item->valuedouble : 1;
    if (near != NULL && same_dimension(&given, &wanted) && strcmp(given.text, wanted.text) != 0)
        json_fault(r->p, place, "unknown field; did you mean %s? %.12g %s is %.12g %s", near,
                   value, given.text, value * factor, wanted.text);
    else if (near != NULL)
        json_fault(r->p, place, "unknown field; did you mean %s?", near);
    else
        json_fault(r->p, place, "unknown field");
}

void read_members(reading *r, const schema *s, const cJSON *object, bool typed,
                  const json_place *place, void *request)
{
    field_set seen = 0;
    int hint = 0;
    for (const cJSON *member = object != NULL ? object->child : NULL; member != NULL;
         member = member->next) {
        const json_place at = {.parent = place, .name = member->string};
        if (typed && strcmp(member->string, "type") == 0)
            continue;
        const int row = schema_row(s, member->string, hint);
        if (row < 0) {
            unknown_member(r, s, typed, member, &at);
            continue;
        }
        hint = row + 1;
        seen |= row_bit(row);
        const field *f = &s->fields[row];
        if (read_field(r, f, member, &at, (char *)request + f->offset))
            *(field_set *)request |= row_bit(row);
    }
    complete_members(r, s, seen, place, request);
}

void *schema_read(const schema *s, const cJSON *object, bool variables, schema_arena **arena,
                  problem *p)
{
    reading r = {.arena = arena_new(), .p = p, .variables = variables};
    void *request = r.arena != NULL ? schema_alloc(r.arena, s->size) : NULL;
    if (request == NULL)
        problem_out_of_memory(p);
    else if (!cJSON_IsObject(object))
        problem_add(p, "", "expected an object with the fields of %s", s->name);
    else
        read_members(&r, s, object, false, NULL, request);
    if (p->status != 0) {
        schema_free(r.arena);
        *arena = NULL;
        return NULL;
    }
    *arena = r.arena;
    return request;
}
