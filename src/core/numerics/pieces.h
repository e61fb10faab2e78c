/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * LAPACK's long factorisations in pieces of at most some tenths of a second, before each of which
 * the work is asked whether it may go on. Sizes below PIECES_FROM are one call. Column-major,
 * lower triangles, as LAPACK; every function returns what work_spend says, STRUM_ERR_INTERNAL for
 * what cannot be factorised, or STRUM_OK. `w` may be NULL.
 */
#ifndef CORE_NUMERICS_PIECES_H
#define CORE_NUMERICS_PIECES_H

#include <stddef.h>

#include "core/numerics/arena.h"
#include "core/numerics/work.h"

/* From here on a single call would be long; below it every digit is LAPACK's own. */
#define PIECES_FROM 1200

/* The upper triangle of C = A'A: A has `rows` x n. */
strum_status pieces_gram(int n, int rows, const double *a, int lda, double *c, int ldc,
                         work *w);
/* A = L L' in place (lower triangle). */
strum_status pieces_cholesky(int n, double *a, int lda, work *w);
/* The symmetric c becomes L^-1 c L^-T (both triangles). */
strum_status pieces_reduce(int n, const double *l, double *c, work *w);
/* Lower form of dsytrd: d, e, tau, and the reflections below c's subdiagonal. */
strum_status pieces_tridiagonal(int n, double *c, double *d, double *e, double *tau,
                                arena *scratch);
/* z (n x columns) becomes Q z, Q from pieces_tridiagonal. */
strum_status pieces_back(int n, const double *c, const double *tau, int columns, double *z,
                         arena *scratch);
/* As dpstrf, to the tolerance `least` of a pivot: P'AP = L L', `pivots` from 1. */
strum_status pieces_pivoted(int n, double *a, int *pivots, int *rank, double least,
                            arena *scratch);

#endif
