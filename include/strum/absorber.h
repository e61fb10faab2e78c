/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Absorber optimisation: the numbers of a taut chain that may vary are set so that the least
 * damped of the modes that matter is damped most (C. R. Levesque 1997, chapter 4, whose
 * procedure followed one root from a fixed guess).
 *
 * The objective is max over the variables of the min over modes of the damping ratio decay/|w|.
 * Modes are either branches, numbered at zero damping and followed from there, or all roots
 * with real part in a band, found anew and counted at every trial, so that none escapes. Optima
 * lie on kinks (two modes equal) and at exceptional points (two modes coalesce): the first are
 * climbed to as max level with every damping ratio >= level, the second with the double root
 * as an unknown.
 *
 * The search is deterministic: a low-discrepancy scan, then climbs from its peaks; with several
 * variables again and again until three climbs have led to the same best. That no better one
 * exists is likely then, not certain.
 */
#ifndef STRUM_ABSORBER_H
#define STRUM_ABSORBER_H

#include <strum/taut.h>

STRUM_BEGIN_DECLS

#define STRUM_ABSORBER_VARIABLES_MAX 6
#define STRUM_ABSORBER_OPTIMA_MAX    16
#define STRUM_ABSORBER_MODES_MAX     64

typedef struct strum_absorber_problem {
    int variables;
    const double *lowest_values,
        *highest_values; /* bounds of each variable, lowest < highest */
    /* Builds the chain for values of the variables; a chain that cannot exist is
     * STRUM_ERR_IMPOSSIBLE and counts as a trial without damping. */
    strum_status (*build)(void *context, const double *values, strum_taut **chain,
                          strum_error *fault);
    void *context;
    const long *modes; /* branches, ascending; or NULL for a band */
    size_t mode_count;
    double lowest, highest; /* band, rad/s */
    long max_evaluations;   /* of the objective; at least 100 */
    /* Told now and then (may be NULL): evaluations so far, best damping ratio so far, where.
     * False ends the search with what it has. */
    bool (*progress)(void *context, long evaluations, double best, const double *values);
    /* Asked now and then within an evaluation (may be NULL): true ends it, and the search. */
    bool (*cancelled)(void *context);
} strum_absorber_problem;

typedef struct strum_absorber_local {
    double values[STRUM_ABSORBER_VARIABLES_MAX], damping_ratio;
} strum_absorber_local;

typedef struct strum_absorber_optimum {
    double values[STRUM_ABSORBER_VARIABLES_MAX];
    double damping_ratio,
        loss_ratio; /* the objective: decay/|w| and decay/Re w of the limiting mode */
    strum_absorber_local
        optima[STRUM_ABSORBER_OPTIMA_MAX]; /* where local searches ended, best first */
    int optima_count, starts;
    long evaluations;
    bool complete; /* false: the budget or `progress` ended it */
} strum_absorber_optimum;

/* STRUM_ERR_IMPOSSIBLE when no trial gave a chain with a mode that is damped, STRUM_ERR_CANCELLED
 * when it was stopped before. */
strum_status strum_absorber_optimize(const strum_absorber_problem *problem,
                                     strum_absorber_optimum *optimum, strum_error *fault);

/* The roots that matter at given values, by the problem's own rule (branches or band); the
 * caller frees them. */
strum_status strum_absorber_roots(const strum_absorber_problem *problem, const double *values,
                                  strum_taut_roots **roots, strum_error *fault);
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
