/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/lay.h"

#include <math.h>

/* The form as far as it is made. */
typedef struct {
    const bed_frame *frame;
    const strum_cable_section *sections;
    cable_form *form;
    double along, height; /* reached, from end 1 along the bed and above it */
    size_t run;
    bool hung; /* something of this run hangs */
    double fold;
    lay_result result;
} layer;

static void world(const layer *l, double *x, double *z)
{
    bed_to_world(l->frame, l->along, l->height - l->frame->height_1, x, z);
}

static cable_piece *add_piece(layer *l, size_t origin, double s, double length)
{
    const line_piece *from = l->frame->line->pieces + origin;
    cable_piece *piece = l->form->pieces + l->form->count;
    *piece = (cable_piece){.section = l->sections + from->section,
                           .start = from->start + s,
                           .length = length,
                           .run = l->run};
    l->form->origin[l->form->count++] = origin;
    return piece;
}

/* ---- what hangs ---- */

static void hang_part(layer *l, bed_state *at, double length)
{
    if (!(length > 0))
        return;
    cable_piece *piece = add_piece(l, at->piece, at->s, length);
    bed_to_world(l->frame, at->t, at->n, &piece->h, &piece->v);
    world(l, &piece->x, &piece->z);
    l->along += bed_move(l->frame, at, length);
    l->height = at->height;
    l->hung = true;
}

/* Up to a place inside a piece, or up to a joint, before its step. */
static void hang_to(layer *l, bed_state *at, const bed_state *to, bool at_joint)
{
    while (at->piece < to->piece) {
        hang_part(l, at, l->frame->line->pieces[at->piece].arc.length - at->s);
        at->piece++;
        at->s = 0;
        if (at->piece < to->piece || !at_joint)
            bed_step(l->frame, at->piece, &at->t, &at->n);
    }
    if (!at_joint)
        hang_part(l, at, to->s - at->s);
}

/* ---- what lies ---- */

static void smallest(layer *l, double reaction)
{
    if (!(l->form->reaction <= reaction))
        l->form->reaction = reaction;
}

/* Pieces from landing to lifting with the tension that they have without friction. */
static void lie_parts(layer *l, const bed_contact *c)
{
    const bed_frame *f = l->frame;
    double t = c->from.t, n = c->from.n;
    double s = c->from.s;
    if (c->at_joint)
        bed_step(f, c->from.piece, &t, &n);
    for (size_t i = c->from.piece;; i++) {
        const cable_arc *arc = &f->line->pieces[i].arc;
        const double length = (i == c->to.piece ? c->to.s : arc->length) - s;
        if (length > 0) {
            cable_piece *piece = add_piece(l, i, s, length);
            piece->lies = true;
            piece->h = t; /* along the bed as yet */
            piece->rate = arc->weight * f->sine;
            t += piece->rate * length;
            smallest(l, arc->weight * f->cosine);
        }
        if (i == c->to.piece)
            break;
        n = 0;
        s = 0;
        bed_step(f, i + 1, &t, &n);
        if (n != 0 && i + 1 < c->to.piece)
            smallest(l, n);
    }
    if (c->at_joint || c->reaction > 0)
        smallest(l, c->reaction);
}

/* Makes room for a piece behind number `i`, of the same origin. */
static void split(layer *l, size_t i, double length)
{
    cable_form *form = l->form;
    for (size_t k = form->count; k > i + 1; k--) {
        form->pieces[k] = form->pieces[k - 1];
        form->origin[k] = form->origin[k - 1];
    }
    form->pieces[i + 1] = form->pieces[i];
    form->origin[i + 1] = form->origin[i];
    form->pieces[i].length = length;
    form->pieces[i + 1].start += length;
    form->pieces[i + 1].length -= length;
    form->count++;
}

/* What the joint at the start of a piece takes from the tension of what lies before it. */
static double joint_grip(const bed_frame *f, size_t origin, double reaction)
{
    const line_piece *p = f->line->pieces + origin;
    double load_t, load_n;
    bed_from_world(f, p->load_x, p->load_z, &load_t, &load_n);
    return load_t + p->jump + p->friction * fmax(reaction < 0 ? load_n : reaction, 0);
}

/* Friction, from where the line leaves the bed back to end 1. */
static void grip(layer *l, size_t first, const bed_contact *c)
{
    const bed_frame *f = l->frame;
    cable_form *form = l->form;
    double t = c->to.t;
    if (c->to.s == 0 && c->to.piece > 0)
        t = fmax(0, t - joint_grip(f, c->to.piece, c->reaction));
    for (size_t i = form->count; i-- > first;) {
        cable_piece *piece = form->pieces + i;
        const size_t origin = form->origin[i];
        const double weight = piece->section->weight;
        const double rate = weight * (f->sine + f->line->pieces[origin].friction * f->cosine);
        const bool begins = i == first || form->origin[i - 1] != origin;
        const double at_start = t - rate * piece->length;
        piece->rate = t > 0 || at_start > 0 ? rate : 0;
        piece->h = fmax(0, at_start);
        if (t > 0 && at_start < 0) {
            const double taut = t / rate;
            split(l, i, piece->length - taut);
            form->pieces[i].rate = 0;
        }
        t = form->pieces[i].h;
        if (begins && i > first)
            t = fmax(0, t - joint_grip(f, origin, -1));
    }
}

/* Places of the lying pieces from `first` on, and their forces as all others have them. */
static void place_lying(layer *l, size_t first)
{
    const bed_frame *f = l->frame;
    for (size_t i = first; i < l->form->count; i++) {
        cable_piece *piece = l->form->pieces + i;
        const double t = piece->h, end = t + piece->rate * piece->length;
        const bool slack = fabs(t) <= 1e-12 * f->load && fabs(end) <= 1e-12 * f->load;
        const double along = slack ? l->fold : 1;
        l->result.compressed |= fmin(t, end) < -1e-12 * f->load;
        l->result.slack += slack ? piece->length : 0;
        l->form->slack |= slack;
        piece->bed_x = along * f->cosine;
        piece->bed_z = along * f->sine;
        piece->h = fmax(t, 0) * f->cosine;
        piece->v = fmax(t, 0) * f->sine;
        world(l, &piece->x, &piece->z);
        l->along += along * form_stretched(piece, piece->length);
    }
}

static double place_of(const bed_frame *f, const bed_state *at)
{
    return f->line->pieces[at->piece].start + at->s;
}

/* Up to where a contact's pieces bear no tension. */
static double slack_until(const cable_form *form, size_t first, double from)
{
    for (size_t i = first; i < form->count; i++) {
        const cable_piece *piece = form->pieces + i;
        if (piece->h != 0 || piece->v != 0 || piece->rate != 0)
            break;
        from = piece->start + piece->length;
    }
    return from;
}

static void lay_contact(layer *l, const bed_contact *c, bool from_end_1)
{
    cable_form *form = l->form;
    const size_t first = form->count;
    double x, z;
    strum_cable_contact *contact = form->contacts + form->contact_count++;
    l->height = 0;
    world(l, &x, &z);
    *contact = (strum_cable_contact){.from = place_of(l->frame, &c->from), .x_from = x};
    if (l->hung)
        l->run++;
    l->hung = false;
    lie_parts(l, c);
    if (from_end_1)
        grip(l, first, c);
    place_lying(l, first);
    world(l, &x, &z);
    contact->to = place_of(l->frame, &c->to);
    contact->x_to = contact->touchdown = x;
    contact->slack_to = slack_until(form, first, contact->from);
    if (from_end_1 && c->to.t < -1e-12 * l->frame->load)
        l->result.compressed = true;
}

lay_result lay_form(const bed_frame *f, const bed_touch *touch,
                    const strum_cable_section *sections, double fold, cable_form *form)
{
    layer l = {.frame = f, .sections = sections, .form = form, .fold = fold};
    bed_state at = touch->start;
    l.height = f->height_1;
    form->count = form->contact_count = 0;
    form->reaction = NAN;
    form->slack = false;
    for (size_t i = 0; i < touch->count; i++) {
        const bed_contact *c = touch->contacts + i;
        const bool from_end_1 =
            f->height_1 == 0 && i == 0 && c->from.piece == 0 && c->from.s == 0 && !c->at_joint;
        hang_to(&l, &at, &c->from, c->at_joint);
        lay_contact(&l, c, from_end_1);
        at = c->to;
        at.height = 0;
    }
    const size_t last = f->line->count - 1;
    const bed_state end = {.piece = last, .s = f->line->pieces[last].arc.length};
    hang_to(&l, &at, &end, false);
    bed_to_world(f, at.t, at.n, &form->h, &form->v);
    world(&l, &form->x, &form->z);
    l.result.along = l.along;
    return l.result;
}
