/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elimination in symmetric matrices that counts negative pivots. */
#ifndef CORE_CABLE_PIVOTS_H
#define CORE_CABLE_PIVOTS_H

#include <stdbool.h>

/* Eliminates the first `count` of n unknowns without pivoting (lower triangle, column-major);
 * whether no pivot was near 0. */
bool pivots_eliminate(int n, int count, double *a, long *negative);
/* The same of few unknowns, full matrix, with complete pivoting; false: it is singular. */
bool pivots_eliminate_few(int n, int count, double *a, long *negative);

#endif
