/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What a handbook would say of a suspended cable: the taut string, and the shallow elastic
 * cable of Irvine and Caughey (The linear theory of free vibrations of a suspended cable, Proc.
 * R. Soc. Lond. A 341, 1974, 299-315; Irvine, Cable Structures, 1981, sections 3.2-3.5). For an
 * inclined cable both use the chord: its length, the tension along it and the weight normal to
 * it.
 *
 * Units are those of catenary.h: a frequency in rad/s is the one here times sqrt(g/a).
 *
 *     strum_handbook shallow;
 *     strum_handbook_of(&catenary, &cable, &shallow);
 *     printf("lambda^2 = %g\n", shallow.lambda_squared);
 *     printf("first symmetric mode: %g\n",
 *            strum_handbook_in_plane(&shallow, STRUM_SYMMETRIC, 1));
 *
 * Ownership: everything is the caller's. The formulas hold for every cable that catenary.h makes,
 * and nothing here can fail. All functions are re-entrant.
 */
#ifndef STRUM_HANDBOOK_H
#define STRUM_HANDBOOK_H

#include <strum/catenary.h>

STRUM_BEGIN_DECLS

typedef struct strum_handbook {
    double chord;          /* L, length of the chord, in a */
    double tension;        /* T, its component along the chord, in H */
    double sag_ratio;      /* 8 d/L, d the sag normal to the chord */
    double lambda_squared; /* (8 d/L)^2 L EA/(T Le), Le = L (1 + (8 d/L)^2/8); INFINITY where
                              inextensible */
    double mass;           /* normal to the cable, per length */
} strum_handbook;

/* The handbook's cable with the exact one's supports, horizontal tension and sag. */
void strum_handbook_of(const strum_catenary *catenary, const strum_cable *cable,
                       strum_handbook *shallow);

/* omega_n = (n pi/L) sqrt(T/m), n >= 1: taut string in either plane, and shallow cable out of
 * plane. */
double strum_handbook_string(const strum_handbook *shallow, int n);
/* The k-th (k >= 1) symmetric or antisymmetric frequency in plane. */
double strum_handbook_in_plane(const strum_handbook *shallow, strum_symmetry symmetry, int k);
/* k-th positive root b of tan(b/2) = b/2 - (4/lambda^2) (b/2)^3, lambda_squared > 0 or
 * INFINITY. */
double strum_handbook_root(double lambda_squared, int k);

STRUM_END_DECLS
#endif
