/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/line.h"

#include <math.h>

line_piece *line_room(const strum_cable_params *p, arena *a)
{
    return arena_alloc(a, p->section_count + p->attachment_count, sizeof(line_piece));
}

double line_weight(const strum_cable_attachment *attachment)
{
    switch (attachment->kind) {
    case STRUM_CABLE_POINT_MASS:
    case STRUM_CABLE_ABSORBER:
        return attachment->weight;
    default:
        return 0;
    }
}

static void load(line_piece *piece, const strum_cable_attachment *attachment)
{
    piece->load_z += line_weight(attachment);
    if (attachment->kind == STRUM_CABLE_FORCE) {
        piece->load_x -= attachment->force_x;
        piece->load_z -= attachment->force_z;
    }
    if (attachment->kind == STRUM_CABLE_TENSION_JUMP)
        piece->jump += attachment->jump;
    piece->count++;
}

/* Places nearer than this to each other, of the length up to there, are one place. */
#define SAME_PLACE 1e-14

static void lengthen(cable_line *line, double by)
{
    /* Knuth's sum of two doubles and its error */
    const double sum = line->length + by, back = sum - line->length;
    line->length_rest += (line->length - (sum - back)) + (by - back);
    line->length = sum;
}

void line_cut(const strum_cable_section *sections, size_t section_count,
              const strum_cable_attachment *attachments, size_t attachment_count,
              const strum_cable_bed *bed, cable_line *line)
{
    size_t next = 0;
    line->count = 0;
    line->length = line->length_rest = 0;
    line->has_jumps = false;
    for (size_t i = 0; i < section_count; i++) {
        const strum_cable_section *s = sections + i;
        const double begin = line->length, end = begin + s->length;
        double at = begin;
        do {
            line_piece *piece = line->pieces + line->count++;
            *piece = (line_piece){.arc = {s->weight, 0, 1 / s->axial_stiffness},
                                  .start = at,
                                  .friction =
                                      isnan(s->bed_friction) ? bed->friction : s->bed_friction,
                                  .section = i,
                                  .first = next};
            for (;
                 next < attachment_count && attachments[next].position <= at * (1 + SAME_PLACE);
                 next++)
                load(piece, attachments + next);
            line->has_jumps |= piece->jump != 0;
            const bool cut =
                next < attachment_count && attachments[next].position < end * (1 - SAME_PLACE);
            const double to = cut ? attachments[next].position : end;
            piece->arc.length = at == begin && !cut ? s->length : to - at;
            at = to;
        } while (at < end);
        lengthen(line, s->length);
    }
}

void line_step(const line_piece *piece, double *h, double *v)
{
    if (piece->jump != 0) {
        const double tension = hypot(*h, *v);
        const double factor = tension > 0 ? 1 + piece->jump / tension : 1;
        *h *= factor;
        *v *= factor;
    }
    *h += piece->load_x;
    *v += piece->load_z;
}
