/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One trial of a search: from a place to values, to a chain, to its roots and the least damped
 * of them. */
#include "core/absorber/search.h"

#include <math.h>
#include <string.h>

/* A variable whose bounds differ by more is searched by its logarithm. */
#define LOG_RANGE 30.0
/* Estimated time of one evaluation of the objective, in microseconds. */
#define EVALUATION_US 300

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

void search_values(const strum_absorber_params *p, const double *t, double *values)
{
    for (int i = 0; i < p->variables; i++) {
        const double low = p->lowest_values[i], high = p->highest_values[i];
        values[i] = low == 0 && t[i] > 0 && t[i] < 1 ? from_zero(high, t[i])
                                                     : strum_absorber_scale(low, high, t[i]);
    }
}

/* What is left of the work for one trial. */
static strum_options rest_of(const work *w)
{
    strum_options rest = w->options;
    if (rest.work_max > 0)
        rest.work_max = fmax(rest.work_max - w->done, 1);
    return rest;
}

static strum_status roots_of(const strum_absorber_params *p, const strum_options *options,
                             const strum_taut *chain, const strum_taut_roots *guesses,
                             strum_taut_roots **roots, strum_error *error)
{
    strum_taut_query query = {.numbers = p->modes,
                              .count = p->modes != NULL ? p->mode_count : 0,
                              .lowest = p->lowest,
                              .highest = p->highest};
    if (p->modes == NULL) {
        query.max_decay = STRUM_ABSORBER_DECAY * p->highest;
        if (guesses != NULL) {
            query.guesses = guesses->roots;
            query.guess_count = guesses->count;
        }
    }
    return strum_taut_solve(chain, &query, options, roots, error);
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

strum_status strum_absorber_roots(const strum_absorber_params *p, const strum_options *options,
                                  const double *values, strum_taut_roots **roots,
                                  strum_error *error)
{
    strum_taut *chain = NULL;
    strum_status status = p->build(p->context, values, &chain, error);
    if (status == STRUM_OK)
        status = roots_of(p, options, chain, NULL, roots, error);
    strum_taut_free(chain);
    return status;
}

void search_count(search *s)
{
    const strum_absorber_params *p = s->params;
    double values[STRUM_ABSORBER_VARIABLES_MAX];
    s->evaluations++;
    if (work_spend(&s->work, EVALUATION_US) != STRUM_OK)
        s->stopped = true;
    search_values(p, s->best_at, values);
    if (s->evaluations >= s->limit ||
        (p->progress != NULL && !p->progress(p->context, s->evaluations, s->best, values)))
        s->stopped = true;
}

static void note_status(search *s, strum_status status)
{
    if (status == STRUM_ERR_MEMORY || status == STRUM_ERR_INTERNAL)
        s->broken = status;
    if (status == STRUM_ERR_CANCELLED || status == STRUM_ERR_WORK) {
        s->stopped = true;
        s->work.status = status; /* and all further work is refused */
    }
}

strum_taut *search_chain(search *s, const double *t)
{
    double values[STRUM_ABSORBER_VARIABLES_MAX];
    strum_taut *chain = NULL;
    search_values(s->params, t, values);
    note_status(s, s->params->build(s->params->context, values, &chain, s->error));
    return chain;
}

strum_taut_roots *search_roots(search *s, const double *t, double beyond)
{
    strum_absorber_params wider = *s->params;
    const strum_options rest = rest_of(&s->work);
    strum_taut_roots *roots = NULL;
    strum_taut *chain = search_chain(s, t);
    if (chain == NULL)
        return NULL;
    wider.lowest = fmax(wider.lowest - beyond, 0.5 * wider.lowest);
    wider.highest += beyond;
    note_status(s, roots_of(&wider, &rest, chain, s->last, &roots, s->error));
    strum_taut_free(chain);
    return roots;
}

/* The smallest damping ratio at one trial. A trial that cannot be answered counts as undamped:
 * a search may pass by, it may not end there. */
double search_trial(search *s, const double *t)
{
    const strum_absorber_params *p = s->params;
    const strum_options rest = rest_of(&s->work);
    double objective = 0;
    if (!search_goes_on(s))
        return 0;
    strum_taut *chain = search_chain(s, t);
    strum_taut_roots *roots = NULL;
    if (chain != NULL)
        note_status(s, roots_of(p, &rest, chain, s->last, &roots, s->error));
    strum_taut_free(chain);
    if (roots != NULL) {
        const int limiting = strum_absorber_limiting(roots);
        objective = limiting >= 0 ? damping_ratio(&roots->roots[limiting]) : 0;
        s->answered = true;
        s->met = s->met || limiting >= 0;
        strum_taut_roots_free(s->last);
        s->last = roots;
    }
    if (objective > s->best) {
        s->best = objective;
        memcpy(s->best_at, t, (size_t)p->variables * sizeof *t);
    }
    search_count(s);
    return objective;
}
