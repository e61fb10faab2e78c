/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dense linear algebra: thin wrappers of LAPACK, column-major. Sizes are positive. Memory is freed
 * before they return, and counted by the work `w` (NULL: no limit), which is asked before each
 * piece of what is long: what would pass its limit, or was cancelled, is not begun. */
#ifndef CORE_NUMERICS_LINALG_H
#define CORE_NUMERICS_LINALG_H

#include <complex.h>

#include "core/numerics/work.h"
#include "core/numerics/status.h"

/* C = alpha A'A (+ C): A has `rows` x n, leading dimension lda; both triangles of C (n x n,
 * ldc) are set. */
strum_status linalg_gram(int n, int rows, const double *a, int lda, double *c, int ldc,
                         work *w);

/* C = A B, A m x k, B k x n. `ta`, `tb`: 'N' or 'T'. */
void linalg_multiply(char ta, char tb, int m, int n, int k, const double *a, int lda,
                     const double *b, int ldb, double *c, int ldc);

/* C = L'S L, S symmetric n x n (leading dimension lds), L n x r; `half`: room for n x r. */
strum_status linalg_project(int n, int r, const double *s, int lds, const double *l,
                            double *half, double *c, work *w);

/* An eigenvalue of a matrix that is not graded is right to eps times the largest only. Far up
 * the spectrum Rayleigh's quotient, right to eps itself, mends it: it is taken whenever vectors
 * are asked for, and wanted from about this many on. */
#define LINALG_POLISH_FROM 24

/* Largest `want` eigenvalues mu of A v = mu B v, descending; A symmetric, B symmetric positive
 * definite, both n x n and left untouched. B NULL: the identity. `vectors` (n x want,
 * B-orthonormal) may be NULL. */
strum_status linalg_symmetric(int n, const double *a, int lda, const double *b, int ldb,
                              int want, double *values, double *vectors, work *w);

/* A = L L' for A positive semidefinite (n x n), to its numerical rank: L is n x *rank (leading
 * dimension n). */
strum_status linalg_semidefinite_root(int n, const double *a, int lda, double *l, int *rank,
                                      work *w);

/* All eigenpairs of (z^2 I + z C + M) g = 0, C and M symmetric n x n: 2n values, vectors n x
 * 2n. */
strum_status linalg_quadratic(int n, const double *c, const double *m, double _Complex *values,
                              double _Complex *vectors, work *w);

/* Least squares: x minimises |A x - b| (A rows x n, rows >= n <= LINALG_NARROW, both destroyed; x
 * is the head of b). STRUM_ERR_ACCURACY where A has not the rank n. */
#define LINALG_NARROW 8
strum_status linalg_least_squares(int rows, int n, double *a, int lda, double *b);

/* Singular values of A (rows x n, destroyed; rows >= n <= LINALG_NARROW), descending, and the right
 * vectors as the rows of vt (n x n, column-major). */
strum_status linalg_singular(int rows, int n, double *a, int lda, double *values, double *vt);

/* Solves Z x = r in place: Z (n x n) is destroyed, r becomes x. */
strum_status linalg_complex_solve(int n, double _Complex *z, double _Complex *r, work *w);

#endif
