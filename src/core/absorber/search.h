/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the search over the whole range (optimise.c) and the climb from one place (climb.c)
 * stand on: trials, and what has come of them so far. Places are shares t in 0..1 of the
 * variables' ranges. */
#ifndef CORE_ABSORBER_SEARCH_H
#define CORE_ABSORBER_SEARCH_H

#include <strum/absorber.h>

#include "core/numerics/work.h"

typedef struct search {
    const strum_absorber_params *params;
    work work;
    long evaluations, limit;
    double best, best_at[STRUM_ABSORBER_VARIABLES_MAX];
    bool stopped;        /* by progress, the options or the limit of evaluations */
    strum_status broken; /* an error that ends everything */
    strum_error *error;
    strum_taut_roots *last; /* of the trial before: guesses for the next */
    bool answered, met;     /* some trial gave roots; some had a mode among them */
} search;

static inline bool search_goes_on(const search *s)
{
    return !s->stopped && s->broken == STRUM_OK;
}

/* Values of the variables at a place. */
void search_values(const strum_absorber_params *p, const double *t, double *values);
/* The chain at a place; NULL where none can exist. */
strum_taut *search_chain(search *s, const double *t);
/* One evaluation more: tells progress, keeps the limits. */
void search_count(search *s);
/* The objective. */
double search_trial(search *s, const double *t);
/* The roots about a place, for a band with those up to `beyond` outside it; NULL: unknown. */
strum_taut_roots *search_roots(search *s, const double *t, double beyond);

#endif
