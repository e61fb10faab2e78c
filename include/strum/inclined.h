/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Taut elastic inclined cables: in-plane modes and dynamic tension by L. Grinfogel, Dynamics of
 * Elastic Taut Inclined Cables (MIT, 1984), at all levels of the report, errata mended.
 *
 * Units. Dimensionless: lengths in L (along the cable, unstretched where it is elastic), forces
 * in T_a, masses per length in M (with the added mass), so that a frequency is kL = omega L
 * sqrt(M/T_a). T_a is the static tension where the cable is parallel to its chord. s = 0 at the
 * lower support, s = 1 at the upper one.
 *
 * Ownership: structs are the caller's; strum_inclined_modes are made by strum_inclined_solve
 * and ended by strum_inclined_free. All functions are re-entrant.
 */
#ifndef STRUM_INCLINED_H
#define STRUM_INCLINED_H

#include <strum/modes.h>

STRUM_BEGIN_DECLS

/* Ranges of strum_inclined. Within them a slope may still be too steep (STRUM_CHI_MAX). */
#define STRUM_EPSILON_MIN         1e-6
#define STRUM_EPSILON_MAX         1e3
#define STRUM_INCLINATION_MAX_DEG 89.9
#define STRUM_LAMBDA_SQUARED_MIN  1e-20
#define STRUM_LAMBDA_SQUARED_MAX  1e15
#define STRUM_MASS_RATIO_MIN      1e-6
/* Beyond it the report's expansions mean nothing any more, and are refused. */
#define STRUM_EXPANSION_EPSILON_MAX 1.0

typedef struct strum_inclined {
    double epsilon;        /* W0 L/T_a */
    double inclination;    /* phi_a of the chord, radians, 0 <= phi_a < pi/2 */
    double lambda_squared; /* EA epsilon^2 cos^2(phi_a)/T_a; INFINITY: inextensible */
    double mass_ratio;     /* h = m/M, at most 1: mass without over mass with added mass */
    bool
        elastic_statics; /* about the elastic catenary; else, as the report, the inextensible */
} strum_inclined;

typedef struct strum_inclined_statics {
    strum_catenary profile; /* in a = H/W0 */
    double stiffness;       /* EA/T_a; INFINITY: inextensible */
    double s_a;             /* where the cable is parallel to its chord */
    double tension_bottom, tension_top;
    double curvature_bottom, curvature_top;
    double angle_bottom, angle_top; /* to the horizontal, radians */
    double chord, sag;              /* sag: largest vertical distance to the chord */
    double phase;                   /* INT T0^(-1/2) ds: W(L)/kL of the report */
} strum_inclined_statics;

strum_status strum_inclined_statics_find(const strum_inclined *cable,
                                         strum_inclined_statics *statics, strum_error *fault);

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
strum_status strum_inclined_crossover(const strum_inclined *cable, strum_crossover *crossover);

typedef enum strum_inclined_model {
    STRUM_INCLINED_FULL,         /* (1)-(5) without approximation */
    STRUM_INCLINED_AIRY,         /* 4 x 4 determinant of chapter 2, Q by (17), (18) */
    STRUM_INCLINED_AIRY_TANGENT, /* the same with Q's tangent at s_a: the report's tables */
    STRUM_INCLINED_ASYMPTOTIC,   /* (21), shapes (34) and (37), tension (38) */
    STRUM_INCLINED_IRVINE        /* (11), (20): no coupling of symmetric and antisymmetric */
} strum_inclined_model;

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

typedef struct strum_inclined_modes strum_inclined_modes;

/* The first `count` (1..STRUM_MODES_MAX) modes by frequency. STRUM_ERR_METHOD where an
 * approximation does not reach the cable. */
strum_status strum_inclined_solve(const strum_inclined *cable, strum_inclined_model model,
                                  int count, strum_inclined_modes **modes, strum_error *fault);
void strum_inclined_free(strum_inclined_modes **modes);
/* Estimated time of strum_inclined_solve in microseconds. */
double strum_inclined_work(const strum_inclined *cable, strum_inclined_model model, int count);

int strum_inclined_count(const strum_inclined_modes *modes);
/* Mode `index` in 0..count-1; owned by `modes`. */
const strum_inclined_mode *strum_inclined_mode_at(const strum_inclined_modes *modes, int index);
/* The low root that the Airy determinant and (21) have and the cable has not, which is left out
 * of the modes; 0 where there is none, or none above 1e-3: rounding hides a lower one. */
double strum_inclined_spurious(const strum_inclined_modes *modes);

/* Shape of mode `index` at `points` >= 2 equally spaced values of s, ends included. */
strum_status strum_inclined_shape(const strum_inclined_modes *modes, int index, int points,
                                  strum_inclined_point *shape);

/* A second method. Full model: the strains and transverse displacement as unknowns instead of
 * forces; modes counted by strum_modes_below. Approximations: zeros of the characteristic
 * function counted by the argument principle, and how far each root lies from its nearest zero.
 * STRUM_ERR_METHOD for a cable that stretches to a million times its length and more.
 */
strum_status strum_inclined_verify(const strum_inclined_modes *modes,
                                   strum_verification *verification, strum_error *fault);

STRUM_END_DECLS
#endif
