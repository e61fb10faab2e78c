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
/* Replaces the roots given out by those of Muller's method, and compares. */
strum_status taut_solve_muller(taut_solve *s);
/* Ends what the solve itself owns (not `out`). */
void taut_solve_clear(taut_solve *s);

#endif
