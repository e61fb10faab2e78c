/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Absorber optimisation: the numbers of a taut chain that may vary are set so that the least
 * damped of the modes that matter is damped most (C. R. Levesque 1997, chapter 4, whose
 * procedure followed one root from a fixed guess).
 *
 * Units: of the chain (taut.h), SI; frequencies w in rad/s, decays in 1/s. The objective is
 *     max over the variables of min over the modes of decay/|w|.
 *
 * Modes are either branches, numbered at zero damping and followed from there, or all roots
 * with real part in a band, found anew and counted at every trial, so that none escapes. Optima
 * lie on kinks (two modes equal) and at exceptional points (two modes coalesce): the first are
 * climbed to as max level with every damping ratio >= level, the second with the double root
 * as an unknown.
 *
 * The search is deterministic: a low-discrepancy scan, then climbs from its peaks; with several
 * variables again and again until three climbs have led to the same best. That no better one
 * exists is likely then, not certain.
 *
 * With `build` a function that makes the chain for a damping and a stiffness:
 *
 *     const double lowest[] = {0.1, 1}, highest[] = {200, 500};
 *     strum_absorber_params params = STRUM_ABSORBER_PARAMS_INIT;
 *     params.variables = 2;
 *     params.lowest_values = lowest;
 *     params.highest_values = highest;
 *     params.build = build;
 *     params.lowest = 0.5;
 *     params.highest = 7;
 *     strum_absorber_optimum best;
 *     strum_error error;
 *     if (strum_absorber_solve(&params, NULL, &best, &error) == STRUM_OK)
 *         printf("damping %g, stiffness %g: %g of critical\n", best.values[0], best.values[1],
 *                best.damping_ratio);
 *
 * Ownership: all structs are the caller's; there is nothing to free but the roots that
 * strum_absorber_roots returns. All functions are re-entrant, as `build` and `progress` then
 * have to be.
 */
#ifndef STRUM_ABSORBER_H
#define STRUM_ABSORBER_H

#include <strum/taut.h>

STRUM_BEGIN_DECLS

#define STRUM_ABSORBER_VARIABLES_MAX   6
#define STRUM_ABSORBER_OPTIMA_MAX      16
#define STRUM_ABSORBER_MODES_MAX       64
#define STRUM_ABSORBER_EVALUATIONS_MIN 100
/* In a band, whatever decays faster than this many times the upper end limits nothing. */
#define STRUM_ABSORBER_DECAY 2

typedef struct strum_absorber_params {
    int variables;               /* 1..STRUM_ABSORBER_VARIABLES_MAX */
    const double *lowest_values; /* bounds of each variable, lowest < highest */
    const double *highest_values;
    /* Builds the chain for values of the variables; a chain that cannot exist is
     * STRUM_ERR_IMPOSSIBLE and counts as a trial without damping. The chain is the library's
     * then. */
    strum_status (*build)(void *context, const double *values, strum_taut **chain,
                          strum_error *error);
    void *context;     /* handed to `build` and `progress`; the caller's */
    const long *modes; /* branches, ascending; or NULL for a band */
    size_t mode_count;
    double lowest, highest; /* band, rad/s */
    long max_evaluations;   /* of the objective; at least STRUM_ABSORBER_EVALUATIONS_MIN */
    /* Called after each evaluation (may be NULL): evaluations so far, best damping ratio so
     * far, where. False ends the search with what it has, which then counts as an answer. */
    bool (*progress)(void *context, long evaluations, double best, const double *values);
} strum_absorber_params;

/* The variables, `build` and what is to be damped remain to be set. */
#define STRUM_ABSORBER_PARAMS_INIT                                                             \
    {                                                                                          \
        0, NULL, NULL, NULL, NULL, NULL, 0, 0.0, 0.0, 6000, NULL                               \
    }

/* strum_error.argument of the functions here: the parameter at fault. */
typedef enum strum_absorber_argument {
    STRUM_ABSORBER_ARG_VARIABLES = 1,
    STRUM_ABSORBER_ARG_BOUNDS, /* index: of the variable */
    STRUM_ABSORBER_ARG_MAX_EVALUATIONS
} strum_absorber_argument;

typedef struct strum_absorber_local {
    double values[STRUM_ABSORBER_VARIABLES_MAX], damping_ratio;
} strum_absorber_local;

typedef struct strum_absorber_optimum {
    double values[STRUM_ABSORBER_VARIABLES_MAX];
    double damping_ratio; /* the objective: decay/|w| of the limiting mode */
    double loss_ratio;    /* decay/Re w of it */
    /* Where local searches ended, best first. */
    strum_absorber_local optima[STRUM_ABSORBER_OPTIMA_MAX];
    int optima_count, starts;
    long evaluations;
    bool complete; /* false: something else than its own rule ended the search */
} strum_absorber_optimum;

/* The optimum. STRUM_ERR_RANGE with the argument; STRUM_ERR_IMPOSSIBLE where no trial gave a
 * chain with all modes damped. STRUM_ERR_CANCELLED and STRUM_ERR_WORK where `options` (may be
 * NULL) ended the search, be it within an evaluation: `*optimum` then holds the best so far,
 * with a damping_ratio of 0 where there is none. */
strum_status strum_absorber_solve(const strum_absorber_params *params,
                                  const strum_options *options, strum_absorber_optimum *optimum,
                                  strum_error *error);

/* The roots that matter at given values, by the same rule (branches or band), found anew; the
 * caller frees them. Errors are those of `build` and of strum_taut_solve, with their arguments
 * (taut.h); `*roots` stays as it was then. */
strum_status strum_absorber_roots(const strum_absorber_params *params,
                                  const strum_options *options, const double *values,
                                  strum_taut_roots **roots, strum_error *error);
/* The least damped of them: index into roots->roots (ties: the first), -1 for none. */
int strum_absorber_limiting(const strum_taut_roots *roots);

/* How a sweep spaces a variable, share 0..1 of its range: by the logarithm where it spans
 * more than a factor of 30, from 0 by orders down to 1e-6 of its range, evenly otherwise. The
 * search does likewise, but from 0 it looks down to 1e-15 of the range. */
double strum_absorber_scale(double lowest, double highest, double share);

/* ---- closed forms of a tuned mass on mode n of a uniform taut cable ---- */

typedef struct strum_absorber_form {
    double stiffness, damping, damping_ratio;
} strum_absorber_form;

/* mass: of the absorber; ratio: mass over the modal mass (rho L/2)/sin^2(n pi x/L); frequency:
 * of the bare mode. Both tune to stiffness m W^2/(1 + ratio)^2. */
/* Flat steady response: damping 2 m W sqrt(3 r/(8 (1 + r)^3)), a criterion other than damping
 * [Den Hartog]. */
strum_absorber_form strum_absorber_den_hartog(double mass, double ratio, double frequency);
/* Both poles coalesce: damping 2 m W sqrt(r)/(1 + r)^{3/2}, damping ratio sqrt(r)/2. */
strum_absorber_form strum_absorber_coalescence(double mass, double ratio, double frequency);
/* A damper to ground at x << L: damping 0.10 rho L W_1/(n x/L), damping ratio 0.52 x/L
 * (universal curve of Pacheco, Fujino and Sulekh 1993, at its optimum). */
strum_absorber_form strum_absorber_universal_curve(double length, double mass_per_length,
                                                   double tension, double position, long mode);

STRUM_END_DECLS
#endif
