/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the models of the inclined cable share. Units as in include/strum/inclined.h; the
 * coordinate is x in [-1, 1] of core/numerics/mapping.h. */
#ifndef CORE_INCLINED_INCLINED_H
#define CORE_INCLINED_INCLINED_H

#include <strum/inclined.h>

#include "core/suspended/modes.h"

/* A mode of an approximation. */
typedef struct inclined_wave {
    double kl;
    strum_symmetry symmetry; /* closed forms: of the factor that vanishes */
    double fast[2];          /* Airy: C3, C4 */
} inclined_wave;

struct strum_inclined_modes {
    strum_inclined cable;
    strum_inclined_model model;
    strum_inclined_statics statics;
    double length; /* L in a: epsilon/cos(phi_a) */
    int count;
    double spurious;
    strum_inclined_mode *modes;
    double *unit;         /* a shape's values are divided by it */
    double *forces;       /* full: size x 2 a mode, coefficients of its force's q_k */
    double *constants;    /* full: 2 a mode, the force's constants */
    double *stretch;      /* full: size a mode, du/dx in p_k */
    inclined_wave *waves; /* approximations */
    legendre rule;        /* Airy: for inclined_phase */
    mapping along;        /* from x to chi */
    int size;             /* Legendre functions of x that resolve the last mode */
    arena memory;         /* owns the arrays */
};

/* The cable as the core's mechanics sees it, masses in M. */
strum_cable inclined_mechanics(const strum_inclined *cable,
                               const strum_inclined_statics *statics);
/* INT T0^(-1/2) ds from the lower support to where chi - chi_m is `offset`; `rule`:
 * legendre_make(1, ..). */
double inclined_phase(const strum_inclined *cable, const strum_catenary *profile,
                      const legendre *rule, double offset);
double inclined_s_of_x(const strum_inclined_modes *m, double x);
double inclined_x_of_s(const strum_inclined_modes *m, double s);

/* Modes first .. last-1, not normalised, at each of `points` values of x: out[i * (last -
 * first)
 * + mode]. */
strum_status inclined_sample(const strum_inclined_modes *m, int first, int last, int points,
                             const double *x, strum_inclined_point *out, arena *scratch);
/* Full: du/dx of all modes, which inclined_sample needs. */
strum_status inclined_stretch(strum_inclined_modes *m);
/* Energies, shares, maxima and units of all modes. */
strum_status inclined_measure(strum_inclined_modes *m);

/* An approximation's roots: the lowest `count` into `waves`. */
strum_status inclined_roots(const strum_inclined_modes *m, int count, inclined_wave *waves,
                            double *spurious);
strum_status inclined_airy_roots(const strum_inclined_modes *m, int count, inclined_wave *waves,
                                 double *spurious);
strum_status inclined_closed_roots(const strum_inclined_modes *m, int count,
                                   inclined_wave *waves, double *spurious);
/* Length in kL that holds few of its roots: 1, less where longitudinal waves are slow. */
double inclined_spacing(const strum_inclined_modes *m);
/* Its characteristic function, real on the real axis and analytic. */
double _Complex inclined_airy_function(const strum_inclined_modes *m, double _Complex kl);
double _Complex inclined_closed_function(const strum_inclined_modes *m, double _Complex kl);
/* One mode at s (and x); `phase` is inclined_phase there. */
void inclined_airy_sample(const strum_inclined_modes *m, const inclined_wave *wave, double x,
                          double phase, strum_inclined_point *out);
void inclined_closed_sample(const strum_inclined_modes *m, const inclined_wave *wave,
                            strum_inclined_point *out);

#endif
