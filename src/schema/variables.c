/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The variables that the numbers of a request name, wherever they stand in it. */
#include <stdio.h>

#include "schema/parts.h"

#define POINTER_MAX 256

static void see_members(const schema *s, const void *request, const char *pointer,
                        schema_see_variable see, void *context)
{
    for (int row = 0; s->fields[row].kind != FIELD_END; row++) {
        const field *f = &s->fields[row];
        const void *value = (const char *)request + f->offset;
        char at[POINTER_MAX];
        if ((given_rows(request) & row_bit(row)) == 0)
            continue;
        (void)snprintf(at, sizeof at, "%s/%s", pointer, f->name);
        if (f->kind == FIELD_NUMBER && (f->flags & FIELD_VARIABLE)) {
            const variable_value *v = value;
            if (v->name.text[0] != '\0')
                see(context, at, f, v);
        } else if (f->kind == FIELD_OBJECT) {
            see_members(f->schema, value, at, see, context);
        } else if (f->kind == FIELD_OBJECTS || f->kind == FIELD_VARIANTS) {
            const objects_value *list = value;
            for (size_t i = 0; i < list->count; i++) {
                char item[POINTER_MAX + 24];
                (void)snprintf(item, sizeof item, "%s/%zu", at, i);
                if (f->kind == FIELD_OBJECTS) {
                    see_members(f->schema, (const char *)list->items + i * f->schema->size,
                                item, see, context);
                } else {
                    const object_item *one = (const object_item *)list->items + i;
                    see_members(f->variants[one->variant].schema, one->object, item, see,
                                context);
                }
            }
        }
    }
}

void schema_variables(const schema *s, const void *request, schema_see_variable see,
                      void *context)
{
    see_members(s, request, "", see, context);
}
