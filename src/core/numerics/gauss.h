/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Gauss and Legendre's rule of n nodes on [-1, 1], n even: the zeros x of P_n and the weights
 *     2/((1 - x^2) P_n'(x)^2).
 * The sizes that discretisations choose are constants (gauss_tables.py), each the double nearest
 * to the exact value; others cost a Newton iteration a node, in extended precision. Nothing is
 * allocated.
 */
#ifndef CORE_NUMERICS_GAUSS_H
#define CORE_NUMERICS_GAUSS_H

/* The smallest size of at least `needed` nodes that costs little; even. */
int gauss_size(int needed);
/* All nodes, ascending, and their weights. */
void gauss_legendre(int n, double *node, double *weight);
/* The n/2 nodes above 0 only. */
void gauss_legendre_half(int n, double *node, double *weight);

#endif
