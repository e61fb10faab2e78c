/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Damped roots of one solve: branches followed, bands counted, missing roots found. */
#include "core/taut/solve.h"

#include <float.h>
#include <stdlib.h>

static strum_status solve_band(taut_solve *s)
{
    const strum_taut_query *q = s->query;
    const strum_taut *chain = s->search.chain;
    const long margin = 1 + chain->dampers;
    const long below = strum_taut_count(chain, q->lowest);
    const long last = strum_taut_count(chain, q->highest);
    taut_rectangle box = taut_solve_box(s, q->lowest, q->highest, q->max_decay);
    if (last - below > STRUM_TAUT_ROOTS_MAX)
        return error_set(s->fault, STRUM_ERR_RANGE, "the band holds %ld modes, more than %d",
                         last - below, STRUM_TAUT_ROOTS_MAX);
    if (last > STRUM_TAUT_MODE_MAX)
        return error_set(s->fault, STRUM_ERR_RANGE,
                         "the band reaches mode %ld; modes to %d can be followed", last,
                         STRUM_TAUT_MODE_MAX);
    strum_status status = taut_solve_follow(s, below + 1 - margin, last + margin);
    if (status == STRUM_OK)
        status = taut_solve_complete(s, &box, &s->out->expected, &s->out->found);
    for (size_t i = 0; i < s->known && status == STRUM_OK; i++)
        if (taut_inside(&box, s->s[i]) && cimag(s->s[i]) > 0.0)
            status = taut_solve_give(s, i, false);
    if (status == STRUM_OK)
        status = taut_solve_note_missing(s, below + 1, last);
    s->out->lowest = fmax(box.im_lo, 0.0);
    s->out->highest = box.im_hi;
    s->out->max_decay = -box.re_lo;
    return status == STRUM_OK ? taut_solve_axis(s, box.im_lo, s->out->max_decay) : status;
}

/* Borders of a run: half way from its outermost roots to the next ones known beyond. */
static taut_rectangle run_box(taut_solve *s, long first, long last)
{
    double lo = INFINITY, hi = 0.0, decay = 0.0, under = 0.0, above = INFINITY,
           least = INFINITY;
    for (size_t i = 0; i < s->known; i++) {
        const double w = cimag(s->s[i]);
        if (w == 0.0)
            continue;
        least = fmin(least, w);
        if (s->mode[i] < first || s->mode[i] > last)
            continue;
        lo = fmin(lo, w);
        hi = fmax(hi, w);
        decay = fmax(decay, -creal(s->s[i]));
    }
    for (size_t i = 0; i < s->known; i++) {
        const double w = cimag(s->s[i]);
        if (w < lo)
            under = fmax(under, w);
        if (w > hi)
            above = fmin(above, w);
    }
    if (s->query->max_decay > 0.0)
        decay = s->query->max_decay;
    else
        decay = 1.5 * decay + 0.5 * s->search.spacing;
    const double spacing = s->search.spacing;
    const double from =
        first == 1 ? 0.5 * fmin(least, spacing) : lo - 0.5 * fmin(lo - under, spacing);
    return taut_solve_box(s, from, hi + 0.5 * fmin(above - hi, spacing), decay);
}

static strum_status solve_run(taut_solve *s, long first, long last)
{
    strum_taut_roots *out = s->out;
    const long margin = 1 + s->search.chain->dampers;
    strum_status status = taut_solve_follow(s, first - margin, last + margin);
    if (status != STRUM_OK)
        return status;
    long running = 0;
    for (size_t i = 0; i < s->known; i++)
        running += s->mode[i] >= first && s->mode[i] <= last && cimag(s->s[i]) > 0.0;
    taut_rectangle box = run_box(s, first, last);
    if (running > 0) {
        long expected = 0, found = 0;
        status = taut_solve_complete(s, &box, &expected, &found);
        if (status != STRUM_OK)
            return status;
        out->expected += expected;
        out->found += found;
        out->lowest = out->highest > 0.0 ? out->lowest : fmax(box.im_lo, 0.0);
        out->highest = box.im_hi;
        out->max_decay = fmax(out->max_decay, -box.re_lo);
    }
    for (long k = first; k <= last && status == STRUM_OK; k++) {
        if (k > s->last)
            return error_set(s->fault, STRUM_ERR_IMPOSSIBLE, "the chain has only %ld modes",
                             s->last);
        if (s->branches[k - s->first].state == TAUT_LOST) {
            const bool rigid = s->branches[k - s->first].s[0] == 0.0;
            if (rigid)
                status = taut_roots_add(s->out, (strum_taut_root){k, 0.0, 0.0, INFINITY, 0.0},
                                        false, s->fault);
        }
        for (size_t i = 0; i < s->known && status == STRUM_OK; i++)
            if (s->mode[i] == k && cimag(s->s[i]) > 0.0)
                status = taut_solve_give(s, i, false);
    }
    if (status == STRUM_OK)
        status = taut_solve_note_missing(s, first, last);
    if (status == STRUM_OK && first == s->query->numbers[0])
        status =
            taut_solve_axis(s, running > 0 ? box.im_lo : 0.25 * s->search.spacing, -box.re_lo);
    else if (status == STRUM_OK)
        status = taut_solve_give_overdamped(s, 0.0);
    return status;
}

/* Roots of a similar chain lead to all that the count expects, or nothing is given out; the
 * roots alone, for searches that come by often. */
static strum_status solve_by_guesses(taut_solve *s, bool *done)
{
    const strum_taut_query *q = s->query;
    taut_rectangle box = taut_solve_box(s, q->lowest, q->highest, q->max_decay);
    *done = false;
    strum_status status = taut_solve_reserve(s, q->guess_count);
    if (status == STRUM_OK)
        status = taut_solve_count(s, &box, &s->out->expected);
    if (status != STRUM_OK)
        return status;
    for (size_t i = 0; i < q->guess_count; i++) {
        cplx root = CMPLX(-q->guesses[i].decay, q->guesses[i].frequency);
        if (!taut_newton(&s->search, &root))
            continue;
        if (cimag(root) <
            0.0) /* it may have crossed the axis: the same root as its conjugate */
            root = conj(root);
        if (taut_known(s->s, s->known, root, TAUT_SAME * taut_solve_scale(s, root)))
            continue;
        s->s[s->known] = root;
        s->mode[s->known++] = q->guesses[i].mode;
    }
    s->out->found = taut_solve_inside(s, &box);
    if (s->search.status != STRUM_OK)
        return taut_solve_stopped(s);
    if (s->out->found != s->out->expected)
        return STRUM_OK;
    for (size_t i = 0; i < s->known && status == STRUM_OK; i++)
        if (taut_inside(&box, s->s[i]))
            status = taut_roots_add(s->out, taut_solve_plain(s, i), false, s->fault);
    s->out->lowest = fmax(box.im_lo, 0.0);
    s->out->highest = box.im_hi;
    s->out->max_decay = -box.re_lo;
    *done = status == STRUM_OK;
    return status;
}

strum_status taut_solve_damped(taut_solve *s)
{
    const strum_taut_query *q = s->query;
    s->search.spacing = taut_spacing(s->search.chain);
    s->out->count_method = "argument principle";
    if (q->count == 0 && q->wanted > 0)
        return taut_solve_places(s);
    if (q->count == 0) {
        bool done = false;
        strum_status status = STRUM_OK;
        if (q->guess_count > 0)
            status = solve_by_guesses(s, &done);
        return status != STRUM_OK || done ? status : solve_band(s);
    }
    strum_status status = STRUM_OK;
    for (size_t i = 0, end; i < q->count && status == STRUM_OK; i = end) {
        for (end = i + 1; end < q->count && q->numbers[end] == q->numbers[end - 1] + 1;)
            end++;
        status = solve_run(s, q->numbers[i], q->numbers[end - 1]);
    }
    return status;
}
