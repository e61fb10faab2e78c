/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The arena of a request, its rows, and the names that are near one another. */
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "schema/parts.h"

/* ---- arena ---- */

/* One chunk holds an ordinary request; lists bring larger ones. */
#define CHUNK_SIZE 4000

typedef struct chunk {
    struct chunk *next;
    size_t used, size;
    max_align_t bytes[];
} chunk;

/* Held in the arena's own memory. */
typedef struct owned {
    struct owned *before;
    void *object;
    void (*destroy)(void *object);
} owned;

struct schema_arena {
    chunk *chunks; /* the newest first */
    owned *owned;  /* the newest first */
};

schema_arena *arena_new(void)
{
    return calloc(1, sizeof(schema_arena));
}

void *schema_alloc(schema_arena *arena, size_t size)
{
    const size_t align = sizeof(max_align_t);
    if (size > SIZE_MAX / 2)
        return NULL;
    size = (size + align - 1) / align * align;
    chunk *c = arena->chunks;
    if (c == NULL || c->size - c->used < size) {
        const size_t room = size > CHUNK_SIZE ? size : CHUNK_SIZE;
        c = calloc(1, sizeof *c + room);
        if (c == NULL)
            return NULL;
        c->size = room;
        c->next = arena->chunks;
        arena->chunks = c;
    }
    void *bytes = (char *)c->bytes + c->used;
    c->used += size;
    return bytes;
}

bool schema_arena_own(schema_arena *arena, void *object, void (*destroy)(void *object))
{
    owned *o = schema_alloc(arena, sizeof *o);
    if (o == NULL) {
        destroy(object);
        return false;
    }
    *o = (owned){arena->owned, object, destroy};
    arena->owned = o;
    return true;
}

void schema_free(schema_arena *arena)
{
    if (arena == NULL)
        return;
    for (const owned *o = arena->owned; o != NULL; o = o->before)
        o->destroy(o->object);
    for (chunk *c = arena->chunks, *next; c != NULL; c = next) {
        next = c->next;
        free(c);
    }
    free(arena);
}

/* ---- rows ---- */

int schema_row(const schema *s, const char *name, int hint)
{
    for (int row = hint; s->fields[row].kind != FIELD_END; row++)
        if (strcmp(s->fields[row].name, name) == 0)
            return row;
    for (int row = 0; row < hint; row++)
        if (strcmp(s->fields[row].name, name) == 0)
            return row;
    return -1;
}

bool field_given(const schema *s, const void *request, const char *name)
{
    const int row = schema_row(s, name, 0);
    return row >= 0 && (given_rows(request) & row_bit(row)) != 0;
}

/* The bit of the row whose value stands there; 0 when none does. */
static field_set bit_at(const schema *s, size_t offset)
{
    for (int row = 0; s->fields[row].kind != FIELD_END; row++)
        if (s->fields[row].offset == offset)
            return row_bit(row);
    return 0;
}

bool field_given_at(const schema *s, const void *request, size_t offset)
{
    return (given_rows(request) & bit_at(s, offset)) != 0;
}

void field_give_at(const schema *s, void *request, size_t offset)
{
    *(field_set *)request |= bit_at(s, offset);
}

static const field complex_fields[] = {
    {FIELD_AT(FIELD_NUMBER, complex_members, re), .flags = FIELD_REQUIRED, .help = "real part"},
    {FIELD_AT(FIELD_NUMBER, complex_members, im), .flags = FIELD_REQUIRED,
     .help = "imaginary part"},
    {.kind = FIELD_END},
};
const schema complex_schema = {
    .name = "complex", .fields = complex_fields, .size = sizeof(complex_members)};

static const field variable_fields[] = {
    {FIELD_AT(FIELD_NAME, variable_members, variable), .flags = FIELD_REQUIRED,
     .help = "name of the variable"},
    {FIELD_AT(FIELD_NUMBER, variable_members, scale), .flags = FIELD_DEFAULT, .fallback = 1,
     .help = "factor of the variable"},
    {FIELD_AT(FIELD_NUMBER, variable_members, offset), .flags = FIELD_DEFAULT, .fallback = 0,
     .help = "added to scale times variable"},
    {.kind = FIELD_END},
};
const schema variable_schema = {
    .name = "variable", .fields = variable_fields, .size = sizeof(variable_members)};

/* ---- names ---- */

/* Changes (insert, delete, replace, swap neighbours) between two names, case aside. */
static int edit_distance(const char *a, const char *b)
{
    int rows[3][NAME_MAX_SIZE];
    const int m = (int)strlen(a), n = (int)strlen(b);
    for (int j = 0; j <= n; j++)
        rows[0][j] = j;
    for (int i = 1; i <= m; i++) {
        int *row = rows[i % 3], *above = rows[(i + 2) % 3], *before = rows[(i + 1) % 3];
        row[0] = i;
        for (int j = 1; j <= n; j++) {
            const int x = tolower((unsigned char)a[i - 1]),
                      y = tolower((unsigned char)b[j - 1]);
            int best = above[j - 1] + (x != y);
            best = above[j] + 1 < best ? above[j] + 1 : best;
            best = row[j - 1] + 1 < best ? row[j - 1] + 1 : best;
            if (i > 1 && j > 1 && x == tolower((unsigned char)b[j - 2]) &&
                y == tolower((unsigned char)a[i - 2]) && before[j - 2] + 1 < best)
                best = before[j - 2] + 1;
            row[j] = best;
        }
    }
    return rows[m % 3][n];
}

void nearest_try(nearest *n, const char *candidate)
{
    const size_t length = strlen(n->wanted), other = strlen(candidate);
    if (length == 0 || length >= NAME_MAX_SIZE || other >= NAME_MAX_SIZE)
        return;
    if (n->name == NULL)
        n->distance = length < 6 ? 2 : (int)(length / 3) + 1; /* nearer than that is near */
    /* A name without its unit is the likeliest slip. */
    const bool bare = other > length && candidate[length] == '_' &&
                      strncmp(n->wanted, candidate, length) == 0;
    const int distance = bare ? 0 : edit_distance(n->wanted, candidate);
    if (distance < n->distance || (bare && n->distance == 0 && other < strlen(n->name))) {
        n->distance = distance;
        n->name = candidate;
    }
}
