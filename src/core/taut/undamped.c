/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Undamped frequencies: intervals are cut by the mode count until each holds one mode, then the
 * entire characteristic function, which changes sign there exactly once, is solved by inverse
 * interpolation. Shots are shared between neighbouring modes.
 */
#include "core/taut/taut.h"

#include <float.h>

typedef struct cut {
    const strum_taut *chain;
    const long *numbers;
    double *frequencies;
    work *work;
} cut;

/* Zero of the inverse cubic through both ends of the bracket with both slopes; NaN when the
 * values differ too much for it to mean anything. */
static double interpolate(const taut_shot *a, const taut_shot *b)
{
    const long shift = b->exponent - a->exponent;
    if (shift < -60 || shift > 60)
        return NAN;
    const double scale = ldexp(1.0, (int)shift), fb = b->f * scale, gb = b->df * scale;
    const double slope = (b->w - a->w) / (fb - a->f);
    const double c0 = (slope - 1.0 / a->df) / (fb - a->f),
                 c1 = (1.0 / gb - slope) / (fb - a->f);
    return a->w - a->f / a->df + a->f * a->f * (c0 - fb * (c1 - c0) / (fb - a->f));
}

/* A shot, counted as work; false when no more is allowed. */
static bool shoot(const cut *c, double w, taut_shot *shot)
{
    if (work_spend(c->work, taut_shot_us(c->chain)) != STRUM_OK)
        return false;
    taut_shoot(c->chain, w, shot);
    return true;
}

/* The one mode between two shots. Stops when the next Newton step's error, at most its square
 * over the distance to the next mode, is below rounding. */
static double refine(const cut *c, taut_shot lo, taut_shot hi)
{
    const double first = lo.w, last = hi.w;
    const long number = hi.count;
    bool halve = lo.w == 0.0;
    while (hi.w - lo.w > 2.0 * DBL_EPSILON * hi.w) {
        double w = halve ? NAN : interpolate(&lo, &hi);
        if (!(w > lo.w && w < hi.w))
            w = lo.w + 0.5 * (hi.w - lo.w);
        taut_shot shot;
        if (!shoot(c, w, &shot))
            break;
        const double step = shot.f / shot.df, near = fmin(w - first, last - w);
        /* a neighbour may lie on either end, up to rounding: there only the count decides */
        if (near > 1e-10 * w && fabs(step) <= fmax(1e-8 * near, DBL_EPSILON * w) &&
            w - step >= lo.w && w - step <= hi.w)
            return w - step;
        const double width = hi.w - lo.w;
        if (shot.count < number)
            lo = shot;
        else
            hi = shot;
        halve = lo.w == 0.0 || hi.w - lo.w > 0.5 * width;
    }
    return lo.w + 0.5 * (hi.w - lo.w);
}

/* Numbers first..last - 1 of the cut lie between two shots: lo.count < number <= hi.count. */
static void cut_between(const cut *c, const taut_shot *lo, const taut_shot *hi, size_t first,
                        size_t last, bool halve)
{
    if (first == last)
        return;
    if (hi->count - lo->count == 1) {
        c->frequencies[first] = refine(c, *lo, *hi);
        return;
    }
    const double width = hi->w - lo->w;
    if (width <= 2.0 * DBL_EPSILON * hi->w) { /* a multiple mode */
        for (size_t i = first; i < last; i++)
            c->frequencies[i] = lo->w + 0.5 * width;
        return;
    }
    /* Where the count would be if it were even, next to the middle one of the numbers wanted;
     * by turns halved, so that clusters cost no more than their depth. */
    const double share = ((double)(c->numbers[first + (last - first) / 2] - lo->count) - 0.5) /
                         (double)(hi->count - lo->count);
    const double w =
        lo->w + width * (halve || last - first > 1 ? 0.5 : fmin(fmax(share, 0.02), 0.98));
    taut_shot middle;
    if (!shoot(c, w, &middle))
        return;
    if (middle.count < lo->count) /* roundings within one step of the grid */
        middle.count = lo->count;
    if (middle.count > hi->count)
        middle.count = hi->count;
    size_t split = first;
    while (split < last && c->numbers[split] <= middle.count)
        split++;
    cut_between(c, lo, &middle, first, split, !halve);
    cut_between(c, &middle, hi, split, last, !halve);
}

/* A frequency above mode `number`; false when the chain has no such mode. */
static bool bracket(const cut *c, long number, taut_shot *hi)
{
    const strum_taut *chain = c->chain;
    /* no multiple of pi, where modes of plain cables are */
    double w = chain->travel > 0.0 ? ((double)number + 0.7) * M_PI / chain->travel : 1.0;
    for (int i = 0; i < 100; i++, w *= 2.0) {
        if (!shoot(c, w, hi))
            return false;
        if (hi->count >= number)
            return true;
        if (chain->travel > 0.0 && i > 60)
            break;
    }
    return false;
}

strum_status taut_frequencies(const strum_taut *chain, const long *numbers, size_t count,
                              work *spent, double *frequencies, strum_error *error)
{
    for (size_t i = 0; i < count; i++)
        if (numbers[i] < 1 || numbers[i] > STRUM_TAUT_MODE_MAX ||
            (i > 0 && numbers[i] <= numbers[i - 1]))
            return error_set(error, STRUM_ERR_RANGE,
                             "mode numbers must ascend and lie within 1 and %d",
                             STRUM_TAUT_MODE_MAX);
    if (!chain->moves)
        return error_set(error, STRUM_ERR_IMPOSSIBLE,
                         "a chain that moves needs a cable or a body with a length");
    if (count == 0)
        return STRUM_OK;
    taut_shot lo, hi = {.count = 0};
    const cut c = {chain, numbers, frequencies, spent};
    if (!bracket(&c, numbers[count - 1], &hi))
        return spent != NULL && spent->status != STRUM_OK
                   ? work_error(spent, error)
                   : error_set(error, STRUM_ERR_IMPOSSIBLE, "the chain has only %ld modes",
                               hi.count);
    /* Below every elastic mode: what counts there are rigid motions. */
    taut_shoot(chain, 1e-60 * hi.w, &lo);
    if (!isfinite(hi.f) || !isfinite(hi.df) || !isfinite(lo.f))
        return error_set(error, STRUM_ERR_ACCURACY,
                         "the components differ by more than doubles resolve");
    lo.w = 0.0;
    size_t first = 0;
    while (first < count && numbers[first] <= lo.count)
        frequencies[first++] = 0.0;
    cut_between(&c, &lo, &hi, first, count, false);
    return spent != NULL && spent->status != STRUM_OK ? work_error(spent, error) : STRUM_OK;
}

strum_status strum_taut_frequencies(const strum_taut *chain, const long *numbers, size_t count,
                                    const strum_options *options, double *frequencies,
                                    strum_error *error)
{
    work spent = work_begin(options);
    return taut_frequencies(chain, numbers, count, &spent, frequencies, error);
}

double taut_spacing(const strum_taut *chain)
{
    if (chain->travel > 0.0)
        return M_PI / chain->travel;
    const long first = 1; /* bodies alone: their lowest mode */
    double w;
    return taut_frequencies(chain, &first, 1, NULL, &w, NULL) == STRUM_OK && w > 0.0 ? w : 1.0;
}
