/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/taut/assembly.h"

#include <stdlib.h>

static void place_all(const strum_taut *chain, taut_cursor *at)
{
    for (size_t i = 0; i < chain->count; i++) {
        const taut_component *c = &chain->components[i];
        c->model->place(at, c);
        if (at->next > 10000000)
            return; /* more than any method takes; the caller refuses */
    }
}

/* Holds unknown i: its own equation becomes y = 0, with no mass. */
static void hold(taut_assembly *a, int i)
{
    for (int row = i; row < a->size && row <= i + a->band; row++)
        for (int column = row - a->band; column <= row; column++) {
            if (column < 0 || (row != i && column != i))
                continue;
            const size_t at =
                (size_t)row * (size_t)(a->band + 1) + (size_t)(column - row + a->band);
            a->k[at] = row == column ? 1.0 : 0.0;
            a->c[at] = a->m[at] = 0.0;
        }
}

strum_status taut_assembly_make(const strum_taut *chain, double highest, bool dynamic, int most,
                                taut_assembly *assembly, strum_error *error)
{
    taut_lobatto lobatto;
    taut_lobatto_make(&lobatto);
    *assembly = (taut_assembly){0};
    const taut_cursor start = {assembly, &lobatto, 0, 1, 1.0, highest, dynamic};
    taut_cursor at = start;
    place_all(chain, &at);
    if (at.next > most)
        return error_set(error, STRUM_ERR_METHOD,
                         "the second method would need more than %d unknowns", most);
    assembly->size = at.next;
    const size_t room = (size_t)assembly->size * (size_t)(assembly->band + 1);
    assembly->k = calloc(3 * room, sizeof(double));
    assembly->wires = calloc((size_t)assembly->wire_count + 1, sizeof(taut_wire));
    if (assembly->k == NULL || assembly->wires == NULL) {
        taut_assembly_free(assembly);
        return error_set(error, STRUM_ERR_MEMORY, "no memory for %d unknowns", at.next);
    }
    assembly->c = assembly->k + room;
    assembly->m = assembly->c + room;
    assembly->wire_count = 0;
    at = start;
    place_all(chain, &at);
    assembly->last = at.node;
    if (!chain->free_left)
        hold(assembly, 0);
    if (!chain->free_right)
        hold(assembly, at.node);
    return STRUM_OK;
}

void taut_assembly_free(taut_assembly *assembly)
{
    free(assembly->k);
    free(assembly->wires);
    *assembly = (taut_assembly){0};
}
