/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Roots of a chain: the modes asked by number, or a band. Without damping the mode count does
 * it all. With damping the branches of the modes asked and of their neighbours are followed;
 * the argument principle counts what the band really holds, and what is missing is searched
 * for.
 */
#include "core/taut/solve.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

/* rad/s: their squares, with masses and lengths, stay within doubles. */
#define FREQUENCY_MIN 1e-120
#define FREQUENCY_MAX 1e120

/* ---- undamped chains ---- */

static strum_status undamped(taut_solve *s, const long *numbers, size_t count)
{
    const strum_taut *chain = s->search.chain;
    strum_taut_roots *out = s->out;
    out->count_method = "signed shooting count";
    if (count == 0)
        return STRUM_OK;
    double *w = malloc(count * sizeof *w);
    if (w == NULL)
        return error_set(s->fault, STRUM_ERR_MEMORY, "no memory for %zu modes", count);
    strum_status status = taut_frequencies(chain, numbers, count, &s->search.work, w, s->fault);
    for (size_t i = 0; i < count && status == STRUM_OK; i++) {
        taut_shot below = {.count = 0}, above, there;
        taut_shoot(chain, w[i] > 0.0 ? w[i] * (1.0 + 1e-10) : 1e-30, &above);
        if (w[i] > 0.0) {
            taut_shoot(chain, w[i] * (1.0 - 1e-10), &below);
            taut_shoot(chain, w[i], &there);
            out->max_residual = fmax(out->max_residual, fabs(there.f / there.df) / w[i]);
        }
        out->evaluations += 3;
        out->expected++;
        out->found += below.count < numbers[i] && numbers[i] <= above.count;
        status = taut_roots_add(s->out, (strum_taut_root){numbers[i], w[i], 0.0, INFINITY, 0.0},
                                false, s->fault);
        if (status == STRUM_OK &&
            work_spend(&s->search.work, 3 * taut_shot_us(chain)) != STRUM_OK)
            status = work_error(&s->search.work, s->fault);
    }
    if (status == STRUM_OK && out->found != out->expected)
        status = error_set(s->fault, STRUM_ERR_ACCURACY,
                           "the count confirms %ld of %ld modes only: the components differ by "
                           "more than doubles resolve",
                           out->found, out->expected);
    if (status == STRUM_OK && !(out->highest > 0.0)) {
        out->lowest = w[0];
        out->highest = w[count - 1];
    }
    free(w);
    return status;
}

/* Modes first.. first + count - 1. */
static strum_status undamped_run(taut_solve *s, long first, size_t count)
{
    long *numbers = malloc((count + 1) * sizeof *numbers);
    if (numbers == NULL)
        return error_set(s->fault, STRUM_ERR_MEMORY, "no memory for %zu modes", count);
    for (size_t i = 0; i < count; i++)
        numbers[i] = first + (long)i;
    const strum_status status = undamped(s, numbers, count);
    free(numbers);
    return status;
}

/* Places are mode numbers. */
static strum_status undamped_places(taut_solve *s)
{
    return undamped_run(s, s->query->first, s->query->wanted);
}

static strum_status undamped_band(taut_solve *s)
{
    const strum_taut *chain = s->search.chain;
    const long below = strum_taut_count(chain, s->query->lowest);
    const long last = strum_taut_count(chain, s->query->highest);
    const size_t count = (size_t)(last - below);
    s->out->lowest = s->query->lowest;
    s->out->highest = s->query->highest;
    s->out->max_decay = s->query->max_decay;
    if (last - below > STRUM_TAUT_ROOTS_MAX || last > STRUM_TAUT_MODE_MAX)
        return error_set(s->fault, STRUM_ERR_RANGE, "the band holds %ld modes, more than %d",
                         last - below, STRUM_TAUT_ROOTS_MAX);
    return undamped_run(s, below + 1, count);
}

static strum_status check_query(const strum_taut *chain, const strum_taut_query *q,
                                strum_error *fault)
{
    if (!chain->moves)
        return error_set(fault, STRUM_ERR_IMPOSSIBLE,
                         "a chain that moves needs a cable or a body with a length");
    if (q->count > STRUM_TAUT_ROOTS_MAX)
        return error_set(fault, STRUM_ERR_RANGE, "at most %d modes at once",
                         STRUM_TAUT_ROOTS_MAX);
    for (size_t i = 0; i < q->count; i++)
        if (q->numbers[i] < 1 || q->numbers[i] > STRUM_TAUT_MODE_MAX ||
            (i > 0 && q->numbers[i] <= q->numbers[i - 1]))
            return error_set(fault, STRUM_ERR_RANGE,
                             "mode numbers must ascend and lie within 1 and %d",
                             STRUM_TAUT_MODE_MAX);
    const bool band = q->count == 0 && q->wanted == 0;
    if (q->count == 0 && q->wanted > 0 &&
        (q->wanted > STRUM_TAUT_ROOTS_MAX || q->first < 1 ||
         q->first > STRUM_TAUT_MODE_MAX - (long)q->wanted + 1))
        return error_set(fault, STRUM_ERR_RANGE,
                         "at most %d roots at once, at places within 1 and %d",
                         STRUM_TAUT_ROOTS_MAX, STRUM_TAUT_MODE_MAX);
    if (band && !(q->lowest > 0.0 && q->highest > q->lowest && isfinite(q->highest)))
        return error_set(fault, STRUM_ERR_RANGE, "a band needs 0 < lowest < highest");
    if (!(q->max_decay >= 0.0) || !isfinite(q->max_decay) || (band && q->max_decay == 0.0))
        return error_set(fault, STRUM_ERR_RANGE, "the largest decay must be positive");
    return STRUM_OK;
}

strum_status taut_frequency_fits(double frequency, strum_error *error)
{
    return frequency == 0.0 || (frequency >= FREQUENCY_MIN && frequency <= FREQUENCY_MAX)
               ? STRUM_OK
               : error_set(error, STRUM_ERR_RANGE,
                           "a mode has %.3g rad/s: nothing is answered beyond %g and %g",
                           frequency, FREQUENCY_MIN, FREQUENCY_MAX);
}

strum_status strum_taut_solve(const strum_taut *chain, const strum_taut_query *query,
                              const strum_options *options, strum_taut_roots **roots,
                              strum_error *fault)
{
    *roots = NULL;
    strum_status status = check_query(chain, query, fault);
    if (status != STRUM_OK)
        return status;
    strum_taut_roots *out = calloc(1, sizeof *out);
    if (out == NULL)
        return error_set(fault, STRUM_ERR_MEMORY, "no memory for roots");
    taut_solve s = {.search = {.chain = chain, .work = work_begin(options)},
                    .query = query,
                    .out = out,
                    .fault = fault};
    if (chain->damped)
        status = taut_solve_damped(&s);
    else if (query->count > 0)
        status = undamped(&s, query->numbers, query->count);
    else if (query->wanted > 0)
        status = undamped_places(&s);
    else
        status = undamped_band(&s);
    if (status == STRUM_OK && query->method == STRUM_TAUT_MULLER)
        status = taut_solve_muller(&s);
    for (size_t i = 0; i < out->count && status == STRUM_OK; i++)
        status = taut_frequency_fits(out->roots[i].frequency, fault);
    if (status == STRUM_OK)
        taut_roots_sort(out, query->count == 0);
    out->evaluations += s.search.evaluations;
    taut_solve_clear(&s);
    if (status == STRUM_OK)
        *roots = out;
    else
        strum_taut_roots_free(out);
    return status;
}
