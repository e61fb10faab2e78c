/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/numerics/linalg.h"

#include <cblas.h>
#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "core/numerics/work.h"

/* The _work forms: column-major passes through without copies, and no scan for NaN. */

static void mirror(int n, double *c, int ldc)
{
    for (int j = 0; j < n; j++)
        for (int i = 0; i < j; i++)
            c[j + (size_t)i * (size_t)ldc] = c[i + (size_t)j * (size_t)ldc];
}

static void copy(int rows, int columns, const double *from, int ldf, double *to, int ldt)
{
    for (int j = 0; j < columns; j++)
        memcpy(to + (size_t)j * (size_t)ldt, from + (size_t)j * (size_t)ldf,
               (size_t)rows * sizeof *to);
}

void linalg_gram(int n, int rows, const double *a, int lda, double *c, int ldc)
{
    cblas_dsyrk(CblasColMajor, CblasUpper, CblasTrans, n, rows, 1, a, lda, 0, c, ldc);
    mirror(n, c, ldc);
}

void linalg_multiply(char ta, char tb, int m, int n, int k, const double *a, int lda,
                     const double *b, int ldb, double *c, int ldc)
{
    cblas_dgemm(CblasColMajor, ta == 'T' ? CblasTrans : CblasNoTrans,
                tb == 'T' ? CblasTrans : CblasNoTrans, m, n, k, 1, a, lda, b, ldb, 0, c, ldc);
}

/*
 * Largest `want` eigenvalues of the symmetric c (destroyed), descending. Matrices of functions
 * in order of degree are graded: LAPACK's lower form takes its reflections from the first,
 * large column on and keeps the digits of the small eigenvalues; the upper form loses them.
 */
static strum_status symmetric_standard(int n, double *c, int want, double *values,
                                       double *vectors, arena *scratch)
{
    const size_t size = (size_t)n;
    double *all = arena_room(scratch, size);
    lapack_int *support = arena_alloc(scratch, 2 * size, sizeof *support);
    lapack_int *iwork = arena_alloc(scratch, 10 * size, sizeof *iwork);
    const lapack_int lwork = 40 * n;
    double *room = arena_room(scratch, (size_t)lwork);
    double *z = vectors != NULL ? arena_room(scratch, size * (size_t)want) : NULL;
    if (all == NULL || support == NULL || iwork == NULL || room == NULL ||
        (vectors != NULL && z == NULL))
        return STRUM_ERR_MEMORY;
    lapack_int found = n, info;
    if (vectors == NULL)
        info = LAPACKE_dsyev_work(LAPACK_COL_MAJOR, 'N', 'L', n, c, n, all, room, lwork);
    else
        info = LAPACKE_dsyevr_work(LAPACK_COL_MAJOR, 'V', want == n ? 'A' : 'I', 'L', n, c, n,
                                   0, 0, n - want + 1, n, 0, &found, all, z, n, support, room,
                                   lwork, iwork, 10 * n);
    if (info != 0 || (vectors != NULL && found != want))
        return STRUM_ERR_INTERNAL;
    for (int i = 0; i < want; i++) {
        values[i] = all[found - 1 - i];
        if (vectors != NULL)
            memcpy(vectors + (size_t)i * size, z + (size_t)(want - 1 - i) * size,
                   size * sizeof *z);
    }
    return STRUM_OK;
}

/* v'Sv of a column-major symmetric matrix. */
static double quadratic_form(int n, const double *s, int lds, const double *v)
{
    double sum = 0;
    for (int j = 0; j < n; j++)
        sum += v[j] * cblas_ddot(n, s + (size_t)j * (size_t)lds, 1, v, 1);
    return sum;
}

strum_status linalg_symmetric(int n, const double *a, int lda, const double *b, int ldb,
                              int want, double *values, double *vectors, arena *scratch)
{
    if (work_spend(scratch->work, 4e-4 * n * n * (double)n) != STRUM_OK)
        return scratch->work->status;
    const size_t size = (size_t)n * (size_t)n;
    double *c = arena_room(scratch, size);
    double *root = b != NULL ? arena_room(scratch, size) : NULL;
    if (c == NULL || (b != NULL && root == NULL))
        return STRUM_ERR_MEMORY;
    copy(n, n, a, lda, c, n);
    if (b != NULL) {
        copy(n, n, b, ldb, root, n);
        if (LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', n, root, n) != 0)
            return STRUM_ERR_INTERNAL;
        /* Twice the operations of dsygst, which spends its time in calls for single columns. */
        cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, n, n, 1,
                    root, n, c, n);
        cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, n, n, 1,
                    root, n, c, n);
    }
    const strum_status status = symmetric_standard(n, c, want, values, vectors, scratch);
    if (status == STRUM_OK && b != NULL && vectors != NULL)
        cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasTrans, CblasNonUnit, n, want, 1,
                    root, n, vectors, n);
    /* what is rounding of the largest has no digits to mend, nor has what follows it */
    for (int i = 0; status == STRUM_OK && vectors != NULL && i < want &&
                    (i == 0 || values[i - 1] > DBL_EPSILON / 4 * values[0]);
         i++) {
        const double *v = vectors + (size_t)i * (size_t)n;
        values[i] = quadratic_form(n, a, lda, v) /
                    (b != NULL ? quadratic_form(n, b, ldb, v) : cblas_ddot(n, v, 1, v, 1));
    }
    return status;
}

strum_status linalg_semidefinite_root(int n, const double *a, int lda, double *l, int *rank,
                                      arena *scratch)
{
    if (work_spend(scratch->work, 1e-3 * n * n * (double)n) != STRUM_OK)
        return scratch->work->status;
    lapack_int *pivots = arena_alloc(scratch, (size_t)n, sizeof *pivots);
    double *room = arena_doubles(scratch, 2 * (size_t)n);
    double *c = arena_room(scratch, (size_t)n * (size_t)n);
    if (pivots == NULL || room == NULL || c == NULL)
        return STRUM_ERR_MEMORY;
    copy(n, n, a, lda, c, n);
    double largest = 0;
    for (int i = 0; i < n; i++)
        largest = fmax(largest, c[i + (size_t)i * (size_t)n]);
    const lapack_int info = LAPACKE_dpstrf_work(LAPACK_COL_MAJOR, 'L', n, c, n, pivots, rank,
                                                DBL_EPSILON * largest, room);
    if (info < 0)
        return STRUM_ERR_INTERNAL;
    for (int j = 0; j < *rank; j++)
        for (int i = 0; i < n; i++)
            l[pivots[i] - 1 + (size_t)j * (size_t)n] =
                i >= j ? c[i + (size_t)j * (size_t)n] : 0;
    return STRUM_OK;
}

strum_status linalg_quadratic(int n, const double *c, const double *m, double _Complex *values,
                              double _Complex *vectors, arena *scratch)
{
    if (work_spend(scratch->work, 3e-2 * n * n * (double)n) != STRUM_OK)
        return scratch->work->status;
    const size_t s = (size_t)n, two = 2 * s;
    double *companion = arena_doubles(scratch, two * two);
    double *v = vectors != NULL ? arena_room(scratch, two * two) : NULL;
    double *re = arena_doubles(scratch, two), *im = arena_doubles(scratch, two);
    const lapack_int lwork = (lapack_int)(16 * two);
    double *room = arena_room(scratch, (size_t)lwork);
    if (companion == NULL || (vectors != NULL && v == NULL) || re == NULL || im == NULL ||
        room == NULL)
        return STRUM_ERR_MEMORY;
    /* z [z g; g] = [-C -M; I 0] [z g; g] */
    for (size_t j = 0; j < s; j++) {
        for (size_t i = 0; i < s; i++) {
            companion[i + j * two] = -c[i + j * s];
            companion[i + (j + s) * two] = -m[i + j * s];
        }
        companion[j + s + j * two] = 1;
    }
    if (LAPACKE_dgeev_work(LAPACK_COL_MAJOR, 'N', vectors != NULL ? 'V' : 'N', (lapack_int)two,
                           companion, (lapack_int)two, re, im, NULL, 1, v, (lapack_int)two,
                           room, lwork) != 0)
        return STRUM_ERR_INTERNAL;
    for (size_t j = 0; j < two; j++) {
        values[j] = CMPLX(re[j], im[j]);
        if (vectors == NULL)
            continue;
        /* a conjugate pair shares two real columns, the first belonging to Im > 0 */
        const double *x = v + j * two + s, *y = x + two;
        for (size_t i = 0; i < s; i++)
            vectors[i + j * s] = im[j] > 0   ? CMPLX(x[i], y[i])
                                 : im[j] < 0 ? CMPLX((x - two)[i], -x[i])
                                             : CMPLX(x[i], 0);
    }
    return STRUM_OK;
}

strum_status linalg_complex_solve(int n, double _Complex *z, double _Complex *r, arena *scratch)
{
    if (work_spend(scratch->work, 8e-4 * n * n * (double)n) != STRUM_OK)
        return scratch->work->status;
    lapack_int *pivots = arena_alloc(scratch, (size_t)n, sizeof *pivots);
    if (pivots == NULL)
        return STRUM_ERR_MEMORY;
    return LAPACKE_zgesv_work(LAPACK_COL_MAJOR, n, 1, z, n, pivots, r, n) == 0
               ? STRUM_OK
               : STRUM_ERR_INTERNAL;
}
