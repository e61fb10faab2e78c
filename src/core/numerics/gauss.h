/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CORE_NUMERICS_GAUSS_H
#define CORE_NUMERICS_GAUSS_H

/* Gauss and Legendre's rule of n nodes on [-1, 1], ascending; n >= 1. The nodes are the zeros of
 * P_n by Newton's method in extended precision, the weights 2/((1 - x^2) P_n'(x)^2): both are
 * the doubles nearest to the exact values. Takes no memory. */
void gauss_legendre(int n, double *node, double *weight);

#endif
