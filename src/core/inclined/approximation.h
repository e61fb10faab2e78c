/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the models with a characteristic equation share: how they are solved, sampled and
 * verified, from their `roots`, `function` and `sample`. */
#ifndef CORE_INCLINED_APPROXIMATION_H
#define CORE_INCLINED_APPROXIMATION_H

#include "core/inclined/model.h"

strum_status approximation_solve(strum_inclined *m, work *w, strum_error *error);
strum_status approximation_evaluate(const strum_inclined *m, const inclined_samples *at,
                                    arena *scratch, work *w);
strum_status approximation_verify(const strum_inclined *m, strum_verification *v, arena *a,
                                  work *w, strum_error *error);

/* Members of their rows. */
#define APPROXIMATION                                                                          \
    .solve = approximation_solve, .evaluate = approximation_evaluate,                          \
    .verify = approximation_verify

#endif
