/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is read off a mode's shape: energies, largest values, sign. */
#include "core/inclined/mode_metrics.h"

#include <math.h>

#include "core/inclined/statics.h"
#include "core/numerics/peak.h"

enum { TRANSVERSE, LONGITUDINAL, TENSION };

static double component_of(const strum_inclined_point *p, int component)
{
    return component == TRANSVERSE     ? p->transverse
           : component == LONGITUDINAL ? p->longitudinal
                                       : p->tension;
}

/* INT w^2, h INT u^2 and INT w(s) w(1-s) of every mode by Gauss' rule in x. */
typedef struct energies {
    double transverse, longitudinal, mirrored;
} energies;

static strum_status find_energies(const strum_inclined *m, energies *e, arena *a, work *w)
{
    legendre b;
    const strum_catenary *p = &m->statics.profile;
    strum_status status = legendre_make(m->size, mapping_singularity(&m->along), false, a, &b);
    if (status != STRUM_OK)
        return status;
    const size_t points = (size_t)b.points, count = (size_t)m->count;
    double *mirror = arena_doubles(a, points);
    strum_inclined_point *at = arena_alloc(a, 2 * points * count, sizeof *at);
    if (mirror == NULL || at == NULL)
        return STRUM_ERR_MEMORY;
    strum_inclined_point *mirrored = at + points * count;
    for (size_t i = 0; i < points; i++)
        mirror[i] = inclined_x_of_s(m, 1 - inclined_s_of_x(m, b.x[i]));
    status = m->model->evaluate(m, &(inclined_samples){0, m->count, b.points, b.x, at}, a, w);
    if (status == STRUM_OK)
        status = m->model->evaluate(
            m, &(inclined_samples){0, m->count, b.points, mirror, mirrored}, a, w);
    for (size_t i = 0; status == STRUM_OK && i < points * count; i++) {
        const size_t point = i / count, mode = i % count;
        const double x = b.x[point];
        const double ds = b.w[point] * mapping_slope(&m->along, x) / m->length *
                          cosh(p->chi_m + mapping_offset(&m->along, x));
        const double across = at[i].transverse, along = at[i].longitudinal;
        e[mode].transverse += ds * across * across;
        e[mode].longitudinal += ds * along * along * m->cable.mass_ratio;
        e[mode].mirrored += ds * across * mirrored[i].transverse;
    }
    return status;
}

/* All modes at equally spaced x, six or more samples a half wave. */
typedef struct survey {
    const strum_inclined *m;
    work *work;
    int points;
    double *x;
    strum_inclined_point *at; /* at[i * count + mode] */
} survey;

static strum_status survey_make(const strum_inclined *m, arena *a, work *w, survey *s)
{
    s->m = m;
    s->work = w;
    s->points = 4 * m->size + 1;
    const size_t points = (size_t)s->points;
    s->x = arena_doubles(a, points);
    s->at = arena_alloc(a, points * (size_t)m->count, sizeof *s->at);
    if (s->x == NULL || s->at == NULL)
        return STRUM_ERR_MEMORY;
    for (size_t i = 0; i < points; i++)
        s->x[i] = 2.0 * (double)i / (double)(points - 1) - 1;
    return m->model->evaluate(m, &(inclined_samples){0, m->count, s->points, s->x, s->at}, a,
                              w);
}

static double sampled(const survey *s, int mode, int component, int i)
{
    return component_of(&s->at[(size_t)i * (size_t)s->m->count + (size_t)mode], component);
}

/* The polynomial through nine samples around sample `i`, at `t` steps from it: right to about
 * 1e-8 of the largest value. */
static double interpolated(const survey *s, int mode, int component, int i, double t)
{
    static const double weights[] = {1, -8, 28, -56, 70, -56, 28, -8, 1};
    int first = i - 4;
    first = first < 0 ? 0 : first > s->points - 9 ? s->points - 9 : first;
    double above = 0, below = 0;
    for (int k = 0; k < 9; k++) {
        const double value = sampled(s, mode, component, first + k);
        const double apart = i + t - (first + k);
        if (apart == 0)
            return value;
        above += weights[k] / apart * value;
        below += weights[k] / apart;
    }
    return above / below;
}

/* A component of a mode about sample `i`. */
typedef struct nearby {
    const survey *s;
    int mode, component, i;
} nearby;

static double magnitude(void *data, double t)
{
    const nearby *n = data;
    return fabs(interpolated(n->s, n->mode, n->component, n->i, t));
}

/* Where, in steps from sample `i`, its polynomial has the largest magnitude (golden section). A
 * tension that falls steeply enough from a support has its peak between that and the first
 * sample. */
static double top_of(const survey *s, int mode, int component, int i)
{
    nearby n = {s, mode, component, i};
    golden g = golden_begin(magnitude, &n, i > 0 ? -1 : 0, i < s->points - 1 ? 1 : 0);
    for (int pass = 0; pass < 32; pass++)
        golden_step(&g, magnitude, &n);
    const double top = (g.low + g.high) / 2;
    return magnitude(&n, top) > fabs(sampled(s, mode, component, i)) ? top : 0;
}

/* The largest value of a component along the cable, with its sign; of values that agree to 1e-9
 * the first along the cable. A first pass finds how large it is by interpolation, a second one
 * looks at the peaks that come near to that. */
static strum_status largest(const survey *s, int mode, int component, double *best)
{
    double height = 0;
    const int n = s->points;
    *best = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < n; i++) {
            const double here = fabs(sampled(s, mode, component, i));
            /* no peak hides a tenth of its height between two samples */
            if (here < 0.9 * height ||
                (i > 0 && here <= fabs(sampled(s, mode, component, i - 1))) ||
                (i < n - 1 && here < fabs(sampled(s, mode, component, i + 1))))
                continue;
            const double t = top_of(s, mode, component, i);
            const double top = fabs(interpolated(s, mode, component, i, t));
            height = fmax(height, top);
            if (pass == 0 || top < height * (1 - 1e-6))
                continue;
            strum_inclined_point p;
            const double x = s->x[i] + t * (s->x[1] - s->x[0]);
            arena scratch = {.work = s->work};
            const strum_status status = s->m->model->evaluate(
                s->m, &(inclined_samples){mode, mode + 1, 1, &x, &p}, &scratch, s->work);
            arena_free(&scratch);
            if (status != STRUM_OK)
                return status;
            if (fabs(component_of(&p, component)) > fabs(*best) * (1 + 1e-9))
                *best = component_of(&p, component);
        }
    return STRUM_OK;
}

static strum_status measure_mode(const survey *s, const energies *e, int mode,
                                 strum_inclined_mode *out, double *unit)
{
    const strum_inclined *m = s->m;
    double peak[3];
    for (int component = TRANSVERSE; component <= TENSION; component++) {
        const strum_status status = largest(s, mode, component, &peak[component]);
        if (status != STRUM_OK)
            return status;
    }
    *unit = peak[fabs(peak[LONGITUDINAL]) > fabs(peak[TRANSVERSE]) ? LONGITUDINAL : TRANSVERSE];
    out->longitudinal_energy = e->longitudinal / (e->longitudinal + e->transverse);
    out->family = out->longitudinal_energy <= STRUM_HYBRID_SHARE       ? STRUM_TRANSVERSE
                  : out->longitudinal_energy >= 1 - STRUM_HYBRID_SHARE ? STRUM_LONGITUDINAL
                                                                       : STRUM_HYBRID;
    out->symmetric_share = out->symmetry == STRUM_SYMMETRIC ? 1
                           : out->symmetry == STRUM_ANTISYMMETRIC
                               ? 0
                               : 0.5 * (1 + e->mirrored / e->transverse);
    const double slope = m->cable.epsilon * cos(m->cable.inclination);
    out->tension_amplification = fabs(peak[TENSION]) * slope / fabs(peak[TRANSVERSE]);
    out->hybrid_region = fabs(out->kl * out->kl / m->cable.lambda_squared - 1) <
                         2 * m->cable.epsilon * sin(m->cable.inclination);
    return STRUM_OK;
}

strum_status inclined_measure(strum_inclined *m, work *w)
{
    arena scratch = {.work = w};
    survey s = {0};
    energies *e = arena_alloc(&scratch, (size_t)m->count, sizeof *e);
    strum_status status = e == NULL ? STRUM_ERR_MEMORY : find_energies(m, e, &scratch, w);
    if (status == STRUM_OK)
        status = survey_make(m, &scratch, w, &s);
    for (int i = 0; status == STRUM_OK && i < m->count; i++)
        status = measure_mode(&s, &e[i], i, &m->modes[i], &m->unit[i]);
    arena_free(&scratch);
    return status;
}
