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
 * A strum_forced holds one modal solution that serves every frequency up to the one it was made
 * for; it is read-only once made, so threads may share it. A strum_response is one caller's.
 */
#ifndef STRUM_FORCED_H
#define STRUM_FORCED_H

#include <strum/catenary.h>

STRUM_BEGIN_DECLS

typedef struct strum_forced strum_forced;
typedef struct strum_response strum_response;

/* Displacement of end 2 in a, along and normal to the tangent there, and out of plane. */
typedef struct strum_end_motion {
    strum_complex tangential, normal, out_of_plane;
} strum_end_motion;

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

/* Prepares responses at frequencies 0..frequency_max to motion in plane, out of plane or both.
 * STRUM_ERR_ACCURACY, STRUM_ERR_RANGE as in strum_modes_solve; at most STRUM_MODES_MAX modes
 * may lie below frequency_max. */
strum_status strum_forced_make(const strum_cable *cable, double frequency_max, bool in_plane,
                               bool out_of_plane, strum_forced **forced, strum_error *fault);
void strum_forced_free(strum_forced **forced);

/* Room for a response of this cable; NULL without memory. */
strum_response *strum_response_make(const strum_forced *forced);
void strum_response_free(strum_response **response);

/* Response to the motion at a frequency in 0..frequency_max; 0 is the exact static answer.
 * STRUM_ERR_METHOD when an undamped cable is driven within 1e-8 of a natural frequency that
 * the motion excites: there is no bounded answer; the resonance is written to `at` (may be
 * NULL). */
strum_status strum_forced_solve(const strum_forced *forced, double frequency,
                                const strum_end_motion *motion, strum_response *response,
                                strum_resonance *at);

/* The response at one chi, and its largest dynamic tension. */
void strum_response_at(const strum_response *response, double chi, strum_forced_point *point);
void strum_response_peak(const strum_response *response, strum_peak *peak);

/* Natural frequencies below frequency_max with their residues for a motion: in plane where it
 * has an in-plane part, out of plane where it has that; ascending. Returns their number; `list`
 * has room for `room`. */
int strum_forced_resonances(const strum_forced *forced, const strum_end_motion *motion,
                            strum_resonance *list, int room);

/* Second method: integrates the first-order system from end 1 for two starting forces and
 * combines them (eighth-order Runge-Kutta, tolerance 1e-12). Fills `points` points at the chi
 * they carry. In plane only where the motion is; shares nothing with the Galerkin method.
 * STRUM_ERR_ACCURACY when the integration fails. */
strum_status strum_forced_shoot(const strum_cable *cable, double frequency,
                                const strum_end_motion *motion, strum_forced_point *points,
                                int count, strum_error *fault);

/* A response held against the second method at 33 places: the largest differences of tension
 * and of displacement, each relative to the largest of its kind (0 where there is none). */
strum_status strum_forced_compare(const strum_response *response, double frequency,
                                  double *tension, double *displacement, strum_error *fault);

/* The largest dynamic tension over cable and period of a sum of harmonics Re(sum T_k e^{i k_m
 * phase}): the responses are of the multiples k_m of one frequency. `phase` (radians, 0..2 pi)
 * is where in the period, the sign of the tension there is kept in `tension`. */
typedef struct strum_periodic_peak {
    double tension, chi, phase;
} strum_periodic_peak;
strum_status strum_periodic_peak_find(strum_response *const *responses, const int *multiples,
                                      int count, strum_periodic_peak *peak);

STRUM_END_DECLS
#endif
