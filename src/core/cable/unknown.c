/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/unknown.h"

#include <float.h>
#include <math.h>

#include "core/cable/chord.h"

#define STEPS_MAX 40
/* Estimated time of one step and arc, in microseconds. */
#define STEP_US 0.8

void unknown_set(cable_settler *s, double value)
{
    const strum_cable_params *p = &s->cable->params;
    double others = 0;
    if (p->span_unknown) {
        s->span = value;
        return;
    }
    for (size_t i = 0; i < p->section_count; i++)
        others += i != p->adjusted ? s->cable->sections[i].length : 0;
    s->cable->sections[p->adjusted].length = value - others;
}

double unknown_now(const cable_settler *s)
{
    const strum_cable_params *p = &s->cable->params;
    double length = 0;
    if (p->span_unknown)
        return s->span;
    for (size_t i = 0; i < p->section_count; i++)
        length += s->cable->sections[i].length;
    return length;
}

double unknown_figure(const cable_settler *s)
{
    const strum_cable_params *p = &s->cable->params;
    return form_given(&s->form, p->given, s->span, p->rise, p->sections + p->adjusted);
}

/* ---- Newton's method ---- */

enum { ALONG, ACROSS, FIGURE, EQUATIONS };

/* Errors of end 2's place over its distance, and of the figure; force in the frame of the
 * chord. */
typedef struct {
    double r[EQUATIONS];
    chord_miss miss;
    cable_chord chord;
} state;

static state state_at(cable_settler *s, const double x[EQUATIONS])
{
    const strum_cable_params *p = &s->cable->params;
    state at;
    double q_p, q_q;
    unknown_set(s, x[2]);
    settle_cut(s);
    at.chord = chord_of(&s->line, s->span, p->rise);
    chord_from_world(&at.chord, x[0], x[1], &q_p, &q_q);
    at.miss = chord_reach(&at.chord, q_p, q_q);
    form_hang(&s->line, s->cable->sections, x[0], x[1], &s->form);
    const bool angle =
        p->given == STRUM_CABLE_ANGLE_END_1 || p->given == STRUM_CABLE_ANGLE_END_2;
    at.r[ALONG] = at.miss.along / at.chord.distance;
    at.r[ACROSS] = at.miss.across / at.chord.distance;
    at.r[FIGURE] = (unknown_figure(s) - p->value) / (angle ? 1 : p->value);
    return at;
}

/* Derivatives by (h, v, unknown): of the place by the force as they are, the rest by differences,
 * which leave each step a few digits nearer. */
static void slopes(cable_settler *s, const double x[EQUATIONS], const state *at,
                   double d[EQUATIONS][EQUATIONS])
{
    const chord_miss *m = &at->miss;
    const double c_x = at->chord.along_x, c_z = at->chord.along_z, r = at->chord.distance;
    for (int k = 0; k < EQUATIONS; k++) {
        const double by = 1e-7 * (k == 2 ? fabs(x[2]) : m->tension);
        double moved[EQUATIONS] = {x[0], x[1], x[2]};
        moved[k] += by;
        const state next = state_at(s, moved);
        for (int i = 0; i < EQUATIONS; i++)
            d[i][k] = (next.r[i] - at->r[i]) / by;
    }
    d[ALONG][0] = (m->pp * c_x - m->pq * c_z) / r;
    d[ALONG][1] = (m->pp * c_z + m->pq * c_x) / r;
    d[ACROSS][0] = (m->qp * c_x - m->qq * c_z) / r;
    d[ACROSS][1] = (m->qp * c_z + m->qq * c_x) / r;
}

/* d y = -r, rows and columns balanced, by elimination with pivots. */
static bool eliminate(double d[EQUATIONS][EQUATIONS], const double r[EQUATIONS],
                      double y[EQUATIONS])
{
    for (int i = 0; i < EQUATIONS; i++)
        y[i] = -r[i];
    for (int k = 0; k < EQUATIONS; k++) {
        int best = k;
        for (int i = k + 1; i < EQUATIONS; i++)
            best = fabs(d[i][k]) > fabs(d[best][k]) ? i : best;
        if (!(fabs(d[best][k]) > 0))
            return false;
        for (int j = 0; j < EQUATIONS; j++) {
            const double kept = d[k][j];
            d[k][j] = d[best][j];
            d[best][j] = kept;
        }
        const double kept = y[k];
        y[k] = y[best];
        y[best] = kept;
        for (int i = k + 1; i < EQUATIONS; i++) {
            const double factor = d[i][k] / d[k][k];
            for (int j = k; j < EQUATIONS; j++)
                d[i][j] -= factor * d[k][j];
            y[i] -= factor * y[k];
        }
    }
    for (int k = EQUATIONS - 1; k >= 0; k--) {
        for (int j = k + 1; j < EQUATIONS; j++)
            y[k] -= d[k][j] * y[j];
        y[k] /= d[k][k];
    }
    return isfinite(y[0]) && isfinite(y[1]) && isfinite(y[2]);
}

static double size_of(const state *at)
{
    return fabs(at->r[ALONG]) + fabs(at->r[ACROSS]) + fabs(at->r[FIGURE]);
}

/* One step, cut until the errors fall. Its size, relative; negative: it failed. */
static double advance(cable_settler *s, double x[EQUATIONS], state *at)
{
    double d[EQUATIONS][EQUATIONS], y[EQUATIONS];
    slopes(s, x, at, d);
    if (!eliminate(d, at->r, y))
        return -1;
    const double size = fmax(hypot(y[0], y[1]) / at->miss.tension, fabs(y[2]) / fabs(x[2]));
    double part = 1;
    for (int cut = 0; cut < 30; cut++, part /= 2) {
        const double to[EQUATIONS] = {x[0] + part * y[0], x[1] + part * y[1],
                                      x[2] + part * y[2]};
        if (!(to[2] > 0.5 * x[2]))
            continue;
        const state next = state_at(s, to);
        if (size_of(&next) < size_of(at) || size < 1e-12) {
            for (int i = 0; i < EQUATIONS; i++)
                x[i] = to[i];
            *at = next;
            return size;
        }
    }
    return size_of(at) < 1e-13 ? 0 : -1;
}

bool unknown_solve(cable_settler *s, double h, double v)
{
    const double begin = unknown_now(s);
    double x[EQUATIONS] = {h, v, begin}, last = INFINITY;
    state at = state_at(s, x);
    /* A straight inextensible cable without load closes for every force along it: no step is left
     * to take, nor any that could be. */
    if (size_of(&at) <= 2 * DBL_EPSILON)
        return true;
    for (int i = 0; i < STEPS_MAX && isfinite(size_of(&at)); i++) {
        if (work_spend(s->work, STEP_US * (double)s->line.count) != STRUM_OK)
            break;
        const double size = advance(s, x, &at);
        if (size < 0)
            break;
        if (size < 4 * DBL_EPSILON || (size < 1e-12 && size > last / 4)) {
            (void)state_at(s, x);
            return size_of(&at) < 1e-11;
        }
        last = size;
    }
    unknown_set(s, begin);
    return false;
}
