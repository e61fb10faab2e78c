/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Modes that coincide without damping, or nearly so: an absorber on a node tuned to its mode,
 * spans held apart by a stiff spring. No step is short enough for one branch alone, so all of
 * them are followed together, as the roots within a circle, until they lie apart; from there
 * each goes on by itself. They take their numbers by frequency, then decay, where they part.
 */
#include "core/taut/solve.h"

/* They lie apart, in spacings of modes. */
#define APART 6e-3
/* Circles: widest, in distances to the next mode, and narrowest, in spacings. */
#define WIDEST    0.3
#define NARROWEST 1e-4
#define STEPS_MAX 400

typedef struct group {
    taut_search *search;
    int count;
    double factor, step, radius, widest;
    cplx centre, speed;
    taut_ring at; /* where the group stands */
    cplx roots[TAUT_CLUSTER_MAX];
} group;

/* Stands at a circle that holds the group and nothing else. */
static void stand(group *g, const taut_ring *ring, double factor)
{
    taut_ring_rough(ring, g->roots);
    g->at = *ring;
    const cplx mean = ring->centre + ring->radius * ring->power[1] / g->count;
    g->speed = (mean - g->centre) / (factor - g->factor);
    g->centre = mean;
    g->factor = factor;
    g->radius = fmin(1.5 * g->radius, g->widest);
}

/* One step on; false when no circle there holds all of the group and nothing else. */
static bool advance(group *g)
{
    taut_search *search = g->search;
    while (search->status == STRUM_OK && g->step > 1e-12 * (1e-3 + g->factor) &&
           g->radius > NARROWEST * search->spacing) {
        const double factor = fmin(g->factor + g->step, 1.0), ahead = factor - g->factor;
        const cplx centre = g->centre + ahead * g->speed;
        taut_ring ring;
        if (cimag(centre) <= g->radius) {
            g->radius *= 0.5;
        } else if (!taut_ring_glance(search, centre, g->radius, factor, &ring)) {
            g->step *= 0.5;
            g->radius *= 0.9;
        } else if (ring.count > g->count) {
            g->radius *= 0.6;
        } else if (ring.count < g->count || !(cabs(ring.power[1]) < 0.5 * g->count)) {
            g->step *= 0.2;
        } else {
            stand(g, &ring, factor);
            g->step = fmin(2.0 * ahead, 0.2);
            return true;
        }
    }
    return false;
}

/* Where they lie apart, or at the full damping. */
static bool part_ways(group *g)
{
    const double apart = APART * g->search->spacing;
    for (int n = 0; n < STEPS_MAX; n++) {
        if (!advance(g))
            return false;
        taut_ring as = {.count = g->count};
        if (g->factor == 1.0 || taut_ring_apart(&as, g->roots) > apart) {
            taut_ring_roots(g->search, &g->at, g->factor, g->roots);
            return true;
        }
    }
    return false;
}

/* The group of `count` branches from `first` on, whose neighbours lie `gap` away. */
bool taut_solve_group(taut_solve *s, taut_branch *first, int count, double w, double gap)
{
    group g = {.search = &s->search, .count = count, .step = 0.01, .centre = CMPLX(0.0, w)};
    if (count > TAUT_CLUSTER_MAX)
        return false;
    g.widest = g.radius = WIDEST * fmin(gap, w);
    if (!part_ways(&g))
        return false;
    for (int i = 0; i < count; i++) {
        taut_branch *b = first + i;
        *b = (taut_branch){
            b->mode, g.factor, TAUT_OSCILLATES, {g.roots[i], conj(g.roots[i])}, false};
        taut_branch_follow(&s->search, b, fmax(gap, 0.2 * s->search.spacing), 1.0, 1.0);
    }
    return true;
}
