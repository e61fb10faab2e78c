/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Roots asked by their place: all that oscillate, by frequency, whatever branch they lie on. A
 * count from 0 up says how many lie below those asked, so that a window is a part of the whole
 * list, and a root is never passed over because no branch leads to it.
 */
#include "core/taut/solve.h"

#include <stdlib.h>

/* Modes are looked at up to so many times the place asked: where dampers match their cables
 * there are fewer roots than modes, and possibly none. */
#define MODES_PER_PLACE 4
/* Borders are drawn between modes that lie so far apart, in spacings. */
#define CLEARANCE 0.02
/* Doublings of the decay that is looked at, from one spacing on. */
#define DOUBLINGS 14

typedef struct places {
    taut_solve *s;
    long most, rigid;   /* modes that the chain has; of them rigid motions */
    long below, last;   /* modes below the two borders, without damping */
    double low, high;   /* the borders, rad/s; low 0: from the axis on */
    double decay;       /* to which is looked */
    long under;         /* oscillating roots below the lower border */
    taut_rectangle box; /* what was counted between the borders */
} places;

static strum_status frequency(places *p, long number, double *w)
{
    return taut_frequencies(p->s->search.chain, &number, 1, &p->s->search.work, w, p->s->fault);
}

/* A frequency well between mode `number` and the next one, or one further on by `step` each
 * time; tells which it was. */
static strum_status border(places *p, long *number, long step, double *between)
{
    const double spacing = p->s->search.spacing;
    strum_status status = STRUM_OK;
    for (int n = 0; status == STRUM_OK; n++, *number += step) {
        double w = 0.0, next = 0.0;
        if (*number < 1) {
            *number = 0;
            *between = 0.0;
            return STRUM_OK;
        }
        if (*number > p->most)
            *number = p->most;
        status = frequency(p, *number, &w);
        if (status == STRUM_OK && *number < p->most)
            status = frequency(p, *number + 1, &next);
        else
            next = w + 2.0 * spacing;
        *between = 0.5 * (w + next);
        if (status != STRUM_OK || next - w > CLEARANCE * spacing || n > 20 ||
            *number == p->most)
            return status;
    }
    return status;
}

/* ---- how far down ---- */

static cplx slope_at(places *p, double decay, double w)
{
    const taut_value v = taut_search_value(&p->s->search, CMPLX(-decay, w));
    return v.f == 0.0 ? (cplx)INFINITY : over(v.d, v.f);
}

/* The shortest time that a wave takes through a cable, of those that can have roots of their
 * own below the upper border. */
static double shortest_travel(const places *p)
{
    const strum_taut *chain = p->s->search.chain;
    double least = chain->travel;
    for (size_t i = 0; i < chain->count; i++) {
        const double travel = taut_travel_time(&chain->components[i]);
        if (travel > 0.0)
            least = fmin(least, travel);
    }
    return fmax(least, 1.5 / p->high);
}

/* All roots: far to the left one wave outgrows all others, and F'/F no longer changes. */
static double decay_of_all(places *p)
{
    const double spacing = p->s->search.spacing, travel = shortest_travel(p);
    int needed = 2;
    for (int k = 0; k < 3; k++) {
        const double w = p->high * (k == 0 ? 0.07 : k == 1 ? 0.53 : 1.0);
        cplx slope[DOUBLINGS];
        int last = 0;
        for (; last < DOUBLINGS; last++) {
            const double decay = ldexp(spacing, last);
            slope[last] = slope_at(p, decay, w);
            if (last > 2 && taut_noise(&p->s->search, CMPLX(-decay, w), 1.0) > 1e-3)
                break;
        }
        for (int j = last - 1; j > needed; j--)
            if (!(cabs(slope[j] - slope[j - 1]) <= 0.25 * travel))
                needed = j;
    }
    return ldexp(spacing, needed < DOUBLINGS - 1 ? needed + 1 : needed);
}

/* ---- counting ---- */

/* Oscillating roots on the list, above `low` and up to `high`. */
static long oscillating(const places *p, double low, double high)
{
    const taut_solve *s = p->s;
    long count = 0;
    for (size_t i = 0; i < s->known; i++)
        count += cimag(s->s[i]) > low && cimag(s->s[i]) <= high && -creal(s->s[i]) <= p->decay;
    return count;
}

/* How many oscillate below the lower border: those of a box about the axis, without what lies
 * on it. */
static strum_status count_under(places *p)
{
    taut_solve *s = p->s;
    taut_rectangle box = taut_solve_box(s, -p->low, p->low, p->decay);
    long all = 0, on_axis = 0;
    const strum_status status = taut_solve_count(s, &box, &all);
    for (size_t i = 0; i < s->known; i++)
        on_axis += cimag(s->s[i]) == 0.0 && taut_inside(&box, s->s[i]);
    p->low = box.im_hi;
    p->under = (all - on_axis) / 2;
    return status;
}

/* Everything between the borders on the list, and on the axis. */
static strum_status survey(places *p)
{
    taut_solve *s = p->s;
    strum_taut_roots *out = s->out;
    const long margin = 1 + s->search.chain->dampers;
    long expected, found;
    strum_status status = taut_solve_follow(s, p->below + 1 - margin, p->last + margin);
    if (status == STRUM_OK)
        status = taut_solve_axis_list(s, &p->box, 0.25 * s->search.spacing, p->decay);
    if (status != STRUM_OK)
        return status;
    const double axis = p->box.im_hi;
    p->decay = fmin(p->decay, -p->box.re_lo);
    p->under = 0;
    if (p->low <= axis)
        p->low = 0.0;
    else
        status = count_under(p);
    if (status != STRUM_OK)
        return status;
    p->box = taut_solve_box(s, fmax(p->low, axis), p->high, p->decay);
    status = taut_solve_complete(s, &p->box, &expected, &found);
    p->decay = fmin(p->decay, -p->box.re_lo);
    p->high = p->box.im_hi;
    out->hidden_beyond = out->hidden_beyond && s->query->max_decay > 0.0;
    return status;
}

/* Widens the borders until the places asked lie between them. */
static strum_status enclose(places *p)
{
    const strum_taut_query *q = p->s->query;
    const long first = q->first, last = first + (long)q->wanted - 1;
    p->below = first - 1;
    p->last = last;
    strum_status status = border(p, &p->below, -1, &p->low);
    for (int n = 0; n < 12 && status == STRUM_OK; n++) {
        status = border(p, &p->last, 1, &p->high);
        p->decay = q->max_decay;
        if (status == STRUM_OK && !(p->decay > 0.0))
            p->decay = decay_of_all(p);
        if (status == STRUM_OK)
            status = survey(p);
        if (status != STRUM_OK)
            break;
        const long under = p->rigid + p->under;
        const long there = under + oscillating(p, p->low, p->high);
        if (under >= first && p->low > 0.0) {
            p->below -= under - first + 1;
            status = border(p, &p->below, -1, &p->low);
        } else if (there < last && p->last < p->most &&
                   p->last < MODES_PER_PLACE * last + p->rigid) {
            p->last += 1 + (last - there) + (last - there) / 2;
        } else {
            break;
        }
    }
    return status;
}

/* ---- giving out ---- */

static strum_status give_all(places *p, size_t *order)
{
    taut_solve *s = p->s;
    const strum_taut_query *q = s->query;
    const long last = q->first + (long)q->wanted - 1;
    size_t count = 0;
    strum_status status = STRUM_OK;
    for (long k = q->first; k <= p->rigid && k <= last && status == STRUM_OK; k++)
        status = taut_roots_add(s->out, (strum_taut_root){k, 0.0, 0.0, INFINITY, 0.0}, false,
                                s->fault);
    for (size_t i = 0; i < s->known; i++) {
        if (!(cimag(s->s[i]) > p->low) || !(cimag(s->s[i]) <= p->high) ||
            -creal(s->s[i]) > p->decay)
            continue;
        size_t at = count++;
        for (; at > 0 && taut_solve_before(s->s[i], s->s[order[at - 1]]); at--)
            order[at] = order[at - 1];
        order[at] = i;
    }
    long low = q->first > 1 ? STRUM_TAUT_MODE_MAX : 1, high = 0;
    double least = INFINITY, most = 0.0, beyond = p->high, before = fmax(p->low, 0.0);
    for (size_t k = 0; k < count && status == STRUM_OK; k++) {
        const long place = p->rigid + p->under + 1 + (long)k;
        const double w = cimag(s->s[order[k]]);
        if (place < q->first) {
            before = w;
        } else if (place > last) {
            beyond = fmin(beyond, w);
        } else {
            const long mode = s->mode[order[k]];
            status = taut_solve_give(s, order[k], false);
            low = mode > 0 && mode < low ? mode : low;
            high = mode > high ? mode : high;
            least = fmin(least, w);
            most = fmax(most, w);
            s->out->expected++;
        }
    }
    s->out->found = s->out->expected;
    s->out->lowest = s->out->expected > 0 ? 0.5 * (before + least) : before;
    s->out->highest = s->out->expected > 0 ? 0.5 * (most + beyond) : p->high;
    s->out->max_decay = p->decay;
    if (high == 0) {
        low = q->first;
        high = last;
    }
    return status == STRUM_OK ? taut_solve_note_missing(s, low, high) : status;
}

strum_status taut_solve_places(taut_solve *s)
{
    const strum_taut_query *q = s->query;
    places p = {.s = s, .most = taut_modes_most(s->search.chain, s->search.spacing)};
    taut_shot rest;
    taut_shoot(s->search.chain, 1e-60 * s->search.spacing, &rest);
    p.rigid = rest.count;
    if (q->first + (long)q->wanted - 1 > p.most)
        return error_set(s->fault, STRUM_ERR_IMPOSSIBLE, "the chain has only %ld modes",
                         p.most);
    strum_status status = enclose(&p);
    if (status != STRUM_OK)
        return status;
    size_t *order = malloc((s->known + 1) * sizeof *order);
    if (order == NULL)
        return taut_solve_no_memory(s);
    status = give_all(&p, order);
    free(order);
    return status == STRUM_OK ? taut_solve_give_overdamped(s, p.decay) : status;
}
