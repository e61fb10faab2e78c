/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Inside of taut chains. Motion ~ e^{s t}, s = i w: then every characteristic function is real
 * on the real axis, and roots come as conjugates. Each component has its transfer matrix as
 * N/den with N and den entire in s; the product of the N gives an entire characteristic
 * function, whose zeros are the modes and nothing else.
 */
#ifndef CORE_TAUT_TAUT_H
#define CORE_TAUT_TAUT_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

#include <strum/taut.h>

#include "core/numerics/work.h"
#include "core/taut/components/component.h"

struct strum_taut {
    atomic_uint references; /* the caller's, and one of each shape */
    bool free_left, free_right, damped;
    bool moves;     /* some component lets y differ at its ends */
    int dampers;    /* components with finite damping */
    double length;  /* m */
    double travel;  /* time a wave takes from end to end, s */
    double tension; /* mean along the length, N */
    size_t count;
    taut_component *components;
};

/* Time a wave takes through a component, s. */
double taut_travel_time(const taut_component *c);

/* A counted reference, given back by strum_taut_free. */
strum_taut *taut_ref(const strum_taut *chain);

/* ---- shooting ---- */

/* A shot without damping at w: the mode count below w, the end condition f and df/dw, both
 * times 2^-exponent. */
typedef struct taut_shot {
    double w, f, df;
    long count, exponent;
} taut_shot;

/* Estimated microseconds of one shot. */
double taut_shot_us(const strum_taut *chain);
void taut_shoot(const strum_taut *chain, double w, taut_shot *shot);

/* The characteristic function at a point, and its derivative along at's direction, both times
 * e^{-log_scale}. */
typedef struct taut_value {
    cplx f, d;
    double log_scale;
} taut_value;

void taut_characteristic(const strum_taut *chain, const taut_at *at, taut_value *value);

/* strum_taut_frequencies within the work of a solve (NULL: without limit). */
strum_status taut_frequencies(const strum_taut *chain, const long *numbers, size_t count,
                              work *spent, double *frequencies, strum_error *error);

/* STRUM_ERR_RANGE for a frequency whose square is next to the end of doubles. */
strum_status taut_frequency_fits(double frequency, strum_error *error);

/* Typical distance of modes, rad/s. */
double taut_spacing(const strum_taut *chain);

/* ---- damped roots ---- */

/* Shared by the searches of one solve. */
typedef struct taut_search {
    const strum_taut *chain;
    work work;
    double spacing; /* typical distance of modes, rad/s */
    long evaluations;
    int steps_max;       /* of one branch; 0: as many as it may take */
    strum_status status; /* of the first failure; searches end early when not STRUM_OK */
} taut_search;

/* F and dF/ds at full damping. */
taut_value taut_search_value(taut_search *search, cplx s);
/* F and dF/ds where all damping is multiplied by a factor. */
taut_value taut_search_at(taut_search *search, cplx s, double factor);
/* Newton's method at full damping from `s`; true when it converged. A real start stays real. */
bool taut_newton(taut_search *search, cplx *s);

/* ds/dfactor of a root, and about how far the nearest other root lies. */
cplx taut_speed(taut_search *search, cplx s, double factor, double *nearest);

typedef enum taut_branch_state {
    TAUT_OSCILLATES,
    TAUT_OVERDAMPED,
    TAUT_LOST
} taut_branch_state;

/* One branch at some damping: s[0] (upper half plane) or the two real roots. */
typedef struct taut_branch {
    long mode;
    double factor;
    taut_branch_state state;
    cplx s[2];
    bool meets; /* where it was lost another root was near */
} taut_branch;

/* From mode `mode` with undamped frequency w whose neighbours lie `gap` away. */
void taut_branch_start(taut_branch *branch, long mode, double w);
/* On to a larger factor; branch->state says what became of it. `reach` (<= 1) shortens steps.
 */
void taut_branch_follow(taut_search *search, taut_branch *branch, double gap, double factor,
                        double reach);

/* What rounding does to F at a point, as a share of it (1 and more: nothing is left). */
double taut_noise(taut_search *search, cplx s, double factor);

/* Zeros in [re_lo, re_hi] x [im_lo, im_hi] of the s plane; -1 when a zero lies on the boundary.
 * im_lo < 0 = -im_hi: symmetric, only the upper half is walked. */
typedef struct taut_rectangle {
    double re_lo, re_hi, im_lo, im_hi;
} taut_rectangle;

long taut_count_zeros(taut_search *search, const taut_rectangle *box);
/* Adds to roots[*known] (room for `room`) the zeros in `box` that are missing among them, which
 * number `expected` - those known. Roots in the lower half plane are never stored. */
void taut_find_missing(taut_search *search, const taut_rectangle *box, long expected,
                       cplx *roots, size_t *known, size_t room);
bool taut_inside(const taut_rectangle *box, cplx s);
/* Does the list hold s (to the digits that a root has)? */
bool taut_known(const cplx *roots, size_t count, cplx s, double tolerance);

/* ---- clusters ---- */

#define TAUT_CLUSTER_MAX 8

/* A circle, the number of roots in it and their power sums about its centre, in radii. */
typedef struct taut_ring {
    cplx centre;
    double radius;
    int count;
    cplx power[TAUT_CLUSTER_MAX + 1];
} taut_ring;

/* False where a root lies too near the circle, or more than TAUT_CLUSTER_MAX within it. */
bool taut_ring_make(taut_search *search, cplx centre, double radius, double factor,
                    taut_ring *ring);
/* The same by half as many points, for roots well within. */
bool taut_ring_glance(taut_search *search, cplx centre, double radius, double factor,
                      taut_ring *ring);
/* Its roots (`count` of them), by frequency, then decay. */
void taut_ring_roots(taut_search *search, const taut_ring *ring, double factor, cplx *roots);
/* The same from the power sums alone: to the count-th root of rounding, in radii. */
void taut_ring_rough(const taut_ring *ring, cplx *roots);
/* The smallest distance of two of them. */
double taut_ring_apart(const taut_ring *ring, const cplx *roots);

/* Muller's method from guess i w_k, deflated by what it found; see taut_muller.c. */
bool taut_muller(taut_search *search, cplx guess, const cplx *found, size_t count, cplx *root);

#endif
