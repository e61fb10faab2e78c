/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A digest of the numerics that this machine gives the library. BLAS, LAPACK and libm choose
 * their code by the processor when they are loaded (OpenBLAS by its core type, glibc by whether
 * there is a fused multiply-add), and the last digits follow: one binary gave other bytes for
 * 630 of 1,200 answers under another core type. The digest is over the bits of what each
 * function that the core calls returns for fixed arguments, so that it differs where answers
 * may.
 */
#include <cblas.h>
#include <complex.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <strum/version.h>

#include "core/numerics/arena.h"
#include "core/numerics/linalg.h"

#define ARGUMENTS 400

/* FNV-1a over the bits of what was seen so far, and a generator of arguments. */
typedef struct digest {
    uint64_t hash, state;
} digest;

static void add(digest *d, const double *x, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        uint64_t bits;
        memcpy(&bits, &x[i], sizeof bits);
        for (int k = 0; k < 64; k += 8)
            d->hash = (d->hash ^ ((bits >> k) & 0xff)) * 0x100000001b3u;
    }
}

/* In [-1, 1): Knuth's MMIX generator. */
static double draw(digest *d)
{
    d->state = d->state * 6364136223846793005u + 1442695040888963407u;
    return (double)(d->state >> 11) * 0x1p-52 - 1.0;
}

static void add_functions(digest *d)
{
    for (int i = 0; i < ARGUMENTS; i++) {
        const double u = draw(d), v = draw(d), size = ldexp(1.0, i % 24 - 12);
        const double x = u * size, y = fabs(v) + 0x1p-60, large = fmin(fmax(x, -300.0), 300.0);
        double sine, cosine;
        sincos(x, &sine, &cosine);
        const double _Complex z = CMPLX(large, v * size), root = csqrt(z), grown = cexp(z),
                              wave = csin(z), other = ccos(z);
        const double values[] = {sine,         cosine,      sin(x),           cos(x),
                                 tan(x),       atan(x),     atan2(x, v),      asin(u),
                                 acos(u),      exp(large),  expm1(large),     log(y * size),
                                 log1p(y),     log10(y),    pow(y * size, u), sinh(large),
                                 cosh(large),  tanh(u),     asinh(x),         acosh(1.0 + y),
                                 atanh(u),     cbrt(x),     hypot(x, v),      exp2(u),
                                 log2(y),      creal(root), cimag(root),      creal(grown),
                                 cimag(grown), cabs(z),     carg(z),          lgamma(1.0 + y),
                                 creal(wave),  cimag(wave), creal(other),     cimag(other)};
        add(d, values, sizeof values / sizeof *values);
    }
}

static double *drawn(digest *d, size_t count, arena *scratch)
{
    double *x = arena_doubles(scratch, count);
    for (size_t i = 0; x != NULL && i < count; i++)
        x[i] = draw(d);
    return x;
}

static void add_vectors(digest *d, int n, const double *a, const double *b, double *c)
{
    const double dot = cblas_ddot(n, a, 1, b, 1);
    add(d, &dot, 1);
    cblas_dgemv(CblasColMajor, CblasNoTrans, n, n, 1.0, a, n, b, 1, 0.0, c, 1);
    cblas_daxpy(n, dot, a, 1, c, 1);
    add(d, c, (size_t)n);
    cblas_dgemv(CblasColMajor, CblasTrans, n, n, 1.0, a, n, b, 1, 0.0, c, 1);
    add(d, c, (size_t)n);
}

/* Least squares and singular values of a few columns of `a`, with room in `e`. */
static strum_status add_narrow(digest *d, int n, const double *a, double *e)
{
    const int columns = n < 4 ? 1 : 4;
    const size_t size = (size_t)n * (size_t)columns;
    double values[LINALG_NARROW], vt[LINALG_NARROW * LINALG_NARROW];
    memcpy(e, a, size * sizeof *e);
    strum_status status = linalg_singular(n, columns, e, n, values, vt);
    add(d, values, (size_t)columns);
    add(d, vt, (size_t)columns * (size_t)columns);
    memcpy(e, a, size * sizeof *e);
    memcpy(e + size, a + n, (size_t)n * sizeof *e);
    if (status == STRUM_OK)
        status = linalg_least_squares(n, columns, e, n, e + size);
    add(d, e + size, (size_t)columns);
    return status;
}

/* Each function of linalg.h at order n. */
static strum_status add_matrices(digest *d, int n, arena *scratch)
{
    const size_t square = (size_t)n * (size_t)n;
    double *a = drawn(d, square, scratch), *b = drawn(d, square, scratch);
    double *c = drawn(d, 2 * square, scratch), *e = drawn(d, 2 * square, scratch);
    double _Complex *z = arena_alloc(scratch, 2 * square, sizeof *z);
    double _Complex *values = arena_alloc(scratch, 2 * (size_t)n, sizeof *values);
    if (a == NULL || b == NULL || c == NULL || e == NULL || z == NULL || values == NULL)
        return STRUM_ERR_MEMORY;
    add_vectors(d, n, a, b, c);
    linalg_multiply('N', 'N', n, n, n, a, n, b, n, c, n);
    add(d, c, square);
    linalg_multiply('T', 'N', n, n, n, a, n, b, n, c, n);
    add(d, c, square);
    (void)linalg_gram(n, n, a, n, c, n, NULL); /* semidefinite */
    add(d, c, square);
    for (int i = 0; i < n; i++)
        c[i * n + i] += n; /* definite */
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            b[i * n + j] = 0.5 * (a[i * n + j] + a[j * n + i]);
    int rank;
    strum_status status = linalg_symmetric(n, b, n, NULL, n, n, e, NULL, NULL);
    add(d, e, (size_t)n);
    if (status == STRUM_OK)
        status = linalg_symmetric(n, b, n, c, n, n / 2 + 1, e, e + n, NULL);
    if (status == STRUM_OK)
        add(d, e, (size_t)n * (size_t)(n / 2 + 2));
    if (status == STRUM_OK)
        status = linalg_semidefinite_root(n, c, n, e, &rank, NULL);
    if (status == STRUM_OK)
        add(d, e, square);
    if (status == STRUM_OK)
        status = add_narrow(d, n, a, e);
    if (status == STRUM_OK)
        status = linalg_quadratic(n, b, c, values, z, NULL);
    for (int i = 0; status == STRUM_OK && i < 2 * n; i++)
        add(d, (double[2]){creal(values[i]), cimag(values[i])}, 2);
    for (size_t i = 0; i < square; i++)
        z[i] = CMPLX(a[i], b[i]);
    for (int i = 0; i < n; i++)
        values[i] = CMPLX(c[i], a[i]);
    if (status == STRUM_OK)
        status = linalg_complex_solve(n, z, values, NULL);
    for (int i = 0; status == STRUM_OK && i < n; i++)
        add(d, (double[2]){creal(values[i]), cimag(values[i])}, 2);
    return status;
}

strum_status strum_numerics(char digest_text[STRUM_NUMERICS_SIZE], strum_error *error)
{
    static const int orders[] = {2, 5, 12, 23, 48, 90};
    digest d = {0xcbf29ce484222325u, 1};
    strum_status status = STRUM_OK;
    add_functions(&d);
    for (size_t i = 0; i < sizeof orders / sizeof *orders && status == STRUM_OK; i++) {
        arena scratch = {0};
        status = add_matrices(&d, orders[i], &scratch);
        arena_free(&scratch);
    }
    (void)snprintf(digest_text, STRUM_NUMERICS_SIZE, "%016" PRIx64, d.hash);
    return status == STRUM_OK ? STRUM_OK
                              : error_set(error, status, "%s", strum_status_text(status));
}
