/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Components that are repeated. An entry with `repeat` stands `count` times, with `spacing_m` of
 * cable between one and the next where that is given; a group does so with all it holds.
 */
#include <stdio.h>
#include <string.h>

#include "endpoints/common/chain_part.h"

static const field repeat_fields[] = {
    {FIELD_AT(FIELD_INTEGER, chain_repeat, count), .min = 1, .max = STRUM_TAUT_COMPONENTS_MAX,
     .flags = FIELD_REQUIRED, .help = "how many"},
    {FIELD_AT(FIELD_NUMBER, chain_repeat, spacing_m), .unit = "m", .min = 0, .max = 1e7,
     .flags = FIELD_OPEN_MIN | FIELD_VARIABLE,
     .help = "length of the cable between one and the next, like the cable that stands before "
             "this entry in the list, or else after it; without: they touch"},
    {.kind = FIELD_END}};
const schema chain_repeat_schema = {
    .name = "repeat", .fields = repeat_fields, .size = sizeof(chain_repeat)};

static const chain_part *part_of(const object_item *item)
{
    return item->object;
}

static size_t times(const chain_part *c)
{
    return c->repeat.count > 0 ? (size_t)c->repeat.count : 1;
}

static bool spaced(const chain_part *c)
{
    return c->repeat.count > 0 && FIELD_GIVEN(&chain_repeat_schema, &c->repeat, spacing_m);
}

/* How many components a list makes; a double, for the counts multiply. Up to the entry that
 * makes too many, which goes to `last`. */
static double count_list(const objects_value *list, size_t *last)
{
    const object_item *items = list->items;
    double sum = 0;
    for (size_t i = 0; i < list->count && sum <= STRUM_TAUT_COMPONENTS_MAX; i++) {
        const chain_part *c = part_of(&items[i]);
        size_t within;
        const double n = (double)times(c);
        sum += n * (items[i].variant == GROUP ? count_list(&c->components, &within) : 1) +
               (spaced(c) ? n - 1 : 0);
        *last = i;
    }
    return sum;
}

/* The cable beside entry i of a list; NULL without one. */
static const object_item *beside(const objects_value *list, size_t i)
{
    const object_item *items = list->items;
    if (i > 0 && items[i - 1].variant == CABLE)
        return &items[i - 1];
    return i + 1 < list->count && items[i + 1].variant == CABLE ? &items[i + 1] : NULL;
}

static void check_spacings(const objects_value *list, const char *where, problem *p)
{
    const object_item *items = list->items;
    char pointer[128];
    for (size_t i = 0; i < list->count; i++) {
        (void)snprintf(pointer, sizeof pointer, "%s/components/%zu", where, i);
        if (items[i].variant == GROUP)
            check_spacings(&part_of(&items[i])->components, pointer, p);
        if (!spaced(part_of(&items[i])) || beside(list, i) != NULL)
            continue;
        (void)snprintf(pointer, sizeof pointer, "%s/components/%zu/repeat/spacing_m", where, i);
        problem_add(p, pointer,
                    "needs a component of type cable next to this one in the list: the pieces "
                    "between have its mass, drag and tension");
    }
}

typedef struct expansion {
    chain_input *in;
    schema_arena *arena;
} expansion;

static void add(expansion *x, const object_item *item, const chain_place *place)
{
    x->in->parts[x->in->part_count] = *item;
    x->in->places[x->in->part_count++] = *place;
}

/* A piece of the cable beside entry i, as long as its spacing; false without memory. */
static bool make_piece(const expansion *x, const objects_value *list, size_t i,
                       object_item *piece)
{
    const object_item *items = list->items, *cable = beside(list, i);
    chain_part *c = schema_alloc(x->arena, sizeof *c);
    if (c == NULL)
        return false;
    *c = *part_of(cable);
    c->length_m = part_of(&items[i])->repeat.spacing_m;
    *piece = (object_item){CABLE, c};
    return true;
}

static bool expand_list(expansion *x, const objects_value *list, const chain_place *group)
{
    const object_item *items = list->items;
    for (size_t i = 0; i < list->count; i++) {
        const chain_part *c = part_of(&items[i]);
        const chain_place place =
            group != NULL ? (chain_place){group->entry, i, true} : (chain_place){i, 0, false};
        object_item piece = {0};
        if (spaced(c) && !make_piece(x, list, i, &piece))
            return false;
        for (size_t k = 0; k < times(c); k++) {
            if (k > 0 && piece.object != NULL)
                add(x, &piece, &place);
            if (items[i].variant != GROUP)
                add(x, &items[i], &place);
            else if (!expand_list(x, &c->components, &place))
                return false;
        }
    }
    return true;
}

void chain_expand(chain_input *in, schema_arena *arena, problem *p)
{
    size_t last = 0;
    const double count = count_list(&in->components, &last);
    char pointer[64];
    in->part_count = 0;
    check_spacings(&in->components, "", p);
    if (count > STRUM_TAUT_COMPONENTS_MAX) {
        const object_item *items = in->components.items;
        (void)snprintf(pointer, sizeof pointer, "/components/%zu%s", last,
                       part_of(&items[last])->repeat.count > 0 ? "/repeat/count" : "");
        problem_add(p, pointer, "makes more than %d components of the chain",
                    STRUM_TAUT_COMPONENTS_MAX);
    }
    if (p->status != 0)
        return;
    in->parts = schema_alloc(arena, (size_t)count * sizeof *in->parts);
    in->places = schema_alloc(arena, (size_t)count * sizeof *in->places);
    if (in->parts == NULL || in->places == NULL ||
        !expand_list(&(expansion){in, arena}, &in->components, NULL))
        problem_out_of_memory(p);
}
