/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What can be measured on the form of a cable. */
#include <float.h>
#include <math.h>

#include "core/cable/form.h"

/* ---- places of a piece where something is largest ---- */

/* Where a hanging piece is level: v = 0; NAN where it is not. */
static double level_at(const cable_piece *piece)
{
    const double w = piece->section->weight, end = piece->v + w * piece->length;
    return !piece->lies && piece->v * end < 0 ? -piece->v / w : NAN;
}

/* Where a hanging piece is parallel to (x, z): F x (x, z) = 0; NAN where it is not. */
static double parallel_at(const cable_piece *piece, double x, double z)
{
    const double w = piece->section->weight * x, from = piece->v * x - piece->h * z,
                 end = from + w * piece->length;
    return !piece->lies && from * end <= 0 && w != 0 ? -from / w : NAN;
}

/* ---- sag ---- */

static double below_chord(double x, double z, double span, double rise)
{
    return x * (rise / span) - z;
}

static double sag_max(const cable_form *f, double span, double rise)
{
    double most = fmax(0, below_chord(f->x, f->z, span, rise));
    for (size_t i = 0; i < f->count; i++) {
        const cable_piece *p = f->pieces + i;
        const double s = parallel_at(p, span, rise);
        most = fmax(most, below_chord(p->x, p->z, span, rise));
        if (!isnan(s)) {
            const form_state at = form_at(p, s);
            most = fmax(most, below_chord(at.x, at.z, span, rise));
        }
    }
    return most;
}

/* The first place of the piece whose x is given; its ends lie on either side. */
static double place_of_x(const cable_piece *piece, double x)
{
    double low = 0, high = piece->length, s = high / 2;
    const bool rising = form_at(piece, high).x > piece->x;
    for (int i = 0; i < 200 && high - low > DBL_EPSILON * high; i++) {
        const form_state at = form_at(piece, s);
        if ((at.x < x) == rising)
            low = s;
        else
            high = s;
        /* dx/dS = h (1/T + 1/EA) */
        const double t = hypot(at.h, at.v),
                     slope = at.h * (1 / t + 1 / piece->section->axial_stiffness);
        s += (x - at.x) / slope;
        if (!(s > low && s < high))
            s = low + (high - low) / 2;
        else if (fabs(x - at.x) <= DBL_EPSILON * fabs(x))
            break;
    }
    return s;
}

static double sag_mid(const cable_form *f, double span, double rise)
{
    const double middle = span / 2;
    for (size_t i = 0; i < f->count; i++) {
        const cable_piece *p = f->pieces + i;
        const double end = i + 1 < f->count ? p[1].x : f->x;
        if ((p->x - middle) * (end - middle) <= 0 && p->x != end) {
            const form_state at = form_at(p, place_of_x(p, middle));
            return below_chord(middle, at.z, span, rise);
        }
    }
    return NAN;
}

/* ---- single figures ---- */

static double stretched(const cable_form *f)
{
    double sum = 0;
    for (size_t i = 0; i < f->count; i++)
        sum += form_stretched(f->pieces + i, f->pieces[i].length);
    return sum;
}

/* Tension where the line is first parallel to its chord. */
static double parallel_tension(const cable_form *f, double span, double rise)
{
    for (size_t i = 0; i < f->count; i++) {
        const cable_piece *p = f->pieces + i;
        const double s = parallel_at(p, span, rise);
        if (!isnan(s)) {
            const form_state at = form_at(p, s);
            return hypot(at.h, at.v);
        }
        /* a straight one is so everywhere */
        const double cross = p->v * span - p->h * rise, size = hypot(p->h, p->v);
        if (!p->lies && p->section->weight * span == 0 &&
            fabs(cross) <= 1e-12 * size * hypot(span, rise))
            return size;
    }
    return NAN;
}

/* The first such point where tied, to rounding. What lies is as low as the bed is: the lowest of a
 * cable on it is where it first lies. */
static strum_cable_place extreme(const cable_form *f, int side)
{
    const double length = f->pieces[f->count - 1].start + f->pieces[f->count - 1].length;
    const double tie = 1e-14 * length;
    strum_cable_place best = {0, 0};
    bool lies = f->pieces->lies;
    for (size_t i = 0; i < f->count; i++) {
        const cable_piece *p = f->pieces + i;
        if (side < 0 && p->lies && !lies && p->z <= best.z + tie) {
            best = (strum_cable_place){p->x, p->z};
            lies = true;
        }
        const double s = level_at(p);
        form_state candidates[2] = {{p->x, p->z, 0, 0}, {p->x, p->z, 0, 0}};
        if (!isnan(s))
            candidates[1] = form_at(p, s);
        for (int k = 0; k < 2; k++)
            if (side * candidates[k].z > side * best.z + tie)
                best = (strum_cable_place){candidates[k].x, candidates[k].z};
    }
    return side * f->z > side * best.z + tie ? (strum_cable_place){f->x, f->z} : best;
}

static void tensions(const cable_form *f, double *least, double *most)
{
    *least = INFINITY;
    *most = 0;
    for (size_t i = 0; i < f->count; i++) {
        const cable_piece *p = f->pieces + i;
        const form_state end = form_at(p, p->length);
        const double from = hypot(p->h, p->v), to = hypot(end.h, end.v);
        *most = fmax(*most, fmax(from, to));
        *least = fmin(*least, fmin(from, to));
        if (!isnan(level_at(p)))
            *least = fmin(*least, fabs(p->h));
    }
}

void form_measure(const cable_form *f, double span, double rise, strum_cable_statics *s)
{
    const cable_piece *first = f->pieces;
    s->horizontal_end_1 = first->h;
    s->vertical_end_1 = first->v;
    s->tension_end_1 = hypot(first->h, first->v);
    s->horizontal_end_2 = f->h;
    s->vertical_end_2 = f->v;
    s->tension_end_2 = hypot(f->h, f->v);
    tensions(f, &s->tension_min, &s->tension_max);
    s->tension_parallel_to_chord = parallel_tension(f, span, rise);
    s->span = span;
    s->rise = rise;
    s->unstretched_length = f->pieces[f->count - 1].start + f->pieces[f->count - 1].length;
    s->length = stretched(f);
    s->sag_mid = span > 0 ? sag_mid(f, span, rise) : NAN;
    s->sag_max = span > 0 ? sag_max(f, span, rise) : NAN;
    s->angle_end_1 = form_angle(first, 0);
    s->angle_end_2 = form_angle(f->pieces + f->count - 1, f->pieces[f->count - 1].length);
    s->lowest = extreme(f, -1);
    s->highest = extreme(f, 1);
    s->slack = f->slack;
    s->contacts = f->contact_count;
    s->lying = 0;
    for (size_t i = 0; i < f->contact_count; i++)
        s->lying += f->contacts[i].to - f->contacts[i].from;
    s->smallest_reaction = f->reaction;
    s->closure = hypot(f->x - span, f->z - rise) / s->unstretched_length;
}

double form_given(const cable_form *f, strum_cable_given given, double span, double rise,
                  const strum_cable_section *section)
{
    const cable_piece *first = f->pieces, *last = f->pieces + f->count - 1;
    switch (given) {
    case STRUM_CABLE_LENGTHS:
        break;
    case STRUM_CABLE_HORIZONTAL_TENSION:
        return first->h;
    case STRUM_CABLE_TENSION_END_1:
        return hypot(first->h, first->v);
    case STRUM_CABLE_TENSION_END_2:
        return hypot(f->h, f->v);
    case STRUM_CABLE_TENSION_PARALLEL_TO_CHORD:
        return parallel_tension(f, span, rise);
    case STRUM_CABLE_CATENARY_PARAMETER:
        return first->h / fabs(section->weight);
    case STRUM_CABLE_SAG_MID:
        return sag_mid(f, span, rise);
    case STRUM_CABLE_SAG_MAX:
        return sag_max(f, span, rise);
    case STRUM_CABLE_DEPTH_BELOW_END_1:
        return -extreme(f, -1).z;
    case STRUM_CABLE_STRETCHED_LENGTH:
        return stretched(f);
    case STRUM_CABLE_ANGLE_END_1:
        return form_angle(first, 0);
    case STRUM_CABLE_ANGLE_END_2:
        return form_angle(last, last->length);
    }
    return NAN;
}
