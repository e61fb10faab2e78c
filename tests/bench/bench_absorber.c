/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The best hanging absorber over (k, R), all modes of a band, against the procedure of
 * Levesque's report refined to the same optimum: Muller's method (his MULLER and DFLATE) from
 * the undamped frequency of each mode, at every point of a grid of (k, R) that is narrowed
 * about its best point until the optimum is met to 1e-6, or given up. How often a root of his
 * is another mode's is counted (outside the time taken).
 */
#include <complex.h>
#include <math.h>
#include <stdbool.h>
#include <strum/strum.h>

#include "bench.h"

typedef double _Complex cplx;

/* The optimum (a double root, solved for in high precision), and when it is met. */
#define RIGHT      0.2330964385740096
#define SAME       1e-6
#define ROUNDS_MAX 20

static strum_status build(void *context, const double *values, strum_taut **chain,
                          strum_error *fault)
{
    (void)context;
    const strum_taut_component parts[] = {
        {.kind = STRUM_TAUT_CABLE,
         .tension_left = 5000,
         .tension_right = 5000,
         .cable = {25, 1, 0}},
        {.kind = STRUM_TAUT_HANGING, .hanging = {5, values[0], values[1]}},
        {.kind = STRUM_TAUT_CABLE,
         .tension_left = 5000,
         .tension_right = 5000,
         .cable = {25, 1, 0}},
    };
    return strum_taut_make(parts, 3, STRUM_TAUT_FIXED, STRUM_TAUT_FIXED, chain, fault);
}

static const double low[] = {1, 0.1}, high[] = {500, 200};
static double found, report_found;
static long ours, report_trials, calls, rounds, hopped, asked;

static void optimum(void *data)
{
    (void)data;
    const strum_absorber_params problem = {2, low, high, build, NULL, NULL,
                                           0, 0.5, 7,    20000, NULL};
    strum_absorber_optimum best;
    if (strum_absorber_solve(&problem, NULL, &best, NULL) != STRUM_OK)
        exit(1);
    found = best.loss_ratio;
    ours = best.evaluations;
}

/* ---- the report's procedure, written as it stands there (MULLER, DFLATE, STRING2) ---- */

static cplx times(cplx a, cplx b)
{
    return CMPLX(creal(a) * creal(b) - cimag(a) * cimag(b),
                 creal(a) * cimag(b) + cimag(a) * creal(b));
}

/* t12 of half the cable, the absorber, half the cable. */
static cplx t12(double k, double r, cplx w)
{
    const double length = 25, tension = 5000, mass = 5;
    const cplx q = w * sqrt(1 / tension), c = ccos(q * length), s = csin(q * length);
    const cplx force = times(w, w) * mass, g = k + I * r * w;
    const cplx kick = -times(force, g) / (g - force);
    /* (y, V) = (0, 1) through the three */
    const cplx y = s / (tension * q), v = c + times(kick, y);
    return times(c, y) + times(s / (tension * q), v);
}

static cplx deflated(double k, double r, cplx w, const cplx *known, int count, double *size)
{
    cplx f = t12(k, r, w);
    *size = cabs(f);
    for (int i = 0; i < count; i++)
        if (w != known[i])
            f /= w - known[i];
    calls++;
    return f;
}

static cplx muller(double k, double r, cplx guess, const cplx *known, int count)
{
    double size;
    cplx h = CMPLX(1e-5, 1e-5), before = -2 * h, w = guess;
    cplx f1 = deflated(k, r, guess + h, known, count, &size);
    cplx f2 = deflated(k, r, guess - h, known, count, &size);
    cplx f3 = deflated(k, r, guess, known, count, &size);
    cplx slope = (f2 - f1) / before;
    for (int n = 0; n < 500; n++) {
        const cplx now = (f3 - f2) / h, bend = (now - slope) / (h + before);
        const cplx c = now + times(h, bend), root = csqrt(times(c, c) - 4 * times(f3, bend));
        const cplx bottom = creal(c * conj(root)) < 0 ? c - root : c + root;
        before = h;
        slope = now;
        f2 = f3;
        h = -2 * f3 / bottom;
        if (!isfinite(cabs(h)))
            break;
        w += h;
        f3 = deflated(k, r, w, known, count, &size);
        while (cabs(f3) > 10 * cabs(f2) && cabs(h) > 1e-12 * cabs(w)) {
            h /= 2;
            w -= h;
            f3 = deflated(k, r, w, known, count, &size);
        }
        if (cabs(h) < 1e-12 * cabs(w) || size < 1e-20)
            break;
    }
    return w;
}

/* The two roots that he finds from the undamped frequencies, the first divided out for the
 * second; the smaller of their loss ratios. */
static double report_trial(double k, double r, const double *guesses, cplx *roots)
{
    double least = INFINITY;
    report_trials++;
    for (int i = 0; i < 2; i++) {
        roots[i] = muller(k, r, guesses[i], roots, i);
        const double loss = fabs(cimag(roots[i])) / fabs(creal(roots[i]));
        least = fmin(least, isfinite(loss) ? loss : 0);
    }
    return least;
}

static void undamped(double k, double *guesses)
{
    const double values[] = {k, 0};
    const long modes[] = {1, 2};
    strum_taut *chain;
    if (build(NULL, values, &chain, NULL) != STRUM_OK ||
        strum_taut_frequencies(chain, modes, 2, NULL, guesses, NULL) != STRUM_OK)
        exit(1);
    strum_taut_free(chain);
}

/* Is each of his roots that of the mode whose frequency it was started from? */
static void check(double k, double r, const cplx *roots)
{
    const double values[] = {k, r};
    const long modes[] = {1, 2};
    const strum_taut_query query = {.numbers = modes, .count = 2};
    strum_taut *chain;
    strum_taut_roots *right = NULL;
    if (build(NULL, values, &chain, NULL) != STRUM_OK ||
        strum_taut_solve(chain, &query, NULL, &right, NULL) != STRUM_OK)
        exit(1);
    for (long mode = 1; mode <= 2; mode++) {
        bool same = false;
        for (size_t i = 0; i < right->count; i++)
            same = same || (right->roots[i].mode == mode &&
                            cabs(CMPLX(right->roots[i].frequency, right->roots[i].decay) -
                                 roots[mode - 1]) < 1e-6 * cabs(roots[mode - 1]));
        for (size_t i = 0; i < right->overdamped_count; i++)
            same = same || fabs(right->overdamped[i].decay - cimag(roots[mode - 1])) < 1e-6;
        asked++;
        hopped += !same;
    }
    strum_taut_roots_free(right);
    strum_taut_free(chain);
}

static void report_grid(bool checking)
{
    enum { GRID = 31 };
    double from[2] = {log(low[0]), log(low[1])}, to[2] = {log(high[0]), log(high[1])};
    report_trials = calls = rounds = 0;
    report_found = 0;
    for (; rounds < ROUNDS_MAX && fabs(report_found / RIGHT - 1) > SAME; rounds++) {
        double best = -1, at[2] = {0, 0}, guesses[2];
        for (int i = 0; i < GRID; i++) {
            const double x = from[0] + (to[0] - from[0]) * i / (GRID - 1);
            undamped(exp(x), guesses);
            for (int j = 0; j < GRID; j++) {
                const double y = from[1] + (to[1] - from[1]) * j / (GRID - 1);
                cplx roots[2];
                const double value = report_trial(exp(x), exp(y), guesses, roots);
                if (checking)
                    check(exp(x), exp(y), roots);
                if (value > best &&
                    value < 1) { /* beyond 1 a root has run away from its branch */
                    best = value;
                    at[0] = x;
                    at[1] = y;
                }
            }
        }
        report_found = best;
        for (int i = 0; i < 2; i++) { /* three grid steps about the best */
            const double step = 3 * (to[i] - from[i]) / (GRID - 1);
            from[i] = at[i] - step;
            to[i] = at[i] + step;
        }
    }
}

static void report(void *data)
{
    (void)data;
    report_grid(false);
}

int main(void)
{
    const double us = bench_median_us(optimum, NULL, 7);
    const double his = bench_median_us(report, NULL, 3);
    printf(
        "# ours: loss ratio %.10f in %ld trials; the report's procedure: %.10f in %ld trials, "
        "%ld evaluations of t12, grid narrowed %ld times; right: %.10f\n",
        found, ours, report_found, report_trials, calls, rounds, RIGHT);
    report_grid(true);
    printf("# of %ld roots that it asked for, %ld were another mode's or none\n", asked,
           hopped);
    bench_time("absorber/best-k-and-R", us);
    bench_time("absorber/report-procedure-refined", his);
    bench_ratio("absorber/report-over-strum", his / us, "at-least", 10);
    return 0;
}
