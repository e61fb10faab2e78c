/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What a request leaves open: which of the alternative groups it means, which defaults follow,
 * and what is missing.
 *
 * Index: complete_members -> schema_alternatives -> parse_group; choose_group ->
 * report_conflict, report_open, report_missing.
 */
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "schema/parts.h"

static group parse_group(const schema *s, const char *words)
{
    group g = {0};
    for (const char *at = words; *at != '\0';) {
        const size_t size = strcspn(at, " ");
        const bool optional = *at == '[', needed = *at == '+';
        const size_t skip = optional || needed;
        char name[NAME_MAX_SIZE] = "";
        if (size < NAME_MAX_SIZE)
            memcpy(name, at + skip, size - skip - optional);
        const int row = schema_row(s, name, 0);
        if (row >= 0) {
            if (needed)
                g.needed |= row_bit(row);
            else
                g.own |= row_bit(row);
            if (!needed && !optional && !(s->fields[row].flags & FIELD_DEFAULT))
                g.required |= row_bit(row);
        }
        at += size;
        at += *at == ' ';
    }
    return g;
}

/* What is kept of one table. */
typedef struct memo {
    struct memo *next;
    const schema *schema;
    alternatives all[]; /* then the groups */
} memo;

static memo *memo_make(const schema *s)
{
    size_t sets = 1, count = 0;
    for (const field_groups *g = s->groups; g != NULL && g->title != NULL; g++, sets++)
        for (int i = 0; g->groups[i] != NULL; i++)
            count++;
    memo *m = calloc(1, sizeof *m + sets * sizeof *m->all + count * sizeof(group));
    if (m == NULL)
        return NULL;
    m->schema = s;
    alternatives *at = m->all;
    group *one = (group *)(m->all + sets);
    for (const field_groups *g = s->groups; g != NULL && g->title != NULL; g++, at++) {
        *at = (alternatives){.words = g, .groups = one};
        for (int i = 0; g->groups[i] != NULL; i++, one++, at->count++) {
            *one = parse_group(s, g->groups[i]);
            at->own |= one->own;
        }
    }
    return m;
}

const alternatives *schema_alternatives(const schema *s)
{
    static _Atomic(memo *) memos;
    static const alternatives none;
    if (s->groups == NULL)
        return &none;
    for (const memo *m = atomic_load(&memos); m != NULL; m = m->next)
        if (m->schema == s)
            return m->all;
    memo *m = memo_make(s);
    if (m == NULL)
        return NULL;
    /* two threads may both put one in: either serves */
    m->next = atomic_load(&memos);
    while (!atomic_compare_exchange_weak(&memos, &m->next, m))
        continue;
    return m->all;
}

/* "a, b" */
static void add_names(const schema *s, field_set rows, strbuf *out)
{
    const char *comma = "";
    for (int row = 0; s->fields[row].kind != FIELD_END; row++)
        if (rows & row_bit(row)) {
            strbuf_format(out, "%s%s", comma, s->fields[row].name);
            comma = ", ";
        }
}

/* "(1) sag_parameter, optionally rise_to_span; (2) xi_1, xi_2": the groups that own all of
 * `rows`. */
static void add_groups(const schema *s, const alternatives *g, field_set rows, strbuf *out)
{
    int shown = 0;
    for (size_t i = 0; i < g->count; i++) {
        const group one = g->groups[i];
        if (rows & ~one.own)
            continue;
        shown++;
        strbuf_format(out, "%s(%d) ", shown > 1 ? "; " : "", shown);
        add_names(s, one.required, out);
        if (one.required != one.own) {
            strbuf_add_string(out, one.required != 0 ? ", optionally " : "");
            add_names(s, one.own & ~one.required, out);
        }
        if (one.needed != 0) {
            strbuf_add_string(out, ", with ");
            add_names(s, one.needed, out);
        }
    }
}

/* No group, or more than one, fits what was given. */
static void report_open(reading *r, const schema *s, const alternatives *g, field_set given,
                        const json_place *place)
{
    strbuf groups = {0}, names = {0};
    add_groups(s, g, given, &groups);
    add_names(s, given, &names);
    if (groups.failed || names.failed)
        problem_out_of_memory(r->p);
    else if (given == 0)
        json_fault(r->p, place, "the %s is missing; give one of %s", g->words->title,
                   groups.data);
    else
        json_fault(r->p, place, "the %s is incomplete with %s alone; give one of %s",
                   g->words->title, names.data, groups.data);
    strbuf_clear(&groups);
    strbuf_clear(&names);
}

/* Fields of different groups: names those outside the group that most of them belong to. */
static void report_conflict(reading *r, const schema *s, const alternatives *g, field_set given,
                            const json_place *place)
{
    field_set best = 0;
    for (size_t i = 0; i < g->count; i++) {
        const field_set own = g->groups[i].own & given;
        if (__builtin_popcountll(own) > __builtin_popcountll(best))
            best = own;
    }
    strbuf groups = {0}, names = {0};
    add_groups(s, g, 0, &groups);
    add_names(s, best, &names);
    for (int row = 0; s->fields[row].kind != FIELD_END; row++) {
        const json_place at = {.parent = place, .name = s->fields[row].name};
        if (!(given & ~best & row_bit(row)))
            continue;
        if (groups.failed || names.failed)
            problem_out_of_memory(r->p);
        else
            json_fault(r->p, &at, "cannot stand beside %s: give the %s by only one of %s",
                       names.data, g->words->title, groups.data);
    }
    strbuf_clear(&groups);
    strbuf_clear(&names);
}

static void report_missing(reading *r, const schema *s, const alternatives *g,
                           field_set missing, field_set given, const json_place *place)
{
    strbuf names = {0};
    strbuf_add(&names, "", 0);
    add_names(s, given, &names);
    for (int row = 0; s->fields[row].kind != FIELD_END; row++) {
        const json_place at = {.parent = place, .name = s->fields[row].name};
        if (!(missing & row_bit(row)))
            continue;
        if (names.failed)
            problem_out_of_memory(r->p);
        else
            json_fault(r->p, &at, "missing: the %s by %s needs it", g->words->title,
                       names.data);
    }
    strbuf_clear(&names);
}

/* The rows of the chosen group (0: none, or a fault). `given`: rows seen that any group of `g`
 * owns. */
static field_set choose_group(reading *r, const schema *s, const alternatives *g,
                              field_set seen, field_set given, const json_place *place)
{
    group fitting = {0};
    int candidates = 0;
    for (size_t i = 0; i < g->count; i++) {
        const group one = g->groups[i];
        if (given & ~one.own)
            continue;
        if (((one.required | one.needed) & ~seen) == 0)
            return one.own;
        fitting = one;
        candidates++;
    }
    if (given == 0) {
        if (!g->words->optional)
            report_open(r, s, g, given, place);
    } else if (candidates == 0) {
        report_conflict(r, s, g, given, place);
    } else if (candidates > 1) {
        report_open(r, s, g, given, place);
    } else {
        report_missing(r, s, g, (fitting.required | fitting.needed) & ~seen, given, place);
    }
    return 0;
}

static void fill_default(reading *r, const field *f, const json_place *place, void *value)
{
    switch (f->kind) {
    case FIELD_NUMBER:
        if (f->flags & FIELD_VARIABLE)
            *(variable_value *)value = (variable_value){.value = f->fallback, .scale = 1};
        else
            *(double *)value = f->fallback;
        break;
    case FIELD_INTEGER:
        *(int64_t *)value = (int64_t)f->fallback;
        break;
    case FIELD_FLAG:
        *(bool *)value = f->fallback != 0;
        break;
    case FIELD_CHOICE:
        *(int *)value = (int)f->fallback;
        break;
    case FIELD_OBJECT:
        read_members(r, f->schema, NULL, false, &(json_place){place, f->name, 0}, value);
        break;
    default: /* lists and names have no defaults */
        break;
    }
}

void complete_members(reading *r, const schema *s, field_set seen, const json_place *place,
                      void *request)
{
    field_set grouped = 0, chosen = 0;
    const alternatives *g = schema_alternatives(s);
    if (g == NULL) {
        problem_out_of_memory(r->p);
        return;
    }
    for (; g->words != NULL; g++) {
        grouped |= g->own;
        chosen |= choose_group(r, s, g, seen, seen & g->own, place);
    }
    for (int row = 0; s->fields[row].kind != FIELD_END; row++) {
        const field *f = &s->fields[row];
        const field_set bit = row_bit(row);
        if (seen & bit || (grouped & ~chosen & bit))
            continue;
        if (f->flags & FIELD_DEFAULT) {
            fill_default(r, f, place, (char *)request + f->offset);
            *(field_set *)request |= bit;
        } else if (f->flags & FIELD_REQUIRED && !(grouped & bit)) {
            json_fault(r->p, &(json_place){place, f->name, 0}, "missing: %s", f->help);
        }
    }
}
