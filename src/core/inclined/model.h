/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A solved inclined cable, and what a model of it is. Units as in include/strum/inclined.h; the
 * coordinate is x in [-1, 1] of core/numerics/mapping.h. */
#ifndef CORE_INCLINED_MODEL_H
#define CORE_INCLINED_MODEL_H

#include <strum/inclined.h>

#include "core/numerics/arena.h"
#include "core/numerics/legendre.h"
#include "core/numerics/mapping.h"
#include "core/numerics/work.h"

typedef struct inclined_model inclined_model;

/* A mode of an approximation. */
typedef struct inclined_wave {
    double kl;
    strum_symmetry symmetry; /* closed forms: of the factor that vanishes */
    double fast[2];          /* Airy: C3, C4 */
} inclined_wave;

struct strum_inclined {
    strum_inclined_cable cable;
    strum_inclined_model kind;
    const inclined_model *model;
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
    legendre rule;        /* approximations: for inclined_phase */
    mapping along;        /* from x to chi */
    int size;             /* Legendre functions of x that resolve the last mode */
    arena memory;         /* owns the arrays */
};

/* Modes first .. last-1, not normalised, at each of `points` values of x: out[i * (last -
 * first) + mode - first]. */
typedef struct inclined_samples {
    int first, last, points;
    const double *x;
    strum_inclined_point *out;
} inclined_samples;

/*
 * A model: one file, which ends in one of these, and one row of the table in solve.c.
 *
 * Models with a characteristic equation take solve, evaluate and verify from approximation.h
 * and state the equation below; the full model has its own three instead.
 */
struct inclined_model {
    const char *name;
    bool expansion;        /* in powers of epsilon: refused above STRUM_EXPANSION_EPSILON_MAX */
    bool has_longitudinal; /* waves along the cable are among its modes */
    bool meets_supports;   /* its shapes vanish there but for rounding */

    /* kl and symmetry of every mode, and what `evaluate` needs of them. */
    strum_status (*solve)(strum_inclined *m, work *w, strum_error *error);
    strum_status (*evaluate)(const strum_inclined *m, const inclined_samples *at,
                             arena *scratch, work *w);
    strum_status (*verify)(const strum_inclined *m, strum_verification *v, arena *a, work *w,
                           strum_error *error);
    /* Estimated time of `count` modes that need `size` Legendre functions, in microseconds;
     * `mechanics` may be NULL for a model with a characteristic equation. */
    double (*work_us)(const strum_cable *mechanics, int count, double size);

    /* ---- with a characteristic equation ---- */
    /* The lowest `count` roots; `*spurious`: one that no cable has, 0 without. */
    strum_status (*roots)(const strum_inclined *m, int count, inclined_wave *waves,
                          double *spurious, work *w);
    /* Real on the real axis and analytic. */
    double _Complex (*function)(const strum_inclined *m, double _Complex kl);
    /* One mode at out->s (and x); `phase` is inclined_phase there, 0 unless wanted. */
    void (*sample)(const strum_inclined *m, const inclined_wave *wave, double x, double phase,
                   strum_inclined_point *out);
    bool wants_phase;
};

extern const inclined_model inclined_full, inclined_airy, inclined_airy_tangent,
    inclined_asymptotic, inclined_irvine;

#endif
