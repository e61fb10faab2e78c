/* SPDX-License-Identifier: GPL-3.0-or-later */
/* /v1/absorber/optimize: what varies in a taut chain is set so that the worst mode is damped
 * most (Levesque 1997, chapter 4). */
#include <math.h>
#include <stdio.h>

#include "endpoints/absorber/answer.h"
#include "endpoints/absorber/assess.h"
#include "endpoints/common/plausibility.h"

/* Damping ratios from here on, and distances from a border, that call for a word. */
#define NO_LONGER_OSCILLATES 0.999
#define BORDER               1e-4

/* What an engineer should know of a place that is not an optimum in the usual sense. */
static void warn_of_borders(const absorber_solving *s, const strum_absorber_optimum *best,
                            double frequency, size_t oscillating)
{
    const absorber_request *r = s->r;
    if (best->damping_ratio > NO_LONGER_OSCILLATES)
        answer_warn(s->a, "the least damped mode is all but overdamped here: beyond, it no "
                          "longer oscillates, and its damping ratio has no maximum");
    if (s->params.mode_count > oscillating)
        answer_warn(s->a,
                    "%zu of the %zu modes asked do not oscillate here (overdamped, or their "
                    "decay is beyond bounds) and do not limit",
                    s->params.mode_count - oscillating, s->params.mode_count);
    if (r->modes.count == 0 &&
        (frequency < r->band[0] * (1 + BORDER) || frequency > r->band[1] * (1 - BORDER)))
        answer_warn(s->a, "the least damped mode lies on the border of the band: a little "
                          "further it leaves the band and limits no longer");
}

/* The optimum, or the best so far at the time limit, and the roots there. */
static strum_status solve(absorber_solving *s, strum_absorber_optimum *best,
                          strum_taut_roots **roots, bool *late, strum_error *error)
{
    strum_status status = strum_absorber_solve(&s->params, &s->options, best, error);
    *late = s->late;
    if (status == STRUM_ERR_CANCELLED && *late && best->damping_ratio > 0)
        status = STRUM_OK;
    absorber_allow(s, INFINITY); /* the best so far is answered however long it takes */
    if (status == STRUM_OK)
        status = strum_absorber_roots(&s->params, &s->options, best->values, roots, error);
    if (answer_cancelled(s->a))
        return STRUM_ERR_CANCELLED;
    if (status == STRUM_ERR_CANCELLED) /* none so far: not a matter of this daemon */
        (void)snprintf(error->reason, sizeof error->reason,
                       "the time limit of %g s ended the search before any trial damped every "
                       "mode that was asked for",
                       s->r->time_limit_s);
    return status == STRUM_ERR_CANCELLED ? STRUM_ERR_IMPOSSIBLE : status;
}

static bool respond(const void *data, answer *a)
{
    const absorber_request *r = data;
    absorber_solving s;
    strum_error error = {0};
    strum_absorber_optimum best;
    strum_taut_roots *roots = NULL;
    bool late;
    a->theory = "exact transfer matrices of the chain (Levesque 1997), max-min of the damping "
                "ratio over all "
                "modes that were asked for";
    warn_chain(&r->in, a);
    absorber_begin(&s, r, a);
    if (r->assess) {
        a->theory = "exact transfer matrices of the chain (Levesque 1997); required damping by "
                    "Griffin's reduced damping";
        return absorber_assess(&s);
    }
    const strum_status status = solve(&s, &best, &roots, &late, &error);
    if (status != STRUM_OK) {
        strum_taut_roots_free(roots);
        chain_refuse(&r->in, &error, status, a->problem);
        if (status == STRUM_ERR_IMPOSSIBLE && !answer_cancelled(a))
            absorber_explain(&s);
        return false;
    }
    if (late) {
        a->transient = true;
        answer_warn(a, "the time limit of %g s ended the search: this is the best so far",
                    r->time_limit_s);
    } else if (!best.complete) {
        answer_warn(a, "max_evaluations (%lld) ended the search before it came to rest",
                    (long long)r->max_evaluations);
    }
    const int limiting = strum_absorber_limiting(roots);
    if (limiting >= 0) { /* what is answered is what the roots listed beside it say */
        const strum_taut_root *root = &roots->roots[limiting];
        best.damping_ratio = root->decay / hypot(root->frequency, root->decay);
        best.loss_ratio = root->decay / root->frequency;
    }
    warn_of_borders(&s, &best, limiting >= 0 ? roots->roots[limiting].frequency : NAN,
                    roots->count);
    const bool good = absorber_write(&s, &best, roots);
    strum_taut_roots_free(roots);
    return good;
}

const endpoint absorber_optimize = {
    .path = "/v1/absorber/optimize",
    .title = "The absorber that damps the worst mode of a taut chain most",
    .request = &absorber_schema,
    .variables = true,
    .prepare = absorber_prepare,
    .cost_us = absorber_cost_us,
    .solve_bytes = absorber_solve_bytes,
    .answer = respond,
};
