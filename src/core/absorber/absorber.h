/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the search over the whole range (absorber.c) and the climb from one place
 * (absorber_climb.c) share. Places are shares t in 0..1 of the variables' ranges. */
#ifndef CORE_ABSORBER_ABSORBER_H
#define CORE_ABSORBER_ABSORBER_H

#include <strum/absorber.h>

typedef struct search {
    const strum_absorber_problem *problem;
    long evaluations, limit;
    double best, best_at[STRUM_ABSORBER_VARIABLES_MAX];
    bool stopped;        /* by progress or the budget */
    strum_status broken; /* an error that ends everything */
    strum_error *fault;
    strum_taut_roots *last; /* of the trial before: guesses for the next */
    bool answered, met;     /* some trial gave roots; some had a mode among them */
} search;

static inline bool search_goes_on(const search *s)
{
    return !s->stopped && s->broken == STRUM_OK;
}

/* The chain at a place; NULL where none can exist. */
strum_taut *search_chain(search *s, const double *t);
/* One evaluation more: tells progress, keeps the budget. */
void search_count(search *s);
/* The objective. */
double search_trial(search *s, const double *t);
/* The roots about a place, for a band with those up to `beyond` outside it; NULL: unknown. */
strum_taut_roots *search_roots(search *s, const double *t, double beyond);

/* From `t` to the best place near, in at most `rounds` rounds, the first within `reach` of
 * `t`; ends where a round gains less than `gain` of what there is. */
double absorber_climb(search *s, double *t, double reach, int rounds, double gain);

#endif
