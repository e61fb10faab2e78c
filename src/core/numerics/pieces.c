/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/numerics/pieces.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>

/* Of LAPACK, which has no C form of them. */
extern void dlatrd_(const char *uplo, const int *n, const int *nb, double *a, const int *lda,
                    double *e, double *tau, double *w, const int *ldw, size_t length);
extern void dsytd2_(const char *uplo, const int *n, double *a, const int *lda, double *d,
                    double *e, double *tau, int *info, size_t length);

static size_t at(int i, int j, int ld)
{
    return (size_t)i + (size_t)j * (size_t)ld;
}

static int least_of(int a, int b)
{
    return a < b ? a : b;
}

/* About 0.2 s of products. */
#define GRAM_LONG  6e9
#define GRAM_BLOCK 128

strum_status pieces_gram(int n, int rows, const double *a, int lda, double *c, int ldc, work *w)
{
    if (n == 0) /* BLAS would print that the leading dimension 0 is none */
        return STRUM_OK;
    if ((double)n * n * rows < GRAM_LONG) {
        const strum_status status = work_poll(w);
        if (status == STRUM_OK)
            cblas_dsyrk(CblasColMajor, CblasUpper, CblasTrans, n, rows, 1, a, lda, 0, c, ldc);
        return status;
    }
    for (int j = 0; j < n; j += GRAM_BLOCK) {
        const int m = least_of(GRAM_BLOCK, n - j);
        const double *here = a + at(0, j, lda);
        const strum_status status = work_poll(w);
        if (status != STRUM_OK)
            return status;
        cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, j, m, rows, 1, a, lda, here, lda,
                    0, c + at(0, j, ldc), ldc);
        cblas_dsyrk(CblasColMajor, CblasUpper, CblasTrans, m, rows, 1, here, lda, 0,
                    c + at(j, j, ldc), ldc);
    }
    return STRUM_OK;
}

strum_status pieces_cholesky(int n, double *a, int lda, work *w)
{
    for (int j = 0; j < n;) {
        const int m = n - j < 2 * PIECES_FROM ? n - j : PIECES_FROM, rest = n - j - m;
        double *corner = a + at(j, j, lda), *below = corner + m;
        const strum_status status = work_poll(w);
        if (status != STRUM_OK)
            return status;
        if (LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', m, corner, lda) != 0)
            return STRUM_ERR_INTERNAL;
        if (rest > 0) {
            cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, rest,
                        m, 1, corner, lda, below, lda);
            cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, rest, m, -1, below, lda, 1,
                        below + at(0, m, lda), lda);
        }
        j += m;
    }
    return STRUM_OK;
}

strum_status pieces_reduce(int n, const double *l, double *c, work *w)
{
    const int block = n < PIECES_FROM ? n : 384;
    strum_status status = STRUM_OK;
    for (int j = 0; j < n && status == STRUM_OK; j += block) {
        status = work_poll(w);
        if (status == STRUM_OK)
            cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, n,
                        least_of(block, n - j), 1, l, n, c + at(0, j, n), n);
    }
    for (int i = 0; i < n && status == STRUM_OK; i += block) {
        status = work_poll(w);
        if (status == STRUM_OK)
            cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit,
                        least_of(block, n - i), n, 1, l, n, c + i, n);
    }
    return status;
}

/* Columns that are reduced together: LAPACK's own number, so that the digits are its too. */
#define PANEL 32

strum_status pieces_tridiagonal(int n, double *c, double *d, double *e, double *tau,
                                arena *scratch)
{
    const int panel = PANEL;
    double *room = arena_doubles(scratch, (size_t)n * PANEL);
    if (room == NULL)
        return STRUM_ERR_MEMORY;
    int j = 0, info = 0;
    for (; j < n - PANEL; j += PANEL) {
        const int left = n - j, after = left - PANEL;
        double *corner = c + at(j, j, n);
        const strum_status status = work_poll(scratch->work);
        if (status != STRUM_OK)
            return status;
        dlatrd_("L", &left, &panel, corner, &n, e + j, tau + j, room, &n, 1);
        cblas_dsyr2k(CblasColMajor, CblasLower, CblasNoTrans, after, PANEL, -1, corner + PANEL,
                     n, room + PANEL, n, 1, corner + at(PANEL, PANEL, n), n);
        for (int i = j; i < j + PANEL; i++) {
            c[at(i + 1, i, n)] = e[i];
            d[i] = c[at(i, i, n)];
        }
    }
    const int left = n - j;
    dsytd2_("L", &left, c + at(j, j, n), &n, d + j, e + j, tau + j, &info, 1);
    return info == 0 ? STRUM_OK : STRUM_ERR_INTERNAL;
}

/* Reflections that are applied together: a multiple of any block of LAPACK's. */
#define GROUP 256

strum_status pieces_back(int n, const double *c, const double *tau, int columns, double *z,
                         arena *scratch)
{
    const int count = n - 1, lwork = 64 * columns + 65 * 64;
    double *room = arena_doubles(scratch, (size_t)lwork);
    if (room == NULL)
        return STRUM_ERR_MEMORY;
    int first = count < 2 * GROUP ? 0 : (count / GROUP - 1) * GROUP;
    for (int last = count; last > 0; last = first, first -= GROUP) {
        const strum_status status = work_poll(scratch->work);
        if (status != STRUM_OK)
            return status;
        if (LAPACKE_dormqr_work(LAPACK_COL_MAJOR, 'L', 'N', count - first, columns,
                                last - first, c + at(1 + first, first, n), n, tau + first,
                                z + 1 + first, n, room, lwork) != 0)
            return STRUM_ERR_INTERNAL;
    }
    return STRUM_OK;
}

/* Rows and columns i < j of a symmetric matrix's lower triangle change places. */
static void exchange(int n, double *a, int i, int j)
{
    const double kept = a[at(i, i, n)];
    a[at(i, i, n)] = a[at(j, j, n)];
    a[at(j, j, n)] = kept;
    cblas_dswap(i, a + i, n, a + j, n);
    if (j + 1 < n)
        cblas_dswap(n - j - 1, a + at(j + 1, i, n), 1, a + at(j + 1, j, n), 1);
    cblas_dswap(j - i - 1, a + at(i + 1, i, n), 1, a + at(j, i + 1, n), n);
}

/* Columns from..to-1, whose reductions by earlier panels are done; false where no pivot is larger
 * than `least`: `*rank` columns are. `square`: of the entries within the panel, by rows. */
static bool pivoted_panel(int n, double *a, int from, int to, int *pivots, double least,
                          double *square, int *rank)
{
    for (int i = from; i < n; i++)
        square[i] = 0;
    for (int j = from; j < to; j++) {
        int best = j;
        double largest = -INFINITY;
        for (int i = j; i < n; i++) {
            if (j > from)
                square[i] += pow(a[at(i, j - 1, n)], 2);
            const double left = a[at(i, i, n)] - square[i];
            if (left > largest) {
                largest = left;
                best = i;
            }
        }
        if (!(largest > least)) {
            *rank = j;
            return false;
        }
        if (best != j) {
            exchange(n, a, j, best);
            square[best] = square[j];
            const int kept = pivots[best];
            pivots[best] = pivots[j];
            pivots[j] = kept;
        }
        a[at(j, j, n)] = sqrt(largest);
        if (j + 1 == n)
            continue;
        cblas_dgemv(CblasColMajor, CblasNoTrans, n - j - 1, j - from, -1,
                    a + at(j + 1, from, n), n, a + at(j, from, n), n, 1, a + at(j + 1, j, n),
                    1);
        cblas_dscal(n - j - 1, 1 / a[at(j, j, n)], a + at(j + 1, j, n), 1);
    }
    return true;
}

strum_status pieces_pivoted(int n, double *a, int *pivots, int *rank, double least,
                            arena *scratch)
{
    double *room = arena_doubles(scratch, 2 * (size_t)n);
    if (room == NULL)
        return STRUM_ERR_MEMORY;
    if (n < PIECES_FROM)
        return LAPACKE_dpstrf_work(LAPACK_COL_MAJOR, 'L', n, a, n, pivots, rank, least, room) <
                       0
                   ? STRUM_ERR_INTERNAL
                   : STRUM_OK;
    for (int i = 0; i < n; i++)
        pivots[i] = i + 1;
    *rank = n;
    for (int j = 0; j < n; j += PANEL) {
        const int to = least_of(j + PANEL, n);
        const strum_status status = work_poll(scratch->work);
        if (status != STRUM_OK)
            return status;
        if (!pivoted_panel(n, a, j, to, pivots, least, room, rank))
            break;
        cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, n - to, to - j, -1,
                    a + at(to, j, n), n, 1, a + at(to, to, n), n);
    }
    return STRUM_OK;
}
