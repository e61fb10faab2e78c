/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "endpoints/absorber/solving.h"

#include <time.h>

static strum_status build(void *context, const double *values, strum_taut **chain,
                          strum_error *fault)
{
    const absorber_solving *s = context;
    const chain_variables x = {s->r->names, values, s->r->variables.count};
    return chain_make(&s->r->in, &x, chain, fault);
}

static double now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static bool out_of_time(void *context)
{
    absorber_solving *s = context;
    s->late = now_s() > s->deadline;
    return s->late || answer_cancelled(s->a);
}

void absorber_allow(absorber_solving *s, double seconds)
{
    s->late = false;
    s->deadline = now_s() + seconds;
}

static bool look_on(void *context, long evaluations, double best, const double *values)
{
    (void)values;
    absorber_solving *s = context;
    answer_progress(s->a, evaluations, best, "trials; largest smallest damping ratio");
    return !out_of_time(s);
}

void absorber_begin(absorber_solving *s, const absorber_request *r, answer *a)
{
    *s = (absorber_solving){.r = r, .a = a};
    s->options = (strum_options){.cancelled = out_of_time, .context = s};
    s->params = (strum_absorber_params){
        .variables = (int)r->variables.count,
        .lowest_values = r->low,
        .highest_values = r->high,
        .build = build,
        .context = s,
        .modes = r->modes.count > 0 ? r->mode_numbers : NULL,
        .mode_count = r->modes.count,
        .lowest = r->band[0],
        .highest = r->band[1],
        .max_evaluations = r->max_evaluations,
        .progress = look_on,
    };
    absorber_allow(s, r->time_limit_s);
}
