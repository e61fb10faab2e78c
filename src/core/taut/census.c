/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The count of one damped solve: how many roots a band holds, and those that are missing. */
#include "core/taut/solve.h"

/* Share of F that rounding may be where it is counted. */
#define CLEAR 1e-3

long taut_solve_inside(const taut_solve *s, const taut_rectangle *box)
{
    long count = 0;
    for (size_t i = 0; i < s->known; i++)
        count += taut_inside(box, s->s[i]) +
                 (cimag(s->s[i]) != 0.0 && taut_inside(box, conj(s->s[i])));
    return count;
}

/* Down to which decay, of that of the box, F stands above its rounding: beside a damper that
 * matches its cable nothing comes back, and F is a difference of much larger numbers. */
static double clear_decay(taut_solve *s, const taut_rectangle *box)
{
    const double high = box->im_hi, low = box->im_lo < 0.0 ? 0.1 * high : box->im_lo;
    const double at[3] = {low, 0.43 * low + 0.57 * high, high};
    double decay = -box->re_lo;
    for (int k = 0; k < 3; k++)
        while (decay > 0.1 * s->search.spacing && s->search.status == STRUM_OK &&
               taut_noise(&s->search, CMPLX(-decay, at[k]), 1.0) > CLEAR)
            decay *= 0.9;
    return decay;
}

strum_status taut_solve_count(taut_solve *s, taut_rectangle *box, long *expected)
{
    taut_rectangle given = *box;
    for (int k = 0; k < 6; k++) {
        *expected = taut_count_zeros(&s->search, box);
        if (s->search.status != STRUM_OK)
            return taut_solve_stopped(s);
        if (*expected >= 0)
            return STRUM_OK;
        const double clear = k == 0 ? clear_decay(s, &given) : -given.re_lo;
        if (clear < -given.re_lo) {
            given.re_lo = -clear;
            s->out->hidden_beyond = true;
        }
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
        if (s->branches[k - s->first].state != TAUT_LOST)
            continue;
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
strum_status taut_solve_complete(taut_solve *s, taut_rectangle *box, long *expected,
                                 long *found)
{
    strum_status status = taut_solve_count(s, box, expected);
    if (status != STRUM_OK)
        return status;
    for (int round = 0; round < 3 && taut_solve_inside(s, box) < *expected; round++) {
        const long known = taut_solve_inside(s, box);
        const size_t before = s->known;
        if (*expected > 4 * STRUM_TAUT_ROOTS_MAX)
            return error_set(s->fault, STRUM_ERR_RANGE, "the band holds more than %d roots",
                             STRUM_TAUT_ROOTS_MAX);
        status = taut_solve_reserve(s, (size_t)(*expected - known));
        if (status != STRUM_OK)
            return status;
        taut_find_missing(&s->search, box, *expected, s->s, &s->known, s->room);
        for (size_t i = before; i < s->known; i++)
            s->mode[i] = 0;
        for (size_t i = before; i < s->known; i++)
            s->mode[i] = mode_near(s, s->s[i]);
        if (s->known > before)
            status = taut_solve_tell_apart(s);
        if (status != STRUM_OK)
            return status;
    }
    *found = taut_solve_inside(s, box);
    if (s->search.status != STRUM_OK)
        return taut_solve_stopped(s);
    if (*found != *expected)
        return error_set(s->fault, STRUM_ERR_ACCURACY,
                         "the count expects %ld roots, %ld were found", *expected, *found);
    /* Never more than there are: a root on the border may be seen by one and not by the other. */
    const long beside = not_asked_inside(s, box), more = beside < *found ? beside : *found;
    *expected -= more;
    *found -= more;
    return STRUM_OK;
}

taut_rectangle taut_solve_box(const taut_solve *s, double lowest, double highest, double decay)
{
    /* all roots have Re s <= 0: half a spacing off the axis F is smooth */
    return (taut_rectangle){-decay, 0.5 * s->search.spacing, lowest, highest};
}
