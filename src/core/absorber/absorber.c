/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/absorber/absorber.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

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
/* A variable whose bounds differ by more is searched by its logarithm. */
#define LOG_RANGE 30.0

double strum_absorber_scale(double low, double high, double share)
{
    if (share <= 0)
        return low;
    if (share >= 1)
        return high;
    if (low > 0 && high / low > LOG_RANGE)
        return low * pow(high / low, share);
    if (low == 0)
        return high * expm1(share * log(1e6)) / (1e6 - 1);
    return low + (high - low) * share;
}

/* From 0: the upper third of the share spans two orders, the whole fifteen, so that neither an
 * optimum near the bound nor one far below it is passed over. */
static double from_zero(double high, double share)
{
    const double rest = 1 - share, least = 1e-15;
    const double orders = 15 * rest * (0.25 + 0.75 * rest * rest);
    return high * (pow(10, -orders) - least) / (1 - least);
}

static void values_of(const strum_absorber_problem *p, const double *t, double *values)
{
    for (int i = 0; i < p->variables; i++) {
        const double low = p->lowest_values[i], high = p->highest_values[i];
        values[i] = low == 0 && t[i] > 0 && t[i] < 1 ? from_zero(high, t[i])
                                                     : strum_absorber_scale(low, high, t[i]);
    }
}

static strum_status roots_of(const strum_absorber_problem *p, const strum_taut *chain,
                             const strum_taut_roots *guesses, strum_taut_roots **roots,
                             strum_error *fault)
{
    strum_taut_query query = {.numbers = p->modes,
                              .count = p->modes != NULL ? p->mode_count : 0,
                              .lowest = p->lowest,
                              .highest = p->highest};
    const strum_options options = {p->cancelled, p->context, 0};
    if (p->modes == NULL) {
        /* whatever decays faster than twice its own frequency limits nothing */
        query.max_decay = 2 * p->highest;
        if (guesses != NULL) {
            query.guesses = guesses->roots;
            query.guess_count = guesses->count;
        }
    }
    return strum_taut_solve(chain, &query, &options, roots, fault);
}

static double damping_ratio(const strum_taut_root *root)
{
    return root->decay > 0 ? root->decay / hypot(root->frequency, root->decay) : 0;
}

int strum_absorber_limiting(const strum_taut_roots *roots)
{
    int worst = -1;
    for (size_t i = 0; i < roots->count; i++)
        if (worst < 0 || damping_ratio(&roots->roots[i]) < damping_ratio(&roots->roots[worst]))
            worst = (int)i;
    return worst;
}

strum_status strum_absorber_roots(const strum_absorber_problem *p, const double *values,
                                  strum_taut_roots **roots, strum_error *fault)
{
    strum_taut *chain = NULL;
    strum_status status = p->build(p->context, values, &chain, fault);
    if (status == STRUM_OK)
        status = roots_of(p, chain, NULL, roots, fault);
    strum_taut_free(&chain);
    return status;
}

void search_count(search *s)
{
    const strum_absorber_problem *p = s->problem;
    double values[STRUM_ABSORBER_VARIABLES_MAX];
    s->evaluations++;
    values_of(p, s->best_at, values);
    if (s->evaluations >= s->limit ||
        (p->progress != NULL && !p->progress(p->context, s->evaluations, s->best, values)))
        s->stopped = true;
}

static void note_status(search *s, strum_status status)
{
    if (status == STRUM_ERR_MEMORY || status == STRUM_ERR_INTERNAL)
        s->broken = status;
    if (status == STRUM_ERR_CANCELLED)
        s->stopped = true;
}

strum_taut *search_chain(search *s, const double *t)
{
    double values[STRUM_ABSORBER_VARIABLES_MAX];
    strum_taut *chain = NULL;
    values_of(s->problem, t, values);
    note_status(s, s->problem->build(s->problem->context, values, &chain, s->fault));
    return chain;
}

strum_taut_roots *search_roots(search *s, const double *t, double beyond)
{
    strum_absorber_problem wider = *s->problem;
    strum_taut_roots *roots = NULL;
    strum_taut *chain = search_chain(s, t);
    if (chain == NULL)
        return NULL;
    wider.lowest = fmax(wider.lowest - beyond, 0.5 * wider.lowest);
    wider.highest += beyond;
    note_status(s, roots_of(&wider, chain, s->last, &roots, s->fault));
    strum_taut_free(&chain);
    return roots;
}

/* The smallest damping ratio at one trial. A trial that cannot be answered counts as undamped:
 * a search may pass by, it may not end there. */
double search_trial(search *s, const double *t)
{
    const strum_absorber_problem *p = s->problem;
    double objective = 0;
    if (!search_goes_on(s))
        return 0;
    strum_taut *chain = search_chain(s, t);
    strum_taut_roots *roots = NULL;
    if (chain != NULL)
        note_status(s, roots_of(p, chain, s->last, &roots, s->fault));
    strum_taut_free(&chain);
    if (roots != NULL) {
        const int limiting = strum_absorber_limiting(roots);
        objective = limiting >= 0 ? damping_ratio(&roots->roots[limiting]) : 0;
        s->answered = true;
        s->met = s->met || limiting >= 0;
        strum_taut_roots_free(&s->last);
        s->last = roots;
    }
    if (objective > s->best) {
        s->best = objective;
        memcpy(s->best_at, t, (size_t)p->variables * sizeof *t);
    }
    search_count(s);
    return objective;
}

/* Golden section about a place of a scan in one variable, down to a width. */
static double climb_one(search *s, double *t, double step, double width)
{
    const double golden = 0.6180339887498949;
    double low = fmax(*t - step, 0), high = fmin(*t + step, 1);
    double left = high - golden * (high - low), right = low + golden * (high - low);
    double at_left = search_trial(s, &left), at_right = search_trial(s, &right);
    while (high - low > width && search_goes_on(s)) {
        if (at_left > at_right) {
            high = right;
            right = left;
            at_right = at_left;
            left = high - golden * (high - low);
            at_left = search_trial(s, &left);
        } else {
            low = left;
            left = right;
            at_left = at_right;
            right = low + golden * (high - low);
            at_right = search_trial(s, &right);
        }
    }
    *t = at_left > at_right ? left : right;
    return fmax(at_left, at_right);
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
    const int n = s->problem->variables;
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

static void note(const strum_absorber_problem *p, const place *end, strum_absorber_optimum *out)
{
    int at = out->optima_count;
    if (at < STRUM_ABSORBER_OPTIMA_MAX)
        out->optima_count++;
    else if (out->optima[--at].damping_ratio >= end->value)
        return;
    for (; at > 0 && out->optima[at - 1].damping_ratio < end->value; at--)
        out->optima[at] = out->optima[at - 1];
    values_of(p, end->t, out->optima[at].values);
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
        note(s->problem, &best[i], out);
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
    const int n = s->problem->variables;
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
            note(s->problem, &best[i], out);
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
        return error_set(s->fault, STRUM_ERR_CANCELLED,
                         "the search was stopped before any trial damped every mode");
    if (!s->answered) {
        const strum_error last = s->fault != NULL ? *s->fault : (strum_error){0};
        return error_set(s->fault, STRUM_ERR_IMPOSSIBLE,
                         "no trial within the bounds could be answered; the last one: %.200s",
                         last.reason);
    }
    return error_set(s->fault, STRUM_ERR_IMPOSSIBLE,
                     s->met ? "nothing within the bounds damps every mode that was asked for "
                              "(%ld trials)"
                            : "within the bounds no trial has an oscillating mode that was "
                              "asked for (%ld trials)",
                     s->evaluations);
}

strum_status strum_absorber_optimize(const strum_absorber_problem *p,
                                     strum_absorber_optimum *out, strum_error *fault)
{
    if (p->variables < 1 || p->variables > STRUM_ABSORBER_VARIABLES_MAX)
        return error_set(fault, STRUM_ERR_RANGE, "1 to %d numbers may vary",
                         STRUM_ABSORBER_VARIABLES_MAX);
    search s = {.problem = p, .limit = p->max_evaluations, .fault = fault};
    memset(out, 0, sizeof *out);
    if (p->variables == 1)
        run_one(&s, out);
    else
        run_several(&s, out);
    strum_taut_roots_free(&s.last);
    out->evaluations = s.evaluations;
    out->complete = !s.stopped;
    if (s.broken != STRUM_OK)
        return error_set(fault, s.broken, "%s", strum_status_text(s.broken));
    if (!(s.best > 1e-12)) /* a mode that is not reached has rounding for a decay */
        return no_optimum(&s);
    values_of(p, s.best_at, out->values);
    out->damping_ratio = s.best;
    const double below = fmax(1 - s.best, DBL_EPSILON / 2); /* all but overdamped */
    out->loss_ratio = s.best / sqrt(below * (1 + s.best));
    return STRUM_OK;
}

static double tuned_stiffness(double mass, double ratio, double frequency)
{
    return mass * pow(frequency / (1 + ratio), 2);
}

strum_absorber_form strum_absorber_den_hartog(double mass, double ratio, double frequency)
{
    return (strum_absorber_form){
        tuned_stiffness(mass, ratio, frequency),
        2 * mass * frequency * sqrt(3 * ratio / (8 * pow(1 + ratio, 3))), NAN};
}

strum_absorber_form strum_absorber_coalescence(double mass, double ratio, double frequency)
{
    return (strum_absorber_form){tuned_stiffness(mass, ratio, frequency),
                                 2 * mass * frequency * sqrt(ratio) / pow(1 + ratio, 1.5),
                                 sqrt(ratio) / 2};
}

strum_absorber_form strum_absorber_universal_curve(double length, double mass_per_length,
                                                   double tension, double position, long mode)
{
    const double share = fmin(position, length - position) / length;
    const double first = M_PI / length * sqrt(tension / mass_per_length);
    return (strum_absorber_form){
        0, 0.10 * mass_per_length * length * first / ((double)mode * share), 0.52 * share};
}
