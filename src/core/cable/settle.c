/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/settle.h"

#include <math.h>

#include "core/cable/bed.h"
#include "core/cable/free.h"
#include "core/cable/rod.h"

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

/* Nothing turns a cable without load between ends that let it lie straight. */
static bool is_straight(const strum_hanging *cable)
{
    const strum_cable_params *p = &cable->params;
    bool loaded = false;
    for (size_t i = 0; i < p->attachment_count; i++) {
        const strum_cable_attachment *a = &cable->attachments[i];
        loaded = loaded || a->weight != 0 || a->force_x != 0 || a->force_z != 0 || a->jump != 0;
    }
    for (size_t i = 0; i < p->section_count; i++)
        loaded = loaded || cable->sections[i].weight != 0;
    const bool free_1 = p->end_1.rotation == STRUM_CABLE_PINNED || isnan(p->end_1.angle);
    const bool free_2 = p->end_2.rotation == STRUM_CABLE_PINNED || isnan(p->end_2.angle);
    return !loaded && free_1 && free_2;
}

bool settle_bends(const strum_hanging *cable)
{
    bool any = false;
    for (size_t i = 0; i < cable->params.section_count; i++)
        any = any || cable->sections[i].bending_stiffness > 0;
    return any && cable->params.stiff && !is_straight(cable);
}

/* Pieces, stations and figures of the form as it is. */
static strum_status keep(const cable_settler *s)
{
    strum_hanging *cable = s->cable;
    const cable_form *form = &s->form;
    const strum_cable_bed *bed = &cable->params.bed;
    strum_cable_statics *figures = &cable->statics;
    cable->rod = NULL;
    cable->pieces = form->pieces;
    cable->piece_count = form->count;
    cable->contacts = form->contacts;
    cable->stations = arena_alloc(&cable->memory, form->count + 1, sizeof *cable->stations);
    if (cable->stations == NULL)
        return STRUM_ERR_MEMORY;
    for (size_t i = 0; i < form->count; i++) {
        const cable_piece *piece = form->pieces + i;
        const line_piece *from = s->line.pieces + form->origin[i];
        const bool begins = i == 0 || form->origin[i] != form->origin[i - 1];
        cable->stations[i] = (cable_station){piece->start, piece->x, piece->z, from->first,
                                             begins ? from->count : 0};
    }
    form_measure(form, s->span, cable->params.rise, figures);
    cable->stations[form->count] =
        (cable_station){figures->unstretched_length, s->span, cable->params.rise, 0, 0};
    figures->lowest_clearance = bed->present ? bed_clearance(form, bed) : NAN;
    return STRUM_OK;
}

strum_status settle_keep(cable_settler *s, strum_error *error)
{
    strum_status status = keep(s);
    if (status != STRUM_OK || !settle_bends(s->cable))
        return work_result(s->work, status, error);
    status = rod_settle(s->cable, s->span, s->work, error);
    if (status == STRUM_OK)
        rod_measure(s->cable, s->span);
    return status;
}
