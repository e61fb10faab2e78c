/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eigenpairs of a large general matrix in pieces of at most some tenths of a second. */
#ifndef CORE_NUMERICS_SCHUR_H
#define CORE_NUMERICS_SCHUR_H

#include "core/numerics/arena.h"
#include "core/numerics/status.h"

/* All eigenvalues of a (n x n, destroyed), and the right eigenvectors where `vectors` (n x n) is
 * not NULL, as dgeev gives them but for their lengths: balancing, Hessenberg form, sweeps of small
 * bulges with early deflation (Braman, Byers, Mathias, SIAM J. Matrix Anal. Appl. 23, 2002,
 * 929-973), back substitution. What scratch->work says, STRUM_ERR_INTERNAL without convergence. */
strum_status schur_pairs(int n, double *a, double *re, double *im, double *vectors,
                         arena *scratch);

#endif
