/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The natural frequencies that the motion of end 2 may excite, and how strongly it does. */
#include <complex.h>
#include <math.h>
#include <stdlib.h>

#include "core/suspended/forced/modal.h"

/* How many of a part's pairs, or of the modes out of plane, lie below the highest frequency. */
static int count_in_part(const strum_forced *f, const forced_part *p)
{
    int n = 0;
    while (n < p->part.count && p->mu[n] > 0 && 1 / sqrt(p->mu[n]) <= f->frequency_max)
        n++;
    return n;
}

static int count_out_of_plane(const strum_forced *f)
{
    int n = 0;
    while (f->out_of_plane && n < f->size - 1 &&
           forced_out_of_plane_frequency(f, n) <= f->frequency_max)
        n++;
    return n;
}

static int by_frequency(const void *left, const void *right)
{
    const forced_natural *l = left, *r = right;
    return l->frequency < r->frequency ? -1 : l->frequency > r->frequency;
}

static void number(forced_natural *list, size_t count, bool level)
{
    int modes[2] = {0, 0};
    qsort(list, count, sizeof *list, by_frequency);
    for (size_t i = 0; i < count; i++) {
        const bool out = list[i].part == NULL;
        list[i].mode = ++modes[out];
        if (out && level) /* a string's modes alternate */
            list[i].symmetry = list[i].mode % 2 == 1 ? STRUM_SYMMETRIC : STRUM_ANTISYMMETRIC;
    }
}

strum_status forced_naturals_make(strum_forced *f)
{
    int in_plane[2] = {0, 0};
    const int out = count_out_of_plane(f);
    size_t count = (size_t)out;
    for (int i = 0; i < f->part_count; i++) {
        in_plane[i] = count_in_part(f, &f->parts[i]);
        count += (size_t)in_plane[i];
    }
    f->natural_count = 0;
    f->naturals = arena_alloc(&f->memory, count, sizeof *f->naturals);
    if (f->naturals == NULL)
        return STRUM_ERR_MEMORY;
    for (int i = 0; i < f->part_count; i++) {
        const forced_part *p = &f->parts[i];
        for (int j = 0; j < in_plane[i]; j++)
            f->naturals[f->natural_count++] = (forced_natural){.part = p,
                                                               .pair = j,
                                                               .frequency = 1 / sqrt(p->mu[j]),
                                                               .symmetry = p->part.symmetry};
    }
    for (int j = 0; j < out; j++)
        f->naturals[f->natural_count++] =
            (forced_natural){.pair = j, .frequency = forced_out_of_plane_frequency(f, j)};
    number(f->naturals, f->natural_count, f->cable.chi_m == 0);
    return STRUM_OK;
}

/* Near mode j: h -> phi (phi.r)/(2 delta), so T -> T_phi omega_j^2 (phi.r)/(2 delta). */
static double residue(const strum_forced *f, const forced_natural *at,
                      const strum_end_motion *motion, strum_response *scratch)
{
    const forced_part *p = at->part;
    double _Complex d[2];
    strum_peak peak;
    if (p == NULL)
        return forced_out_of_plane_residue(f, at->pair, motion->out_of_plane, scratch->table);
    for (int k = 0; k < 2; k++)
        d[k] = motion->tangential * f->end[0][k] + motion->normal * f->end[1][k];
    const double _Complex share = d[0] * p->share[0][at->pair] + d[1] * p->share[1][at->pair];
    response_of_mode(scratch, p, at->pair);
    strum_response_peak(scratch, &peak);
    return peak.tension * cabs(share) / (2 * p->mu[at->pair]);
}

size_t strum_forced_count(const strum_forced *f)
{
    return f->natural_count;
}

strum_status strum_forced_get(const strum_forced *f, size_t i, const strum_end_motion *motion,
                              strum_resonance *resonance)
{
    if (i >= f->natural_count)
        return STRUM_ERR_RANGE;
    const forced_natural *at = &f->naturals[i];
    double strength = 0;
    if (motion != NULL) {
        strum_response *scratch;
        const strum_status status = strum_response_make(f, &scratch, NULL);
        if (status != STRUM_OK)
            return status;
        strength = residue(f, at, motion, scratch);
        strum_response_free(scratch);
    }
    *resonance =
        (strum_resonance){.frequency = at->frequency,
                          .plane = at->part != NULL ? STRUM_IN_PLANE : STRUM_OUT_OF_PLANE,
                          .mode = at->mode,
                          .symmetry = at->symmetry,
                          .residue = strength};
    return STRUM_OK;
}
