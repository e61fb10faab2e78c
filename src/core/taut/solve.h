/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CORE_TAUT_SOLVE_H
#define CORE_TAUT_SOLVE_H

#include "core/taut/roots.h"
#include "core/taut/taut.h"

/* One solve. Known roots of the damped chain: s (upper half plane or real axis) and the mode at
 * zero damping that led to it, 0 where a search did. */
typedef struct taut_solve {
    taut_search search;
    const strum_taut_query *query;
    strum_taut_roots *out;
    strum_error *fault;
    cplx *s;
    long *mode;
    size_t known, room;
    long first, last;      /* modes whose branches were followed; last < first: none */
    taut_branch *branches; /* theirs, branches[k - first] */
} taut_solve;

strum_status taut_solve_damped(taut_solve *s);
/* The roots asked by place (places.c). */
strum_status taut_solve_places(taut_solve *s);
/* Replaces the roots given out by those of Muller's method, and compares. */
strum_status taut_solve_muller(taut_solve *s);
/* A root is itself to this share of its size. */
#define TAUT_SAME 1e-9

/* ---- what it knows (known.c) ---- */

double taut_solve_scale(const taut_solve *s, cplx root);
/* By frequency, then decay; frequencies that differ by rounding only are one. */
bool taut_solve_before(cplx a, cplx b);
/* Room for `more` further roots. */
strum_status taut_solve_reserve(taut_solve *s, size_t more);
strum_status taut_solve_no_memory(taut_solve *s);
/* The error for a search that ended early. */
strum_status taut_solve_stopped(taut_solve *s);

/* ---- branches (branches.c) ---- */

/* Modes that a chain has, or that can be asked. */
long taut_modes_most(const strum_taut *chain, double spacing);
/* Follows the branches of modes first..last, as far as the chain has them. */
strum_status taut_solve_follow(taut_solve *s, long first, long last);

/* Notes those of the modes first..last that no oscillating root has the number of. */
strum_status taut_solve_note_missing(taut_solve *s, long first, long last);

/* ---- groups of modes that coincide without damping (groups.c) ---- */

/* Modes nearer to each other than this share of the spacing make a group. */
#define TAUT_GROUP 2e-2
/* Modes nearer than this share of their frequency cannot be followed one by one. */
#define TAUT_TWINS 1e-5

/* Follows `count` branches from `first` on, about the frequency w, whose neighbours lie `gap`
 * away; false when it cannot. */
bool taut_solve_group(taut_solve *s, taut_branch *first, int count, double w, double gap);

/* ---- counting (census.c) ---- */

taut_rectangle taut_solve_box(const taut_solve *s, double lowest, double highest, double decay);
/* Zeros known in the box; a pair counts twice where the box holds both. */
long taut_solve_inside(const taut_solve *s, const taut_rectangle *box);
/* Tells roots on the list apart that lie too near for Newton's method, with those among them
 * that it has not. */
strum_status taut_solve_tell_apart(taut_solve *s);
/* Counts the zeros in the box, moving its borders a little outwards when one lies on them. */
strum_status taut_solve_count(taut_solve *s, taut_rectangle *box, long *expected);
/* Counts, and searches for what the branches did not lead to. */
strum_status taut_solve_complete(taut_solve *s, taut_rectangle *box, long *expected,
                                 long *found);

/* ---- giving out (give.c) ---- */

/* Root i of the list without what is said of its neighbours. */
strum_taut_root taut_solve_plain(const taut_solve *s, size_t i);
strum_status taut_solve_give(taut_solve *s, size_t i, bool overdamped);
/* Overdamped roots: all that are known on the axis within `decay`, and those of modes asked. */
strum_status taut_solve_give_overdamped(taut_solve *s, double decay);
/* Puts on the list what lies up to `highest` about the axis; `box` becomes what was counted. */
strum_status taut_solve_axis_list(taut_solve *s, taut_rectangle *box, double highest,
                                  double decay);
/* Counts and gives out what lies on the axis. */
strum_status taut_solve_axis(taut_solve *s, double lowest, double decay);

/* Ends what the solve itself owns (not `out`). */
void taut_solve_clear(taut_solve *s);

#endif
