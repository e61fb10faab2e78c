/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Unlabelled frequencies: all increasing numbers of modes whose first is not above a limit and which
 * leave out at most so many between the first and the last. Each is fitted along one path, by
 * tables of the modes' frequencies, and the best are fitted in full. A mode is missed with the
 * probability 0.1: -2 ln(0.1/0.9) = 2 ln 9 is the price of each below the highest that is seen.
 */
#include "core/identify/report.h"

#include <stdlib.h>
#include <string.h>

/* With readings closer than 2 ln 20 the data do not decide at the level of 1/20. */
#define AMBIGUOUS (2 * log(20.0))
#define DATA_TELL 4.0
#define POINTS    60
#define REFINED   12
/* Of the mean spacing, where no standard deviation is given. */
#define ASSUMED 0.01

/* Frequencies along a path: T where EI is known, u with the tension as a scale otherwise. */
typedef struct table {
    bool scales;
    size_t points;
    int modes;
    double *f;    /* of mode n at point i: f[i * modes + n - 1] */
    double *bend; /* how far it lies below the straight line to the next point, times 4 */
} table;

typedef struct ranking {
    const strum_identify_params *params;
    strum_identify *f;
    table t;
    strum_identify_reading best[REFINED];
    size_t count;
    int modes[STRUM_IDENTIFY_FREQUENCIES_MAX];
    double inverse[STRUM_IDENTIFY_FREQUENCIES_MAX];
} ranking;

/* C(n, k), as a double: no overflow. */
static double choose(double n, double k)
{
    double value = 1;
    for (double i = 1; i <= k; i++)
        value *= (n - k + i) / i;
    return round(value);
}

/* With a last mode at most n + missing: C(n + missing, missing). A first mode above its limit is
 * left out of the enumeration. */
double assign_count(const strum_identify_params *p)
{
    return choose((double)p->count + p->missing_max, p->missing_max);
}

/* ---- the table ---- */

/* Highest tension of any reading: the first frequency as mode 1. */
static state table_state(const problem *p, const table *t, size_t i)
{
    state s = {.u = 0.01};
    for (int q = 0; q < QUANTITIES; q++)
        s.q[q] = p->unknown[q] && p->prior[q] > 0 ? p->prior_value[q]
                 : p->unknown[q]                  ? 1
                                                  : p->value[q];
    if (p->unknown[FIXITY] && !(p->prior[FIXITY] > 0))
        s.q[FIXITY] = 0.5;
    const double part = (double)i / (double)(t->points - 1);
    if (p->unknown[BENDING])
        s.u = i == 0 ? 0 : 1e-4 * pow(3e4, part);
    else if (!t->scales)
        s.q[TENSION] = p->value[TENSION] * pow(1e-5, part);
    state_close(p, &s);
    return s;
}

static strum_status fill_table(ranking *r)
{
    table *t = &r->t;
    problem p = r->f->p;
    prediction out[DATA_MAX];
    strum_status status = STRUM_OK;
    const size_t batch = STRUM_IDENTIFY_FREQUENCIES_MAX;
    memset(p.skip, 0, sizeof p.skip);
    if (!t->scales) /* the first frequency as mode 1, of a string */
        p.value[TENSION] = 1.05 * (p.value[MASS] + p.added_mass) *
                           pow(2 * p.value[LENGTH] * p.measured[p.ratios_at - 1], 2);
    for (size_t i = 0; i < t->points && status == STRUM_OK; i++) {
        const state s = table_state(&p, t, i);
        for (int from = 0; from < t->modes && status == STRUM_OK; from += (int)batch) {
            p.count = (size_t)(t->modes - from) < batch ? (size_t)(t->modes - from) : batch;
            p.ratios_at = p.count;
            for (size_t k = 0; k < p.count; k++)
                p.modes[k] = from + (int)k + 1;
            if (p.chain != NULL)
                status = model_prepare_chain(&p, NULL);
            if (status == STRUM_OK)
                status = model_predict(&p, &s, out);
            for (size_t k = 0; k < p.count && status == STRUM_OK; k++)
                t->f[i * (size_t)t->modes + (size_t)from + k] = out[k].value;
        }
    }
    for (size_t i = 0; i + 1 < t->points; i++)
        for (size_t m = i * (size_t)t->modes; m < (i + 1) * (size_t)t->modes; m++) {
            const double low = t->f[m], high = t->f[m + (size_t)t->modes];
            t->bend[m] = 4 * (0.5 * (low + high) - sqrt(low * high));
        }
    return status;
}

/* ---- one reading ---- */

/* Chi^2 where the path is at i + x: between two points frequencies follow the parabola through
 * both and their geometric mean. */
static double chi2_on(const ranking *r, size_t i, double x)
{
    const table *t = &r->t;
    const double *low = t->f + i * (size_t)t->modes, *bend = t->bend + i * (size_t)t->modes;
    const double *high = i + 1 < t->points ? low + t->modes : low;
    const size_t n = r->params->count;
    const double within = x * (1 - x);
    double fg = 0, gg = 0, ff = 0;
    for (size_t k = 0; k < n; k++) {
        const int m = r->modes[k] - 1;
        const double g = (low[m] + x * (high[m] - low[m]) - within * bend[m]) * r->inverse[k];
        const double f = r->params->frequencies[k] * r->inverse[k];
        fg += f * g;
        gg += g * g;
        ff += f * f;
    }
    return t->scales ? ff - fg * fg / gg : ff - 2 * fg + gg;
}

/* Least along the path: the best point, then golden section beside it. */
static double chi2_of_reading(const ranking *r)
{
    const table *t = &r->t;
    size_t best = 0;
    double least = chi2_on(r, 0, 0);
    for (size_t i = 1; i < t->points; i++) {
        const double here = chi2_on(r, i, 0);
        if (here < least) {
            least = here;
            best = i;
        }
    }
    for (int side = 0; side < 2 && t->points > 1; side++) {
        const size_t i = best - (size_t)side;
        if ((side == 1 && best == 0) || i + 1 >= t->points)
            continue;
        double low = 0, high = 1;
        for (int k = 0; k < 14; k++) {
            const double a = low + 0.382 * (high - low), b = high - 0.382 * (high - low);
            const double at_a = chi2_on(r, i, a), at_b = chi2_on(r, i, b);
            least = fmin(least, fmin(at_a, at_b));
            *(at_a < at_b ? &high : &low) = at_a < at_b ? b : a;
        }
    }
    return fmax(least, 0);
}

static double price(const int *modes, size_t n)
{
    return 2 * log(9.0) * (double)(modes[n - 1] - (int)n);
}

static void rank(ranking *r)
{
    const size_t n = r->params->count;
    strum_identify_reading one = {.chi_squared = chi2_of_reading(r)};
    one.criterion = one.chi_squared + price(r->modes, n);
    size_t i = r->count < REFINED ? r->count++ : REFINED;
    if (i == REFINED && !(one.criterion < r->best[--i].criterion))
        return;
    memcpy(one.modes, r->modes, n * sizeof *one.modes);
    for (; i > 0 && r->best[i - 1].criterion > one.criterion; i--)
        r->best[i] = r->best[i - 1];
    r->best[i] = one;
}

/* All increasing numbers with at most missing_max left out below the last. */
static strum_status enumerate(ranking *r)
{
    const int n = (int)r->params->count, top = n + r->params->missing_max;
    int *m = r->modes;
    for (int i = 0; i < n; i++)
        m[i] = i + 1;
    for (;;) {
        const strum_status status = work_spend(r->f->p.work, 0.004 * n * (double)r->t.points);
        if (status != STRUM_OK)
            return status;
        if (m[0] <= r->params->first_mode_max)
            rank(r);
        int i = n - 1;
        while (i >= 0 && m[i] == top - (n - 1 - i))
            i--;
        if (i < 0)
            return STRUM_OK;
        m[i]++;
        for (int k = i + 1; k < n; k++)
            m[k] = m[k - 1] + 1;
    }
}

/* ---- the best ones in full ---- */

static int by_criterion(const void *a, const void *b)
{
    const double x = ((const strum_identify_reading *)a)->criterion;
    const double y = ((const strum_identify_reading *)b)->criterion;
    return (x > y) - (x < y);
}

static strum_status refine(ranking *r, fit *room)
{
    const size_t n = r->params->count;
    for (size_t i = 0; i < r->count; i++) {
        strum_identify_reading *one = &r->best[i];
        problem p = r->f->p;
        size_t count, minima;
        memcpy(p.modes, one->modes, n * sizeof *p.modes);
        strum_status status = p.chain != NULL ? model_prepare_chain(&p, NULL) : STRUM_OK;
        if (status == STRUM_OK)
            status = scan_minima(&p, room, &count, &minima);
        if (status == STRUM_OK) {
            one->chi_squared = room[0].chi2;
            one->tension = room[0].at.q[TENSION];
            one->criterion = one->chi_squared + price(one->modes, n);
        } else if (status != STRUM_ERR_ACCURACY) {
            return status;
        } else {
            one->criterion = HUGE_VAL;
        }
    }
    qsort(r->best, r->count, sizeof *r->best, by_criterion);
    return STRUM_OK;
}

static void conclude(ranking *r)
{
    strum_identify *f = r->f;
    f->reading_count = 0;
    for (size_t i = 0; i < r->count && i < STRUM_IDENTIFY_READINGS_MAX; i++)
        if (isfinite(r->best[i].criterion))
            f->readings[f->reading_count++] = r->best[i];
    if (f->reading_count > 1) {
        f->ambiguous = r->best[1].criterion - r->best[0].criterion < AMBIGUOUS;
        f->by_price = r->best[1].chi_squared - r->best[0].chi_squared < DATA_TELL;
    }
    memcpy(f->p.modes, r->best[0].modes, r->params->count * sizeof *f->p.modes);
}

strum_status assign_modes(strum_identify *f, const strum_identify_params *params,
                          strum_error *error)
{
    if (assign_count(params) > STRUM_IDENTIFY_ASSIGNMENTS_MAX)
        return error_at(error, STRUM_ERR_METHOD, STRUM_IDENTIFY_ARG_ASSIGNMENT, STRUM_NO_INDEX,
                        "%.0f numberings of these frequencies are possible, more than %d: give "
                        "mode numbers, "
                        "or allow fewer missing modes",
                        assign_count(params), STRUM_IDENTIFY_ASSIGNMENTS_MAX);
    problem *p = &f->p;
    if (!p->weighted) {
        const double *x = params->frequencies;
        const size_t n = params->count;
        f->assumed_deviation = ASSUMED * (n > 1 ? (x[n - 1] - x[0]) / (double)(n - 1) : x[0]);
        for (size_t i = 0; i < p->count; i++)
            p->deviation[i] = f->assumed_deviation;
    }
    ranking *r = calloc(1, sizeof *r);
    fit *room = calloc(STRUM_IDENTIFY_SOLUTIONS_MAX, sizeof *room);
    strum_status status = r == NULL || room == NULL ? STRUM_ERR_MEMORY : STRUM_OK;
    if (status == STRUM_OK) {
        r->params = params;
        r->f = f;
        r->t.modes = (int)params->count + params->missing_max;
        r->t.scales = !p->sag && p->chain == NULL
                          ? p->unknown[BENDING] || p->value[BENDING] == 0
                          : p->chain != NULL;
        r->t.points = r->t.scales && !p->unknown[BENDING] ? 1 : POINTS;
        r->t.f = calloc(r->t.points * (size_t)r->t.modes, sizeof *r->t.f);
        r->t.bend = calloc(r->t.points * (size_t)r->t.modes, sizeof *r->t.bend);
        for (size_t i = 0; i < params->count; i++)
            r->inverse[i] = 1 / p->deviation[i];
        status = r->t.f == NULL || r->t.bend == NULL ? STRUM_ERR_MEMORY : fill_table(r);
    }
    if (status == STRUM_OK)
        status = enumerate(r);
    if (status == STRUM_OK)
        status = refine(r, room);
    if (status == STRUM_OK)
        conclude(r);
    for (size_t i = 0; i < p->count && !p->weighted; i++)
        p->deviation[i] = 1;
    if (r != NULL) {
        free(r->t.f);
        free(r->t.bend);
    }
    free(r);
    free(room);
    return status;
}
