/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a damped solve gives out of the roots that it knows. */
#include "core/taut/solve.h"

#include <float.h>

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

/* What rounding leaves uncertain of a root, relative. Next to a damper that matches its cable
 * the root hangs on the difference of two nearly equal impedances: a few roundings of the
 * damping move it far. */
static double error_of(taut_solve *s, cplx root)
{
    taut_search *search = &s->search;
    const long evaluations = search->evaluations; /* not of the search */
    double unused;
    const taut_value value = taut_search_value(search, root);
    const cplx beside = root + 1e-6 * search->spacing;
    const double rise = cabs(taut_search_value(search, beside).f);
    const double off = taut_noise(search, beside, 1.0) * rise / cabs(value.d);
    const double moved = 4.0 * DBL_EPSILON * cabs(taut_speed(search, root, 1.0, &unused));
    search->evaluations = evaluations;
    const double error = fmax(off, moved) / taut_solve_scale(s, root);
    return isfinite(error) ? fmax(error, DBL_EPSILON) : 1.0;
}

strum_taut_root taut_solve_plain(const taut_solve *s, size_t i)
{
    const double frequency = cimag(s->s[i]), decay = -creal(s->s[i]);
    /* what is only rounding is none: even modes pass by their absorbers */
    return (strum_taut_root){s->mode[i], frequency, decay < 4e-15 * frequency ? 0.0 : decay,
                             INFINITY, 0.0};
}

strum_status taut_solve_give(taut_solve *s, size_t i, bool overdamped)
{
    const cplx root = s->s[i];
    strum_taut_root out = taut_solve_plain(s, i);
    const taut_value value = taut_search_value(&s->search, root);
    if (value.f != 0.0)
        s->out->max_residual = fmax(s->out->max_residual,
                                    cabs(over(value.f, value.d)) / taut_solve_scale(s, root));
    out.exceptional = exceptional(s, i);
    out.error = error_of(s, root);
    return taut_roots_add(s->out, out, overdamped, s->fault);
}

/* Overdamped roots: all that are known on the axis within `decay`, and those of modes asked. */
strum_status taut_solve_give_overdamped(taut_solve *s, double decay)
{
    const size_t before = s->out->overdamped_count; /* by another run of numbers */
    strum_status status = STRUM_OK;
    for (size_t i = 0; i < s->known && status == STRUM_OK; i++) {
        const double rate = -creal(s->s[i]);
        bool asked = rate <= decay;
        for (size_t k = 0; k < s->query->count; k++)
            asked = asked || s->query->numbers[k] == s->mode[i];
        bool given = false;
        for (size_t k = 0; k < before; k++)
            given = given || fabs(s->out->overdamped[k].decay - rate) <= TAUT_SAME * rate;
        if (cimag(s->s[i]) == 0.0 && asked && !given && rate > 0.0)
            status = taut_solve_give(s, i, true);
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

strum_status taut_solve_axis_list(taut_solve *s, taut_rectangle *box, double highest,
                                  double decay)
{
    *box = taut_solve_box(s, -highest, highest, decay);
    const int rigid = zeros_at_origin(s->search.chain);
    strum_status status = taut_solve_reserve(s, (size_t)rigid);
    for (int i = 0; i < rigid && status == STRUM_OK; i++) {
        s->s[s->known] = 0.0;
        s->mode[s->known++] = 0;
    }
    return status == STRUM_OK
               ? taut_solve_complete(s, box, &s->out->axis_expected, &s->out->axis_found)
               : status;
}

strum_status taut_solve_axis(taut_solve *s, double lowest, double decay)
{
    taut_rectangle box;
    const double half = fmin(lowest > 0.0 ? lowest : INFINITY, 0.25 * s->search.spacing);
    const strum_status status = taut_solve_axis_list(s, &box, half, decay);
    return status == STRUM_OK ? taut_solve_give_overdamped(s, decay) : status;
}
