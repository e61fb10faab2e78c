/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Ordinary differential equations by extrapolation of the modified midpoint rule (W. B. Gragg
 * 1965, R. Bulirsch and J. Stoer 1966; Hairer, Norsett and Wanner, Solving Ordinary
 * Differential Equations I, II.9), order 14 with a step that follows the error. Takes no memory
 * but the caller's stack and always ends.
 */
#ifndef CORE_NUMERICS_EXTRAPOLATION_H
#define CORE_NUMERICS_EXTRAPOLATION_H

#include "core/numerics/work.h"

#define EXTRAPOLATION_STATE_MAX 24

typedef struct extrapolation {
    int size;                                                          /* of the state */
    void (*slope)(void *data, double at, const double *y, double *dy); /* dy/dat */
    void *data;
    /* Component i is right to `tolerance` times the largest magnitude that any component of its
     * block has had so far; `block[i]` numbers the blocks from 0. */
    const int *block;
    double tolerance;
    double step;                             /* the next one that will be tried; > 0 */
    long steps, steps_max;                   /* done so far, refused ones too; at most */
    double slope_us;                         /* estimated time of one slope, for `work` */
    double largest[EXTRAPOLATION_STATE_MAX]; /* of each block so far; begin with 0 */
} extrapolation;

/* From `at` to `end` >= at, y in place. STRUM_ERR_ACCURACY when steps_max steps are not enough
 * or a step becomes too short, else what work_spend says. */
strum_status extrapolation_advance(extrapolation *e, double *at, double end, double *y,
                                   work *w);

#endif
