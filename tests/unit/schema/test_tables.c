/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every table of every endpoint says only what the schema engine can keep: the engine trusts
 * tables and does not check them at run time. */
#include <string.h>

#include "check.h"
#include "endpoints/endpoint.h"
#include "tables.h"
#include "validation/registry.h"

static const char *table_name;

#define demand(condition, ...)                                                                 \
    do {                                                                                       \
        if (!(condition)) {                                                                    \
            print_error("%s: ", table_name);                                                   \
            fail_msg(__VA_ARGS__);                                                             \
        }                                                                                      \
    } while (0)

static size_t value_size(const field *f)
{
    switch (f->kind) {
    case FIELD_NUMBER:
        return f->flags & FIELD_VARIABLE ? sizeof(variable_value) : sizeof(double);
    case FIELD_INTEGER:
        return sizeof(int64_t);
    case FIELD_FLAG:
        return sizeof(bool);
    case FIELD_CHOICE:
        return sizeof(int);
    case FIELD_CHOICES:
        return sizeof(choices_value);
    case FIELD_NAME:
        return sizeof(name_value);
    case FIELD_NUMBERS:
        return sizeof(numbers_value);
    case FIELD_COMPLEXES:
        return sizeof(complexes_value);
    case FIELD_OBJECT:
        return f->schema->size;
    case FIELD_OBJECTS:
    case FIELD_VARIANTS:
        return sizeof(objects_value);
    case FIELD_END:
        break;
    }
    return 0;
}

static void check_number(const field *f)
{
    demand(f->min <= f->max, "%s: an empty range", f->name);
    demand(!(f->flags & FIELD_OPEN_MIN) || isfinite(f->min), "%s: open at no end", f->name);
    demand(!(f->flags & FIELD_OPEN_MAX) || isfinite(f->max), "%s: open at no end", f->name);
    if (f->kind == FIELD_INTEGER)
        demand(f->min < f->max && f->min >= -0x1p53 && f->max <= 0x1p53,
               "%s: an integer needs a range that a double holds", f->name);
    if (!(f->flags & FIELD_DEFAULT))
        return;
    const bool infinite = f->flags & FIELD_INFINITE && f->fallback == INFINITY;
    demand(infinite || isfinite(f->fallback), "%s: its default is not finite", f->name);
    if (f->min < f->max && !infinite) {
        demand(f->fallback >= f->min && f->fallback <= f->max, "%s: default out of range",
               f->name);
        demand(!(f->flags & FIELD_OPEN_MIN) || f->fallback > f->min, "%s: default out of range",
               f->name);
        demand(!(f->flags & FIELD_OPEN_MAX) || f->fallback < f->max, "%s: default out of range",
               f->name);
    }
}

static int count_words(const char *const *words)
{
    int count = 0;
    while (words[count] != NULL)
        count++;
    return count;
}

static void check_schema(const schema *s, bool typed);

static void check_field(const schema *s, const field *f, bool typed)
{
    demand(f->name != NULL && f->name[0] != '\0' && strlen(f->name) < NAME_MAX_SIZE,
           "a row without a name");
    demand(strcspn(f->name, " []+~/") == strlen(f->name), "%s: not a name", f->name);
    demand(!typed || strcmp(f->name, "type") != 0, "a variant's field is named type");
    for (const field *other = s->fields; other < f; other++)
        demand(strcmp(other->name, f->name) != 0, "%s stands twice", f->name);
    demand(f->help != NULL && f->help[0] != '\0', "%s has no help", f->name);
    demand(f->offset >= sizeof(field_set) && f->offset + value_size(f) <= s->size,
           "%s is not in its struct", f->name);
    demand(f->max_items == 0 || f->min_items <= f->max_items, "%s: no list fits", f->name);
    if (f->kind == FIELD_NUMBER || f->kind == FIELD_INTEGER)
        check_number(f);
    if (f->kind == FIELD_CHOICE) {
        demand(f->choices != NULL && f->choices[0] != NULL, "%s: nothing to choose", f->name);
        demand(f->fallback >= 0 && f->fallback < count_words(f->choices), "%s: no such default",
               f->name);
    }
    if (f->kind == FIELD_CHOICES)
        demand(f->choices != NULL && f->choices[0] != NULL && count_words(f->choices) <= 64,
               "%s: 1 to 64 words", f->name);
    const bool list = f->kind == FIELD_NUMBERS || f->kind == FIELD_CHOICES || f->kind == FIELD_COMPLEXES ||
                      f->kind == FIELD_OBJECTS || f->kind == FIELD_VARIANTS;
    demand(!((list || f->kind == FIELD_NAME) && f->flags & FIELD_DEFAULT),
           "%s: lists and names have no defaults", f->name);
    if (f->kind == FIELD_OBJECT || f->kind == FIELD_OBJECTS)
        check_schema(f->schema, false);
    if (f->kind == FIELD_VARIANTS)
        for (const variant *v = f->variants; v->type != NULL; v++)
            check_schema(v->schema, true);
}

static int find_row(const schema *s, const char *name, size_t size)
{
    for (int row = 0; s->fields[row].kind != FIELD_END; row++)
        if (strlen(s->fields[row].name) == size &&
            strncmp(s->fields[row].name, name, size) == 0)
            return row;
    return -1;
}

/* Every name is a row, and belongs to one field_groups only. */
static void check_groups(const schema *s)
{
    field_set owned_before = 0;
    for (const field_groups *g = s->groups; g != NULL && g->title != NULL; g++) {
        field_set owned = 0;
        demand(count_words(g->groups) >= 2, "%s: no alternatives", g->title);
        for (int i = 0; g->groups[i] != NULL; i++) {
            for (const char *at = g->groups[i]; *at != '\0';) {
                const size_t size = strcspn(at, " ");
                const bool optional = *at == '[', needed = *at == '+';
                demand(!optional || at[size - 1] == ']', "%s: unbalanced", g->groups[i]);
                const size_t skip = optional || needed;
                const int row = find_row(s, at + skip, size - skip - optional);
                demand(row >= 0, "%s: no such field: %s", g->title, at);
                if (!needed)
                    owned |= (field_set)1 << row;
                demand(at[size] == '\0' || at[size + 1] != '\0', "%s: a space too many",
                       g->groups[i]);
                at += size + (at[size] == ' ');
            }
        }
        demand((owned & owned_before) == 0, "%s: a field of other groups", g->title);
        owned_before |= owned;
    }
}

static void check_schema(const schema *s, bool typed)
{
    const char *outer = table_name;
    table_name = s->name;
    int rows = 0;
    for (const field *f = s->fields; f->kind != FIELD_END; f++, rows++)
        check_field(s, f, typed);
    demand(rows > 0 || typed, "no fields");
    demand(rows <= FIELDS_MAX, "%d fields, more than %d", rows, FIELDS_MAX);
    check_groups(s);
    table_name = outer;
}

static void tables_are_sound(void **state)
{
    (void)state;
    for (int i = 0; endpoints[i] != NULL; i++) {
        const endpoint *e = endpoints[i];
        assert_non_null(e->cost_us);
        assert_non_null(e->answer);
        assert_int_equal(strncmp(e->path, "/v1/", 4), 0);
        assert_true(strlen(e->title) > 0);
        for (int k = 0; k < i; k++)
            assert_string_not_equal(e->path, endpoints[k]->path);
        check_schema(e->request, false);
        /* a query string cannot hold nested values, so none may be needed by who asks with one
         */
        for (const field *f = e->request->fields; e->query && f->kind != FIELD_END; f++)
            demand((f->flags & FIELD_REQUIRED) == 0 ||
                       (f->kind != FIELD_OBJECT && f->kind != FIELD_OBJECTS &&
                        f->kind != FIELD_VARIANTS),
                   "%s: GET cannot give it", f->name);
    }
    check_schema(&cable_schema, false);
    check_schema(&chain_schema, false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(tables_are_sound)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
