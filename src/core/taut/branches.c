/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Branches of one damped solve: followed from zero damping, told apart, put on its list. */
#include "core/taut/solve.h"

#include <stdlib.h>

/* Modes looked at beyond those asked, so that a group is whole. */
#define EDGE (TAUT_CLUSTER_MAX - 1)
/* Steps of a branch of a group, before all of it is followed together. */
#define STEPS_IN_GROUP 150

/* Roots that a branch ends with. */
static int branch_roots(const taut_branch *branch)
{
    return branch->state == TAUT_LOST         ? 0
           : branch->state == TAUT_OSCILLATES ? 1
           : isfinite(creal(branch->s[1]))    ? 2
                                              : 1;
}

/* Does another branch end where this one does? */
static bool meets_another(const taut_solve *s, const taut_branch *branch)
{
    for (long k = s->first; k <= s->last; k++) {
        const taut_branch *other = &s->branches[k - s->first];
        if (other == branch || other->factor != 1.0)
            continue;
        for (int i = 0; i < branch_roots(branch); i++)
            if (taut_known(other->s, (size_t)branch_roots(other), branch->s[i],
                           TAUT_SAME * taut_solve_scale(s, branch->s[i])))
                return true;
    }
    return false;
}

/* Two branches with one end: one of them has changed over where roots pass each other closely.
 * Both are followed again with shorter steps; at a true double root they meet again. */
static void part(taut_solve *s, const double *w, const double *gap)
{
    for (double reach = 0.3; reach > 0.02; reach *= 0.3)
        for (long k = s->first; k <= s->last; k++) {
            taut_branch *branch = &s->branches[k - s->first];
            if (!meets_another(s, branch))
                continue;
            taut_branch again;
            taut_branch_start(&again, k, w[k - s->first]);
            taut_branch_follow(&s->search, &again, gap[k - s->first], 1.0, reach);
            *branch = again;
        }
}

/* Where branches coalesce at the full damping the last steps shrink to nothing: from so near
 * Newton's method has the rest of the way. */
static void arrive(taut_solve *s)
{
    for (long k = s->first; k <= s->last; k++) {
        taut_branch *branch = &s->branches[k - s->first];
        cplx end = branch->s[0];
        if (branch->state == TAUT_LOST && branch->factor > 1.0 - 1e-6 &&
            taut_newton(&s->search, &end) && cimag(end) > 0.0 &&
            cabs(end - branch->s[0]) < 1e-2 * s->search.spacing)
            *branch = (taut_branch){k, 1.0, TAUT_OSCILLATES, {end, conj(end)}, false};
    }
}

/* The modes from i on that lie so near each other that they may have to be followed together. */
static size_t group_at(const taut_solve *s, const double *w, size_t i, size_t count)
{
    size_t end = i + 1;
    while (end < count && w[end] - w[end - 1] <= TAUT_GROUP * s->search.spacing)
        end++;
    return end - i;
}

/* Groups of which a branch was lost, or ends where another does. `below` and `above`: the
 * frequencies next to all of them. */
static void follow_groups(taut_solve *s, const double *w, size_t count, double below,
                          double above)
{
    for (size_t i = 0, n; i < count; i += n) {
        n = group_at(s, w, i, count);
        bool whole = true;
        for (size_t k = i; k < i + n; k++)
            whole = whole && s->branches[k].state != TAUT_LOST &&
                    !meets_another(s, &s->branches[k]);
        if (n == 1 || whole || w[i] == 0.0)
            continue;
        double middle = 0.0;
        for (size_t k = i; k < i + n; k++)
            middle += w[k] / (double)n;
        const double under = i > 0 ? w[i - 1] : below;
        const double over_it = i + n < count ? w[i + n] : above;
        const double gap = fmin(s->search.spacing, fmin(w[i] - under, over_it - w[i + n - 1]));
        (void)taut_solve_group(s, &s->branches[i], (int)n, middle, gap);
    }
}

/* Puts the ends of all branches on the list. */
static strum_status list_ends(taut_solve *s, size_t count)
{
    s->known = 0;
    strum_status status = taut_solve_reserve(s, 2 * count);
    for (size_t i = 0; i < count && status == STRUM_OK; i++) {
        const taut_branch *branch = &s->branches[i];
        for (int k = 0; k < branch_roots(branch); k++) {
            s->s[s->known] = branch->s[k];
            s->mode[s->known++] = branch->mode;
        }
    }
    return status;
}

/* Follows modes first..last, dropping what was followed before (`w`, `gap`: room for them). */
static strum_status follow(taut_solve *s, double *w, double *gap, double below, double above)
{
    const size_t count = (size_t)(s->last - s->first + 1);
    for (size_t i = 0; i < count; i++) {
        taut_branch *branch = &s->branches[i];
        taut_branch_start(branch, s->first + (long)i, w[i]);
        const double down = w[i] - (i > 0 ? w[i - 1] : below),
                     up = (i + 1 < count ? w[i + 1] : above) - w[i];
        gap[i] = fmin(s->search.spacing, fmin(down, up));
        gap[i] = fmax(gap[i], 0.2 * s->search.spacing);
        /* in a group there is another way than to creep */
        const bool grouped = fmin(down, up) <= TAUT_GROUP * s->search.spacing;
        s->search.steps_max = grouped ? STEPS_IN_GROUP : 0;
        if (fmin(down, up) > TAUT_TWINS * w[i])
            taut_branch_follow(&s->search, branch, gap[i], 1.0, 1.0);
        else
            branch->state = TAUT_LOST; /* a double root: only as a group */
    }
    s->search.steps_max = 0;
    part(s, w, gap);
    follow_groups(s, w, count, below, above);
    arrive(s);
    strum_status status = list_ends(s, count);
    if (status == STRUM_OK)
        status = taut_solve_tell_apart(s);
    if (s->search.status != STRUM_OK)
        return taut_solve_stopped(s);
    return status;
}

/* What became of a branch. */
static strum_taut_fate fate_of(const taut_solve *s, const taut_branch *branch)
{
    bool on_axis = branch->state == TAUT_OVERDAMPED;
    for (size_t i = 0; i < s->known; i++)
        on_axis = on_axis || (s->mode[i] == branch->mode && cimag(s->s[i]) == 0.0);
    if (on_axis)
        return STRUM_TAUT_OVERDAMPED;
    return branch->state == TAUT_LOST && !branch->meets ? STRUM_TAUT_UNBOUNDED
                                                        : STRUM_TAUT_COALESCED;
}

strum_status taut_solve_note_missing(taut_solve *s, long first, long last)
{
    strum_status status = STRUM_OK;
    first = first < s->first ? s->first : first;
    last = last > s->last ? s->last : last;
    for (long k = first; k <= last && status == STRUM_OK; k++) {
        const taut_branch *branch = &s->branches[k - s->first];
        bool there = branch->state == TAUT_LOST && branch->s[0] == 0.0; /* a rigid motion */
        for (size_t i = 0; i < s->known && !there; i++)
            there = s->mode[i] == k && cimag(s->s[i]) > 0.0;
        if (!there)
            status = taut_roots_miss(
                s->out, (strum_taut_missing){k, fate_of(s, branch), branch->factor}, s->fault);
    }
    return status;
}

/* Frequencies of `count` modes from `first` on. */
static strum_status frequencies(taut_solve *s, long first, size_t count, double *w)
{
    strum_status status = STRUM_OK;
    long numbers[EDGE];
    for (size_t i = 0; i < count; i++)
        numbers[i] = first + (long)i;
    if (count > 0)
        status =
            taut_frequencies(s->search.chain, numbers, count, &s->search.work, w, s->fault);
    return status;
}

/* Widens first..last so that no group is cut, and finds the frequencies next to them. */
static strum_status widen(taut_solve *s, long most, double *below, double *above)
{
    double w[EDGE];
    const double near = TAUT_GROUP * s->search.spacing;
    const long low = s->first > EDGE ? s->first - EDGE + 1 : 1;
    const long high = s->last + EDGE - 1 < most ? s->last + EDGE - 1 : most;
    strum_status status = frequencies(s, low, (size_t)(s->first - low + 1), w);
    if (status != STRUM_OK)
        return status;
    long at = s->first;
    while (at > low && w[at - low] - w[at - 1 - low] <= near)
        at--;
    *below = at > low ? w[at - 1 - low] : at > 1 ? w[0] - s->search.spacing : -INFINITY;
    s->first = at;
    status = frequencies(s, s->last, (size_t)(high - s->last + 1), w);
    if (status != STRUM_OK)
        return status;
    at = s->last;
    while (at < high && w[at + 1 - s->last] - w[at - s->last] <= near)
        at++;
    *above = at < high ? w[at + 1 - s->last] : INFINITY;
    s->last = at;
    return STRUM_OK;
}

long taut_modes_most(const strum_taut *chain, double spacing)
{
    taut_shot shot;
    if (chain->travel > 0.0)
        return STRUM_TAUT_MODE_MAX;
    taut_shoot(chain, 1e12 * spacing, &shot); /* without cables there are only so many */
    return shot.count < STRUM_TAUT_MODE_MAX ? shot.count : STRUM_TAUT_MODE_MAX;
}

strum_status taut_solve_follow(taut_solve *s, long first, long last)
{
    const strum_taut *chain = s->search.chain;
    const long most = taut_modes_most(chain, s->search.spacing);
    s->first = first < 1 ? 1 : first;
    s->last = last > most ? most : last;
    double below = 0.0, above = INFINITY;
    if (s->last < s->first) {
        s->last = s->first - 1; /* none */
    } else {
        const strum_status status = widen(s, most, &below, &above);
        if (status != STRUM_OK)
            return status;
    }
    const size_t count = (size_t)(s->last - s->first + 1);
    if (count > 2 * STRUM_TAUT_ROOTS_MAX)
        return error_set(s->fault, STRUM_ERR_RANGE, "more than %d modes to follow",
                         2 * STRUM_TAUT_ROOTS_MAX);
    free(s->branches);
    s->branches = calloc(count + 1, sizeof *s->branches);
    long *numbers = malloc((count + 1) * sizeof *numbers);
    double *w = malloc((2 * count + 1) * sizeof *w);
    strum_status status = STRUM_OK;
    if (s->branches == NULL || numbers == NULL || w == NULL) {
        status = taut_solve_no_memory(s);
    } else {
        for (size_t i = 0; i < count; i++)
            numbers[i] = s->first + (long)i;
        status = taut_frequencies(chain, numbers, count, &s->search.work, w, s->fault);
        if (status == STRUM_OK)
            status = follow(s, w, w + count, below, above);
    }
    free(numbers);
    free(w);
    return status;
}
