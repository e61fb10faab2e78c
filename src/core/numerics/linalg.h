/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dense linear algebra: thin wrappers of LAPACK, column-major. Sizes are positive; memory is
 * the arena's, and its work: a call that would pass its limit, or was cancelled, is not begun. */
#ifndef CORE_NUMERICS_LINALG_H
#define CORE_NUMERICS_LINALG_H

#include <complex.h>

#include "core/numerics/arena.h"
#include "core/numerics/status.h"

/* C = alpha A'A (+ C): A has `rows` x n, leading dimension lda; both triangles of C (n x n,
 * ldc) are set. */
void linalg_gram(int n, int rows, const double *a, int lda, double *c, int ldc);

/* C = A B, A m x k, B k x n. `ta`, `tb`: 'N' or 'T'. */
void linalg_multiply(char ta, char tb, int m, int n, int k, const double *a, int lda,
                     const double *b, int ldb, double *c, int ldc);

/* An eigenvalue of a matrix that is not graded is right to eps times the largest only. Far up
 * the spectrum Rayleigh's quotient, right to eps itself, mends it: it is taken whenever vectors
 * are asked for, and wanted from about this many on. */
#define LINALG_POLISH_FROM 24

/* Largest `want` eigenvalues mu of A v = mu B v, descending; A symmetric, B symmetric positive
 * definite, both n x n and left untouched. B NULL: the identity. `vectors` (n x want,
 * B-orthonormal) may be NULL. */
strum_status linalg_symmetric(int n, const double *a, int lda, const double *b, int ldb,
                              int want, double *values, double *vectors, arena *scratch);

/* A = L L' for A positive semidefinite (n x n), to its numerical rank: L is n x *rank (leading
 * dimension n). */
strum_status linalg_semidefinite_root(int n, const double *a, int lda, double *l, int *rank,
                                      arena *scratch);

/* All eigenpairs of (z^2 I + z C + M) g = 0, C and M symmetric n x n: 2n values, vectors n x
 * 2n. */
strum_status linalg_quadratic(int n, const double *c, const double *m, double _Complex *values,
                              double _Complex *vectors, arena *scratch);

/* Solves Z x = r in place: Z (n x n) is destroyed, r becomes x. */
strum_status linalg_complex_solve(int n, double _Complex *z, double _Complex *r,
                                  arena *scratch);

#endif
