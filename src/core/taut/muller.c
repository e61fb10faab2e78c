/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Muller's method with deflation, as Levesque's MULLER finds his roots: a parabola through
 * three points, its nearer zero is the next point; F is divided by (s - root) for every root
 * found before. Nothing ties a root to the guess it was started from: it may belong to another
 * mode, and some may never be found. Offered to show that, beside the certified search.
 */
#include <float.h>
#include <stdlib.h>

#include "core/taut/solve.h"

typedef struct sample {
    cplx s, f;
    double log_scale;
} sample;

static sample take(taut_search *search, cplx s, const cplx *found, size_t count)
{
    const taut_value v = taut_search_value(search, s);
    sample a = {s, v.f, v.log_scale};
    for (size_t i = 0; i < count; i++) {
        const cplx apart = s - found[i];
        if (apart != 0.0)
            a.f = over(a.f, apart / search->spacing);
    }
    return a;
}

bool taut_muller(taut_search *search, cplx guess, const cplx *found, size_t count, cplx *root)
{
    sample a = take(search, 0.99 * guess, found, count);
    sample b = take(search, 1.01 * guess, found, count);
    sample c = take(search, guess, found, count);
    for (int n = 0; n < 100 && search->status == STRUM_OK; n++) {
        const cplx fc = c.f, fb = b.f * exp(b.log_scale - c.log_scale),
                   fa = a.f * exp(a.log_scale - c.log_scale);
        if (fc == 0.0)
            break;
        const cplx cb = over(fb - fc, b.s - c.s), ba = over(fa - fb, a.s - b.s);
        const cplx bend = over(ba - cb, a.s - c.s), slope = cb + times(c.s - b.s, bend);
        const cplx root_of = csqrt(times(slope, slope) - 4.0 * times(fc, bend));
        const cplx plus = slope + root_of, minus = slope - root_of;
        const cplx below = cabs(plus) > cabs(minus) ? plus : minus;
        const cplx move = over(-2.0 * fc, below);
        if (!isfinite(creal(move)) || !isfinite(cimag(move)))
            return false;
        a = b;
        b = c;
        c = take(search, c.s + move, found, count);
        if (cabs(move) <= 1e-14 * cabs(c.s))
            break;
    }
    *root = c.s;
    /* taken as a root where Newton's method, without deflation, stays */
    cplx polished = c.s;
    if (search->status != STRUM_OK || !taut_newton(search, &polished) ||
        cabs(polished - c.s) > 1e-6 * cabs(c.s))
        return false;
    *root = cimag(polished) < 0.0 ? conj(polished) : polished;
    return true;
}

strum_status taut_solve_muller(taut_solve *s)
{
    strum_taut_roots *out = s->out;
    s->search.spacing = taut_spacing(s->search.chain);
    strum_taut_root *certain = out->roots;
    const size_t count = out->count;
    cplx *found = malloc((count + 1) * sizeof *found);
    if (found == NULL)
        return taut_solve_no_memory(s);
    out->roots = NULL;
    out->count = 0;
    size_t known = 0;
    strum_status status = STRUM_OK;
    for (size_t i = 0; i < count && status == STRUM_OK; i++) {
        double w = certain[i].frequency;
        cplx root;
        if (certain[i].mode > 0)
            status = taut_frequencies(s->search.chain, &certain[i].mode, 1, &s->search.work, &w,
                                      s->fault);
        if (status != STRUM_OK ||
            !taut_muller(&s->search, CMPLX(0.0, w), found, known, &root) ||
            taut_known(found, known, root, TAUT_SAME * taut_solve_scale(s, root)))
            continue;
        found[known++] = root;
        const cplx wanted = CMPLX(-certain[i].decay, certain[i].frequency);
        out->hopped += cabs(root - wanted) > TAUT_SAME * taut_solve_scale(s, wanted);
        status = taut_roots_add(s->out,
                                (strum_taut_root){certain[i].mode, cimag(root),
                                                  fmax(-creal(root), 0.0), INFINITY, 0.0},
                                false, s->fault);
    }
    for (size_t i = 0; i < count; i++) {
        const cplx wanted = CMPLX(-certain[i].decay, certain[i].frequency);
        out->missed +=
            !taut_known(found, known, wanted, TAUT_SAME * taut_solve_scale(s, wanted));
    }
    /* A number without an oscillating root was expected of nobody. */
    out->found = out->expected > out->missed ? out->expected - out->missed : 0;
    free(found);
    free(certain);
    if (status == STRUM_OK && s->search.status != STRUM_OK)
        status = taut_solve_stopped(s);
    return status;
}
