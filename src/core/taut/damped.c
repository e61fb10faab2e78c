/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Damped roots of one solve: branches followed, bands counted, missing roots found. */
#include "core/taut/solve.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

/* A root is itself to this share of its size. */
#define SAME 1e-9

static double scale_of(const taut_solve *s, cplx root)
{
    /* slow overdamped roots crowd about 0 when a damper is strong */
    return cimag(root) == 0.0 ? cabs(root) : cabs(root) + 1e-3 * s->search.spacing;
}

static strum_status no_memory(taut_solve *s)
{
    return error_set(s->fault, STRUM_ERR_MEMORY, "no memory for damped roots");
}

static strum_status stopped(taut_solve *s)
{
    return s->search.status == s->search.work.status
               ? work_error(&s->search.work, s->fault)
               : error_set(s->fault, s->search.status,
                           "the roots were not all found within the work allowed; ask fewer "
                           "modes or a narrower band");
}

/* Room for `more` further roots. */
static strum_status reserve(taut_solve *s, size_t more)
{
    if (s->known + more <= s->room)
        return STRUM_OK;
    const size_t room = 2 * s->room + more;
    cplx *roots = realloc(s->s, room * sizeof *roots);
    if (roots == NULL)
        return no_memory(s);
    s->s = roots;
    long *modes = realloc(s->mode, room * sizeof *modes);
    if (modes == NULL)
        return no_memory(s);
    s->mode = modes;
    s->room = room;
    return STRUM_OK;
}

void taut_solve_clear(taut_solve *s)
{
    free(s->s);
    free(s->mode);
    free(s->branches);
}

/* ---- branches ---- */

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
                           SAME * scale_of(s, branch->s[i])))
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
    strum_status status = reserve(s, 2 * count);
    for (size_t i = 0; i < count && status == STRUM_OK; i++) {
        const taut_branch *branch = &s->branches[i];
        for (int k = 0; k < branch_roots(branch); k++) {
            if (taut_known(s->s, s->known, branch->s[k], SAME * scale_of(s, branch->s[k])))
                continue;
            s->s[s->known] = branch->s[k];
            s->mode[s->known++] = branch->mode;
        }
    }
    if (s->search.status != STRUM_OK)
        return stopped(s);
    return status;
}

/* Follows the branches of modes first..last, as far as the chain has them. */
static strum_status follow_modes(taut_solve *s, long first, long last)
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
        status = no_memory(s);
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

/* ---- counting ---- */

static long known_inside(const taut_solve *s, const taut_rectangle *box)
{
    long count = 0;
    for (size_t i = 0; i < s->known; i++)
        count += taut_inside(box, s->s[i]) +
                 (cimag(s->s[i]) != 0.0 && taut_inside(box, conj(s->s[i])));
    return count;
}

/* Counts the zeros in the box, moving its borders a little outwards when one lies on them. */
static strum_status count_box(taut_solve *s, taut_rectangle *box, long *expected)
{
    const taut_rectangle given = *box;
    for (int k = 0; k < 6; k++) {
        *expected = taut_count_zeros(&s->search, box);
        if (s->search.status != STRUM_OK)
            return stopped(s);
        if (*expected >= 0)
            return STRUM_OK;
        const double out = ldexp(1e-7, 3 * k) * s->search.spacing;
        box->re_lo = given.re_lo - out;
        box->im_hi = given.im_hi + out;
        box->im_lo = given.im_lo == -given.im_hi ? -box->im_hi : given.im_lo - out;
    }
    return error_set(s->fault, STRUM_ERR_ACCURACY,
                     "the roots of the band could not be counted: one lies on its border");
}

/* The mode of a root that was searched for: where two branches coalesce at the full damping no
 * step leads to their end, which is told by its being near. Else 0. */
static long mode_near(const taut_solve *s, cplx root)
{
    double nearest = 1e-2 * s->search.spacing;
    long mode = 0;
    for (long k = s->first; k <= s->last; k++) {
        const double apart = cabs(s->branches[k - s->first].s[0] - root);
        bool led = false;
        for (size_t i = 0; i < s->known; i++)
            led = led || s->mode[i] == k;
        if (!led && apart < nearest) {
            nearest = apart;
            mode = k;
        }
    }
    return mode;
}

/* Of the roots in a box those it is not asked for: near the axis what oscillates, and in a band
 * whose border moved over the axis what does not, and conjugates. */
static long not_asked_inside(const taut_solve *s, const taut_rectangle *box)
{
    const bool near_axis = box->im_lo == -box->im_hi;
    long count = 0;
    for (size_t i = 0; i < s->known && box->im_lo < 0.0; i++) {
        const long here = taut_inside(box, s->s[i]);
        if (cimag(s->s[i]) == 0.0)
            count += near_axis ? 0 : here;
        else
            count += (near_axis ? here : 0) + taut_inside(box, conj(s->s[i]));
    }
    return count;
}

/* Counts, and searches for what the branches did not lead to. */
static strum_status complete(taut_solve *s, taut_rectangle *box, long *expected, long *found)
{
    strum_status status = count_box(s, box, expected);
    if (status != STRUM_OK)
        return status;
    const long known = known_inside(s, box);
    if (known < *expected) {
        const size_t before = s->known;
        if (*expected > 4 * STRUM_TAUT_ROOTS_MAX)
            return error_set(s->fault, STRUM_ERR_RANGE, "the band holds more than %d roots",
                             STRUM_TAUT_ROOTS_MAX);
        status = reserve(s, (size_t)(*expected - known));
        if (status != STRUM_OK)
            return status;
        taut_find_missing(&s->search, box, *expected, s->s, &s->known, s->room);
        for (size_t i = before; i < s->known; i++)
            s->mode[i] = 0;
        for (size_t i = before; i < s->known; i++)
            s->mode[i] = mode_near(s, s->s[i]);
    }
    *found = known_inside(s, box);
    if (s->search.status != STRUM_OK)
        return stopped(s);
    if (*found != *expected)
        return error_set(s->fault, STRUM_ERR_ACCURACY,
                         "the count expects %ld roots, %ld were found", *expected, *found);
    const long more = not_asked_inside(s, box);
    *expected -= more;
    *found -= more;
    return STRUM_OK;
}

static taut_rectangle box_of(const taut_solve *s, double lowest, double highest, double decay)
{
    /* all roots have Re s <= 0: half a spacing off the axis F is smooth */
    return (taut_rectangle){-decay, 0.5 * s->search.spacing, lowest, highest};
}

/* ---- giving out ---- */

/* At which relative change of the damping a root meets its nearest neighbour (or its
 * conjugate): the squared distance of two roots is smooth in the damping, (s1 - s2)^2 / (its
 * rate). */
static double exceptional(taut_solve *s, size_t i)
{
    const cplx a = s->s[i];
    cplx b = conj(a);
    double nearest = cimag(a) != 0.0 ? 2.0 * fabs(cimag(a)) : INFINITY, unused;
    for (size_t k = 0; k < s->known; k++)
        if (k != i && cabs(s->s[k] - a) < nearest) {
            nearest = cabs(s->s[k] - a);
            b = s->s[k];
        }
    if (!(nearest < 0.2 * s->search.spacing))
        return INFINITY;
    const cplx apart =
        taut_speed(&s->search, a, 1.0, &unused) - taut_speed(&s->search, b, 1.0, &unused);
    return apart == 0.0 ? INFINITY : 0.5 * nearest / cabs(apart);
}

static strum_taut_root plain_root(const taut_solve *s, size_t i)
{
    const double frequency = cimag(s->s[i]), decay = -creal(s->s[i]);
    /* what is only rounding is none: even modes pass by their absorbers */
    return (strum_taut_root){s->mode[i], frequency, decay < 4e-15 * frequency ? 0.0 : decay,
                             INFINITY};
}

static strum_status give(taut_solve *s, size_t i, bool overdamped)
{
    const cplx root = s->s[i];
    strum_taut_root out = plain_root(s, i);
    const taut_value value = taut_search_value(&s->search, root);
    if (value.f != 0.0)
        s->out->max_residual =
            fmax(s->out->max_residual, cabs(over(value.f, value.d)) / scale_of(s, root));
    out.exceptional = exceptional(s, i);
    return taut_roots_add(s->out, out, overdamped, s->fault);
}

/* Overdamped roots: all that are known on the axis within `decay`, and those of modes asked. */
static strum_status give_overdamped(taut_solve *s, double decay)
{
    strum_status status = STRUM_OK;
    for (size_t i = 0; i < s->known && status == STRUM_OK; i++) {
        const double rate = -creal(s->s[i]);
        bool asked = rate <= decay;
        for (size_t k = 0; k < s->query->count; k++)
            asked = asked || s->query->numbers[k] == s->mode[i];
        bool given = false; /* by another run of numbers */
        for (size_t k = 0; k < s->out->overdamped_count; k++)
            given = given || fabs(s->out->overdamped[k].decay - rate) <= SAME * rate;
        if (cimag(s->s[i]) == 0.0 && asked && !given && rate > 0.0)
            status = give(s, i, true);
    }
    return status;
}

/* ---- a band, and a run of numbers ---- */

/* Rigid motions are zeros at s = 0: one where a damper resists them, two where none does. */
static int zeros_at_origin(const strum_taut *chain)
{
    taut_rigid rigid = {.loose = chain->free_left && chain->free_right};
    for (size_t i = 0; i < chain->count; i++)
        if (chain->components[i].model->rigid != NULL)
            chain->components[i].model->rigid(&chain->components[i], &rigid);
    return rigid.zeros + (rigid.loose ? (rigid.resisted ? 1 : 2) : 0);
}

static strum_status solve_axis(taut_solve *s, double lowest, double decay)
{
    const double half = fmin(lowest > 0.0 ? lowest : INFINITY, 0.25 * s->search.spacing);
    taut_rectangle box = box_of(s, -half, half, decay);
    const int rigid = zeros_at_origin(s->search.chain);
    strum_status status = reserve(s, (size_t)rigid);
    for (int i = 0; i < rigid && status == STRUM_OK; i++) {
        s->s[s->known] = 0.0;
        s->mode[s->known++] = 0;
    }
    if (status == STRUM_OK)
        status = complete(s, &box, &s->out->axis_expected, &s->out->axis_found);
    return status == STRUM_OK ? give_overdamped(s, decay) : status;
}

static strum_status solve_band(taut_solve *s)
{
    const strum_taut_query *q = s->query;
    const strum_taut *chain = s->search.chain;
    const long margin = 1 + chain->dampers;
    const long below = strum_taut_count(chain, q->lowest);
    const long last = strum_taut_count(chain, q->highest);
    taut_rectangle box = box_of(s, q->lowest, q->highest, q->max_decay);
    if (last - below > STRUM_TAUT_ROOTS_MAX)
        return error_set(s->fault, STRUM_ERR_RANGE, "the band holds %ld modes, more than %d",
                         last - below, STRUM_TAUT_ROOTS_MAX);
    if (last > STRUM_TAUT_MODE_MAX)
        return error_set(s->fault, STRUM_ERR_RANGE,
                         "the band reaches mode %ld; modes to %d can be followed", last,
                         STRUM_TAUT_MODE_MAX);
    strum_status status = follow_modes(s, below + 1 - margin, last + margin);
    if (status == STRUM_OK)
        status = complete(s, &box, &s->out->expected, &s->out->found);
    for (size_t i = 0; i < s->known && status == STRUM_OK; i++)
        if (taut_inside(&box, s->s[i]) && cimag(s->s[i]) > 0.0)
            status = give(s, i, false);
    for (long k = s->first; k <= s->last && status == STRUM_OK; k++)
        if (k > below && k <= last && s->branches[k - s->first].state == TAUT_LOST)
            s->out->lost++;
    s->out->lowest = fmax(box.im_lo, 0.0);
    s->out->highest = box.im_hi;
    s->out->max_decay = -box.re_lo;
    return status == STRUM_OK ? solve_axis(s, box.im_lo, q->max_decay) : status;
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
    return box_of(s, from, hi + 0.5 * fmin(above - hi, spacing), decay);
}

static strum_status solve_run(taut_solve *s, long first, long last)
{
    strum_taut_roots *out = s->out;
    const long margin = 1 + s->search.chain->dampers;
    strum_status status = follow_modes(s, first - margin, last + margin);
    if (status != STRUM_OK)
        return status;
    long running = 0;
    for (size_t i = 0; i < s->known; i++)
        running += s->mode[i] >= first && s->mode[i] <= last && cimag(s->s[i]) > 0.0;
    taut_rectangle box = run_box(s, first, last);
    if (running > 0) {
        long expected = 0, found = 0;
        status = complete(s, &box, &expected, &found);
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
            out->lost += !rigid;
            if (rigid)
                status = taut_roots_add(s->out, (strum_taut_root){k, 0.0, 0.0, INFINITY}, false,
                                        s->fault);
        }
        for (size_t i = 0; i < s->known && status == STRUM_OK; i++)
            if (s->mode[i] == k && cimag(s->s[i]) > 0.0)
                status = give(s, i, false);
    }
    if (status == STRUM_OK && first == s->query->numbers[0])
        status = solve_axis(s, running > 0 ? box.im_lo : 0.25 * s->search.spacing, -box.re_lo);
    else if (status == STRUM_OK)
        status = give_overdamped(s, 0.0);
    return status;
}

/* Roots of a similar chain lead to all that the count expects, or nothing is given out; the
 * roots alone, for searches that come by often. */
static strum_status solve_by_guesses(taut_solve *s, bool *done)
{
    const strum_taut_query *q = s->query;
    taut_rectangle box = box_of(s, q->lowest, q->highest, q->max_decay);
    *done = false;
    strum_status status = reserve(s, q->guess_count);
    if (status == STRUM_OK)
        status = count_box(s, &box, &s->out->expected);
    if (status != STRUM_OK)
        return status;
    for (size_t i = 0; i < q->guess_count; i++) {
        cplx root = CMPLX(-q->guesses[i].decay, q->guesses[i].frequency);
        if (!taut_newton(&s->search, &root))
            continue;
        if (cimag(root) <
            0.0) /* it may have crossed the axis: the same root as its conjugate */
            root = conj(root);
        if (taut_known(s->s, s->known, root, SAME * scale_of(s, root)))
            continue;
        s->s[s->known] = root;
        s->mode[s->known++] = q->guesses[i].mode;
    }
    s->out->found = known_inside(s, &box);
    if (s->search.status != STRUM_OK)
        return stopped(s);
    if (s->out->found != s->out->expected)
        return STRUM_OK;
    for (size_t i = 0; i < s->known && status == STRUM_OK; i++)
        if (taut_inside(&box, s->s[i]))
            status = taut_roots_add(s->out, plain_root(s, i), false, s->fault);
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

/* ---- Muller's method, and one branch alone ---- */

strum_status taut_solve_muller(taut_solve *s)
{
    strum_taut_roots *out = s->out;
    s->search.spacing = taut_spacing(s->search.chain);
    strum_taut_root *certain = out->roots;
    const size_t count = out->count;
    cplx *found = malloc((count + 1) * sizeof *found);
    if (found == NULL)
        return no_memory(s);
    out->roots = NULL;
    out->count = 0;
    size_t known = 0;
    strum_status status = STRUM_OK;
    for (size_t i = 0; i < count && status == STRUM_OK; i++) {
        double w = certain[i].frequency;
        cplx root;
        if (certain[i].mode > 0)
            status = taut_frequencies(s->search.chain, &certain[i].mode, 1, &s->search.work, &w,
                                      s->fault);
        if (status != STRUM_OK ||
            !taut_muller(&s->search, CMPLX(0.0, w), found, known, &root) ||
            taut_known(found, known, root, SAME * scale_of(s, root)))
            continue;
        found[known++] = root;
        const cplx wanted = CMPLX(-certain[i].decay, certain[i].frequency);
        out->hopped += cabs(root - wanted) > SAME * scale_of(s, wanted);
        status = taut_roots_add(
            s->out,
            (strum_taut_root){certain[i].mode, cimag(root), fmax(-creal(root), 0.0), INFINITY},
            false, s->fault);
    }
    for (size_t i = 0; i < count; i++) {
        const cplx wanted = CMPLX(-certain[i].decay, certain[i].frequency);
        out->missed += !taut_known(found, known, wanted, SAME * scale_of(s, wanted));
    }
    out->found = out->expected - out->missed;
    free(found);
    free(certain);
    if (status == STRUM_OK && s->search.status != STRUM_OK)
        status = stopped(s);
    return status;
}

strum_status strum_taut_follow(const strum_taut *chain, long mode, const double *factors,
                               size_t count, const strum_options *options,
                               strum_taut_root *roots, strum_error *error)
{
    const long numbers[3] = {mode - 1, mode, mode + 1};
    double w[3] = {0.0, 0.0, INFINITY};
    const int from = mode <= 1;
    taut_search search = {.chain = chain, .work = work_begin(options)};
    strum_status status = taut_frequencies(chain, numbers + from, 2 - (size_t)from,
                                           &search.work, w + from, error);
    if (status != STRUM_OK)
        return status;
    if (taut_frequencies(chain, numbers + 2, 1, &search.work, w + 2, NULL) != STRUM_OK)
        w[2] = INFINITY; /* the last one that the chain has */
    search.spacing = taut_spacing(chain);
    const double gap = fmin(search.spacing, fmin(w[1] - w[0], w[2] - w[1]));
    taut_branch branch;
    taut_branch_start(&branch, mode, w[1]);
    for (size_t i = 0; i < count; i++) {
        if (!(factors[i] >= branch.factor))
            return error_set(error, STRUM_ERR_RANGE, "factors of the damping must ascend");
        taut_branch_follow(&search, &branch, fmax(gap, 0.2 * search.spacing), factors[i], 1.0);
        if (search.work.status != STRUM_OK)
            return work_error(&search.work, error);
        if (branch.state == TAUT_LOST)
            return error_set(error, STRUM_ERR_ACCURACY,
                             "mode %ld cannot be followed beyond %.6g times the damping", mode,
                             branch.factor);
        roots[i] = (strum_taut_root){mode, cimag(branch.s[0]), -creal(branch.s[0]), INFINITY};
    }
    return STRUM_OK;
}
