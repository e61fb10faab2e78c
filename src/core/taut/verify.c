/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A second opinion on roots, from the assembled chain. */
#include "core/taut/assembly.h"

#include <float.h>
#include <lapacke.h>
#include <stdlib.h>

/* Unknowns of the quadratic eigenproblem (dense), and of the banded count. */
#define DENSE_MOST  400
#define BANDED_MOST 50000
/* Where the inner node of a wire lies: no two parts resonate together. */
#define GOLDEN 0.3819660112501051

/* ---- Wittrick and Williams' count ---- */

static size_t place_of(const taut_assembly *a, int i, int j)
{
    const int low = i < j ? i : j, high = i < j ? j : i;
    return (size_t)high * (size_t)(a->band + 1) + (size_t)(low - high + a->band);
}

/* Dynamic stiffness of both parts of a wire, [w z cot, -w z/sin]; its modes below w with both
 * ends held. */
static long add_wire(const taut_assembly *a, const taut_wire *wire, double w, double *matrix)
{
    const double z = wire->impedance * w;
    long held = 0;
    for (int part = 0; part < 2; part++) {
        const double share = part == 0 ? GOLDEN : 1.0 - GOLDEN;
        const double phase = share * w * wire->slowness * wire->length;
        const double lever = part == 0 ? wire->lever : 1.0;
        const double sine = sin(phase), cosine = cos(phase);
        const int i = wire->node[part], j = wire->node[part + 1];
        matrix[place_of(a, i, i)] += lever * lever * z * cosine / sine;
        matrix[place_of(a, j, j)] += z * cosine / sine;
        matrix[place_of(a, i, j)] -= lever * z / sine;
        held += (long)floor(phase / M_PI);
    }
    return held;
}

/* Negative pivots of L D L' (in place). */
static long negative_pivots(int size, int band, double *matrix)
{
    long negative = 0;
    const size_t width = (size_t)band + 1;
    for (int j = 0; j < size; j++) {
        double pivot = matrix[(size_t)j * width + (size_t)band];
        if (pivot == 0.0)
            pivot = DBL_MIN;
        negative += pivot < 0.0;
        for (int i = j + 1; i < size && i <= j + band; i++) {
            const double a = matrix[(size_t)i * width + (size_t)(j - i + band)];
            if (a == 0.0)
                continue;
            for (int k = j + 1; k <= i; k++)
                matrix[(size_t)i * width + (size_t)(k - i + band)] -=
                    a * matrix[(size_t)k * width + (size_t)(j - k + band)] / pivot;
        }
    }
    return negative;
}

static long count_below(const strum_taut *chain, const taut_assembly *a, double w,
                        double *matrix)
{
    const size_t room = (size_t)a->size * (size_t)(a->band + 1);
    for (size_t i = 0; i < room; i++)
        matrix[i] = a->k[i] - w * w * a->m[i];
    long count = 0;
    for (int i = 0; i < a->wire_count; i++)
        count += add_wire(a, &a->wires[i], w, matrix);
    /* a held end stays held, whatever wires have added to it */
    for (int end = 0; end < 2; end++) {
        if (end == 0 ? chain->free_left : chain->free_right)
            continue;
        const int held = end == 0 ? 0 : a->last;
        for (int i = held - a->band; i <= held + a->band; i++)
            if (i >= 0 && i < a->size)
                matrix[place_of(a, i, held)] = i == held ? 1.0 : 0.0;
    }
    return count + negative_pivots(a->size, a->band, matrix);
}

/* Where the count passes `mode` within 1e-6 of w; NaN when it does not. */
static double bisect(const strum_taut *chain, const taut_assembly *a, long mode, double w,
                     double *matrix)
{
    double lo = w * (1.0 - 1e-6), hi = w * (1.0 + 1e-6);
    if (count_below(chain, a, lo, matrix) >= mode || count_below(chain, a, hi, matrix) < mode)
        return NAN;
    while (hi - lo > 2.0 * DBL_EPSILON * hi) {
        const double middle = 0.5 * (lo + hi);
        if (count_below(chain, a, middle, matrix) < mode)
            lo = middle;
        else
            hi = middle;
    }
    return 0.5 * (lo + hi);
}

static strum_status verify_undamped(const strum_taut *chain, const strum_taut_roots *roots,
                                    work *spent, strum_verification *v, strum_error *fault)
{
    taut_assembly a;
    v->method = "assembled dynamic stiffness, Wittrick-Williams count, bisection";
    strum_status status =
        taut_assembly_make(chain, 1.1 * roots->highest, true, BANDED_MOST, &a, fault);
    if (status != STRUM_OK)
        return status;
    double *matrix = malloc((size_t)a.size * (size_t)(a.band + 1) * sizeof *matrix);
    if (matrix == NULL)
        status = error_set(fault, STRUM_ERR_MEMORY, "no memory for %d unknowns", a.size);
    for (size_t i = 0; i < roots->count && status == STRUM_OK; i++) {
        const strum_taut_root *r = &roots->roots[i];
        /* some 35 counts, each a factorisation of the band */
        if (work_spend(spent, 35e-3 * a.size * (a.band + 1.0) * (a.band + 1.0)) != STRUM_OK) {
            status = work_error(spent, fault);
            break;
        }
        if (r->frequency ==
            0.0) { /* a rigid motion: counted well below the first elastic one */
            const double low = i + 1 < roots->count && roots->roots[i + 1].frequency > 0.0
                                   ? 0.5 * roots->roots[i + 1].frequency
                                   : 1e-3 * taut_spacing(chain);
            v->modes_expected += count_below(chain, &a, low, matrix) >= r->mode;
            continue;
        }
        const double w = bisect(chain, &a, r->mode, r->frequency, matrix);
        if (isnan(w))
            continue;
        v->modes_expected++;
        v->max_relative_difference =
            fmax(v->max_relative_difference, fabs(w - r->frequency) / r->frequency);
    }
    free(matrix);
    taut_assembly_free(&a);
    return status;
}

/* ---- the quadratic eigenproblem ---- */

static void dense(const taut_assembly *a, double *k, double *c, double *m, double sigma)
{
    const size_t n = (size_t)a->size;
    for (size_t i = 0; i < n * n; i++)
        k[i] = c[i] = m[i] = 0.0;
    for (int i = 0; i < a->size; i++)
        for (int j = i > a->band ? i - a->band : 0; j <= i; j++) {
            const size_t at = place_of(a, i, j);
            const size_t both[2] = {(size_t)i * n + (size_t)j, (size_t)j * n + (size_t)i};
            for (int q = 0; q < 2; q++) {
                /* s = sigma (1 + z): (K + sigma C + sigma^2 M) is definite */
                k[both[q]] = a->k[at] + sigma * a->c[at] + sigma * sigma * a->m[at];
                c[both[q]] = sigma * a->c[at] + 2.0 * sigma * sigma * a->m[at];
                m[both[q]] = sigma * sigma * a->m[at];
            }
        }
}

/* All s of (s^2 M + s C + K) x = 0: with z = 1/mu, mu^2 + mu L^{-1} C L^{-T} + L^{-1} M L^{-T}
 * = 0 for K = L L' (shifted), linearised; the roots of interest have the largest mu. Re in
 * `re`, Im in `im` (2 n of each; infinite ones as INFINITY). */
static strum_status quadratic_roots(const taut_assembly *a, double sigma, double *room,
                                    double *re, double *im, strum_error *fault)
{
    const int n = a->size;
    const size_t square = (size_t)n * (size_t)n;
    double *k = room, *c = k + square, *m = c + square, *companion = m + square;
    dense(a, k, c, m, sigma);
    lapack_int info = LAPACKE_dpotrf(LAPACK_ROW_MAJOR, 'L', n, k, n);
    if (info == 0)
        info = LAPACKE_dsygst(LAPACK_ROW_MAJOR, 1, 'L', n, c, n, k, n);
    if (info == 0)
        info = LAPACKE_dsygst(LAPACK_ROW_MAJOR, 1, 'L', n, m, n, k, n);
    if (info != 0)
        return error_set(fault, STRUM_ERR_METHOD,
                         "the second method does not resolve so different components");
    const size_t width = 2 * (size_t)n;
    for (size_t i = 0; i < 4 * square; i++)
        companion[i] = 0.0;
    for (size_t i = 0; i < (size_t)n; i++) {
        companion[(i + (size_t)n) * width + i] = 1.0;
        for (size_t j = 0; j < (size_t)n; j++) { /* dsygst leaves the lower triangle */
            const size_t at = i >= j ? i * (size_t)n + j : j * (size_t)n + i;
            companion[i * width + j] = -c[at];
            companion[i * width + j + (size_t)n] = -m[at];
        }
    }
    info = LAPACKE_dgeev(LAPACK_ROW_MAJOR, 'N', 'N', 2 * n, companion, 2 * n, re, im, NULL, 1,
                         NULL, 1);
    if (info != 0)
        return error_set(fault, info < -1000 ? STRUM_ERR_MEMORY : STRUM_ERR_ACCURACY,
                         "the quadratic eigenproblem was not solved");
    for (int i = 0; i < 2 * n; i++) {
        const cplx mu = CMPLX(re[i], im[i]);
        const cplx s = cabs(mu) > 1e-12 ? sigma + over(sigma, mu) : INFINITY;
        re[i] = creal(s);
        im[i] = cimag(s);
    }
    return STRUM_OK;
}

/* Compares: the eigenvalues inside the box that was counted, and the one nearest to each root.
 */
static void compare(const strum_taut_roots *roots, double decay, size_t count, const double *re,
                    const double *im, strum_verification *v)
{
    for (size_t k = 0; k < count; k++)
        v->modes_expected += im[k] >= roots->lowest && im[k] <= roots->highest &&
                             -re[k] <= decay && isfinite(re[k]);
    for (size_t i = 0; i < roots->count; i++) {
        const strum_taut_root *r = &roots->roots[i];
        double nearest = INFINITY;
        if (r->frequency == 0.0) /* a rigid motion: 0 exactly, and not in the box */
            continue;
        for (size_t k = 0; k < count; k++)
            nearest = fmin(nearest, hypot(im[k] - r->frequency, re[k] + r->decay));
        v->max_relative_difference =
            fmax(v->max_relative_difference, nearest / hypot(r->frequency, r->decay));
    }
}

/* Where the count went further down than any root asked for, elements need not follow. */
static double decay_compared(const strum_taut_roots *roots)
{
    double most = roots->highest;
    for (size_t i = 0; i < roots->count; i++)
        most = fmax(most, 1.5 * roots->roots[i].decay);
    return fmin(most, roots->max_decay);
}

static strum_status verify_damped(const strum_taut *chain, const strum_taut_roots *roots,
                                  work *spent, strum_verification *v, strum_error *fault)
{
    taut_assembly a;
    v->method = "spectral finite elements, quadratic eigenproblem";
    const double decay = decay_compared(roots);
    strum_status status =
        taut_assembly_make(chain, hypot(roots->highest, decay), false, DENSE_MOST, &a, fault);
    if (status != STRUM_OK)
        return status;
    const size_t n = (size_t)a.size;
    double *room = malloc((7 * n * n + 4 * n) * sizeof *room);
    if (work_spend(spent, 0.02 * (double)(n * n * n)) != STRUM_OK) {
        status = work_error(spent, fault);
    } else if (room == NULL) {
        status = error_set(fault, STRUM_ERR_MEMORY, "no memory for %zu unknowns", n);
    } else {
        double *re = room + 7 * n * n, *im = re + 2 * n;
        const double low = roots->lowest > 0.0 ? roots->lowest
                           : roots->count > 0  ? roots->roots[0].frequency
                                               : 0.0;
        const double sigma = low > 0.0 ? sqrt(low * roots->highest) : roots->highest;
        status = quadratic_roots(&a, sigma, room, re, im, fault);
        if (status == STRUM_OK)
            compare(roots, decay, 2 * n, re, im, v);
    }
    free(room);
    taut_assembly_free(&a);
    return status;
}

strum_status strum_taut_verify(const strum_taut *chain, const strum_taut_roots *roots,
                               const strum_options *options, strum_verification *verification,
                               strum_error *fault)
{
    work w = work_begin(options);
    *verification =
        (strum_verification){.modes_found = roots->found, .max_residual = roots->max_residual};
    return chain->damped ? verify_damped(chain, roots, &w, verification, fault)
                         : verify_undamped(chain, roots, &w, verification, fault);
}
