/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What can be measured on a cable whose shape has bending stiffness. */
#include <math.h>

#include "core/cable/form.h"
#include "core/cable/rod.h"
#include "core/numerics/bracket.h"

/* Parts of an element, or of a piece that does not bend, between which a figure changes sign once
 * at most. */
#define PARTS 8

typedef struct {
    const strum_hanging *cable;
    size_t piece;
    double target;
} level;

static rod_point state_at(const strum_hanging *cable, size_t piece, double s, bool place)
{
    if (rod_bends(cable, piece))
        return rod_at(cable, piece, s, place);
    const cable_piece *p = cable->pieces + piece;
    const form_state at = form_at(p, s);
    return (rod_point){.angle = form_angle(p, s),
                       .normal = hypot(at.h, at.v),
                       .stretch = 1 + hypot(at.h, at.v) / p->section->axial_stiffness,
                       .x = at.x,
                       .z = at.z};
}

/* Stretch number k of a piece: between the ends of an element, or all of it. */
static size_t stretches(const strum_hanging *cable, size_t piece)
{
    return rod_bends(cable, piece) ? cable->rod->first[piece + 1] - cable->rod->first[piece]
                                   : 1;
}

static void stretch_of(const strum_hanging *cable, size_t piece, size_t k, double *from,
                       double *to)
{
    *from = 0;
    *to = cable->pieces[piece].length;
    if (rod_bends(cable, piece)) {
        const rod_element *e = cable->rod->elements + cable->rod->first[piece] + k;
        *from = e->from;
        *to = e->from + 2 * e->half;
    }
}

static double angle_beyond(double s, const void *data)
{
    const level *l = data;
    return sin(state_at(l->cable, l->piece, s, false).angle - l->target);
}

static double place_beyond(double s, const void *data)
{
    const level *l = data;
    return state_at(l->cable, l->piece, s, true).x - l->target;
}

/* ---- extremes ---- */

static void take(strum_cable_statics *f, double x, double z, double span, double rise)
{
    if (z < f->lowest.z)
        f->lowest = (strum_cable_place){x, z};
    if (z > f->highest.z)
        f->highest = (strum_cable_place){x, z};
    if (span > 0)
        f->sag_max = fmax(f->sag_max, x * (rise / span) - z);
}

/* Where the tangent has the direction `target` between two places with the angles there. */
static void take_level(strum_hanging *cable, size_t piece, const double place[2],
                       const rod_point *at_ends, double target, bool chord)
{
    strum_cable_statics *f = &cable->statics;
    const level l = {cable, piece, target};
    if (!(sin(at_ends[0].angle - target) * sin(at_ends[1].angle - target) <= 0))
        return;
    const double s = bracket_root(angle_beyond, &l, place[0], place[1]);
    const rod_point at = state_at(cable, piece, s, true);
    take(f, at.x, at.z, f->span, f->rise);
    if (chord && isnan(f->tension_parallel_to_chord) && cos(at.angle - target) > 0)
        f->tension_parallel_to_chord = at.normal;
}

static void measure_stretch(strum_hanging *cable, size_t piece, double from, double to)
{
    strum_cable_statics *f = &cable->statics;
    const double chord = atan2(f->rise, f->span), part = (to - from) / PARTS;
    rod_point at[2];
    at[1] = state_at(cable, piece, from, false);
    for (int i = 0; i < PARTS; i++) {
        const double place[2] = {from + part * i, i + 1 == PARTS ? to : from + part * (i + 1)};
        at[0] = at[1];
        at[1] = state_at(cable, piece, place[1], false);
        f->tension_min = fmin(f->tension_min, fmin(at[0].normal, at[1].normal));
        f->tension_max = fmax(f->tension_max, fmax(at[0].normal, at[1].normal));
        take_level(cable, piece, place, at, 0, false);
        take_level(cable, piece, place, at, chord, true);
    }
}

/* ---- lengths ---- */

static double stretched(const strum_hanging *cable, size_t piece, size_t k)
{
    if (!rod_bends(cable, piece))
        return form_stretched(cable->pieces + piece, cable->pieces[piece].length);
    return cable->rod->elements[cable->rod->first[piece] + k].stretched;
}

/* Chord less cable at half the span, at the first place there. `x`: of the ends. */
static void sag_mid(strum_hanging *cable, size_t piece, const double place[2],
                    const double x[2])
{
    strum_cable_statics *f = &cable->statics;
    const level l = {cable, piece, f->span / 2};
    if (!isnan(f->sag_mid) || !((x[0] - l.target) * (x[1] - l.target) <= 0))
        return;
    const double s = bracket_root(place_beyond, &l, place[0], place[1]);
    f->sag_mid = f->rise / 2 - state_at(cable, piece, s, true).z;
}

/* Where a stretch begins; past the last of a piece, where that ends. */
static void begin_of(const strum_hanging *cable, size_t piece, size_t k, double *x, double *z)
{
    *x = cable->stations[piece].x;
    *z = cable->stations[piece].z;
    if (k == stretches(cable, piece)) {
        *x = cable->stations[piece + 1].x;
        *z = cable->stations[piece + 1].z;
    } else if (rod_bends(cable, piece)) {
        const rod_element *e = cable->rod->elements + cable->rod->first[piece] + k;
        *x = e->x;
        *z = e->z;
    }
}

/* ---- the whole ---- */

static void ends(strum_hanging *cable)
{
    strum_cable_statics *f = &cable->statics;
    const size_t last = cable->piece_count - 1;
    const cable_piece *first = cable->pieces, *end = cable->pieces + last;
    const rod_point one = state_at(cable, 0, 0, false),
                    two = state_at(cable, last, end->length, false);
    f->horizontal_end_1 = first->h;
    f->vertical_end_1 = first->v;
    f->tension_end_1 = hypot(first->h, first->v);
    f->horizontal_end_2 = end->h;
    f->vertical_end_2 = end->v + end->section->weight * end->length;
    f->tension_end_2 = hypot(f->horizontal_end_2, f->vertical_end_2);
    f->angle_end_1 = remainder(one.angle, 2 * M_PI);
    f->angle_end_2 = remainder(two.angle, 2 * M_PI);
    f->moment_end_1 = cable->rod->moment[0];
    f->moment_end_2 = cable->rod->moment[1];
}

void rod_measure(strum_hanging *cable, double span)
{
    strum_cable_statics *f = &cable->statics;
    const cable_station *end = cable->stations + cable->piece_count;
    f->span = span;
    f->tension_min = INFINITY;
    f->tension_max = 0;
    f->tension_parallel_to_chord = NAN;
    f->lowest = f->highest = (strum_cable_place){0, 0};
    f->sag_max = span > 0 ? 0 : NAN;
    f->sag_mid = NAN;
    f->length = 0;
    ends(cable);
    for (size_t i = 0; i < cable->piece_count; i++)
        for (size_t k = 0; k < stretches(cable, i); k++) {
            double place[2], x[2], z;
            stretch_of(cable, i, k, place, place + 1);
            measure_stretch(cable, i, place[0], place[1]);
            begin_of(cable, i, k, x, &z);
            begin_of(cable, i, k + 1, x + 1, &z);
            take(f, x[1], z, span, f->rise);
            f->length += stretched(cable, i, k);
            if (span > 0)
                sag_mid(cable, i, place, x);
        }
    f->closure = hypot(end->x - span, end->z - f->rise) / f->unstretched_length;
}
