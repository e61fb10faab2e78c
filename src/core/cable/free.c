/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/free.h"

#include <float.h>
#include <math.h>

#include "core/cable/chord.h"
#include "core/numerics/bracket.h"

#define STEPS_MAX 300
/* Longest step, in the largest tension and the load together. */
#define STEP_MAX 4.0
/* Estimated time of one arc, in microseconds. */
#define ARC_US 0.1

/* ---- what has no shape ---- */

static strum_status too_short(const cable_chord *c, strum_error *error)
{
    return error_at(error, STRUM_ERR_IMPOSSIBLE, STRUM_CABLE_ARG_SECTIONS, STRUM_NO_INDEX,
                    "an inextensible cable of %.15g m does not hang between ends that are "
                    "%.15g m apart: it must be longer",
                    c->line->length, c->distance);
}

/* The force at end 1 that leaves piece `j` without force. */
static void forceless_at(const cable_line *line, size_t j, double *h, double *v)
{
    *h = *v = 0;
    for (size_t i = 0; i <= j; i++) {
        *h -= line->pieces[i].load_x;
        *v -= line->pieces[i].load_z +
              (i < j ? line->pieces[i].arc.weight * line->pieces[i].arc.length : 0);
    }
}

/* How far the rest ends from end 2 when the force at end 1 is (h, v), and the length of all
 * weightless pieces that are without force then. */
static double rest_misses(const cable_chord *c, double span, double rise, double h, double v,
                          double *forceless)
{
    double x = 0, z = 0;
    *forceless = 0;
    for (size_t i = 0; i < c->line->count; i++) {
        const line_piece *piece = c->line->pieces + i;
        double dx, dz;
        h += piece->load_x;
        v += piece->load_z;
        if (piece->arc.weight == 0 && hypot(h, v) <= 1e-14 * c->load) {
            *forceless += piece->arc.length;
            continue;
        }
        arc_reach(&piece->arc, h, v, &dx, &dz);
        x += dx;
        z += dz;
        v += piece->arc.weight * piece->arc.length;
    }
    return hypot(span - x, rise - z);
}

/* The gradient of Phi jumps by the length of a weightless piece where its force vanishes: when
 * the rest of the line misses end 2 by less, the minimum lies just there. */
static strum_status refuse_slack(const cable_chord *c, double span, double rise, work *w,
                                 strum_error *error)
{
    for (size_t j = 0; j < c->line->count; j++) {
        double h, v, forceless;
        if (c->line->pieces[j].arc.weight != 0)
            continue;
        if (work_spend(w, ARC_US * (double)c->line->count) != STRUM_OK)
            return work_error(w, error);
        forceless_at(c->line, j, &h, &v);
        if (rest_misses(c, span, rise, h, v, &forceless) <= forceless)
            return error_at(error, STRUM_ERR_IMPOSSIBLE, STRUM_CABLE_ARG_SECTIONS,
                            c->line->pieces[j].section,
                            "a weightless piece without tension has no shape: the cable is too "
                            "long, or nothing pulls at this section");
    }
    return STRUM_OK;
}

/* ---- straight up and down ---- */

typedef struct {
    const cable_line *line;
    double rise;
} vertical;

static double vertical_miss(double v, const void *data)
{
    const vertical *a = data;
    double h = 0, z = 0;
    for (size_t i = 0; i < a->line->count; i++) {
        const line_piece *piece = a->line->pieces + i;
        double dx, dz;
        line_step(piece, &h, &v);
        arc_reach(&piece->arc, 0, v, &dx, &dz);
        z += dz;
        v += piece->arc.weight * piece->arc.length;
    }
    return z - a->rise;
}

/* Span 0 and no horizontal load: H = 0, and the height of end 2 rises with V. */
static double solve_vertical(const cable_chord *c, double rise)
{
    const vertical a = {c->line, rise};
    double reach = fmax(2 * c->load, DBL_MIN);
    while (reach < DBL_MAX / 4 &&
           !(vertical_miss(-reach, &a) < 0 && vertical_miss(reach, &a) > 0))
        reach *= 2;
    return bracket_root(vertical_miss, &a, -reach, reach);
}

static bool is_vertical(const cable_line *line, double span)
{
    bool none = span == 0;
    for (size_t i = 0; i < line->count; i++)
        none = none && line->pieces[i].load_x == 0;
    return none;
}

/* ---- Newton's method ---- */

/* Whether the step to where `next` holds may be taken: not far beyond the minimum along it. With
 * tension jumps nothing is minimised, and the error must fall. */
static bool acceptable(const cable_chord *c, const chord_miss *now, const chord_miss *next,
                       double step_p, double step_q)
{
    if (c->line->has_jumps)
        return hypot(next->along, next->across) < hypot(now->along, now->across);
    return next->along * step_p + next->across * step_q <=
           0.5 * fabs(now->along * step_p + now->across * step_q);
}

static strum_status newton(const cable_chord *c, double *p, double *q, work *w)
{
    chord_miss now = chord_reach(c, *p, *q);
    double last = INFINITY;
    for (int i = 0; i < STEPS_MAX; i++) {
        if (work_spend(w, ARC_US * (double)c->line->count) != STRUM_OK)
            return w->status;
        const double determinant = now.pp * now.qq - now.pq * now.qp;
        double step_p = (now.pq * now.across - now.qq * now.along) / determinant;
        double step_q = (now.qp * now.along - now.pp * now.across) / determinant;
        const double size = hypot(step_p, step_q) / now.tension;
        if (!isfinite(size))
            return STRUM_ERR_ACCURACY;
        /* to the last digits, or as far as rounding lets it fall */
        const double rounding = i < 30 ? 1e-13 : 1e-9;
        if (size < 4 * DBL_EPSILON || (size < rounding && size > last / 4))
            return STRUM_OK;
        last = size;
        /* where Phi is nearly straight its curvature says nothing of how far to go */
        const double longest = STEP_MAX * (1 + c->load / now.tension);
        if (size > longest) {
            step_p *= longest / size;
            step_q *= longest / size;
        }
        chord_miss next = chord_reach(c, *p + step_p, *q + step_q);
        for (int cut = 0; cut < 60 && !acceptable(c, &now, &next, step_p, step_q); cut++) {
            step_p /= 2;
            step_q /= 2;
            next = chord_reach(c, *p + step_p, *q + step_q);
        }
        *p += step_p;
        *q += step_q;
        now = next;
    }
    return STRUM_ERR_ACCURACY;
}

/* Where the force of a weightless piece vanishes Phi has a corner, at which Newton's method may
 * end though the minimum lies elsewhere: the corners rounded first, then less and less. */
static strum_status around_corners(cable_chord *c, double *p, double *q, work *w)
{
    chord_guess(c, p, q);
    for (c->rounding = 0.3 * c->load; c->rounding > 1e-9 * c->load; c->rounding /= 5) {
        const strum_status status = newton(c, p, q, w);
        if (status != STRUM_OK && status != STRUM_ERR_ACCURACY)
            return status;
    }
    c->rounding = 0;
    return newton(c, p, q, w);
}

strum_status free_solve(const cable_line *line, double span, double rise, bool warm, double *h,
                        double *v, work *w, strum_error *error)
{
    cable_chord c = chord_of(line, span, rise);
    if (c.flexibility == 0 && c.excess <= 0)
        return too_short(&c, error);
    strum_status status = line->has_jumps ? STRUM_OK : refuse_slack(&c, span, rise, w, error);
    if (status != STRUM_OK)
        return status;
    if (is_vertical(line, span)) {
        *h = 0;
        *v = solve_vertical(&c, rise);
        return STRUM_OK;
    }
    double p, q;
    if (warm)
        chord_from_world(&c, *h, *v, &p, &q);
    else
        chord_guess(&c, &p, &q);
    status = newton(&c, &p, &q, w);
    if (status == STRUM_ERR_ACCURACY)
        status = around_corners(&c, &p, &q, w);
    if (status == STRUM_ERR_ACCURACY)
        return error_set(error, status,
                         "the static shape was not found: Newton's method failed");
    if (status != STRUM_OK)
        return work_error(w, error);
    chord_to_world(&c, p, q, h, v);
    return STRUM_OK;
}
