/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Taut elastic inclined cables: in-plane modes and dynamic tension by L. Grinfogel, Dynamics of
 * Elastic Taut Inclined Cables (MIT, 1984), at all levels of the report, errata mended.
 *
 * Units. Dimensionless: lengths in L (along the cable, unstretched where it is elastic), forces
 * in T_a, masses per length in M (with the added mass), so that a frequency is
 *     kL = omega L sqrt(M/T_a).
 * T_a is the static tension where the cable is parallel to its chord. s = 0 at the lower
 * support, s = 1 at the upper one. Angles are in radians.
 *
 *     strum_inclined_params params = STRUM_INCLINED_PARAMS_INIT;
 *     params.cable.epsilon = 0.18;
 *     params.cable.inclination = 0.41;
 *     params.cable.lambda_squared = 38;
 *     params.count = 4;
 *     strum_inclined *modes;
 *     strum_error error;
 *     if (strum_inclined_solve(&params, NULL, &modes, &error) == STRUM_OK) {
 *         strum_inclined_mode mode;
 *         for (size_t i = 0; i < strum_inclined_count(modes); i++)
 *             if (strum_inclined_get(modes, i, &mode) == STRUM_OK)
 *                 printf("kL/pi = %.12g\n", mode.kl / 3.141592653589793);
 *         strum_inclined_free(modes);
 *     }
 *
 * Ownership: structs are the caller's; a strum_inclined is made by strum_inclined_solve, ended
 * by strum_inclined_free, and refers to nothing that it was made from. All functions are
 * re-entrant; an object may be read by many threads at once.
 */
#ifndef STRUM_INCLINED_H
#define STRUM_INCLINED_H

#include <math.h>

#include <strum/modes.h>

STRUM_BEGIN_DECLS

/* Ranges of strum_inclined_cable. Within them a slope may still be too steep (STRUM_CHI_MAX). */
#define STRUM_EPSILON_MIN         1e-6
#define STRUM_EPSILON_MAX         1e3
#define STRUM_INCLINATION_MAX_DEG 89.9
#define STRUM_LAMBDA_SQUARED_MIN  1e-20
#define STRUM_LAMBDA_SQUARED_MAX  1e15
#define STRUM_MASS_RATIO_MIN      1e-6
/* Beyond it the report's expansions mean nothing any more, and are refused. */
#define STRUM_EXPANSION_EPSILON_MAX 1.0

typedef struct strum_inclined_cable {
    double epsilon;        /* W0 L/T_a: weight over tension */
    double inclination;    /* phi_a of the chord, 0 <= phi_a < pi/2 */
    double lambda_squared; /* EA epsilon^2 cos^2(phi_a)/T_a; INFINITY: inextensible */
    double mass_ratio;     /* h = m/M, at most 1: mass without over mass with added mass */
    /* About the elastic catenary; else, as the report, the inextensible. */
    bool elastic_statics;
} strum_inclined_cable;

typedef enum strum_inclined_model {
    STRUM_INCLINED_FULL,         /* (1)-(5) without approximation */
    STRUM_INCLINED_AIRY,         /* 4 x 4 determinant of chapter 2, Q by (17), (18) */
    STRUM_INCLINED_AIRY_TANGENT, /* the same with Q's tangent at s_a: the report's tables */
    STRUM_INCLINED_ASYMPTOTIC,   /* (21), shapes (34) and (37), tension (38) */
    STRUM_INCLINED_IRVINE        /* (11), (20): no coupling of symmetric and antisymmetric */
} strum_inclined_model;

typedef struct strum_inclined_params {
    strum_inclined_cable cable;
    strum_inclined_model model;
    size_t count; /* modes from the lowest frequency: 1..STRUM_MODES_MAX */
    /* What strum_inclined_statics_find gave for this very cable, so that it is not found again;
     * read during the call only. NULL: the call finds it. */
    const struct strum_inclined_statics *statics;
} strum_inclined_params;

/* An inextensible level cable without added mass, six modes by the full model; its epsilon
 * remains to be set. */
#define STRUM_INCLINED_CABLE_INIT                                                              \
    {                                                                                          \
        0.0, 0.0, HUGE_VAL, 1.0, false                                                         \
    }
#define STRUM_INCLINED_PARAMS_INIT                                                             \
    {                                                                                          \
        STRUM_INCLINED_CABLE_INIT, STRUM_INCLINED_FULL, 6, NULL                                \
    }

/* strum_error.argument of the functions here: the parameter at fault. */
typedef enum strum_inclined_argument {
    STRUM_INCLINED_ARG_EPSILON = 1, /* also where the profile that follows is too steep */
    STRUM_INCLINED_ARG_INCLINATION,
    STRUM_INCLINED_ARG_LAMBDA_SQUARED,
    STRUM_INCLINED_ARG_MASS_RATIO,
    STRUM_INCLINED_ARG_MODEL,
    STRUM_INCLINED_ARG_COUNT
} strum_inclined_argument;

typedef enum strum_family { STRUM_TRANSVERSE, STRUM_LONGITUDINAL, STRUM_HYBRID } strum_family;
/* Share of the longitudinal energy up to which a mode is called transverse; 1 minus it, from
 * which it is called longitudinal. */
#define STRUM_HYBRID_SHARE 0.2

typedef struct strum_inclined_mode {
    double kl;
    strum_family family;
    strum_symmetry symmetry;      /* of a level cable */
    double longitudinal_energy;   /* h INT u^2/(h INT u^2 + INT w^2) */
    double symmetric_share;       /* of INT w^2: 1 symmetric about midspan, 0 antisymmetric */
    double tension_amplification; /* max|T| epsilon cos(phi_a)/max|w| */
    bool hybrid_region; /* |kL^2/lambda^2 - 1| < 2 epsilon sin(phi_a): 0 < s_0 < 1 in (18) */
} strum_inclined_mode;

/* Displacements; the largest value of the dominant one along the cable is +1 (the first such
 * point where tied). tension: in T_a per unit displacement in L. */
typedef struct strum_inclined_point {
    double s, transverse, longitudinal, tension;
} strum_inclined_point;

typedef struct strum_inclined strum_inclined;

/* The lowest modes of a cable by one of the models. `*modes` is the caller's, NULL after an
 * error: STRUM_ERR_RANGE with the argument; STRUM_ERR_IMPOSSIBLE where no such cable hangs;
 * STRUM_ERR_METHOD where an approximation does not reach the cable (argument: the model);
 * STRUM_ERR_ACCURACY; STRUM_ERR_CANCELLED and STRUM_ERR_WORK by `options` (may be NULL). */
strum_status strum_inclined_solve(const strum_inclined_params *params,
                                  const strum_options *options, strum_inclined **modes,
                                  strum_error *error);

/* The number of modes: params.count. */
size_t strum_inclined_count(const strum_inclined *modes);

/* Mode `i`, from 0; STRUM_ERR_RANGE where there is none. */
strum_status strum_inclined_get(const strum_inclined *modes, size_t i,
                                strum_inclined_mode *mode);

/* Shape of mode `i` at the `n` values of `s` (within 0..1, any order); where `s` is NULL, at
 * n >= 2 equally spaced ones, ends included. `shape`: room for n points. STRUM_ERR_RANGE where
 * there is no such mode or place. */
strum_status strum_inclined_shape(const strum_inclined *modes, size_t i, const double *s,
                                  size_t n, strum_inclined_point *shape);

/* A second method. Full model: the strains and transverse displacement as unknowns instead of
 * forces; modes counted by strum_modes_below; the residual is the displacement left at a
 * support, relative to the largest. Approximations: zeros of the characteristic function
 * counted by the argument principle, and how far each root lies from its nearest zero; the
 * residual is the function's value relative to those nearby. STRUM_ERR_METHOD for a cable that
 * stretches to a million times its length and more; otherwise errors as of the solve. */
strum_status strum_inclined_verify(const strum_inclined *modes, const strum_options *options,
                                   strum_verification *verification, strum_error *error);

/* NULL is fine. */
void strum_inclined_free(strum_inclined *modes);

/* The low root that the Airy determinant and (21) have and the cable has not, which is left out
 * of the modes; 0 where there is none, or none above 1e-3: rounding hides a lower one. */
double strum_inclined_spurious(const strum_inclined *modes);

/* Estimated time of strum_inclined_solve in microseconds of a present-day core; 0 for
 * parameters that it refuses. */
double strum_inclined_work(const strum_inclined_params *params);

/* ---- statics ---- */

typedef struct strum_inclined_statics {
    strum_catenary profile; /* in a = H/W0 */
    double stiffness;       /* EA/T_a; INFINITY: inextensible */
    double s_a;             /* where the cable is parallel to its chord */
    double tension_bottom, tension_top;
    double curvature_bottom, curvature_top;
    double angle_bottom, angle_top; /* to the horizontal */
    double chord, sag;              /* sag: largest vertical distance to the chord */
    double phase;                   /* INT T0^(-1/2) ds: W(L)/kL of the report */
} strum_inclined_statics;

/* The equilibrium of a cable; errors as of strum_inclined_solve. */
strum_status strum_inclined_statics_find(const strum_inclined_cable *cable,
                                         strum_inclined_statics *statics, strum_error *error);

/* Where a symmetric and the n-th antisymmetric mode meet: lambda = 2 n pi. */
typedef struct strum_crossover {
    int number;            /* n */
    double lambda_squared; /* (2 n pi)^2 */
    double low, high; /* lambda^2 of the hybrid region; high INFINITY: it has no upper end */
    bool inside;
    double gap; /* least distance of the two branches in kL, to leading order; 0: they cross */
} strum_crossover;

/* The crossover nearest in lambda; STRUM_ERR_METHOD for an inextensible cable, which has none.
 */
strum_status strum_inclined_crossover(const strum_inclined_cable *cable,
                                      strum_crossover *crossover);

STRUM_END_DECLS
#endif
