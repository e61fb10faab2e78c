/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Components of taut chains in one line each, and what the taut tests share. */
#ifndef TESTS_TAUT_PARTS_H
#define TESTS_TAUT_PARTS_H

#include <complex.h>
#include <stdbool.h>

#include <strum/taut.h>

#include "check.h"

static inline strum_taut_component part_cable(double tension, double mass, double length,
                                              double drag)
{
    return (strum_taut_component){.kind = STRUM_TAUT_CABLE,
                                  .tension_left = tension,
                                  .tension_right = tension,
                                  .cable = {length, mass, drag}};
}

static inline strum_taut_component part_varying(double left, double right, double mass,
                                                double length, bool wkb)
{
    return (strum_taut_component){.kind = STRUM_TAUT_VARYING,
                                  .tension_left = left,
                                  .tension_right = right,
                                  .varying = {length, mass, wkb}};
}

static inline strum_taut_component part_mass(double mass)
{
    return (strum_taut_component){.kind = STRUM_TAUT_GROUND, .ground = {.inertance = mass}};
}

static inline strum_taut_component part_ground(double stiffness, double damping)
{
    return (strum_taut_component){.kind = STRUM_TAUT_GROUND,
                                  .ground = {stiffness, damping, 0.0}};
}

static inline strum_taut_component part_hanging(double mass, double stiffness, double damping)
{
    return (strum_taut_component){.kind = STRUM_TAUT_HANGING,
                                  .hanging = {mass, stiffness, damping}};
}

static inline strum_taut_component part_support(double tension, double length, double pivot,
                                                double inertia)
{
    return (strum_taut_component){.kind = STRUM_TAUT_SUPPORT,
                                  .tension_left = tension,
                                  .tension_right = tension,
                                  .support = {length, pivot, inertia}};
}

/* `links` and `joints` must live until the chain is made. */
static inline strum_taut_component part_body(double left, double right,
                                             const strum_taut_link *links,
                                             const strum_taut_joint *joints, size_t count)
{
    return (strum_taut_component){.kind = STRUM_TAUT_BODY,
                                  .tension_left = left,
                                  .tension_right = right,
                                  .body = {links, joints, count}};
}

static inline strum_taut *chain_of(const strum_taut_component *parts, size_t count,
                                   strum_taut_end left, strum_taut_end right)
{
    strum_taut *chain = NULL;
    strum_error fault = {0};
    if (strum_taut_make(parts, count, left, right, &chain, &fault) != STRUM_OK)
        fail_msg("chain: %s", fault.reason);
    return chain;
}

static inline strum_taut *fixed_chain(const strum_taut_component *parts, size_t count)
{
    return chain_of(parts, count, STRUM_TAUT_FIXED, STRUM_TAUT_FIXED);
}

static inline double frequency_of(const strum_taut *chain, long mode)
{
    double w = NAN;
    strum_error fault = {0};
    if (strum_taut_frequencies(chain, &mode, 1, NULL, &w, &fault) != STRUM_OK)
        fail_msg("mode %ld: %s", mode, fault.reason);
    return w;
}

/* All roots of a band, or of numbers 1..modes where `modes` > 0. */
static inline strum_taut_roots *roots_of(const strum_taut *chain, long modes, double lowest,
                                         double highest, double max_decay)
{
    long numbers[1000];
    for (long k = 0; k < modes; k++)
        numbers[k] = k + 1;
    const strum_taut_query query = {.numbers = numbers,
                                    .count = (size_t)modes,
                                    .lowest = lowest,
                                    .highest = highest,
                                    .max_decay = max_decay};
    strum_taut_roots *roots = NULL;
    strum_error fault = {0};
    if (strum_taut_solve(chain, &query, NULL, &roots, &fault) != STRUM_OK)
        fail_msg("roots: %s", fault.reason);
    assert_int_equal(roots->expected, roots->found);
    return roots;
}

/* Some root within tolerance * |want|. */
static inline void check_has_root(const strum_taut_roots *roots, double _Complex want,
                                  double tolerance)
{
    double nearest = INFINITY;
    for (size_t i = 0; i < roots->count; i++)
        nearest =
            fmin(nearest, cabs(CMPLX(roots->roots[i].frequency, roots->roots[i].decay) - want));
    if (!(nearest <= tolerance * cabs(want)))
        fail_msg("no root at %.15g%+.15gi: nearest %.2e away", creal(want), cimag(want),
                 nearest);
}

/* Pseudo-random numbers of the tests' own: the same on every machine. */
static inline double draw(uint64_t *state, double low, double high)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * ((double)(*state >> 11) * 0x1p-53);
}

/* Between low and high, evenly in the logarithm. */
static inline double draw_log(uint64_t *state, double low, double high)
{
    return exp(draw(state, log(low), log(high)));
}

/* Levesque's in-line absorber: two equal links, arms .2 m, levers .03 m, K = 10 N/m. */
#define LEVESQUE_TENSION 5000.0
static inline void levesque_absorber(double mass, double inertia, double damping,
                                     strum_taut_link links[2], strum_taut_joint *joint)
{
    links[0] = links[1] = (strum_taut_link){0.2, 0.2, mass, inertia};
    *joint = (strum_taut_joint){0.03, 0.03, 10.0, damping, LEVESQUE_TENSION};
}

#endif
