/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Profile intervals: where chi^2, with one quantity held and all others fitted anew, has risen by
 * the square of a quantile. Its root, sqrt(chi^2 - minimum), is nearly a straight line in ln T, so
 * that false position takes few steps. */
#include "core/identify/problem.h"

#include "core/numerics/bracket.h"

#define STRETCHES_MAX 14
#define STEPS_MAX     40
#define FIRST_MAX     0.3 /* where the linear guess is far too wide, as with bounds */
/* Beyond, the tension is no more than 1e-4 of what bending does. */
#define U_FREE 100.0
/* Beyond, the ends are no thin layers: bending tells the fixity. */
#define U_LAYERS 0.1
#define CLOSE    1e-9

typedef struct profile {
    problem held;
    fit last, other; /* the nearest fit so far, to begin from */
    double lowest, rise, scale;
    int which;
} profile;

/* The coordinate along which the profile is straight: ln, the fixity itself, sqrt EI. */
static double value_of(const profile *f, double x)
{
    return f->which == FIXITY ? x : f->which == BENDING ? x * x * f->scale : exp(x);
}

/* Chi^2 has one valley for each side of the fixity's range where bending says little: the nearest
 * fit follows one, another begins from the other side. */
static strum_status other_side(profile *f)
{
    if (!f->held.unknown[FIXITY] || f->last.at.u > U_LAYERS)
        return STRUM_OK;
    fit_start(&f->other, &f->last);
    f->other.at.q[FIXITY] = f->last.at.q[FIXITY] < 0.5 ? 0.75 : 0.25;
    const strum_status status = fit_chi2(&f->held, &f->other);
    if (status == STRUM_OK && f->other.chi2 < f->last.chi2)
        fit_start(&f->last, &f->other);
    return status == STRUM_ERR_ACCURACY ? STRUM_OK : status;
}

/* sqrt(chi^2 - minimum) less the quantile. */
static strum_status height(profile *f, double x, double *h)
{
    f->held.value[f->which] = value_of(f, x);
    strum_status status = fit_chi2(&f->held, &f->last);
    if (status == STRUM_OK)
        status = other_side(f);
    *h = sqrt(fmax(0, f->last.chi2 - f->lowest)) - sqrt(f->rise);
    return status;
}

static double clip(const profile *f, double x)
{
    return f->which == FIXITY ? fmin(fmax(x, 0), 1) : f->which == BENDING ? fmax(x, 0) : x;
}

static strum_status refine(profile *f, double inner, double h_inner, double outer,
                           double h_outer, double *end)
{
    bracket_ends b = {inner, outer, h_inner, h_outer, 0};
    double x = outer;
    strum_status status = STRUM_OK;
    for (int i = 0; i < STEPS_MAX && status == STRUM_OK; i++) {
        const double next = b.high - b.f_high * (b.high - b.low) / (b.f_high - b.f_low);
        double h = 0;
        if (!isfinite(next) || fabs(next - x) < CLOSE * fmax(1, fabs(next)))
            break;
        x = next;
        status = height(f, x, &h);
        if (fabs(h) < CLOSE)
            break;
        bracket_take(&b, x, h);
    }
    *end = value_of(f, x);
    return status;
}

/* One side: steps of `step` outward until chi^2 has risen enough. */
static strum_status find_end(profile *f, double from, double step, double *end)
{
    double inner = from, h_inner = sqrt(fmax(0, f->last.chi2 - f->lowest)) - sqrt(f->rise);
    for (int i = 0; i < STRETCHES_MAX; i++, step *= 1.8) {
        const double outer = clip(f, inner + step);
        double h = 0;
        const strum_status status = height(f, outer, &h);
        if (status == STRUM_ERR_ACCURACY)
            return STRUM_OK;
        if (status != STRUM_OK)
            return status;
        if (h > 0)
            return refine(f, inner, h_inner, outer, h, end);
        if (clip(f, outer + step) == outer || outer == inner) { /* at a bound */
            *end = value_of(f, outer);
            return STRUM_OK;
        }
        if (f->which == TENSION && f->last.at.u > U_FREE) {
            *end = 0; /* bending alone fits too */
            return STRUM_OK;
        }
        if (fabs(outer - from) > 20 && f->which != BENDING)
            return STRUM_OK; /* no end on this side */
        inner = outer;
        h_inner = h;
    }
    return STRUM_OK;
}

strum_status profile_interval(const problem *p, const fit *best, int which, double lowest,
                              double rise, double start, double *low, double *high)
{
    profile f = {.held = *p, .lowest = lowest, .rise = rise, .which = which};
    const double value = best->at.q[which];
    f.held.unknown[which] = false;
    f.scale = value > 0 ? value : best->at.q[TENSION] * best->at.q[LENGTH] * best->at.q[LENGTH];
    const double from = which == FIXITY    ? value
                        : which == BENDING ? sqrt(value / f.scale)
                                           : log(value);
    /* of EI: d sqrt = d ln/2 */
    double step = which == BENDING ? (value > 0 ? fmin(0.5 * start, 1) : 1e-3) : start;
    if (which == FIXITY)
        step = fmin(step, 0.5);
    step = isfinite(step) && step > 0 ? fmin(step, FIRST_MAX) : 0.05;
    strum_status status = STRUM_OK;
    *low = *high = NAN;
    for (int side = -1; side <= 1 && status == STRUM_OK; side += 2) {
        fit_start(&f.last, best);
        status = find_end(&f, from, side * step, side < 0 ? low : high);
    }
    return status;
}
