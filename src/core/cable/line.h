/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A cable as its statics see it: arcs in a row, and the dead loads between them. Where a load
 * acts the force makes a step: behind it F+ = F- + load, after F- became longer by the jump.
 */
#ifndef CORE_CABLE_LINE_H
#define CORE_CABLE_LINE_H

#include <stdbool.h>
#include <stddef.h>

#include <strum/cable.h>

#include "core/cable/arc.h"
#include "core/numerics/arena.h"

typedef struct {
    cable_arc arc;
    double start;          /* unstretched, from end 1 */
    double load_x, load_z; /* step of the force at its start: -(force from outside) */
    double jump;           /* step of the tension at its start */
    double friction;       /* of the bed under it */
    size_t section;
    size_t first, count; /* attachments at its start, in the sorted list */
} line_piece;

typedef struct {
    line_piece *pieces;
    size_t count, room;
    double length, length_rest; /* unstretched: a sum of two doubles */
    bool has_jumps;
} cable_line;

/* Room for the pieces of so many sections and attachments; NULL when there is no memory. */
line_piece *line_room(const strum_cable_params *p, arena *a);
/* Cuts the sections at the attachments, which are sorted by position; `line->pieces` has room.
 * Attachments at or behind the end are left out. */
void line_cut(const strum_cable_section *sections, size_t section_count,
              const strum_cable_attachment *attachments, size_t attachment_count,
              const strum_cable_bed *bed, cable_line *line);
/* The force behind the loads at the start of a piece, from that before them. */
void line_step(const line_piece *piece, double *h, double *v);
/* Weight of an attachment in the static shape, as a step of the vertical force. */
double line_weight(const strum_cable_attachment *attachment);

#endif
