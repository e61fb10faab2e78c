/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The best hanging absorber over (k, R), all modes of a band, against the procedure of
 * Levesque's report refined to the same optimum: Muller's method from a fixed guess for each
 * mode, at every point of a grid of (k, R) that is narrowed about its best point until the
 * optimum is met to 1e-4. How often his roots are another mode's is counted.
 */
#include <gsl/gsl_errno.h>
#include <math.h>
#include <strum/strum.h>

#include "bench.h"

static strum_status build(void *context, const double *values, strum_taut **chain,
                          strum_fault *fault)
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
static long ours, report_trials, hopped, asked;

static void optimum(void *data)
{
    (void)data;
    const strum_absorber_problem problem = {2, low, high, build, NULL, NULL,
                                            0, 0.5, 7,    20000, NULL};
    strum_absorber_optimum best;
    if (strum_absorber_optimize(&problem, &best, NULL) != STRUM_OK)
        exit(1);
    found = best.loss_ratio;
    ours = best.evaluations;
}

/* The smaller loss ratio of the two modes as the report finds them. */
static double report_trial(double k, double r)
{
    const double values[] = {k, r};
    const long modes[] = {1, 2};
    const strum_taut_query query = {.numbers = modes, .count = 2, .method = STRUM_TAUT_MULLER};
    strum_taut *chain;
    strum_taut_roots *roots = NULL;
    double least = 0;
    report_trials++;
    if (build(NULL, values, &chain, NULL) != STRUM_OK)
        exit(1);
    if (strum_taut_solve(chain, &query, &roots, NULL) == STRUM_OK) {
        asked += 2;
        hopped += roots->hopped + roots->missed;
        least = INFINITY;
        for (size_t i = 0; i < roots->count; i++)
            least = fmin(least, roots->roots[i].decay / roots->roots[i].frequency);
        if (roots->count < 2 || !isfinite(least))
            least = 0;
    }
    strum_taut_roots_free(&roots);
    strum_taut_free(&chain);
    return least;
}

static void report(void *data)
{
    (void)data;
    enum { GRID = 31 };
    double from[2] = {log(low[0]), log(low[1])}, to[2] = {log(high[0]), log(high[1])};
    report_trials = hopped = asked = 0;
    for (int round = 0; round < 8; round++) {
        double best = -1, at[2] = {0, 0};
        for (int i = 0; i < GRID; i++)
            for (int j = 0; j < GRID; j++) {
                const double x = from[0] + (to[0] - from[0]) * i / (GRID - 1);
                const double y = from[1] + (to[1] - from[1]) * j / (GRID - 1);
                const double value = report_trial(exp(x), exp(y));
                if (value > best &&
                    value < 1) { /* beyond 1 a root has run away from its branch */
                    best = value;
                    at[0] = x;
                    at[1] = y;
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

int main(void)
{
    (void)gsl_set_error_handler_off();
    const double us = bench_median_us(optimum, NULL, 7);
    const double his = bench_median_us(report, NULL, 3);
    printf("# ours: loss ratio %.8f in %ld trials; the report's procedure: %.8f in %ld trials; "
           "right: 0.23309644\n",
           found, ours, report_found, report_trials);
    printf("# of %ld roots that it asked for, %ld were missed or another mode's\n", asked,
           hopped);
    bench_time("absorber/best-k-and-R", us);
    bench_time("absorber/report-procedure-refined", his);
    bench_ratio("absorber/report-over-strum", his / us, "at-least", 10);
    return 0;
}
