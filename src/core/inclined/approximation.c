/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Models with a characteristic equation: its roots are the modes, and the argument principle
 * says how many there are. */
#include "core/inclined/approximation.h"

#include <complex.h>
#include <math.h>

#include "core/inclined/cluster.h"
#include "core/inclined/statics.h"
#include "core/numerics/status.h"
#include "core/suspended/modes.h"

/* Limit of the evaluations of a characteristic function in a count: 200 modes take some 4000. */
#define EVALUATIONS 30000

strum_status approximation_solve(strum_inclined *m, work *w, strum_error *error)
{
    const strum_cable cable = inclined_mechanics(&m->cable, &m->statics);
    m->along = mapping_linear(&cable);
    m->size =
        (int)(1.35 * spectrum_first_size(&cable, &m->along, STRUM_IN_PLANE, m->count)) + 8;
    m->waves = arena_alloc(&m->memory, (size_t)m->count, sizeof *m->waves);
    strum_status status = m->waves == NULL ? STRUM_ERR_MEMORY
                                           : legendre_make(1, M_PI_2 / m->statics.profile.mu,
                                                           false, &m->memory, &m->rule);
    if (status != STRUM_OK)
        return error_set(error, status, "%s", strum_status_text(status));
    status = m->model->roots(m, m->count, m->waves, &m->spurious, w);
    if (status != STRUM_OK)
        return error_set(error, status,
                         "the characteristic equation of this model has not the "
                         "roots it should have for this cable");
    for (int i = 0; i < m->count; i++)
        m->modes[i] = (strum_inclined_mode){
            .kl = m->waves[i].kl,
            .symmetry = m->cable.inclination == 0 ? m->waves[i].symmetry : STRUM_NO_SYMMETRY};
    return STRUM_OK;
}

strum_status approximation_evaluate(const strum_inclined *m, const inclined_samples *at,
                                    arena *scratch, work *w)
{
    (void)scratch;
    const int modes = at->last - at->first;
    for (int i = 0; i < at->points; i++) {
        const strum_status status = work_spend(w, 0);
        if (status != STRUM_OK)
            return status;
        const double s = inclined_s_of_x(m, at->x[i]);
        const double phase = m->model->wants_phase
                                 ? inclined_phase(&m->cable, &m->statics.profile, &m->rule,
                                                  mapping_offset(&m->along, at->x[i]))
                                 : 0;
        for (int mode = at->first; mode < at->last; mode++) {
            strum_inclined_point *out = &at->out[i * modes + mode - at->first];
            out->s = s;
            m->model->sample(m, &m->waves[mode], at->x[i], phase, out);
        }
    }
    return STRUM_OK;
}

/* ---- the second method ---- */

/* A path of the function's argument, in steps that turn it little. */
typedef struct contour {
    const strum_inclined *m;
    work *work;
    double evaluation_us;
    double longest; /* step */
    int left;       /* evaluations, before it is given up; 0 too once the work is to end */
} contour;

static double turning(contour *c, double _Complex a, double _Complex b)
{
    double sum = 0;
    double _Complex here = a, before = c->m->model->function(c->m, a);
    double step = c->longest;
    for (; here != b && c->left > 0; c->left--) {
        if (work_spend(c->work, c->evaluation_us) != STRUM_OK) {
            c->left = 0;
            break;
        }
        const double rest = cabs(b - here);
        const double _Complex next = step >= rest ? b : here + step / rest * (b - here);
        const double _Complex now = c->m->model->function(c->m, next);
        const double turned = carg(now / before);
        if (fabs(turned) > 0.5 && step > 1e-8 * c->longest) {
            step /= 2;
            continue;
        }
        sum += turned;
        here = next;
        before = now;
        step = fmin(2 * step, c->longest);
    }
    return sum;
}

/* Zeros with low < Re < high near the real axis, where the function is real: the lower half of
 * the contour turns it as the upper half does. -1: they cannot be counted. */
static int zeros_inside(const strum_inclined *m, double low, double high, work *w)
{
    const double unit = inclined_spacing(m), height = 0.3 * unit;
    /* a root and its shape take some fifty evaluations */
    contour c = {m, w, m->model->work_us(NULL, 1, m->size) / 50, 0.25 * unit, EVALUATIONS};
    const double sum = turning(&c, high, CMPLX(high, height)) +
                       turning(&c, CMPLX(high, height), CMPLX(low, height)) +
                       turning(&c, CMPLX(low, height), low);
    return c.left > 0 ? (int)round(sum / M_PI) : -1;
}

/* From kl to the nearest zero, by the parabola through three points. */
static double distance(const strum_inclined *m, double kl)
{
    const double h = 1e-3 * inclined_spacing(m), f = creal(m->model->function(m, kl));
    const double after = creal(m->model->function(m, kl + h));
    const double before = creal(m->model->function(m, kl - h));
    const double slope = (after - before) / (2 * h), bend = (after - 2 * f + before) / (h * h);
    const double inside = slope * slope - 2 * f * bend;
    return inside < 0 ? sqrt(fabs(2 * f / bend)) : fabs(2 * f) / (fabs(slope) + sqrt(inside));
}

static strum_status count_zeros(const strum_inclined *m, strum_verification *v, arena *a,
                                work *w)
{
    v->method = "zeros of the characteristic function counted by the argument principle";
    double kl[STRUM_MODES_MAX + BEYOND], spurious;
    inclined_wave *waves = arena_alloc(a, (size_t)m->count + BEYOND, sizeof *waves);
    const strum_status status =
        waves == NULL ? STRUM_ERR_MEMORY
                      : m->model->roots(m, m->count + BEYOND, waves, &spurious, w);
    if (status != STRUM_OK)
        return status;
    for (int i = 0; i < m->count + BEYOND; i++)
        kl[i] = waves[i].kl;
    const int n = gap_after(kl, m->count);
    const int inside = zeros_inside(m, (spurious + kl[0]) / 2, (kl[n - 1] + kl[n]) / 2, w);
    if (inside < 0)
        return w->status != STRUM_OK ? w->status : STRUM_ERR_ACCURACY;
    v->modes_expected = inside - (n - m->count);
    const double near = 0.1 * inclined_spacing(m);
    for (int i = 0; i < m->count && work_spend(w, 0) == STRUM_OK; i++) {
        const double here = m->modes[i].kl;
        const double nearby = fmax(cabs(m->model->function(m, here + near)),
                                   cabs(m->model->function(m, here - near)));
        v->max_residual = fmax(v->max_residual, cabs(m->model->function(m, here)) / nearby);
        v->max_relative_difference = fmax(v->max_relative_difference, distance(m, here) / here);
        /* twice the same zero is one, unless it is a double one: flat */
        const bool flat = cabs(m->model->function(m, here + near / 100)) < 1e-3 * nearby;
        v->modes_found -= i > 0 && here - m->modes[i - 1].kl < 1e-9 * here && !flat;
    }
    return w->status;
}

strum_status approximation_verify(const strum_inclined *m, strum_verification *v, arena *a,
                                  work *w, strum_error *error)
{
    const strum_status status = count_zeros(m, v, a, w);
    return status == STRUM_OK ? status
                              : error_set(error, status, "%s", strum_status_text(status));
}
