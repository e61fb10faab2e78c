/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/numerics/schur.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "core/numerics/work.h"

/* Of LAPACK, which has no C form of them. */
extern void dlahr2_(const int *n, const int *k, const int *nb, double *a, const int *lda,
                    double *tau, double *t, const int *ldt, double *y, const int *ldy);
extern void dgehd2_(const int *n, const int *ilo, const int *ihi, double *a, const int *lda,
                    double *tau, double *work, int *info);
extern void dlahqr_(const int *wantt, const int *wantz, const int *n, const int *ilo,
                    const int *ihi, double *h, const int *ldh, double *wr, double *wi,
                    const int *iloz, const int *ihiz, double *z, const int *ldz, int *info);
extern void dlaqr3_(const int *wantt, const int *wantz, const int *n, const int *ktop,
                    const int *kbot, const int *nw, double *h, const int *ldh, const int *iloz,
                    const int *ihiz, double *z, const int *ldz, int *ns, int *nd, double *sr,
                    double *si, double *v, const int *ldv, const int *nh, double *t,
                    const int *ldt, const int *nv, double *wv, const int *ldwv, double *work,
                    const int *lwork);
extern void dlaqr5_(const int *wantt, const int *wantz, const int *kacc22, const int *n,
                    const int *ktop, const int *kbot, const int *nshfts, double *sr, double *si,
                    double *h, const int *ldh, const int *iloz, const int *ihiz, double *z,
                    const int *ldz, double *v, const int *ldv, double *u, const int *ldu,
                    const int *nv, double *wv, const int *ldwv, const int *nh, double *wh,
                    const int *ldwh);

/* Indices count from 1, as LAPACK's do. */
static size_t at(int i, int j, int n)
{
    return (size_t)(i - 1) + (size_t)(j - 1) * (size_t)n;
}

static int least_of(int a, int b)
{
    return a < b ? a : b;
}

static int most_of(int a, int b)
{
    return a > b ? a : b;
}

#define PANEL  32  /* columns that are reduced together */
#define REST   128 /* columns that are reduced one by one in the end */
#define GROUP  128 /* reflections, and eigenvectors, of one piece */
#define SMALL  75  /* rows that are solved at once */
#define WINDOW 96  /* rows in which deflation is looked for */
#define SHIFTS 48  /* of one sweep */

typedef struct schur {
    int n, lo, hi;
    double *h, *z; /* z NULL: values alone */
    double *re, *im;
    arena *scratch;
} schur;

/* Panels of dlahr2, applied from the right and from the left, as LAPACK's dgehrd. */
static strum_status hessenberg(const schur *s, double *tau)
{
    const int n = s->n, hi = s->hi, panel = PANEL;
    double *t = arena_doubles(s->scratch, PANEL * PANEL);
    double *y = arena_doubles(s->scratch, (size_t)n * PANEL);
    if (t == NULL || y == NULL)
        return STRUM_ERR_MEMORY;
    int i = s->lo, info;
    for (; i < hi - REST; i += PANEL) {
        const strum_status status = work_poll(s->scratch->work);
        if (status != STRUM_OK)
            return status;
        dlahr2_(&hi, &i, &panel, s->h + at(1, i, n), &n, tau + i - 1, t, &panel, y, &n);
        double *corner = s->h + at(i + PANEL, i + PANEL - 1, n);
        const double kept = *corner;
        *corner = 1;
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, hi, hi - i - PANEL + 1, PANEL, -1,
                    y, n, s->h + at(i + PANEL, i, n), n, 1, s->h + at(1, i + PANEL, n), n);
        *corner = kept;
        cblas_dtrmm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasUnit, i, PANEL - 1,
                    1, s->h + at(i + 1, i, n), n, y, n);
        for (int j = 0; j < PANEL - 1; j++)
            cblas_daxpy(i, -1, y + (size_t)j * (size_t)n, 1, s->h + at(1, i + j + 1, n), 1);
        LAPACKE_dlarfb_work(LAPACK_COL_MAJOR, 'L', 'T', 'F', 'C', hi - i, n - i - PANEL + 1,
                            PANEL, s->h + at(i + 1, i, n), n, t, panel,
                            s->h + at(i + 1, i + PANEL, n), n, y, n);
    }
    dgehd2_(&n, &i, &hi, s->h, &n, tau, y, &info);
    return info == 0 ? STRUM_OK : STRUM_ERR_INTERNAL;
}

/* z: the product of the reflections; h: nothing but the form. */
static strum_status reflections(const schur *s, const double *tau)
{
    const int n = s->n, count = s->hi - s->lo, lwork = 64 * n + 65 * 64;
    double *room = arena_doubles(s->scratch, (size_t)lwork);
    if (room == NULL)
        return STRUM_ERR_MEMORY;
    for (int i = 1; i <= n && s->z != NULL; i++)
        s->z[at(i, i, n)] = 1;
    int first = count < 2 * GROUP ? 0 : (count / GROUP - 1) * GROUP;
    for (int last = count; last > 0 && s->z != NULL; last = first, first -= GROUP) {
        const int row = s->lo + 1 + first;
        const strum_status status = work_poll(s->scratch->work);
        if (status != STRUM_OK)
            return status;
        if (LAPACKE_dormqr_work(LAPACK_COL_MAJOR, 'L', 'N', count - first, n, last - first,
                                s->h + at(row, row - 1, n), n, tau + row - 2,
                                s->z + at(row, 1, n), n, room, lwork) != 0)
            return STRUM_ERR_INTERNAL;
    }
    for (int j = 1; j + 2 <= n; j++)
        memset(s->h + at(j + 2, j, n), 0, (size_t)(n - j - 1) * sizeof *s->h);
    return STRUM_OK;
}

/* By size, largest first; of a conjugate pair one behind the other. */
static void sort_shifts(double *re, double *im, int count)
{
    for (int i = 1; i < count; i++)
        for (int j = i; j > 0; j--) {
            if (fabs(re[j]) + fabs(im[j]) <= fabs(re[j - 1]) + fabs(im[j - 1]))
                break;
            const double r = re[j], m = im[j];
            re[j] = re[j - 1];
            im[j] = im[j - 1];
            re[j - 1] = r;
            im[j - 1] = m;
        }
    for (int i = count - 1; i >= 2; i -= 2) /* pairs end at the last */
        if (im[i] != -im[i - 1]) {
            const double r = re[i], m = im[i];
            re[i] = re[i - 1];
            im[i] = im[i - 1];
            re[i - 1] = re[i - 2];
            im[i - 1] = im[i - 2];
            re[i - 2] = r;
            im[i - 2] = m;
        }
}

typedef struct bulges {
    double *v, *t, *wv, *wh, *u, *small, *room; /* of dlaqr3 and dlaqr5 */
    int lroom;
} bulges;

static strum_status bulges_make(const schur *s, bulges *b)
{
    const size_t n = (size_t)s->n, w = 3 * SHIFTS;
    b->lroom = 64 * s->n;
    b->v = arena_doubles(s->scratch, WINDOW * WINDOW);
    b->t = arena_doubles(s->scratch, WINDOW * n);
    b->wv = arena_doubles(s->scratch, n * w);
    b->wh = arena_doubles(s->scratch, n * w);
    b->u = arena_doubles(s->scratch, w * w);
    b->small = arena_doubles(s->scratch, SHIFTS * SHIFTS);
    b->room = arena_doubles(s->scratch, (size_t)b->lroom);
    return b->v == NULL || b->t == NULL || b->wv == NULL || b->wh == NULL || b->u == NULL ||
                   b->small == NULL || b->room == NULL
               ? STRUM_ERR_MEMORY
               : STRUM_OK;
}

/* Shifts in re, im up to `bottom`, `have` of them from deflation; without progress those of the
 * corner, and now and then ones that are none. Returns the number. */
static int find_shifts(const schur *s, const bulges *b, int top, int bottom, int have,
                       int stuck)
{
    const int n = s->n, no = 0, one = 1;
    int count = least_of(SHIFTS, most_of(2, bottom - top)), info;
    count -= count % 2;
    const int from = bottom - count + 1;
    double *re = s->re + from - 1, *im = s->im + from - 1;
    if (stuck % 6 == 0) {
        for (int i = count; i > 0; i -= 2) {
            const int row = from + i - 1;
            const double off = fabs(s->h[at(row, row - 1, n)]) +
                               (row - 2 >= 1 ? fabs(s->h[at(row - 1, row - 2, n)]) : 0);
            re[i - 1] = re[i - 2] = 0.75 * off + s->h[at(row, row, n)];
            im[i - 2] = 0.66 * off;
            im[i - 1] = -im[i - 2];
        }
        return count;
    }
    if (have < count) {
        for (int j = 0; j < count; j++)
            memcpy(b->small + j * SHIFTS, s->h + at(from, from + j, n),
                   (size_t)count * sizeof *b->small);
        const int ld = SHIFTS;
        dlahqr_(&no, &no, &count, &one, &count, b->small, &ld, re, im, &one, &one, b->small,
                &ld, &info);
        if (info > 0) { /* those that were found */
            const int good = (count - info) - (count - info) % 2;
            return good >= 2 ? good : 0;
        }
    }
    sort_shifts(re, im, count);
    return count;
}

/* One deflation, and a sweep where it did not find enough. */
static void sweep(const schur *s, const bulges *b, int top, int *bottom, int *stuck)
{
    const int n = s->n, yes = 1, wantz = s->z != NULL, ldz = n, ldu = 3 * SHIFTS, ldv = WINDOW;
    const int window = least_of(*bottom - top + 1, WINDOW), three = 3, accumulate = 1;
    int shifts, found;
    dlaqr3_(&yes, &wantz, &n, &top, bottom, &window, s->h, &n, &yes, &n, wantz ? s->z : b->u,
            &ldz, &shifts, &found, s->re, s->im, b->v, &ldv, &n, b->t, &ldv, &n, b->wv, &n,
            b->room, &b->lroom);
    *bottom -= found;
    const int left = *bottom - top + 1;
    if (left > 2 && (found == 0 || (100 * found <= 14 * window && left > SMALL))) {
        int count = find_shifts(s, b, top, *bottom, shifts, *stuck);
        const int from = *bottom - count;
        if (count >= 2)
            dlaqr5_(&yes, &wantz, &accumulate, &n, &top, bottom, &count, s->re + from,
                    s->im + from, s->h, &n, &yes, &n, wantz ? s->z : b->u, &ldz, b->v, &three,
                    b->u, &ldu, &n, b->wv, &n, &n, b->wh, &ldu);
    }
    *stuck = found > 0 ? 1 : *stuck + 1;
}

static strum_status iterate(const schur *s)
{
    const int n = s->n, yes = 1, wantz = s->z != NULL;
    bulges b;
    strum_status status = bulges_make(s, &b);
    int bottom = s->hi, stuck = 1;
    for (int i = 0; status == STRUM_OK && i < 30 * n && bottom >= s->lo; i++) {
        status = work_poll(s->scratch->work);
        if (status != STRUM_OK)
            return status;
        int top = bottom, info;
        while (top > s->lo && s->h[at(top, top - 1, n)] != 0)
            top--;
        if (bottom - top + 1 > SMALL) {
            sweep(s, &b, top, &bottom, &stuck);
            continue;
        }
        dlahqr_(&yes, &wantz, &n, &top, &bottom, s->h, &n, s->re, s->im, &yes, &n,
                wantz ? s->z : b.u, &n, &info);
        if (info != 0)
            return STRUM_ERR_INTERNAL;
        bottom = top - 1;
        stuck = 1;
    }
    return status != STRUM_OK ? status : bottom < s->lo ? STRUM_OK : STRUM_ERR_INTERNAL;
}

/* Groups of eigenvectors of the quasi-triangular h, and z times them. */
static strum_status substitute(const schur *s, double *vectors)
{
    const int n = s->n;
    const size_t size = (size_t)n;
    lapack_logical *chosen = arena_alloc(s->scratch, size, sizeof *chosen);
    double *room = arena_doubles(s->scratch, 3 * size);
    double *part = arena_doubles(s->scratch, size * (GROUP + 1));
    if (chosen == NULL || room == NULL || part == NULL)
        return STRUM_ERR_MEMORY;
    for (int first = 0; first < n;) {
        int last = least_of(first + GROUP, n);
        last += last < n && s->im[last - 1] > 0; /* a pair stays together */
        lapack_int columns;
        const strum_status status = work_poll(s->scratch->work);
        if (status != STRUM_OK)
            return status;
        for (int i = 0; i < n; i++)
            chosen[i] = i >= first && i < last;
        if (LAPACKE_dtrevc_work(LAPACK_COL_MAJOR, 'R', 'S', chosen, n, s->h, n, NULL, 1, part,
                                n, last - first, &columns, room) != 0 ||
            columns != last - first)
            return STRUM_ERR_INTERNAL;
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, n, columns, last, 1, s->z, n,
                    part, n, 0, vectors + (size_t)first * size, n);
        first = last;
    }
    return STRUM_OK;
}

strum_status schur_pairs(int n, double *a, double *re, double *im, double *vectors,
                         arena *scratch)
{
    const size_t size = (size_t)n;
    schur s = {.n = n, .h = a, .re = re, .im = im, .scratch = scratch};
    double *scale = arena_doubles(scratch, size), *tau = arena_doubles(scratch, size);
    s.z = vectors != NULL ? arena_doubles(scratch, size * size) : NULL;
    if (scale == NULL || tau == NULL || (vectors != NULL && s.z == NULL))
        return STRUM_ERR_MEMORY;
    if (LAPACKE_dgebal_work(LAPACK_COL_MAJOR, 'B', n, a, n, &s.lo, &s.hi, scale) != 0)
        return STRUM_ERR_INTERNAL;
    for (int i = 1; i <= n; i++)
        if (i < s.lo || i > s.hi) {
            re[i - 1] = a[at(i, i, n)];
            im[i - 1] = 0;
        }
    strum_status status = hessenberg(&s, tau);
    if (status == STRUM_OK)
        status = reflections(&s, tau);
    if (status == STRUM_OK)
        status = iterate(&s);
    if (status == STRUM_OK && vectors != NULL)
        status = substitute(&s, vectors);
    if (status == STRUM_OK && vectors != NULL &&
        LAPACKE_dgebak_work(LAPACK_COL_MAJOR, 'B', 'R', n, s.lo, s.hi, scale, n, vectors, n) !=
            0)
        status = STRUM_ERR_INTERNAL;
    return status;
}
