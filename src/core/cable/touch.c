/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/touch.h"

#include <math.h>

#include "core/numerics/bracket.h"

/* Estimated time of one arc of a flight, in microseconds. */
#define ARC_US 0.1

void bed_step(const bed_frame *f, size_t piece, double *t, double *n)
{
    const line_piece *p = f->line->pieces + piece;
    double load_t, load_n;
    if (p->jump != 0) {
        const double tension = hypot(*t, *n), factor = tension > 0 ? 1 + p->jump / tension : 1;
        *t *= factor;
        *n *= factor;
    }
    bed_from_world(f, p->load_x, p->load_z, &load_t, &load_n);
    *t += load_t;
    *n += load_n;
}

static double weight_across(const bed_frame *f, size_t piece)
{
    return f->line->pieces[piece].arc.weight * f->cosine;
}

double bed_move(const bed_frame *f, bed_state *at, double length)
{
    cable_arc arc = f->line->pieces[at->piece].arc;
    double h, v, x, z, along, up;
    arc.length = length;
    bed_to_world(f, at->t, at->n, &h, &v);
    arc_reach(&arc, h, v, &x, &z);
    bed_from_world(f, x, z, &along, &up);
    at->s += length;
    at->height += up;
    at->t += arc.weight * length * f->sine;
    at->n += arc.weight * length * f->cosine;
    return along;
}

/* ---- a flight: from where it leaves to end 2, the bed ignored ---- */

typedef struct {
    double height;   /* at the end */
    bool has_lowest; /* a minimum on the way */
    bool at_joint;
    bed_state lowest; /* of a joint: before its step, at the start of the piece behind it */
} flight;

static void take_lowest(flight *way, const bed_state *at, bool at_joint)
{
    if (way->has_lowest && at->height >= way->lowest.height)
        return;
    way->has_lowest = true;
    way->lowest = *at;
    way->at_joint = at_joint;
}

static flight fly(const bed_frame *f, bed_state at)
{
    flight way = {0};
    bool lies = at.n == 0 && at.height == 0; /* and no minimum, but the contact itself */
    const size_t count = f->line->count;
    work_spend(f->work, ARC_US * (double)(count - at.piece));
    for (;;) {
        const double left = f->line->pieces[at.piece].arc.length - at.s;
        const double w = weight_across(f, at.piece);
        if (at.n < 0 && w > 0 && at.n + w * left > 0) {
            bed_state low = at;
            bed_move(f, &low, -at.n / w);
            low.n = 0;
            take_lowest(&way, &low, false);
        }
        if (left > 0) {
            lies = lies && w == 0 && at.n == 0;
            bed_move(f, &at, left);
        }
        if (at.piece + 1 == count)
            break;
        bed_state before = at;
        before.piece = at.piece = at.piece + 1;
        before.s = at.s = 0;
        bed_step(f, at.piece, &at.t, &at.n);
        if (before.n <= 0 && at.n >= 0 && before.n < at.n && !lies)
            take_lowest(&way, &before, true);
    }
    way.height = at.height;
    return way;
}

/* How far the flight passes above what it must reach: the bed on the way, and end 2. */
static double spare(const bed_frame *f, const flight *way)
{
    const double end = way->height - f->height_2;
    return way->has_lowest ? fmin(end, way->lowest.height) : end;
}

/* ---- parameters of leaving ---- */

typedef enum { FORCE, RELEASE, LIE } phase_kind;

/* FORCE: n is the parameter itself; RELEASE: n falls from `most` to 0; LIE: the line lies from
 * state.s on, the parameter is the part of what is left of the piece. */
typedef struct {
    const bed_frame *frame;
    phase_kind kind;
    bed_state state;
    double most;
} phase;

static bed_state leave(const phase *p, double parameter)
{
    bed_state at = p->state;
    if (p->kind == FORCE) {
        at.n = parameter;
    } else if (p->kind == RELEASE) {
        at.n = p->most * (1 - parameter);
    } else {
        const cable_arc *arc = &p->frame->line->pieces[at.piece].arc;
        const double by = parameter * (arc->length - at.s);
        at.s = parameter == 1 ? arc->length : at.s + by;
        at.t += arc->weight * by * p->frame->sine;
        at.n = 0;
    }
    return at;
}

static double spare_at(double parameter, const void *data)
{
    const phase *p = data;
    const flight way = fly(p->frame, leave(p, parameter));
    return p->frame->work->status == STRUM_OK ? spare(p->frame, &way) : 0;
}

/* The force at end 1 with nothing to spare, at least `least`. */
static double find_force(const phase *p, double least)
{
    const double scale = fmax(p->frame->load, fabs(p->state.t));
    double high = scale, low = fmax(least, -scale);
    for (int i = 0; i < 1000 && spare_at(high, p) < 0; i++)
        high *= 2;
    for (int i = 0; i < 1000 && low > least && spare_at(low, p) > 0; i++)
        low *= 2;
    return bracket_root(spare_at, p, fmax(low, least), high);
}

/* The phase after LIE or RELEASE has come to its end; false: there is none, since a float or a
 * buoyant piece must have left the bed before. `reaction`: of a joint that is borne in full. */
static bool next_phase(phase *p)
{
    const bed_frame *f = p->frame;
    bed_state at = leave(p, 1);
    if (p->kind == LIE) {
        if (at.piece + 1 == f->line->count)
            return false;
        at.piece++;
        at.s = 0;
        bed_step(f, at.piece, &at.t, &at.n);
        if (at.n < 0)
            return false;
    }
    p->state = at;
    p->most = at.n;
    p->kind = at.n > 0 ? RELEASE : LIE;
    p->state.n = 0;
    return p->kind == RELEASE || weight_across(f, at.piece) >= 0;
}

/* Goes on by `steps` phases, or to the last; returns by how many. */
static size_t go_on(phase *p, size_t steps)
{
    size_t gone = 0;
    while (gone < steps) {
        const phase kept = *p;
        if (!next_phase(p)) {
            *p = kept;
            break;
        }
        gone++;
    }
    return gone;
}

/* The first phase, from p on, at whose end nothing is to spare, or the last: in strides that
 * double, then halved, since every look costs a flight over all that lies ahead. */
static void find_phase(phase *p)
{
    size_t stride = 1;
    while (p->frame->work->status == STRUM_OK && spare_at(1, p) > 0) {
        phase far = *p;
        const size_t gone = go_on(&far, stride);
        if (gone == 0)
            return;
        if (spare_at(1, &far) > 0) {
            *p = far;
            stride *= 2;
            continue;
        }
        size_t low = 0, high = gone; /* to spare at the end of low, not of high */
        while (high - low > 1) {
            const size_t middle = low + (high - low) / 2;
            phase between = *p;
            go_on(&between, middle);
            if (spare_at(1, &between) > 0)
                low = middle;
            else
                high = middle;
        }
        go_on(p, high);
        return;
    }
}

/* From a contact on: the first phase at whose end nothing is to spare, and there the place. */
static bed_state find_lift(phase *p, double *reaction)
{
    find_phase(p);
    const double at_start = spare_at(0, p), at_end = spare_at(1, p);
    double parameter = at_end >= 0 ? 1 : 0;
    if (at_start > 0 && at_end < 0)
        parameter = bracket_root(spare_at, p, 0, 1);
    const bed_state at = leave(p, parameter);
    *reaction = p->kind == RELEASE ? p->most - at.n : 0;
    return at;
}

/* ---- contact after contact ---- */

static bool add_contact(bed_touch *touch, const bed_contact *contact)
{
    if (touch->count == touch->room)
        return false;
    touch->contacts[touch->count++] = *contact;
    return true;
}

/* The contact where a flight is lowest, with how the line leaves it. */
static bed_contact contact_at(const bed_frame *f, const flight *way)
{
    bed_contact c = {.from = way->lowest, .at_joint = way->at_joint};
    phase p = {.frame = f, .kind = LIE, .state = way->lowest};
    c.from.height = p.state.height = 0;
    if (way->at_joint) {
        bed_step(f, p.state.piece, &p.state.t, &p.state.n);
        p.kind = RELEASE;
        p.most = p.state.n;
    }
    c.to = find_lift(&p, &c.reaction);
    return c;
}

/* How the line leaves end 1: by its force, or, on the bed, after it has lain. */
static bool leave_end_1(const bed_frame *f, double t, bed_touch *touch)
{
    phase p = {.frame = f, .kind = FORCE, .state = {.t = t, .height = f->height_1}};
    touch->start = p.state;
    if (f->height_1 > 0) {
        touch->start.n = find_force(&p, -INFINITY);
        return true;
    }
    if (spare_at(0, &p) < 0 || weight_across(f, 0) < 0) {
        touch->start.n = find_force(&p, 0);
        return true;
    }
    bed_contact c = {.from = p.state};
    p.kind = LIE;
    c.to = find_lift(&p, &c.reaction);
    return add_contact(touch, &c);
}

bool touch_solve(const bed_frame *f, double t, bed_touch *touch)
{
    touch->count = 0;
    if (!leave_end_1(f, t, touch))
        return false;
    bed_state at = touch->count > 0 ? touch->contacts[0].to : touch->start;
    while (f->work->status == STRUM_OK) {
        const flight way = fly(f, at);
        if (!way.has_lowest || way.lowest.height > way.height - f->height_2)
            return true;
        const bed_contact c = contact_at(f, &way);
        if (!add_contact(touch, &c))
            return false;
        at = c.to;
        if (at.piece + 1 == f->line->count && at.s >= f->line->pieces[at.piece].arc.length)
            return true;
    }
    return false;
}
