/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/settle.h"

#include <math.h>

#include "core/cable/bed.h"
#include "core/cable/free.h"

/* A piece that touches the bed is cut where it lands, becomes slack, is pulled and lifts. */
#define PARTS_MAX 5

strum_status settle_begin(strum_hanging *cable, work *w, cable_settler *s)
{
    const strum_cable_params *p = &cable->params;
    arena *a = &cable->memory;
    *s = (cable_settler){.cable = cable, .work = w, .span = p->span};
    s->line.pieces = line_room(p, a);
    s->line.room = p->section_count + p->attachment_count;
    const size_t parts = s->line.room * (p->bed.present ? PARTS_MAX : 1);
    s->form.pieces = arena_alloc(a, parts, sizeof *s->form.pieces);
    s->form.origin = arena_alloc(a, parts, sizeof *s->form.origin);
    s->form.contacts = arena_alloc(a, parts, sizeof *s->form.contacts);
    s->touching = arena_alloc(a, s->line.room + 1, sizeof *s->touching);
    const bool room = s->touching != NULL && s->line.pieces != NULL && s->form.pieces != NULL &&
                      s->form.origin != NULL && s->form.contacts != NULL;
    return room ? STRUM_OK : STRUM_ERR_MEMORY;
}

void settle_cut(cable_settler *s)
{
    const strum_cable_params *p = &s->cable->params;
    line_cut(s->cable->sections, p->section_count, s->cable->attachments, p->attachment_count,
             &p->bed, &s->line);
}

/* Whether the free line keeps off its bed, from end 1 on it rises where that lies on it. */
static bool passes_above(const cable_settler *s)
{
    const strum_cable_bed *bed = &s->cable->params.bed;
    return bed_clearance(&s->form, bed) >= 0 && bed_leaves(&s->form, bed);
}

strum_status settle(cable_settler *s, strum_error *error)
{
    const strum_cable_params *p = &s->cable->params;
    settle_cut(s);
    double h = s->form.count > 0 ? s->form.pieces[0].h : 0,
           v = s->form.count > 0 ? s->form.pieces[0].v : 0;
    strum_status status = p->bed.present ? bed_check(p, s->span, error) : STRUM_OK;
    if (status == STRUM_OK)
        status = free_solve(&s->line, s->span, p->rise, s->warm, &h, &v, s->work, error);
    if (status != STRUM_OK)
        return status;
    form_hang(&s->line, s->cable->sections, h, v, &s->form);
    if (!p->bed.present || passes_above(s))
        return STRUM_OK;
    return bed_settle(&s->line, s->cable, s->span, h, v, &s->form, s->touching, s->work, error);
}

double settle_clearance(const cable_settler *s)
{
    const strum_cable_bed *bed = &s->cable->params.bed;
    return bed->present ? bed_clearance(&s->form, bed) : NAN;
}
