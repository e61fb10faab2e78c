/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A second opinion on the modes of an inclined cable. */
#include <complex.h>
#include <math.h>

#include "core/inclined/inclined.h"
#include "core/suspended/strain.h"

/* Frequencies nearer than this are not told apart by a count between them. */
#define CLUSTER 1e-7
/* Modes beyond the last that are asked of the second method, to find a gap to count in. */
#define BEYOND 8
/* Most values of a characteristic function that a count may take: 200 modes take some 4000. */
#define EVALUATIONS 30000

/* Curvature squared over stiffness, in T_a and L, above which the second method loses more than
 * 1e-9: the strains of a cable that soft are a small difference of displacements. */
#define SOFTNESS_MAX 1e7

/* The number of modes, `count` or a few more, after which there is a gap: kl[n-1] << kl[n]. */
static int gap_after(const double *kl, int count)
{
    int n = count;
    while (n < count + BEYOND - 1 && kl[n] - kl[n - 1] < CLUSTER * kl[n])
        n++;
    return n;
}

/* What Galerkin's method leaves free and the exact solution has not: displacement at a support,
 * relative to the largest. */
static strum_status closure(const strum_inclined_modes *m, double *worst, arena *a)
{
    const double supports[] = {-1, 1};
    strum_inclined_point *p = arena_alloc(a, 2 * (size_t)m->count, sizeof *p);
    const strum_status status =
        p == NULL ? STRUM_ERR_MEMORY : inclined_sample(m, 0, m->count, 2, supports, p, a);
    for (int i = 0; status == STRUM_OK && i < 2 * m->count; i++)
        *worst = fmax(*worst,
                      hypot(p[i].transverse, p[i].longitudinal) / fabs(m->unit[i % m->count]));
    return status;
}

static strum_status verify_full(const strum_inclined_modes *m, strum_verification *v, arena *a)
{
    v->method = "strain and displacement Galerkin, modes counted by the phases of the transfer";
    const strum_cable cable = inclined_mechanics(&m->cable, &m->statics);
    const double unit = m->cable.epsilon / sqrt(cos(m->cable.inclination));
    root_list list = {0};
    double kl[STRUM_MODES_MAX + BEYOND];
    strum_status status = closure(m, &v->max_residual, a);
    if (status == STRUM_OK)
        status = strain_roots(&cable, &m->along, m->size + BEYOND, m->count + BEYOND, a, &list);
    if (status != STRUM_OK || list.count < m->count + BEYOND)
        return status != STRUM_OK ? status : STRUM_ERR_INTERNAL;
    for (int i = 0; i < list.count; i++)
        kl[i] = cimag(list.items[i].s) * unit;
    for (int i = 0; i < m->count; i++)
        v->max_relative_difference =
            fmax(v->max_relative_difference, fabs(kl[i] - m->modes[i].kl) / m->modes[i].kl);
    const int n = gap_after(kl, m->count);
    int counted;
    status = strum_modes_below(&cable, (kl[n - 1] + kl[n]) / 2 / unit, &counted, NULL);
    v->modes_expected = counted - (n - m->count);
    return status;
}

/* ---- approximations: the characteristic function itself ---- */

static double _Complex characteristic(const strum_inclined_modes *m, double _Complex kl)
{
    return m->model <= STRUM_INCLINED_AIRY_TANGENT ? inclined_airy_function(m, kl)
                                                   : inclined_closed_function(m, kl);
}

/* A path of the function's argument, in steps that turn it little. */
typedef struct contour {
    const strum_inclined_modes *m;
    double longest; /* step */
    int left;       /* evaluations, before it is given up */
} contour;

static double turning(contour *c, double _Complex a, double _Complex b)
{
    double sum = 0;
    double _Complex here = a, before = characteristic(c->m, a);
    double step = c->longest;
    for (; here != b && c->left > 0; c->left--) {
        const double rest = cabs(b - here);
        const double _Complex next = step >= rest ? b : here + step / rest * (b - here);
        const double _Complex now = characteristic(c->m, next);
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
static int zeros_inside(const strum_inclined_modes *m, double low, double high)
{
    const double unit = inclined_spacing(m), height = 0.3 * unit;
    contour c = {m, 0.25 * unit, EVALUATIONS};
    const double sum = turning(&c, high, CMPLX(high, height)) +
                       turning(&c, CMPLX(high, height), CMPLX(low, height)) +
                       turning(&c, CMPLX(low, height), low);
    return c.left > 0 ? (int)round(sum / M_PI) : -1;
}

/* From kl to the nearest zero, by the parabola through three points. */
static double distance(const strum_inclined_modes *m, double kl)
{
    const double h = 1e-3 * inclined_spacing(m), f = creal(characteristic(m, kl));
    const double after = creal(characteristic(m, kl + h));
    const double before = creal(characteristic(m, kl - h));
    const double slope = (after - before) / (2 * h), bend = (after - 2 * f + before) / (h * h);
    const double inside = slope * slope - 2 * f * bend;
    return inside < 0 ? sqrt(fabs(2 * f / bend)) : fabs(2 * f) / (fabs(slope) + sqrt(inside));
}

static strum_status verify_approximation(const strum_inclined_modes *m, strum_verification *v,
                                         arena *a)
{
    v->method = "zeros of the characteristic function counted by the argument principle";
    double kl[STRUM_MODES_MAX + BEYOND], spurious;
    inclined_wave *waves = arena_alloc(a, (size_t)m->count + BEYOND, sizeof *waves);
    const strum_status status = waves == NULL
                                    ? STRUM_ERR_MEMORY
                                    : inclined_roots(m, m->count + BEYOND, waves, &spurious);
    if (status != STRUM_OK)
        return status;
    for (int i = 0; i < m->count + BEYOND; i++)
        kl[i] = waves[i].kl;
    const int n = gap_after(kl, m->count);
    const int inside = zeros_inside(m, (spurious + kl[0]) / 2, (kl[n - 1] + kl[n]) / 2);
    if (inside < 0)
        return STRUM_ERR_ACCURACY;
    v->modes_expected = inside - (n - m->count);
    const double near = 0.1 * inclined_spacing(m);
    for (int i = 0; i < m->count; i++) {
        const double here = m->modes[i].kl;
        const double nearby =
            fmax(cabs(characteristic(m, here + near)), cabs(characteristic(m, here - near)));
        v->max_residual = fmax(v->max_residual, cabs(characteristic(m, here)) / nearby);
        v->max_relative_difference = fmax(v->max_relative_difference, distance(m, here) / here);
        /* twice the same zero is one, unless it is a double one: flat */
        const bool flat = cabs(characteristic(m, here + near / 100)) < 1e-3 * nearby;
        v->modes_found -= i > 0 && here - m->modes[i - 1].kl < 1e-9 * here && !flat;
    }
    return STRUM_OK;
}

strum_status strum_inclined_verify(const strum_inclined_modes *m, strum_verification *v,
                                   strum_error *fault)
{
    *v = (strum_verification){.modes_found = m->count};
    arena a = {0};
    const double curvature = fmin(m->cable.epsilon, 1) * cos(m->cable.inclination);
    if (m->model == STRUM_INCLINED_FULL &&
        curvature * curvature > SOFTNESS_MAX * m->statics.stiffness)
        return error_set(fault, STRUM_ERR_METHOD,
                         "the second method does not reach a cable that its tension "
                         "stretches %.1g times: it is answered without verify only",
                         1 / m->statics.stiffness);
    const strum_status status = m->model == STRUM_INCLINED_FULL
                                    ? verify_full(m, v, &a)
                                    : verify_approximation(m, v, &a);
    arena_free(&a);
    return status == STRUM_OK ? status
                              : error_set(fault, status, "%s", strum_status_text(status));
}
