/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/numerics/linalg.h"

#include <cblas.h>
#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "core/numerics/pieces.h"
#include "core/numerics/schur.h"

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

strum_status linalg_gram(int n, int rows, const double *a, int lda, double *c, int ldc, work *w)
{
    const strum_status status = pieces_gram(n, rows, a, lda, c, ldc, w);
    if (status == STRUM_OK)
        mirror(n, c, ldc);
    return status;
}

void linalg_multiply(char ta, char tb, int m, int n, int k, const double *a, int lda,
                     const double *b, int ldb, double *c, int ldc)
{
    cblas_dgemm(CblasColMajor, ta == 'T' ? CblasTrans : CblasNoTrans,
                tb == 'T' ? CblasTrans : CblasNoTrans, m, n, k, 1, a, lda, b, ldb, 0, c, ldc);
}

/* About 0.1 s. */
#define PRODUCT_LONG 2e9

strum_status linalg_project(int n, int r, const double *s, int lds, const double *l,
                            double *half, double *c, work *w)
{
    const int block = (double)n * n * r < PRODUCT_LONG ? r : 256;
    strum_status status = STRUM_OK;
    for (int pass = 0; pass < 2; pass++)
        for (int j = 0; j < r && status == STRUM_OK; j += block) {
            const int columns = block < r - j ? block : r - j;
            double *half_j = half + (size_t)j * (size_t)n;
            status = work_poll(w);
            if (status != STRUM_OK)
                break;
            if (pass == 0)
                linalg_multiply('N', 'N', n, columns, n, s, lds, l + (size_t)j * (size_t)n, n,
                                half_j, n);
            else
                linalg_multiply('T', 'N', r, columns, n, l, n, half_j, n,
                                c + (size_t)j * (size_t)r, r);
        }
    return status;
}

/* A tridiagonal matrix, all of whose eigenvectors or the last few are wanted. */
typedef struct tridiagonal {
    int n, want;
    double *d, *e;  /* dsterf and dstemr destroy them */
    double *values; /* n; ascending */
    double *z;      /* n x want; NULL: values alone */
} tridiagonal;

/* The `want` largest by bisection and inverse iteration, ordered by blocks. */
static strum_status solve_last(const tridiagonal *t, arena *scratch)
{
    const size_t n = (size_t)t->n;
    lapack_int found, blocks, *whole = arena_alloc(scratch, 6 * n, sizeof *whole);
    double *room = arena_doubles(scratch, 5 * n);
    if (whole == NULL || room == NULL)
        return STRUM_ERR_MEMORY;
    lapack_int *block = whole + 3 * n, *split = block + n, *failed = split + n;
    if (LAPACKE_dstebz_work('I', 'B', t->n, 0, 0, t->n - t->want + 1, t->n, 0, t->d, t->e,
                            &found, &blocks, t->values, block, split, room, whole) != 0 ||
        found != t->want)
        return STRUM_ERR_INTERNAL;
    const strum_status status = work_poll(scratch->work);
    if (status != STRUM_OK)
        return status;
    return LAPACKE_dstein_work(LAPACK_COL_MAJOR, t->n, t->d, t->e, found, t->values, block,
                               split, t->z, t->n, room, whole, failed) == 0
               ? STRUM_OK
               : STRUM_ERR_INTERNAL;
}

static strum_status solve_all(const tridiagonal *t, arena *scratch)
{
    const size_t n = (size_t)t->n;
    const lapack_int lwork = 18 * t->n, liwork = 10 * t->n;
    lapack_int *iwork = arena_alloc(scratch, 12 * n, sizeof *iwork), found, relative = 1;
    double *room = arena_doubles(scratch, (size_t)lwork + 2 * n), *d = room + lwork, *e = d + n;
    if (iwork == NULL || room == NULL)
        return STRUM_ERR_MEMORY;
    memcpy(d, t->d, n * sizeof *d);
    memcpy(e, t->e, (n - 1) * sizeof *e);
    const lapack_int info = LAPACKE_dstemr_work(
        LAPACK_COL_MAJOR, 'V', 'A', t->n, d, e, 0, 0, 0, 0, &found, t->values, t->z, t->n, t->n,
        iwork + liwork, &relative, room, lwork, iwork, liwork);
    return info == 0 && found == t->n ? STRUM_OK : solve_last(t, scratch);
}

/* Ascending, vectors with their values. */
static void sort_pairs(const tridiagonal *t)
{
    for (int j = 0; j + 1 < t->want && t->z != NULL; j++) {
        int least = j;
        for (int i = j + 1; i < t->want; i++)
            if (t->values[i] < t->values[least])
                least = i;
        if (least == j)
            continue;
        const double kept = t->values[j];
        t->values[j] = t->values[least];
        t->values[least] = kept;
        cblas_dswap(t->n, t->z + (size_t)j * (size_t)t->n, 1,
                    t->z + (size_t)least * (size_t)t->n, 1);
    }
}

/* dsyev and dsyevr in pieces, with their digits; what they scale is not for them. */
static strum_status symmetric_in_pieces(int n, double *c, int want, double *all, double *z,
                                        arena *scratch)
{
    const size_t size = (size_t)n;
    double *d = arena_doubles(scratch, 3 * size), *e = d + size, *tau = e + size;
    if (d == NULL)
        return STRUM_ERR_MEMORY;
    const tridiagonal t = {n, want, d, e, all, z};
    strum_status status = pieces_tridiagonal(n, c, d, e, tau, scratch);
    if (status == STRUM_OK)
        status = work_poll(scratch->work);
    if (status != STRUM_OK)
        return status;
    if (z == NULL) {
        memcpy(all, d, size * sizeof *all);
        return LAPACKE_dsterf_work(n, all, e) == 0 ? STRUM_OK : STRUM_ERR_INTERNAL;
    }
    status = want == n ? solve_all(&t, scratch) : solve_last(&t, scratch);
    if (status == STRUM_OK)
        status = pieces_back(n, c, tau, want, z, scratch);
    if (status == STRUM_OK)
        sort_pairs(&t);
    return status;
}

/* dsyev and dsyevr scale matrices beyond these bounds; a matrix of NaN or infinities is theirs
 * to refuse. */
static bool unscaled(int n, const double *c)
{
    double largest = 0;
    for (int j = 0; j < n; j++)
        for (int i = j; i < n; i++) {
            const double size = fabs(c[(size_t)i + (size_t)j * (size_t)n]);
            if (!(size <= 1e60))
                return false;
            largest = fmax(largest, size);
        }
    return largest > 1e-60;
}

/* Below it a call takes a few hundredths of a second. */
#define SYMMETRIC_FROM 700

/* The `want` largest (ascending, the last of `all`'s first `found`). */
static strum_status symmetric_at_once(int n, double *c, int want, double *all, double *z,
                                      lapack_int *found, arena *scratch)
{
    const size_t size = (size_t)n;
    lapack_int *support = arena_alloc(scratch, 2 * size, sizeof *support);
    lapack_int *iwork = arena_alloc(scratch, 10 * size, sizeof *iwork);
    const lapack_int lwork = 40 * n;
    double *room = arena_doubles(scratch, (size_t)lwork);
    if (support == NULL || iwork == NULL || room == NULL)
        return STRUM_ERR_MEMORY;
    *found = n;
    const lapack_int info =
        z == NULL ? LAPACKE_dsyev_work(LAPACK_COL_MAJOR, 'N', 'L', n, c, n, all, room, lwork)
                  : LAPACKE_dsyevr_work(LAPACK_COL_MAJOR, 'V', want == n ? 'A' : 'I', 'L', n, c,
                                        n, 0, 0, n - want + 1, n, 0, found, all, z, n, support,
                                        room, lwork, iwork, 10 * n);
    return info == 0 && (z == NULL || *found == want) ? STRUM_OK : STRUM_ERR_INTERNAL;
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
    double *z = vectors != NULL ? arena_room(scratch, size * (size_t)want) : NULL;
    lapack_int found = z != NULL ? want : n;
    if (all == NULL || (vectors != NULL && z == NULL))
        return STRUM_ERR_MEMORY;
    const strum_status status = n >= SYMMETRIC_FROM && unscaled(n, c)
                                    ? symmetric_in_pieces(n, c, want, all, z, scratch)
                                    : symmetric_at_once(n, c, want, all, z, &found, scratch);
    if (status != STRUM_OK)
        return status;
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

/* linalg_symmetric with its own scratch. */
static strum_status symmetric(int n, const double *a, int lda, const double *b, int ldb,
                              int want, double *values, double *vectors, arena *scratch)
{
    const size_t size = (size_t)n * (size_t)n;
    double *c = arena_room(scratch, size);
    double *root = b != NULL ? arena_room(scratch, size) : NULL;
    if (c == NULL || (b != NULL && root == NULL))
        return STRUM_ERR_MEMORY;
    strum_status status = STRUM_OK;
    copy(n, n, a, lda, c, n);
    if (b != NULL) {
        copy(n, n, b, ldb, root, n);
        status = pieces_cholesky(n, root, n, scratch->work);
        /* Twice the operations of dsygst, which spends its time in calls for single columns. */
        if (status == STRUM_OK)
            status = pieces_reduce(n, root, c, scratch->work);
    }
    if (status == STRUM_OK)
        status = symmetric_standard(n, c, want, values, vectors, scratch);
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
        status = work_poll(scratch->work);
    }
    return status;
}

strum_status linalg_symmetric(int n, const double *a, int lda, const double *b, int ldb,
                              int want, double *values, double *vectors, work *w)
{
    arena scratch = {.work = w};
    strum_status status = work_spend(w, 4e-4 * n * n * (double)n);
    if (status == STRUM_OK)
        status = symmetric(n, a, lda, b, ldb, want, values, vectors, &scratch);
    arena_free(&scratch);
    return status;
}

static strum_status semidefinite_root(int n, const double *a, int lda, double *l, int *rank,
                                      arena *scratch)
{
    lapack_int *pivots = arena_alloc(scratch, (size_t)n, sizeof *pivots);
    double *c = arena_room(scratch, (size_t)n * (size_t)n);
    if (pivots == NULL || c == NULL)
        return STRUM_ERR_MEMORY;
    copy(n, n, a, lda, c, n);
    double largest = 0;
    for (int i = 0; i < n; i++)
        largest = fmax(largest, c[i + (size_t)i * (size_t)n]);
    const strum_status status =
        pieces_pivoted(n, c, pivots, rank, DBL_EPSILON * largest, scratch);
    for (int j = 0; status == STRUM_OK && j < *rank; j++)
        for (int i = 0; i < n; i++)
            l[pivots[i] - 1 + (size_t)j * (size_t)n] =
                i >= j ? c[i + (size_t)j * (size_t)n] : 0;
    return status;
}

strum_status linalg_semidefinite_root(int n, const double *a, int lda, double *l, int *rank,
                                      work *w)
{
    arena scratch = {.work = w};
    strum_status status = work_spend(w, 1e-3 * n * n * (double)n);
    if (status == STRUM_OK)
        status = semidefinite_root(n, a, lda, l, rank, &scratch);
    arena_free(&scratch);
    return status;
}

/* From here on a single call of dgeev would take more than a tenth of a second. */
#define GENERAL_FROM 400

/* z [z g; g] = [-C -M; I 0] [z g; g] */
static void fill_companion(int n, const double *c, const double *m, double *companion)
{
    const size_t s = (size_t)n, two = 2 * s;
    for (size_t j = 0; j < s; j++) {
        for (size_t i = 0; i < s; i++) {
            companion[i + j * two] = -c[i + j * s];
            companion[i + (j + s) * two] = -m[i + j * s];
        }
        companion[j + s + j * two] = 1;
    }
}

static strum_status quadratic(int n, const double *c, const double *m, double _Complex *values,
                              double _Complex *vectors, arena *scratch)
{
    const size_t s = (size_t)n, two = 2 * s;
    double *companion = arena_doubles(scratch, two * two);
    double *v = vectors != NULL ? arena_room(scratch, two * two) : NULL;
    double *re = arena_doubles(scratch, two), *im = arena_doubles(scratch, two);
    const lapack_int lwork = (lapack_int)(16 * two);
    double *room = arena_room(scratch, (size_t)lwork);
    if (companion == NULL || (vectors != NULL && v == NULL) || re == NULL || im == NULL ||
        room == NULL)
        return STRUM_ERR_MEMORY;
    fill_companion(n, c, m, companion);
    if (two >= GENERAL_FROM) {
        const strum_status status = schur_pairs((int)two, companion, re, im, v, scratch);
        if (status != STRUM_OK)
            return status;
    } else if (LAPACKE_dgeev_work(LAPACK_COL_MAJOR, 'N', vectors != NULL ? 'V' : 'N',
                                  (lapack_int)two, companion, (lapack_int)two, re, im, NULL, 1,
                                  v, (lapack_int)two, room, lwork) != 0) {
        return STRUM_ERR_INTERNAL;
    }
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

strum_status linalg_quadratic(int n, const double *c, const double *m, double _Complex *values,
                              double _Complex *vectors, work *w)
{
    arena scratch = {.work = w};
    strum_status status = work_spend(w, 3e-2 * n * n * (double)n);
    if (status == STRUM_OK)
        status = quadratic(n, c, m, values, vectors, &scratch);
    arena_free(&scratch);
    return status;
}

strum_status linalg_least_squares(int rows, int n, double *a, int lda, double *b)
{
    double room[64 * LINALG_NARROW];
    const lapack_int info = LAPACKE_dgels_work(LAPACK_COL_MAJOR, 'N', rows, n, 1, a, lda, b,
                                               rows, room, 64 * LINALG_NARROW);
    return info == 0 ? STRUM_OK : info > 0 ? STRUM_ERR_ACCURACY : STRUM_ERR_INTERNAL;
}

strum_status linalg_singular(int rows, int n, double *a, int lda, double *values, double *vt)
{
    /* R of A = QR has the same singular values and right vectors, and needs no room of A's size. */
    double tau[LINALG_NARROW], room[64 * LINALG_NARROW], r[LINALG_NARROW * LINALG_NARROW], none;
    lapack_int info = LAPACKE_dgeqrf_work(LAPACK_COL_MAJOR, rows, n, a, lda, tau, room,
                                          64 * LINALG_NARROW);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++)
            r[i + j * n] = i <= j ? a[i + (size_t)j * (size_t)lda] : 0;
    if (info == 0)
        info = LAPACKE_dgesvd_work(LAPACK_COL_MAJOR, 'N', 'A', n, n, r, n, values, &none, 1, vt, n,
                                   room, 64 * LINALG_NARROW);
    return info == 0 ? STRUM_OK : info > 0 ? STRUM_ERR_ACCURACY : STRUM_ERR_INTERNAL;
}

strum_status linalg_complex_solve(int n, double _Complex *z, double _Complex *r, work *w)
{
    const strum_status status = work_spend(w, 8e-4 * n * n * (double)n);
    if (status != STRUM_OK)
        return status;
    arena scratch = {.work = w};
    lapack_int *pivots = arena_alloc(&scratch, (size_t)n, sizeof *pivots);
    const lapack_int info =
        pivots == NULL ? 0 : LAPACKE_zgesv_work(LAPACK_COL_MAJOR, n, 1, z, n, pivots, r, n);
    arena_free(&scratch);
    return pivots == NULL ? STRUM_ERR_MEMORY : info == 0 ? STRUM_OK : STRUM_ERR_INTERNAL;
}
