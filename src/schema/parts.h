/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of the schema engine share; nobody else includes it. */
#ifndef SCHEMA_PARTS_H
#define SCHEMA_PARTS_H

#include "schema/schema.h"

/* One reading of a request. */
typedef struct reading {
    schema_arena *arena;
    problem *p;
    bool variables;
} reading;

/* An empty arena, or NULL. */
schema_arena *arena_new(void);

/* Row `name`, or -1; looked for from row `hint` on, for documents follow the table's order. */
int schema_row(const schema *s, const char *name, int hint);

/* The number of a row with its range checked; false with a fault. */
bool read_number(reading *r, const field *f, const cJSON *item, const json_place *place,
                 double *value);
/* Fills a struct (zeroed) from the members of `object`, which may be NULL (no members). The
 * member "type" of a `typed` one was read before. */
void read_members(reading *r, const schema *s, const cJSON *object, bool typed,
                  const json_place *place, void *request);

/* Chooses groups, fills defaults and reports what is missing; `seen` are the rows that were
 * given, rightly or wrongly. */
void complete_members(reading *r, const schema *s, field_set seen, const json_place *place,
                      void *request);

/* A group of a table, as rows. */
typedef struct group {
    field_set own;      /* rows that choose it */
    field_set required; /* rows of `own` that must be given */
    field_set needed;   /* rows that must be given but do not choose it */
} group;
/* The alternatives of one field_groups; a table's follow one another in its order. */
typedef struct alternatives {
    const field_groups *words;
    const group *groups;
    size_t count;
    field_set own; /* every row that any of the groups owns */
} alternatives;
/* Those of a table, which ends with words NULL; parsed at the first call and kept, for a table
 * is constant and lives as long as the program. NULL when there is no memory. */
const alternatives *schema_alternatives(const schema *s);

/* Rows with a value. */
static inline field_set given_rows(const void *request)
{
    return *(const field_set *)request;
}
static inline field_set row_bit(int row)
{
    return (field_set)1 << row;
}
/* A range is stated when its ends differ. */
static inline bool field_bounded(const field *f)
{
    return f->min < f->max;
}

/* {"re", "im"} and {"variable", "scale", "offset"} are tables too. */
typedef struct complex_members {
    field_set given;
    double re, im;
} complex_members;
extern const schema complex_schema;
typedef struct variable_members {
    field_set given;
    name_value variable;
    double scale, offset;
} variable_members;
extern const schema variable_schema;

#endif
