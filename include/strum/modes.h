/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Natural frequencies and mode shapes of a suspended cable, of any depth, slope and elasticity.
 *
 * Units and equations are those of catenary.h: lengths in a = H/w, times in sqrt(a/g) where
 * w = m g. A frequency in rad/s is mode.frequency sqrt(g/a).
 *
 *     strum_modes_params params = STRUM_MODES_PARAMS_INIT;
 *     strum_modes *modes = NULL;
 *     strum_error error;
 *     strum_mode mode;
 *     params.cable.chi_m = catenary.chi_m;
 *     params.cable.mu = catenary.mu;
 *     params.count = 6;
 *     if (strum_modes_solve(&params, NULL, &modes, &error) == STRUM_OK)
 *         for (size_t i = 0; i < strum_modes_count(modes); i++)
 *             if (strum_modes_get(modes, i, &mode) == STRUM_OK)
 *                 printf("%g\n", mode.frequency);
 *     strum_modes_free(modes);
 *
 * Ownership: a strum_modes is made by strum_modes_solve and ended by strum_modes_free; it is
 * read-only, so many threads may read it at once.
 */
#ifndef STRUM_MODES_H
#define STRUM_MODES_H

#include <strum/catenary.h>

STRUM_BEGIN_DECLS

/* ---- parameters ---- */

/* Largest number of modes of one call. */
#define STRUM_MODES_MAX 200

/* `argument` of an error of this header. */
typedef enum strum_modes_argument {
    STRUM_MODES_ARG_CABLE = 1, /* a property of it */
    STRUM_MODES_ARG_COUNT
} strum_modes_argument;

typedef struct strum_modes_params {
    strum_cable cable;
    strum_plane plane;
    int count;   /* 1..STRUM_MODES_MAX */
    bool shapes; /* keep what strum_modes_shape and strum_modes_verify need */
} strum_modes_params;

#define STRUM_MODES_PARAMS_INIT                                                                \
    {                                                                                          \
        {0, 0, 0, 0, 1, 1, 0, 0}, STRUM_IN_PLANE, 6, false                                     \
    }

/* ---- results ---- */

typedef struct strum_modes strum_modes;

typedef struct strum_mode {
    double frequency; /* Im s > 0; the natural frequency where undamped */
    double decay;     /* -Re s; 0 where undamped */
    strum_symmetry symmetry;
} strum_mode;

/* A point of a mode shape; imaginary parts are 0 where undamped. The largest value of the
 * dominant displacement component (the one with the largest magnitude anywhere on the cable) is
 * +1. */
typedef struct strum_shape_point {
    double chi;
    strum_complex tangential, normal; /* in plane; `normal` is the displacement out of plane */
    strum_complex tension;            /* dynamic tension in S0 per unit displacement in a */
} strum_shape_point;

/* ---- solve ---- */

/* The first `count` modes that oscillate, by frequency, and every overdamped root. In plane:
 * complementary (force) Galerkin method, but for frequencies alone of an inextensible cable of
 * moderate depth the displacement form, which is half as large; out of plane: displacement
 * Galerkin method. Natural frequencies agree between two sizes to 1e-12 (damped: 1e-10) or
 * STRUM_ERR_ACCURACY is returned. STRUM_ERR_RANGE: a property of the cable or the count;
 * STRUM_ERR_MEMORY, STRUM_ERR_CANCELLED, STRUM_ERR_WORK. *modes is NULL after an error. */
strum_status strum_modes_solve(const strum_modes_params *params, const strum_options *options,
                               strum_modes **modes, strum_error *error);
/* Estimated time of strum_modes_solve in microseconds on a present-day core, without solving
 * anything. */
double strum_modes_work(const strum_modes_params *params);

/* ---- count and get ---- */

size_t strum_modes_count(const strum_modes *modes);
/* Mode `index` in 0..count-1, else STRUM_ERR_RANGE. */
strum_status strum_modes_get(const strum_modes *modes, size_t index, strum_mode *mode);
/* Overdamped roots s < 0: returns their number and their decay rates -s, ascending; owned by
 * `modes`. */
size_t strum_modes_overdamped(const strum_modes *modes, const double **decays);
/* Largest relative difference between the two sizes, over all modes. */
double strum_modes_difference(const strum_modes *modes);
/* Size of the discretisation that gave the answer (unknowns a component). */
int strum_modes_size(const strum_modes *modes);

/* How many in-plane natural frequencies of the undamped cable lie below `frequency`: an exact
 * count by integration along the cable, independent of every Galerkin method. STRUM_ERR_METHOD
 * with damping, STRUM_ERR_RANGE for a property out of range or too many modes to count, and what
 * `options` (may be NULL) ends. */
strum_status strum_modes_below(const strum_cable *cable, double frequency,
                               const strum_options *options, int *count, strum_error *error);

/* ---- shape ---- */

/* The shape of mode `index` at `points` values of chi: those handed in (within the ends), or,
 * where `chi` is NULL, points >= 2 equally spaced ones, ends included. STRUM_ERR_METHOD when
 * the modes were solved without shapes, STRUM_ERR_RANGE, STRUM_ERR_MEMORY. */
strum_status strum_modes_shape(const strum_modes *modes, size_t index, const double *chi,
                               size_t points, strum_shape_point *shape);

/* ---- verify ---- */

/* A second, independent method: in plane the displacement Galerkin method (Gale's equation 2.35
 * in weak form; with elasticity its Hellinger-Reissner form, which does not lock), out of plane
 * the force form. Residuals are those of the eigenpairs in the second method's pencil.
 * STRUM_ERR_METHOD when the modes were solved without shapes; else as strum_modes_solve. */
strum_status strum_modes_verify(const strum_modes *modes, const strum_options *options,
                                strum_verification *verification, strum_error *error);

/* ---- free ---- */

/* NULL is fine. */
void strum_modes_free(strum_modes *modes);

STRUM_END_DECLS
#endif
