/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The tensioned beam between two rotational springs, in lengths of the span and in units of the
 * tension: u^2 y'''' - y'' = om^2 y with u = sqrt(EI/T)/L = 1/xi and om^2 = m w^2 L^2/T. A mode's
 * wave number b holds both: om^2 = b^2 (1 + u^2 b^2).
 */
#ifndef CORE_IDENTIFY_BEAM_H
#define CORE_IDENTIFY_BEAM_H

/* One end: moment EI y'' = k y'; k L/EI = a/b, scaled so that a + b = 1. Pinned: a = 0; clamped:
 * b = 0. */
typedef struct beam_end {
    double a, b;
    double a_rho, b_rho; /* how a and b move with the fixity (before the common scale) */
} beam_end;

/* Fixity k/(k + 3 EI/L + sqrt(T EI)): Monforton and Wu's factor for a beam, that of the boundary
 * layer for a cable. */
beam_end beam_end_by_fixity(double rho, double u);
/* k L/EI given. */
beam_end beam_end_by_stiffness(double kappa);

/* A mode. Shares of the strain energy add up to 1. They are the derivatives of ln w^2: by ln T at
 * held EI and k, by ln EI at held T and k, by ln k. */
typedef struct beam_mode {
    double om; /* m w^2 L^2/T, its root */
    double b;  /* wave number over the length */
    double tension, bending, ends[2], sag;
    double by_rho[2]; /* d ln w^2 / d fixity of each end */
} beam_mode;

/* Mode n >= 1 without sag; u = 0: the string. */
beam_mode beam_solve(int n, double u, const beam_end ends[2]);

#endif
