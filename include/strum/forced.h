/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Forced motion: end 2 of a suspended cable moves harmonically, end 1 is fixed (Gale 1976,
 * chapter 2.5 and Appendix C, with his recommendations for further work: any direction,
 * elasticity, damping, any depth, any periodic motion).
 *
 * Units and equations are those of catenary.h with s = i omega and X = d at end 2. The motion
 * is Re(d e^{i omega t}); every response is a complex amplitude in the same sense, real where
 * the cable is undamped. The dynamic tension is T = t.F in S0; motion out of plane makes none
 * to first order.
 *
 *     strum_forced_params params = STRUM_FORCED_PARAMS_INIT;
 *     strum_forced *forced = NULL;
 *     strum_response *response = NULL;
 *     strum_end_motion motion = {0};
 *     strum_peak peak;
 *     params.cable = cable;
 *     params.frequency_max = 5;
 *     motion.tangential = 0.01;
 *     if (strum_forced_solve(&params, NULL, &forced, NULL) == STRUM_OK &&
 *         strum_response_make(forced, &response, NULL) == STRUM_OK &&
 *         strum_response_solve(response, 2.5, &motion, NULL) == STRUM_OK)
 *         strum_response_peak(response, &peak);
 *     strum_response_free(response);
 *     strum_forced_free(forced);
 *
 * A strum_forced holds one modal solution that serves every frequency up to the one it was
 * solved for; it is read-only, so threads may share it. A strum_response is one caller's. It
 * holds a counted reference to its strum_forced: either may be freed first.
 */
#ifndef STRUM_FORCED_H
#define STRUM_FORCED_H

#include <strum/modes.h>

STRUM_BEGIN_DECLS

typedef struct strum_forced strum_forced;
typedef struct strum_response strum_response;

/* ---- parameters ---- */

/* `argument` of an error of this header. */
typedef enum strum_forced_argument {
    STRUM_FORCED_ARG_CABLE = 1,
    STRUM_FORCED_ARG_FREQUENCY
} strum_forced_argument;

typedef struct strum_forced_params {
    strum_cable cable;
    double frequency_max;        /* responses are wanted at 0..frequency_max; >= 0 */
    bool in_plane, out_of_plane; /* to motion in plane, out of plane, or both */
} strum_forced_params;

#define STRUM_FORCED_PARAMS_INIT                                                               \
    {                                                                                          \
        {0, 0, 0, 0, 1, 1, 0, 0}, 0, true, false                                               \
    }

/* Displacement of end 2 in a, along and normal to the tangent there, and out of plane. */
typedef struct strum_end_motion {
    strum_complex tangential, normal, out_of_plane;
} strum_end_motion;

/* ---- results ---- */

typedef struct strum_forced_point {
    double chi;
    strum_complex tangential, normal, out_of_plane; /* displacement, in a */
    strum_complex tension;                          /* in S0 */
} strum_forced_point;

typedef struct strum_peak {
    double tension; /* largest |T| along the whole cable, not over samples */
    double chi;     /* where */
    double phase;   /* of T there, radians; 0 or pi where undamped */
} strum_peak;

/* A natural frequency of the undamped cable that the motion of end 2 may excite. */
typedef struct strum_resonance {
    double frequency;
    strum_plane plane;
    int mode; /* number within its plane */
    strum_symmetry symmetry;
    double residue; /* of a motion: |T| (out of plane: |W|) -> residue/|omega/frequency - 1|
                       near it, at the place where the mode's own is largest; undamped */
} strum_resonance;

/* ---- solve ---- */

/* Prepares responses up to params->frequency_max. STRUM_ERR_RANGE (a property of the cable, the
 * frequency, or more than STRUM_MODES_MAX modes below it), STRUM_ERR_ACCURACY as in modes,
 * STRUM_ERR_MEMORY, STRUM_ERR_CANCELLED, STRUM_ERR_WORK; *forced is then NULL. */
strum_status strum_forced_solve(const strum_forced_params *params, const strum_options *options,
                                strum_forced **forced, strum_error *error);

/* The natural frequencies up to frequency_max, in plane and out of plane as the system was
 * solved for: their number. */
size_t strum_forced_count(const strum_forced *forced);

/* The i-th of them from 0, ascending over both planes, with its residue for a motion; without a
 * motion (NULL) the residue is 0. STRUM_ERR_RANGE when there is no i-th, STRUM_ERR_MEMORY;
 * *resonance is then as it was. */
strum_status strum_forced_get(const strum_forced *forced, size_t i,
                              const strum_end_motion *motion, strum_resonance *resonance);

/* NULL is fine. */
void strum_forced_free(strum_forced *forced);

/* ---- responses ---- */

/* Room for responses of this cable, one at a time. STRUM_ERR_MEMORY: *response is NULL. */
strum_status strum_response_make(const strum_forced *forced, strum_response **response,
                                 strum_error *error);

/* The response to a motion at a frequency in 0..frequency_max; 0 is the exact static answer.
 * STRUM_ERR_RANGE for another frequency. STRUM_ERR_METHOD when an undamped cable is driven
 * within 1e-8 of a natural frequency that the motion excites: there is no bounded answer; the
 * resonance is written to `at` (may be NULL). STRUM_ERR_MEMORY. After an error the response
 * holds nothing. */
strum_status strum_response_solve(strum_response *response, double frequency,
                                  const strum_end_motion *motion, strum_resonance *at);

/* The response at one chi, and its largest dynamic tension. */
void strum_response_at(const strum_response *response, double chi, strum_forced_point *point);
void strum_response_peak(const strum_response *response, strum_peak *peak);

/* The largest dynamic tension over cable and period of a sum of harmonics
 *     Re(sum T_k e^{i k_m phase}),
 * where response k is that to multiple k_m >= 1 of one frequency. `phase` (radians, 0..2 pi) is
 * where in the period; `tension` keeps the sign it has there. STRUM_ERR_MEMORY. */
typedef struct strum_periodic_peak {
    double tension, chi, phase;
} strum_periodic_peak;
strum_status strum_periodic_peak_find(strum_response *const *responses, const int *multiples,
                                      size_t count, strum_periodic_peak *peak);

/* NULL is fine. */
void strum_response_free(strum_response *response);

/* ---- second method ---- */

/* Integrates the first-order system from end 1 for two starting forces and combines them
 * (extrapolated midpoint rule, 1e-13 of the largest value a step). Fills `count` points at the
 * chi they carry, ascending. It shares nothing with the Galerkin method. STRUM_ERR_RANGE for a
 * cable as in strum_forced_solve and for a frequency that is negative or not finite,
 * STRUM_ERR_ACCURACY when the integration needs more than STRUM_SHOOT_STEPS_MAX steps (some
 * thousand waves along the cable) or overflows, STRUM_ERR_MEMORY, STRUM_ERR_CANCELLED,
 * STRUM_ERR_WORK. */
#define STRUM_SHOOT_STEPS_MAX 20000
strum_status strum_forced_shoot(const strum_cable *cable, double frequency,
                                const strum_end_motion *motion, strum_forced_point *points,
                                size_t count, const strum_options *options, strum_error *error);

/* A solved response held against the second method at 33 places: the largest differences of
 * tension and of displacement, each relative to the largest of its kind (0 where there is
 * none). Errors as of strum_forced_shoot. */
strum_status strum_response_verify(const strum_response *response, const strum_options *options,
                                   double *tension, double *displacement, strum_error *error);

STRUM_END_DECLS
#endif
