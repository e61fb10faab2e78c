/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Branches: a root followed from zero damping while `factor`, which multiplies every damping,
 * grows. ds/dfactor = -F_factor/F_s predicts, Newton's method corrects; a step never exceeds
 * half the distance to the nearest other root (from F''), so that roots which pass each other
 * closely are told apart. Where a root meets its conjugate on the real axis, the sum and the
 * product of the pair still are smooth in the damping: they carry the branch across, to two
 * overdamped roots or back.
 */
#include "core/taut/taut.h"

#include <float.h>

/* Spacings of modes beyond which a root on the real axis is given up. */
#define ESCAPED 1e5
/* Steps of one branch (some dozens are usual). */
#define STEPS_MAX 1000

static taut_value value_at(taut_search *search, dual s, dual factor)
{
    const taut_at at = {s, factor};
    taut_value value;
    taut_characteristic(search->chain, &at, &value);
    if ((++search->evaluations & 63) == 0) {
        const strum_status status =
            work_spend(&search->work, 64 * 0.1 * (double)search->chain->count);
        if (status != STRUM_OK)
            search->status = status;
    }
    if ((double)search->evaluations * (double)search->chain->count > STRUM_TAUT_WORK_MAX)
        search->status = STRUM_ERR_ACCURACY;
    return value;
}

taut_value taut_search_at(taut_search *search, cplx s, double factor)
{
    return value_at(search, (dual){s, 1.0}, dual_of(factor));
}

taut_value taut_search_value(taut_search *search, cplx s)
{
    return value_at(search, (dual){s, 1.0}, dual_of(1.0));
}

double taut_noise(taut_search *search, cplx s, double factor)
{
    static const double turns[4] = {3.0, 5.0, -4.0, -7.0};
    const taut_value here = taut_search_at(search, s, factor);
    double most = here.f == 0.0 ? INFINITY : 0.0;
    for (int k = 0; k < 4 && most < INFINITY; k++) {
        const cplx by = times(turns[k] * DBL_EPSILON * s, k & 1 ? CMPLX(0.8, 0.6) : 1.0);
        const cplx there = s + by;
        const taut_value v = taut_search_at(search, there, factor);
        const cplx smooth = here.f + times(here.d, there - s);
        const cplx off = v.f * exp(v.log_scale - here.log_scale) - smooth;
        most = fmax(most, cabs(off) / cabs(here.f));
    }
    return most;
}

/* Far from the imaginary axis F grows like e^{-travel s}, whose slope misleads; times e^{c s},
 * which has no zeros, it does not. */
static double growth(const taut_search *search, cplx s)
{
    const double travel = search->chain->travel;
    return creal(s) < 0.0 ? -travel * expm1(2.0 * travel * creal(s)) : 0.0;
}

/* Newton's method. The first correction may not exceed `reach`, the others must shrink well
 * (INFINITY: no such conditions). At a double root the digits end at half their number. */
static bool newton(taut_search *search, cplx *s, double factor, double reach)
{
    const double c = growth(search, *s);
    double last = INFINITY, first = 0.0;
    for (int n = 0; n < 60 && search->status == STRUM_OK; n++) {
        const taut_value f = value_at(search, (dual){*s, 1.0}, dual_of(factor));
        if (f.f == 0.0)
            return true;
        if (f.d == 0.0)
            return false;
        const cplx step = over(f.f, f.d + c * f.f);
        const double size = cabs(step), scale = cabs(*s) + 1e-3 * search->spacing;
        if (!isfinite(size))
            return false;
        if (n == 0)
            first = size;
        if (isfinite(reach) &&
            (size > reach || (n > 0 && size > 0.3 * first && size > 1e-9 * scale)))
            return false;
        *s -= step;
        if (size <= 4.0 * DBL_EPSILON * scale || (size >= 0.5 * last && size <= 1e-10 * scale))
            return true;
        last = size;
    }
    return last <= 1e-6 * (cabs(*s) + 1e-3 * search->spacing);
}

bool taut_newton(taut_search *search, cplx *s)
{
    return newton(search, s, 1.0, INFINITY);
}

/* About a root F = F_s d + F'' d^2/2, which has its next zero at d = -2 F_s/F''. */
cplx taut_speed(taut_search *search, cplx s, double factor, double *nearest)
{
    const double probe = 1e-5 * search->spacing;
    const taut_value along = value_at(search, (dual){s, 1.0}, dual_of(factor));
    const taut_value turned = value_at(search, (dual){s, 0.0}, (dual){factor, 1.0});
    const taut_value beside = value_at(search, (dual){s + probe, 1.0}, dual_of(factor));
    const cplx second = (beside.d * exp(beside.log_scale - along.log_scale) - along.d) / probe +
                        2.0 * growth(search, s) * along.d;
    const double bend = cabs(second);
    *nearest = bend > 0.0 ? 2.0 * cabs(along.d) / bend : INFINITY;
    return -over(turned.d, along.d);
}

/* Two roots by sum and product: s^2 + p s + q, and the speeds of p and q. */
typedef struct quadratic {
    double p, q, dp, dq;
} quadratic;

/* Over the point where disc = p^2/4 - q changes sign, to as far behind it. False when the two
 * do not meet before `end`, or not that simply. */
static bool cross(taut_search *search, taut_branch *branch, quadratic k, double end)
{
    const double disc = 0.25 * k.p * k.p - k.q, rate = 0.5 * k.p * k.dp - k.dq;
    const double to_meeting = -disc / rate;
    if (!(disc * rate < 0.0) || branch->factor + to_meeting > end)
        return false;
    const double factor = fmin(branch->factor + 2.0 * to_meeting, end);
    const double ahead = factor - branch->factor;
    const double half = -0.5 * (k.p + k.dp * ahead), turned = disc + rate * ahead;
    const double apart = sqrt(fabs(turned));
    if (turned < 0.0) { /* two real roots become a pair */
        cplx s = CMPLX(half, apart);
        if (!newton(search, &s, factor, 0.5 * apart) || !(cimag(s) > 0.2 * apart))
            return false;
        *branch = (taut_branch){branch->mode, factor, TAUT_OSCILLATES, {s, conj(s)}, false};
        return true;
    }
    cplx slow = half + apart, fast = half - apart;
    if (!newton(search, &slow, factor, 0.5 * apart) ||
        !newton(search, &fast, factor, 0.5 * apart) ||
        !(creal(slow) - creal(fast) > 0.4 * apart))
        return false;
    *branch = (taut_branch){branch->mode, factor, TAUT_OVERDAMPED, {slow, fast}, false};
    return true;
}

/* One step of all roots of a branch (one, or two real ones), as long as the tests allow. */
static bool step(taut_search *search, taut_branch *branch, const cplx *speeds,
                 const double *reaches, double end)
{
    const int roots = branch->state == TAUT_OVERDAMPED && isfinite(creal(branch->s[1])) ? 2 : 1;
    double h = end - branch->factor;
    for (int k = 0; k < roots; k++)
        h = fmin(h, reaches[k] / (cabs(speeds[k]) + 1e-300));
    for (; h > 1e-11 * (branch->factor + h) && search->status == STRUM_OK; h *= 0.5) {
        const double factor = h >= end - branch->factor ? end : branch->factor + h;
        cplx s[2] = {branch->s[0], branch->s[1]};
        bool good = true;
        for (int k = 0; k < roots && good; k++) {
            const double move = cabs(speeds[k]) * h;
            s[k] += h * speeds[k];
            good = newton(search, &s[k], factor,
                          fmin(0.25 * move, 0.25 * reaches[k]) + 0.02 * reaches[k]);
        }
        if (good && branch->state == TAUT_OSCILLATES)
            good = cimag(s[0]) > 0.0;
        if (good && roots == 2)
            good = creal(s[0]) > creal(s[1]);
        if (!good)
            continue;
        branch->s[0] = s[0];
        branch->s[1] = s[1];
        branch->factor = factor;
        return true;
    }
    return false;
}

void taut_branch_start(taut_branch *branch, long mode, double w)
{
    *branch = (taut_branch){mode, 0.0, TAUT_OSCILLATES, {CMPLX(0.0, w), CMPLX(0.0, -w)}, false};
    if (w == 0.0)
        branch->state = TAUT_LOST; /* a rigid motion: a double root at 0 */
}

void taut_branch_follow(taut_search *search, taut_branch *branch, double gap, double factor,
                        double reach)
{
    const int steps = search->steps_max > 0 ? search->steps_max : STEPS_MAX;
    for (int n = 0; branch->factor < factor && branch->state != TAUT_LOST; n++) {
        cplx *s = branch->s, speeds[2] = {0.0, 0.0};
        double reaches[2] = {0.0, 0.0};
        quadratic k = {0};
        bool near_axis;
        speeds[0] = taut_speed(search, s[0], branch->factor, &reaches[0]);
        if (branch->state == TAUT_OSCILLATES) {
            reaches[0] = fmin(reaches[0], gap);
            near_axis = cimag(s[0]) < 0.3 * cabs(s[0]);
            k = (quadratic){-2.0 * creal(s[0]), creal(s[0] * conj(s[0])),
                            -2.0 * creal(speeds[0]), 2.0 * creal(conj(s[0]) * speeds[0])};
        } else {
            /* where a damper matches the cable a root passes through infinity */
            if (creal(s[1]) < -ESCAPED * search->spacing)
                s[1] = -INFINITY;
            if (isfinite(creal(s[1])))
                speeds[1] = taut_speed(search, s[1], branch->factor, &reaches[1]);
            near_axis = creal(s[0]) - creal(s[1]) < 0.3 * cabs(s[0]);
            /* far down the axis F'' tells of all roots together, of no single one */
            for (int i = 0; i < 2; i++)
                reaches[i] = fmin(cabs(s[i]), creal(s[0]) - creal(s[1]));
            k = (quadratic){-creal(s[0] + s[1]), creal(s[0] * s[1]),
                            -creal(speeds[0] + speeds[1]),
                            creal(speeds[0] * s[1] + s[0] * speeds[1])};
        }
        if (near_axis && cross(search, branch, k, factor))
            continue;
        reaches[0] *= 0.5 * reach;
        reaches[1] *= 0.5 * reach;
        if (n > steps || search->status != STRUM_OK ||
            !step(search, branch, speeds, reaches, factor)) {
            branch->state = TAUT_LOST;
            branch->meets = !(reaches[0] > 1e-3 * search->spacing);
        }
    }
}

strum_status strum_taut_follow(const strum_taut *chain, long mode, const double *factors,
                               size_t count, const strum_options *options,
                               strum_taut_root *roots, strum_error *error)
{
    const long numbers[3] = {mode - 1, mode, mode + 1};
    double w[3] = {0.0, 0.0, INFINITY};
    const int from = mode <= 1;
    taut_search search = {.chain = chain, .work = work_begin(options)};
    strum_status status = taut_frequencies(chain, numbers + from, 2 - (size_t)from,
                                           &search.work, w + from, error);
    if (status != STRUM_OK)
        return status;
    if (taut_frequencies(chain, numbers + 2, 1, &search.work, w + 2, NULL) != STRUM_OK)
        w[2] = INFINITY; /* the last one that the chain has */
    search.spacing = taut_spacing(chain);
    const double gap = fmin(search.spacing, fmin(w[1] - w[0], w[2] - w[1]));
    taut_branch branch;
    taut_branch_start(&branch, mode, w[1]);
    for (size_t i = 0; i < count; i++) {
        if (!(factors[i] >= branch.factor))
            return error_set(error, STRUM_ERR_RANGE, "factors of the damping must ascend");
        taut_branch_follow(&search, &branch, fmax(gap, 0.2 * search.spacing), factors[i], 1.0);
        if (search.work.status != STRUM_OK)
            return work_error(&search.work, error);
        if (branch.state == TAUT_LOST)
            return error_set(error, STRUM_ERR_ACCURACY,
                             "mode %ld cannot be followed beyond %.6g times the damping", mode,
                             branch.factor);
        roots[i] =
            (strum_taut_root){mode, cimag(branch.s[0]), -creal(branch.s[0]), INFINITY, 0.0};
    }
    return STRUM_OK;
}
