/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * From x in [-1, 1], where the Legendre functions live, to the slope parameter chi. Linear as a
 * rule. On a deep cable transverse waves shorten as sqrt(cosh chi) towards the ends; where many
 * of them are wanted, chi = A asinh(m + r x) evens them out and halves or thirds the number of
 * functions they need.
 */
#ifndef CORE_NUMERICS_MAPPING_H
#define CORE_NUMERICS_MAPPING_H

#include <strum/catenary.h>

typedef struct mapping {
    double chi_m, mu;
    double stretch;      /* A; 0: linear */
    double middle, half; /* m, r */
} mapping;

mapping mapping_linear(const strum_cable *cable);
/* A = 2 would make the waves of a deep cable even, infinity is linear. */
mapping mapping_stretched(const strum_cable *cable, double stretch);

/* chi(x) - chi_m, without cancellation where the coordinate is linear. */
double mapping_offset(const mapping *c, double x);
/* dchi/dx and its logarithmic derivative. */
double mapping_slope(const mapping *c, double x);
double mapping_bend(const mapping *c, double x);
/* x(chi), within [-1, 1]. */
double mapping_x(const mapping *c, double chi);
/* Distance from the real axis, in x, of the nearest singularity of the cable's coefficients,
 * chi = i pi/2. */
double mapping_singularity(const mapping *c);
/* Rate at which Legendre series of the coefficients shrink, e^(-rate n): of the ellipse through
 * that singularity (larger than the distance where it lies beside an end). */
double mapping_ellipse_rate(const mapping *c);

#endif
