/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/spans.h"

/* Of hangers, whose mass alone is given. */
#define STANDARD_GRAVITY 9.80665

strum_status spans_repeat(const strum_hanging *one, arena *memory, strum_hanging *row)
{
    const size_t n = one->piece_count, spans = one->params.spans;
    const cable_station *end = one->stations + n;
    cable_piece *pieces = arena_alloc(memory, n * spans, sizeof *pieces);
    cable_station *stations = arena_alloc(memory, n * spans + 1, sizeof *stations);
    if (pieces == NULL || stations == NULL)
        return STRUM_ERR_MEMORY;
    for (size_t k = 0; k < spans; k++)
        for (size_t i = 0; i < n; i++) {
            cable_piece *piece = pieces + k * n + i;
            cable_station *station = stations + k * n + i;
            *piece = one->pieces[i];
            piece->start += (double)k * end->position;
            piece->x += (double)k * end->x;
            *station = one->stations[i];
            station->position = piece->start;
            station->x += (double)k * end->x;
        }
    stations[n * spans] =
        (cable_station){(double)spans * end->position, (double)spans * end->x, end->z, 0, 0};
    row->params = one->params;
    row->sections = one->sections;
    row->attachments = one->attachments;
    row->order = one->order;
    row->pieces = pieces;
    row->piece_count = n * spans;
    row->stations = stations;
    row->statics = one->statics;
    return STRUM_OK;
}

bool spans_hanger_at(const strum_hanging *row, size_t station, spans_hanger *hanger)
{
    const strum_cable_params *p = &row->params;
    const size_t each = row->piece_count / p->spans;
    if (p->spans < 2 || station == 0 || station >= row->piece_count || station % each != 0)
        return false;
    const cable_piece *left = row->pieces + station - 1, *right = left + 1;
    const double pull = left->v + left->section->weight * left->length - right->v;
    const double weight = p->hanger_mass * STANDARD_GRAVITY;
    *hanger = (spans_hanger){(pull + weight / 2) / p->hanger_length, p->hanger_mass / 3};
    return true;
}
