/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * All minima of chi^2. A cable without sag has one number that matters, u = sqrt(EI/T)/L, and the
 * fixity: the rest is scale and known in closed form. So the minima are sought along u (where EI or
 * two of the scales are unknown), or along the tension, for several fixities; with sag along the
 * tension. Each local minimum of the scan is descended from.
 */
#include "core/identify/problem.h"

#include <stdlib.h>
#include <string.h>

#define CANDIDATES_MAX 24
/* Data that a scan looks at; the descents look at all. */
#define SCAN_DATA  16
#define POINTS_MAX 64
#define U_POINTS   41
#define U_LOW      1e-5
#define U_HIGH     30.0

typedef struct candidate {
    state at;
    double chi2;
} candidate;

typedef struct search {
    const problem *p;
    problem thin; /* fewer data */
    prediction out[DATA_MAX];
    candidate found[CANDIDATES_MAX];
    size_t count;
} search;

typedef enum path {
    ALONG_NOTHING,
    ALONG_U,
    ALONG_TENSION,
    ALONG_LENGTH,
    ALONG_AXIAL,
    ALONG_DAMPING
} path;

static path choose(const problem *p)
{
    const bool *x = p->unknown;
    if (p->ratios_at < p->count)
        return x[DAMPING] ? ALONG_DAMPING : ALONG_NOTHING;
    if (p->chain != NULL)
        return p->chain_scales ? ALONG_NOTHING : ALONG_TENSION;
    if (p->sag)
        return x[TENSION]   ? ALONG_TENSION
               : x[AXIAL]   ? ALONG_AXIAL
               : x[BENDING] ? ALONG_U
               : x[LENGTH]  ? ALONG_LENGTH
                            : ALONG_NOTHING;
    if (x[BENDING])
        return ALONG_U;
    if (p->value[BENDING] == 0)
        return ALONG_NOTHING;
    if (x[TENSION] && x[LENGTH])
        return ALONG_U;
    return x[TENSION] ? ALONG_TENSION : x[LENGTH] ? ALONG_LENGTH : ALONG_NOTHING;
}

/* Data of every part of the list. */
static void thin_out(search *s)
{
    s->thin = *s->p;
    const size_t n = problem_data(s->p);
    size_t seen = 0;
    for (size_t i = 0; i < s->p->count && n > SCAN_DATA; i++) {
        if (s->p->skip[i])
            continue;
        s->thin.skip[i] = seen * (SCAN_DATA - 1) % (n - 1) >= SCAN_DATA - 1 && seen != n - 1;
        seen++;
    }
}

/* String rule of one frequency with the quantities of a state. */
static double string_tension(const problem *p, const state *s, size_t i)
{
    const double k = 2 * s->q[LENGTH] * p->measured[i] / p->modes[i];
    return state_mass(p, s) * k * k;
}

/* A state to begin from: what is known, what is known beforehand, and something for the rest. */
static state first_state(const problem *p)
{
    state s = {.u = 0.01};
    static const double any[QUANTITIES] = {1, 1, 0.5, 1, 1, 1, 1};
    for (int q = 0; q < QUANTITIES; q++)
        s.q[q] = !p->unknown[q] ? p->value[q] : p->prior[q] > 0 ? p->prior_value[q] : any[q];
    if (p->chain != NULL || p->ratios_at == 0)
        return s;
    if (p->unknown[TENSION] && !(p->prior[TENSION] > 0)) {
        double sum = 0;
        for (size_t i = 0; i < p->ratios_at; i++)
            sum += string_tension(p, &s, i);
        s.q[TENSION] = sum / (double)p->ratios_at;
    }
    if (p->prior[BENDING] > 0)
        s.u = sqrt(p->prior_value[BENDING] / s.q[TENSION]) / s.q[LENGTH];
    return s;
}

/* One quantity may multiply all frequencies. */
static bool has_scale(const problem *p)
{
    const bool *x = p->unknown;
    if (p->sag || (p->chain != NULL && !p->chain_scales) || p->ratios_at < p->count)
        return false;
    return x[MASS] || x[LENGTH] ||
           (x[TENSION] && (x[BENDING] || p->chain != NULL || p->value[BENDING] == 0));
}

/* The factor of all frequencies that fits best, put into the one quantity that scales them. */
static void rescale(const problem *p, state *s, prediction *out)
{
    double fg = 0, gg = 0;
    const bool *x = p->unknown;
    const bool along_u = x[BENDING] || (x[TENSION] && x[LENGTH]);
    for (size_t i = 0; i < p->count; i++) {
        const double w = 1 / p->deviation[i];
        if (!p->skip[i]) {
            fg += w * w * p->measured[i] * out[i].value;
            gg += w * w * out[i].value * out[i].value;
        }
    }
    const double factor = fg / gg;
    for (size_t i = 0; i < p->count; i++)
        out[i].value *= factor;
    if (x[TENSION] && p->unknown[LENGTH] && !x[BENDING] && p->value[BENDING] > 0) {
        /* u and EI held: f goes with T, and L with 1/sqrt T */
        s->q[TENSION] *= factor;
        s->q[LENGTH] = sqrt(p->value[BENDING] / s->q[TENSION]) / s->u;
    } else if (x[TENSION] && (along_u || p->chain != NULL || p->value[BENDING] == 0)) {
        s->q[TENSION] *= factor * factor;
    } else if (!x[TENSION] && x[MASS]) {
        const double mass = state_mass(p, s) / (factor * factor) - p->added_mass;
        s->q[MASS] = fmax(mass, 1e-3 * (mass + p->added_mass));
    } else if (!x[TENSION] && x[LENGTH] && (x[BENDING] || p->value[BENDING] == 0)) {
        s->q[LENGTH] /= factor;
    }
    state_close(p, s);
}

static void set_u(const problem *p, state *s, double u)
{
    s->u = u;
    if (!p->unknown[BENDING]) /* T and L unknown, EI known */
        s->q[LENGTH] = sqrt(p->value[BENDING] / s->q[TENSION]) / u;
    state_close(p, s);
}

static strum_status try_state(search *s, state *at, double *chi2)
{
    const strum_status status = model_predict(&s->thin, at, s->out);
    if (status == STRUM_OK && has_scale(s->p))
        rescale(&s->thin, at, s->out);
    *chi2 = status == STRUM_OK ? state_chi2(&s->thin, at, s->out) : HUGE_VAL;
    return status;
}

static void keep(search *s, const state *at, double chi2)
{
    size_t i = s->count < CANDIDATES_MAX ? s->count++ : CANDIDATES_MAX;
    if (i == CANDIDATES_MAX) {
        if (!(chi2 < s->found[--i].chi2))
            return;
    }
    for (; i > 0 && s->found[i - 1].chi2 > chi2; i--)
        s->found[i] = s->found[i - 1];
    s->found[i] = (candidate){*at, chi2};
}

/* Points of a path; without one the state itself. */
static size_t points_of(const search *s, path along, const state *from, double *x)
{
    const problem *p = s->p;
    double low = 1, high = 1;
    size_t n = 0;
    switch (along) {
    case ALONG_U:
        x[n++] = p->unknown[BENDING] && !(p->prior[BENDING] > 0) ? 0 : U_LOW / 2;
        low = U_LOW, high = U_HIGH;
        break;
    case ALONG_TENSION:
        low = HUGE_VAL, high = 0;
        for (size_t i = 0; i < p->ratios_at; i++) {
            const double t =
                p->chain == NULL ? string_tension(p, from, i) : p->chain->reference_tension;
            low = fmin(low, t);
            high = fmax(high, t);
        }
        /* A string's mode n lies below the next one of the cable without sag; bending raises any. */
        low *= p->chain != NULL                               ? 1e-4
               : !p->sag                                      ? 1e-6
               : p->unknown[BENDING] || p->value[BENDING] > 0 ? 0.08
                                                              : 0.2;
        high *= p->chain != NULL ? 1e4 : 1.02;
        break;
    case ALONG_LENGTH:
        /* At least the string's. */
        low = high = 0;
        for (size_t i = 0; i < p->ratios_at; i++)
            low = fmax(low, 0.5 * p->modes[i] / p->measured[i] *
                                sqrt(from->q[TENSION] / state_mass(p, from)));
        low *= 0.5, high = 1e3 * low;
        break;
    case ALONG_AXIAL:
        low = 1e-3, high = 1e5; /* lambda^2; set_axial */
        break;
    case ALONG_DAMPING:
        low = 1e-6, high = 1e6; /* of sqrt(T m) L/x over mode 1 */
        break;
    default:
        x[0] = 0;
        return 1;
    }
    const size_t count = along == ALONG_U                   ? U_POINTS
                         : p->sag || along == ALONG_DAMPING ? POINTS_MAX - 1
                                                            : 30;
    for (size_t i = 0; i < count; i++)
        x[n++] = low * pow(high / low, (double)i / (double)(count - 1));
    return n;
}

static state on_path(const problem *p, path along, const state *from, double x)
{
    state at = *from;
    if (along == ALONG_U)
        set_u(p, &at, x);
    else if (along == ALONG_TENSION)
        at.q[TENSION] = x;
    else if (along == ALONG_LENGTH)
        at.q[LENGTH] = x;
    else if (along == ALONG_AXIAL)
        at.q[AXIAL] *= x / state_lambda2(p, &at);
    else if (along == ALONG_DAMPING)
        at.q[DAMPING] =
            x * sqrt(at.q[TENSION] * state_mass(p, &at)) * at.q[LENGTH] / p->damper_position;
    if (along != ALONG_U)
        state_close(p, &at);
    return at;
}

static strum_status sweep(search *s, path along, const state *from)
{
    double x[POINTS_MAX], chi2[POINTS_MAX];
    state at[POINTS_MAX];
    const size_t n = points_of(s, along, from, x);
    strum_status status = STRUM_OK;
    for (size_t i = 0; i < n && status == STRUM_OK; i++) {
        at[i] = on_path(s->p, along, from, x[i]);
        status = try_state(s, &at[i], &chi2[i]);
    }
    for (size_t i = 0; i < n && status == STRUM_OK; i++)
        if ((i == 0 || chi2[i] <= chi2[i - 1]) && (i + 1 == n || chi2[i] <= chi2[i + 1]) &&
            chi2[i] < HUGE_VAL)
            keep(s, &at[i], chi2[i]);
    return status;
}

/* Sweeps for each fixity and, with sag, for a few bending and axial stiffnesses. */
static strum_status sweep_all(search *s)
{
    static const double rhos[] = {0.5, 0.08, 0.27, 0.73, 0.92},
                        us[] = {1e-3, 4e-3, 0.015, 0.06, 0.2};
    static const double lambda2s[] = {0.1, 1, 5, 20, 60};
    const problem *p = s->p;
    const path along = choose(p);
    const state from = first_state(p);
    const size_t rho_count = p->unknown[FIXITY] ? 5 : 1;
    const size_t u_count = p->sag && p->unknown[BENDING] && along != ALONG_U ? 5 : 1;
    const size_t axial_count = p->sag && p->unknown[AXIAL] && along != ALONG_AXIAL ? 5 : 1;
    strum_status status = STRUM_OK;
    for (size_t i = 0; i < rho_count * u_count * axial_count && status == STRUM_OK; i++) {
        state at = from;
        if (rho_count > 1)
            at.q[FIXITY] = rhos[i % rho_count];
        if (u_count > 1)
            at.u = us[i / rho_count % u_count];
        if (axial_count > 1)
            at.q[AXIAL] *= lambda2s[i / rho_count / u_count] / state_lambda2(p, &at);
        state_close(p, &at);
        status = sweep(s, along, &at);
    }
    return status;
}

static bool same(const fit *a, const fit *b)
{
    for (size_t j = 0; j < a->unknowns; j++) {
        const int q = a->which[j];
        const double x = q == BENDING ? a->at.u : a->at.q[q],
                     y = q == BENDING ? b->at.u : b->at.q[q];
        const double scale = q == FIXITY ? 1 : fmax(fabs(x), fabs(y));
        if (fabs(x - y) > 1e-5 * scale + (q == BENDING ? 1e-9 : 0))
            return false;
    }
    return true;
}

static void insert(fit *fits, size_t *count, size_t *minima, const fit *f)
{
    for (size_t i = 0; i < *count; i++)
        if (same(&fits[i], f)) {
            if (f->chi2 < fits[i].chi2)
                fits[i] = *f;
            return;
        }
    ++*minima;
    if (*count == STRUM_IDENTIFY_SOLUTIONS_MAX && !(f->chi2 < fits[*count - 1].chi2))
        return;
    size_t i = *count < STRUM_IDENTIFY_SOLUTIONS_MAX ? (*count)++ : *count - 1;
    for (; i > 0 && fits[i - 1].chi2 > f->chi2; i--)
        fits[i] = fits[i - 1];
    fits[i] = *f;
}

strum_status scan_minima(const problem *p, fit *fits, size_t *count, size_t *minima)
{
    search *s = calloc(1, sizeof *s);
    fit *f = calloc(1, sizeof *f);
    strum_status status = s == NULL || f == NULL ? STRUM_ERR_MEMORY : STRUM_OK;
    *count = *minima = 0;
    if (status == STRUM_OK) {
        s->p = p;
        thin_out(s);
        status = sweep_all(s);
    }
    for (size_t i = 0; status == STRUM_OK && i < s->count; i++) {
        f->at = s->found[i].at;
        status = fit_descend(p, f);
        if (status == STRUM_OK)
            insert(fits, count, minima, f);
        if (status == STRUM_ERR_ACCURACY)
            status = STRUM_OK; /* this start leads nowhere */
    }
    free(s);
    free(f);
    return status == STRUM_OK && *count == 0 ? STRUM_ERR_ACCURACY : status;
}
