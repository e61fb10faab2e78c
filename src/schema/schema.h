/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A request is declared once: a table of fields, each with name, kind, unit, range, default, a
 * line of help and its place in the endpoint's request struct. From the table follow parsing,
 * checking, defaults, the echo, the canonical form (cache key), GET query parameters, the JSON
 * Schema of api/openapi.yaml and the dashboard's forms.
 *
 * Request structs are plain C; the first member is `field_set given`, where bit i says that row
 * i has a value: the caller gave it, its default was filled in, or FIELD_GIVE was called. Only
 * such rows are echoed and enter the key; the others are zero. Memory is zeroed before reading.
 *
 *     static const field fields[] = {
 *         {FIELD_AT(FIELD_NUMBER, request, span_m), .unit = "m", .min = 0, .max = 1e6,
 *          .flags = FIELD_OPEN_MIN, .help = "horizontal distance of the supports"},
 *         {.kind = FIELD_END}};
 */
#ifndef SCHEMA_SCHEMA_H
#define SCHEMA_SCHEMA_H

#include <cjson/cJSON.h>
#include <complex.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "json/problem.h"
#include "json/read.h"
#include "json/write.h"

typedef enum field_kind {
    FIELD_NUMBER,  /* double */
    FIELD_INTEGER, /* int64_t */
    FIELD_FLAG,    /* bool */
    FIELD_CHOICE,  /* int: index into `choices` */
    FIELD_CHOICES, /* choices_value: some of `choices`, each once, in any order */
    FIELD_NAME, /* name_value: a short identifier ([A-Za-z_][A-Za-z0-9_]*, at most NAME_MAX_SIZE
                   - 1) */
    FIELD_NUMBERS,   /* numbers_value */
    FIELD_COMPLEXES, /* complexes_value: numbers or {"re", "im"} */
    FIELD_OBJECT,    /* a nested struct of `schema`, in place */
    FIELD_OBJECTS,   /* objects_value: structs of `schema` */
    FIELD_VARIANTS,  /* objects_value: structs of one of `variants`, chosen by the member "type"
                      */
    FIELD_END
} field_kind;

enum {
    FIELD_REQUIRED = 1 << 0,
    FIELD_DEFAULT =
        1 << 1, /* `fallback` (for FIELD_CHOICE an index, for FIELD_FLAG 0 or 1) is filled in */
    FIELD_OPEN_MIN = 1 << 2, /* min itself is excluded */
    FIELD_OPEN_MAX = 1 << 3,
    FIELD_VARIABLE =
        1 << 4, /* FIELD_NUMBER held as variable_value: a number, or, where the endpoint
                   allows variables, {"variable": name, "scale": 1, "offset": 0} */
    FIELD_INFINITE =
        1 << 5, /* FIELD_NUMBER that also takes the string "infinite" (+INFINITY) */
    FIELD_ASCENDING = 1 << 6, /* FIELD_NUMBERS: strictly ascending */
    FIELD_WHOLE = 1 << 7,     /* FIELD_NUMBERS: whole numbers only */
};

typedef uint64_t field_set;

#define NAME_MAX_SIZE 64
typedef struct name_value {
    char text[NAME_MAX_SIZE];
} name_value;
/* Bit i: choice i is among them. */
typedef struct choices_value {
    uint64_t bits;
} choices_value;
typedef struct numbers_value {
    double *items;
    size_t count;
} numbers_value;
typedef struct complexes_value {
    double _Complex *items;
    size_t count;
} complexes_value;
typedef struct variable_value {
    double value; /* the number, or the offset when a variable is named */
    double scale;
    name_value name; /* empty: a plain number */
} variable_value;
struct variant;
typedef struct objects_value {
    void *items; /* array of structs (FIELD_OBJECTS), or of object_item (FIELD_VARIANTS) */
    size_t count;
} objects_value;
typedef struct object_item {
    int variant;  /* index into the row's variants */
    void *object; /* struct of that variant's schema */
} object_item;

typedef struct schema schema;

typedef struct variant {
    const char *type; /* value of the member "type" */
    const char *help;
    const schema *schema;
} variant;

/* At most FIELDS_MAX rows a table; a name is at most NAME_MAX_SIZE - 1 characters and is the
 * struct member's (FIELD_AT). */
#define FIELDS_MAX 64
#define FIELD_AT(kind_, type, member)                                                          \
    .name = #member, .kind = (kind_), .offset = offsetof(type, member)

typedef struct field {
    const char *name;
    field_kind kind;
    size_t offset;    /* of the value in the request struct */
    const char *unit; /* "m", "N", "1" for a ratio; NULL where a unit has no meaning */
    /* Range of a number or of every item of FIELD_NUMBERS (of FIELD_COMPLEXES: the largest
     * magnitude of each part is max); infinite: open on that side; min = max: no range. */
    double min, max;
    unsigned flags;
    double fallback;
    const char *help;            /* one line */
    const char *const *choices;  /* FIELD_CHOICE, FIELD_CHOICES (at most 64): NULL-terminated */
    const schema *schema;        /* FIELD_OBJECT, FIELD_OBJECTS */
    const variant *variants;     /* FIELD_VARIANTS: ends with type NULL */
    size_t min_items, max_items; /* lists; max_items 0: as many as a document may hold */
} field;

/* "One of these groups": exactly one group of fields (or none, where `optional`) may be given.
 * A group is field names separated by one space:
 *     name     is needed when this group is chosen, unless it has a default
 *     [name]   may be left out
 *     +name    is needed with this group but does not choose it: it may also be given with
 * others Defaults of a group's fields are filled in only when it is chosen. When none of the
 * fields is given, the first group that needs none is chosen. A name may stand in several
 * groups of one `field_groups`, but (except after +) in one `field_groups` only; FIELD_REQUIRED
 * has no meaning for it. */
typedef struct field_groups {
    const char *title; /* "geometry" */
    bool optional;
    const char *const *groups; /* NULL-terminated */
} field_groups;

struct schema {
    const char *name;           /* "catenary_frequencies_request" */
    const field *fields;        /* ends with FIELD_END */
    const field_groups *groups; /* NULL, or ends with title NULL */
    size_t size;                /* of the struct */
};

/* True when row `name` of the struct has a value: given, defaulted or set since (FIELD_GIVE).
 * To know what a caller gave, look at a field without a default. */
bool field_given(const schema *s, const void *request, const char *name);
/* The same of a struct's member: FIELD_GIVEN(&schema, r, span_m). A name that is no member does not
 * compile, and no names are compared. */
#define FIELD_GIVEN(s, request, member)                                                        \
    field_given_at((s), (request), FIELD_OFFSET(request, member))
bool field_given_at(const schema *s, const void *request, size_t offset);
/* Marks it as set: for defaults that are computed from other fields (they are echoed and enter
 * the key). */
#define FIELD_GIVE(s, request, member)                                                         \
    field_give_at((s), (request), FIELD_OFFSET(request, member))
void field_give_at(const schema *s, void *request, size_t offset);
#define FIELD_OFFSET(request, member)                                                          \
    ((size_t)((const char *)&(request)->member - (const char *)(request)))

/* A filled request: `request` and all lists it points to are owned by the arena and end with
 * schema_free. */
typedef struct schema_arena schema_arena;

/* Fills a request from a JSON object. All faults at once go into `p` (400), unknown fields with
 * the nearest known name. `variables` allows FIELD_VARIABLE rows to name variables. Returns
 * NULL when there is any. */
void *schema_read(const schema *s, const cJSON *object, bool variables, schema_arena **arena,
                  problem *p);

/* The same from a query string's pairs (values percent-decoded). Lists are comma-separated
 * numbers, or several pairs of one name. */
typedef struct query_pair {
    const char *name, *value;
} query_pair;
void *schema_read_query(const schema *s, const query_pair *pairs, size_t count,
                        schema_arena **arena, problem *p);
void schema_free(schema_arena *arena);

/* Calls `see` for every number of a request that names a variable: its pointer, its row, what
 * it holds. */
typedef void (*schema_see_variable)(void *context, const char *pointer, const field *f,
                                    const variable_value *v);
void schema_variables(const schema *s, const void *request, schema_see_variable see,
                      void *context);

/* Memory that lives as long as the request; NULL when there is none left. */
void *schema_alloc(schema_arena *arena, size_t size);
/* Lets the request own an object that is not in the arena's memory: schema_free calls `destroy`
 * with it, for several objects in the reverse order of these calls, so that a later one may
 * refer to an earlier one. When memory runs out the object is destroyed at once: false. */
bool schema_arena_own(schema_arena *arena, void *object, void (*destroy)(void *object));

/* The echo: every field given or defaulted, as a JSON object, in table order. */
void schema_echo(const schema *s, const void *request, json_writer *json);
/* The canonical binary form: equal requests, however written, give equal bytes: typed, with
 * names, -0 as +0, lists with their length, nothing for fields that are not set. */
void schema_canonical(const schema *s, const void *request, strbuf *out);
/* JSON Schema (draft 2020-12, the dialect of OpenAPI 3.1) of the request, with ranges, units
 * ("x-unit"), defaults and help; groups become oneOf. */
void schema_describe(const schema *s, bool variables, json_writer *json);

/* The nearest of the names tried: set `wanted`, try each, look at `name` (NULL: none is near).
 */
typedef struct nearest {
    const char *wanted;
    const char *name;
    int distance;
} nearest;
void nearest_try(nearest *n, const char *candidate);

#endif
