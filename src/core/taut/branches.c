/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Branches of one damped solve: followed from zero damping, told apart, put on its list. */
#include "core/taut/solve.h"

#include <stdlib.h>

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
            *branch = (taut_branch){k, 1.0, TAUT_OSCILLATES, {end, conj(end)}};
    }
}

/* Follows modes first..last, dropping what was followed before (`w`, `gap`: room for them). */
static strum_status follow(taut_solve *s, double *w, double *gap)
{
    const size_t count = (size_t)(s->last - s->first + 1);
    for (size_t i = 0; i < count; i++) {
        taut_branch *branch = &s->branches[i];
        taut_branch_start(branch, s->first + (long)i, w[i]);
        gap[i] = s->search.spacing;
        if (i > 0)
            gap[i] = fmin(gap[i], w[i] - w[i - 1]);
        if (i + 1 < count)
            gap[i] = fmin(gap[i], w[i + 1] - w[i]);
        gap[i] = fmax(gap[i], 0.2 * s->search.spacing);
        taut_branch_follow(&s->search, branch, gap[i], 1.0, 1.0);
    }
    part(s, w, gap);
    arrive(s);
    s->known = 0;
    strum_status status = taut_solve_reserve(s, 2 * count);
    for (size_t i = 0; i < count && status == STRUM_OK; i++) {
        const taut_branch *branch = &s->branches[i];
        for (int k = 0; k < branch_roots(branch); k++) {
            if (taut_known(s->s, s->known, branch->s[k],
                           TAUT_SAME * taut_solve_scale(s, branch->s[k])))
                continue;
            s->s[s->known] = branch->s[k];
            s->mode[s->known++] = branch->mode;
        }
    }
    if (s->search.status != STRUM_OK)
        return taut_solve_stopped(s);
    return status;
}

/* Follows the branches of modes first..last, as far as the chain has them. */
strum_status taut_solve_follow(taut_solve *s, long first, long last)
{
    const strum_taut *chain = s->search.chain;
    if (chain->travel == 0.0) { /* without cables there are only so many */
        taut_shot shot;
        taut_shoot(chain, 1e12 * s->search.spacing, &shot);
        last = last < shot.count ? last : shot.count;
    }
    s->first = first < 1 ? 1 : first;
    s->last = last > STRUM_TAUT_MODE_MAX ? STRUM_TAUT_MODE_MAX : last;
    if (s->last < s->first)
        s->last = s->first - 1; /* none */
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
            status = follow(s, w, w + count);
    }
    free(numbers);
    free(w);
    return status;
}
