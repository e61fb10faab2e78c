/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The search over the whole range: scans, climbs from their peaks, and what is made of them. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/absorber/climb.h"
#include "core/absorber/search.h"
#include "core/numerics/peak.h"
#include "core/numerics/status.h"

/* Local searches that begin, at most. */
#define STARTS STRUM_ABSORBER_OPTIMA_MAX
/* Places of the scan in one variable. */
#define SCAN_ONE 257
/* Places of one scan in several, for each of them; of any scan. */
#define SCAN     100
#define SCAN_MAX (SCAN * STRUM_ABSORBER_VARIABLES_MAX)
/* Climbs that lead to the best optimum before it is believed to be the best of all. */
#define CONFIRMED 3
static double trial(void *data, double t)
{
    return search_trial(data, &t);
}

/* Golden section about a place of a scan in one variable, down to a width. */
static double climb_one(search *s, double *t, double step, double width)
{
    golden g = golden_begin(trial, s, fmax(*t - step, 0), fmin(*t + step, 1));
    while (g.high - g.low > width && search_goes_on(s))
        golden_step(&g, trial, s);
    *t = g.at_left > g.at_right ? g.left : g.right;
    return fmax(g.at_left, g.at_right);
}

typedef struct place {
    double t[STRUM_ABSORBER_VARIABLES_MAX], value;
} place;

/* The generalised golden ratio's sequence, which fills the unit cube evenly (R-sequence). */
static void sequence(int n, long index, double *t)
{
    double g = 2;
    for (int i = 0; i < 40; i++)
        g = pow(1 + g, 1.0 / (n + 1));
    for (int i = 0; i < n; i++) {
        const double x = 0.5 + (double)index * pow(g, -(i + 1));
        t[i] = x - floor(x);
    }
}

static double distance(int n, const double *a, const double *b)
{
    double most = 0;
    for (int i = 0; i < n; i++)
        most = fmax(most, fabs(a[i] - b[i]));
    return most;
}

static int by_value(const void *left, const void *right)
{
    const place *l = left, *r = right;
    return l->value > r->value ? -1 : l->value < r->value;
}

/* Places to climb from: of `points` of the sequence, from its number `first` on (one variable:
 * of its whole range), those that have no better one within `apart`; the best `room` of them.
 */
static int scan(search *s, long first, long points, double apart, place *best, int room)
{
    const int n = s->params->variables;
    place all[SCAN_MAX];
    int count = 0, seen = 0;
    for (; seen < points && search_goes_on(s); seen++) {
        place *p = &all[seen];
        if (n == 1)
            p->t[0] = (double)seen / (double)(points - 1);
        else
            sequence(n, first + seen + 1, p->t);
        p->value = search_trial(s, p->t);
    }
    qsort(all, (size_t)seen, sizeof *all, by_value);
    for (int i = 0; i < seen && count < room; i++) {
        bool peak = true;
        for (int k = 0; k < i && peak; k++)
            peak = distance(n, all[k].t, all[i].t) > apart;
        if (peak)
            best[count++] = all[i];
    }
    return count;
}

static void note(const strum_absorber_params *p, const place *end, strum_absorber_optimum *out)
{
    int at = out->optima_count;
    if (at < STRUM_ABSORBER_OPTIMA_MAX)
        out->optima_count++;
    else if (out->optima[--at].damping_ratio >= end->value)
        return;
    for (; at > 0 && out->optima[at - 1].damping_ratio < end->value; at--)
        out->optima[at] = out->optima[at - 1];
    search_values(p, end->t, out->optima[at].values);
    out->optima[at].damping_ratio = end->value;
}

/* One variable: a fine scan, all its peaks a little way, and the highest to the end. */
static void run_one(search *s, strum_absorber_optimum *out)
{
    const double step = 1.0 / (SCAN_ONE - 1);
    place best[SCAN_ONE];
    out->starts = scan(s, 0, SCAN_ONE, 1.5 * step, best, SCAN_ONE);
    for (int i = 0; i < out->starts && search_goes_on(s); i++)
        best[i].value = climb_one(s, best[i].t, step, 0.05 * step);
    qsort(best, (size_t)out->starts, sizeof *best, by_value);
    for (int i = 0; i < 4 && i < out->starts && search_goes_on(s); i++)
        best[i].value = climb_one(s, best[i].t, 0.1 * step, 1e-10);
    for (int i = 0; i < out->starts; i++)
        note(s->params, &best[i], out);
}

/* How many of the climbs ended at the best place's height. */
static int reached(const search *s, const place *ends, int count)
{
    int times = 0;
    for (int i = 0; i < count; i++)
        times += ends[i].value >= s->best * (1 - 1e-4);
    return times;
}

/* Several: passes of scanning and climbing, until enough climbs lead to the same best. */
static void run_several(search *s, strum_absorber_optimum *out)
{
    const int n = s->params->variables;
    const long all = s->limit, points = (long)fmin(SCAN * n, 0.3 * (double)all);
    const double apart = 1.2 * pow((double)points, -1.0 / n);
    double best_before = 0;
    int times = 0;
    s->limit = (long)(0.85 * (double)all); /* the rest is for the end */
    for (int pass = 0; times < CONFIRMED && search_goes_on(s); pass++) {
        place best[STARTS];
        const int starts = scan(s, pass * points, points, apart, best, STARTS);
        for (int i = 0; i < starts && search_goes_on(s); i++)
            best[i].value = absorber_climb(s, best[i].t, 0.1, 6, 1e-3);
        qsort(best, (size_t)starts, sizeof *best, by_value);
        /* which of the good ones is the best shows only at their ends */
        for (int i = 0; i < 2 && i < starts && search_goes_on(s); i++)
            if (best[i].value > 0.9 * best[0].value)
                best[i].value = absorber_climb(s, best[i].t, 0.03, 20, 1e-7);
        for (int i = 0; i < starts; i++)
            note(s->params, &best[i], out);
        out->starts += starts;
        times = (s->best > best_before * (1 + 1e-4) ? 0 : times) + reached(s, best, starts);
        best_before = s->best;
    }
    const bool unconfirmed = s->stopped && s->evaluations >= s->limit;
    s->stopped = s->stopped && !unconfirmed;
    s->limit = all;
    if (search_goes_on(s))
        (void)absorber_climb(s, s->best_at, 0.003, 20, 1e-12);
    s->stopped = s->stopped || unconfirmed;
}

/* Why there is none. */
static strum_status no_optimum(const search *s)
{
    if (s->stopped && s->evaluations < s->limit)
        return error_set(s->error,
                         s->work.status != STRUM_OK ? s->work.status : STRUM_ERR_CANCELLED,
                         "the search was stopped before any trial damped every mode");
    if (!s->answered) {
        const strum_error last = s->error != NULL ? *s->error : (strum_error){0};
        return error_set(s->error, STRUM_ERR_IMPOSSIBLE,
                         "no trial within the bounds could be answered; the last one: %.200s",
                         last.reason);
    }
    return error_set(s->error, STRUM_ERR_IMPOSSIBLE,
                     s->met ? "nothing within the bounds damps every mode that was asked for "
                              "(%ld trials)"
                            : "within the bounds no trial has an oscillating mode that was "
                              "asked for (%ld trials)",
                     s->evaluations);
}

static strum_status check(const strum_absorber_params *p, strum_error *error)
{
    if (p->variables < 1 || p->variables > STRUM_ABSORBER_VARIABLES_MAX)
        return error_at(error, STRUM_ERR_RANGE, STRUM_ABSORBER_ARG_VARIABLES, STRUM_NO_INDEX,
                        "1 to %d numbers may vary", STRUM_ABSORBER_VARIABLES_MAX);
    for (int i = 0; i < p->variables; i++)
        if (!(isfinite(p->lowest_values[i]) && isfinite(p->highest_values[i]) &&
              p->lowest_values[i] < p->highest_values[i]))
            return error_at(error, STRUM_ERR_RANGE, STRUM_ABSORBER_ARG_BOUNDS, (size_t)i,
                            "the upper bound of a variable must be finite and greater than "
                            "the lower one");
    if (p->max_evaluations < STRUM_ABSORBER_EVALUATIONS_MIN)
        return error_at(error, STRUM_ERR_RANGE, STRUM_ABSORBER_ARG_MAX_EVALUATIONS,
                        STRUM_NO_INDEX, "at least %d evaluations must be allowed",
                        STRUM_ABSORBER_EVALUATIONS_MIN);
    return STRUM_OK;
}

strum_status strum_absorber_solve(const strum_absorber_params *p, const strum_options *options,
                                  strum_absorber_optimum *out, strum_error *error)
{
    memset(out, 0, sizeof *out);
    const strum_status status = check(p, error);
    if (status != STRUM_OK)
        return status;
    search s = {
        .params = p, .work = work_begin(options), .limit = p->max_evaluations, .error = error};
    if (p->variables == 1)
        run_one(&s, out);
    else
        run_several(&s, out);
    strum_taut_roots_free(s.last);
    out->evaluations = s.evaluations;
    out->complete = !s.stopped;
    if (s.broken != STRUM_OK)
        return error_set(error, s.broken, "%s", strum_status_text(s.broken));
    const bool found = s.best > 1e-12; /* a mode that is not reached has rounding for a decay */
    if (found) {
        search_values(p, s.best_at, out->values);
        out->damping_ratio = s.best;
        const double below = fmax(1 - s.best, DBL_EPSILON / 2); /* all but overdamped */
        out->loss_ratio = s.best / sqrt(below * (1 + s.best));
    }
    if (!found)
        return no_optimum(&s);
    return s.work.status == STRUM_OK ? STRUM_OK : work_error(&s.work, error);
}
