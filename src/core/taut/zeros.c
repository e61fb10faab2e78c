/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * How many zeros the entire characteristic function has in a rectangle (the argument
 * principle), and where the ones are that branches did not lead to.
 */
#include "core/taut/taut.h"

#include <float.h>

/* How long a step from z may be, g = F'/F there. Samples one period of a row of zeros apart
 * look alike, so that whole turns between them would pass unseen: beside zeros, a third of the
 * spacing of modes (and of closer ones: g tells of them). Longer where none is near: right of
 * the imaginary axis, and where F grows like e^{+-travel s}. */
static double longest_step(const taut_search *search, cplx z, cplx g)
{
    const double travel = search->chain->travel;
    const double apart = fmin(cabs(g - travel), cabs(g + travel));
    const double beside = fmin(search->spacing / 3.0, 2.5 / cabs(g));
    return fmax(fmax(beside, 4.0 * creal(z)), 0.5 / apart);
}

/* Change of the argument of F from a to b. Each step compares the change seen with the one that
 * F'/F at its two ends predicts; so far from zeros a step spans several radians. */
static bool walk(taut_search *search, cplx a, cplx b, taut_value *at_a, double *argument)
{
    const double length = cabs(b - a);
    double done = 0.0, h = 1.0;
    if (length == 0.0)
        return true;
    while (done < 1.0) {
        if (search->status != STRUM_OK || at_a->f == 0.0)
            return false;
        const cplx start = a + done * (b - a), g = over(at_a->d, at_a->f);
        h = fmin(h, longest_step(search, start, g) / length);
        const double to = fmin(done + h, 1.0);
        const cplx z = to < 1.0 ? a + to * (b - a) : b, dz = (to - done) * (b - a);
        const taut_value next = taut_search_value(search, z);
        if (search->status != STRUM_OK || next.f == 0.0)
            return false;
        const cplx from = times(g, dz), into = times(over(next.d, next.f), dz);
        const double expected = 0.5 * cimag(from + into), bend = cabs(into - from);
        double seen = carg(over(next.f, at_a->f));
        seen += 2.0 * M_PI * round((expected - seen) / (2.0 * M_PI));
        if (fabs(seen - expected) < 0.5 && bend < 1.5 &&
            cabs(dz) <= 1.5 * longest_step(search, z, over(next.d, next.f))) {
            *argument += seen;
            *at_a = next;
            done = to;
            h *= bend < 0.5 ? 2.0 : 1.1;
        } else {
            h *= 0.4;
            if (h * length < 1e-10 * search->spacing)
                return false; /* a zero on the way */
        }
    }
    return true;
}

long taut_count_zeros(taut_search *search, const taut_rectangle *box)
{
    /* F is real on the real axis: of a symmetric rectangle half the way tells all */
    const bool symmetric = box->im_lo == -box->im_hi;
    const double low = symmetric ? 0.0 : box->im_lo;
    const cplx corner[5] = {CMPLX(box->re_lo, low), CMPLX(box->re_hi, low),
                            CMPLX(box->re_hi, box->im_hi), CMPLX(box->re_lo, box->im_hi),
                            CMPLX(box->re_lo, low)};
    double argument = 0.0;
    taut_value value = taut_search_value(search, corner[symmetric]);
    for (int k = symmetric; k < 4; k++)
        if (!walk(search, corner[k], corner[k + 1], &value, &argument))
            return -1;
    const double turns = argument / (symmetric ? M_PI : 2.0 * M_PI), whole = round(turns);
    return fabs(turns - whole) < 0.01 && whole >= 0.0 ? (long)whole : -1;
}

bool taut_inside(const taut_rectangle *box, cplx s)
{
    return creal(s) >= box->re_lo && creal(s) <= box->re_hi && cimag(s) >= box->im_lo &&
           cimag(s) <= box->im_hi;
}

bool taut_known(const cplx *roots, size_t count, cplx s, double tolerance)
{
    for (size_t i = 0; i < count; i++)
        if (cabs(roots[i] - s) <= tolerance)
            return true;
    return false;
}

/* Zeros known in the box; a pair counts twice where the box holds both. */
static long count_known(const taut_rectangle *box, const cplx *roots, size_t known)
{
    long count = 0;
    for (size_t i = 0; i < known; i++)
        count += taut_inside(box, roots[i]) +
                 (cimag(roots[i]) != 0.0 && taut_inside(box, conj(roots[i])));
    return count;
}

/* Newton's method on F/prod(s - known), which no known zero draws near. */
static bool deflated_newton(taut_search *search, cplx *s, const cplx *roots, size_t known)
{
    double size = INFINITY;
    for (int n = 0; n < 60; n++) {
        const taut_value f = taut_search_value(search, *s);
        if (search->status != STRUM_OK)
            return false;
        if (f.f == 0.0)
            return true;
        cplx slope = over(f.d, f.f);
        for (size_t i = 0; i < known; i++) {
            if (*s != roots[i])
                slope -= over(1.0, *s - roots[i]);
            if (cimag(roots[i]) != 0.0 && *s != conj(roots[i]))
                slope -= over(1.0, *s - conj(roots[i]));
        }
        if (slope == 0.0)
            return false;
        cplx step = over(1.0, slope);
        const double most = 3.0 * search->spacing;
        size = cabs(step);
        if (!isfinite(size))
            return false;
        if (size > most)
            step *= most / size;
        *s -= step;
        if (size <= 1e-12 * (cabs(*s) + 1e-3 * search->spacing))
            return true;
    }
    /* beside its twin, a nearly double root is known to half its digits only */
    return size <= 1e-7 * (cabs(*s) + 1e-3 * search->spacing);
}

/* Is a root of F near? */
static bool is_root(taut_search *search, cplx s, double scale)
{
    const taut_value there = taut_search_value(search, s);
    /* where F is hardly more than rounding its zero is nowhere nearer */
    return there.f == 0.0 || cabs(over(there.f, there.d)) <= 1e-7 * scale ||
           taut_noise(search, s, 1.0) > 0.03;
}

/* From one start; true when a new root was added. */
static bool try_start(taut_search *search, const taut_rectangle *box, cplx s, cplx *roots,
                      size_t *known, size_t room)
{
    if (*known == room || !deflated_newton(search, &s, roots, *known))
        return false;
    cplx polished = s;
    const double scale = cabs(s) + 1e-3 * search->spacing;
    if (!is_root(search, s, scale))
        return false; /* where the slopes of F and of the known roots cancel */
    /* One of a nearly double root: polishing leads to its twin. */
    if (taut_newton(search, &polished) && cabs(polished - s) < 1e-4 * scale &&
        !taut_known(roots, *known, polished, 1e-9 * scale))
        s = polished;
    cplx real = creal(s); /* a real root may have come with a rounding beside it */
    if (fabs(cimag(s)) < 1e-7 * scale && taut_newton(search, &real) &&
        cabs(real - s) < 1e-6 * scale)
        s = real;
    if (fabs(cimag(s)) <= 1e-13 * scale)
        s = creal(s);
    if (cimag(s) < 0.0)
        s = conj(s);
    if (!taut_inside(box, s) || taut_known(roots, *known, s, 1e-14 * scale))
        return false;
    roots[(*known)++] = s;
    return true;
}

/* Roots of a small box by a circle about it: also those too near each other for Newton's method.
 * Those known already are told by being next to one of the circle's, each to one of them. */
static void find_by_ring(taut_search *search, const taut_rectangle *box, cplx *roots,
                         size_t *known, size_t room)
{
    const double width = box->re_hi - box->re_lo, height = box->im_hi - box->im_lo;
    const cplx centre = CMPLX(0.5 * (box->re_lo + box->re_hi), 0.5 * (box->im_lo + box->im_hi));
    cplx found[TAUT_CLUSTER_MAX];
    bool taken[TAUT_CLUSTER_MAX] = {false};
    taut_ring ring;
    if (!taut_ring_make(search, centre, 0.8 * fmax(width, height), 1.0, &ring))
        return;
    taut_ring_roots(search, &ring, 1.0, found);
    for (size_t i = 0; i < *known; i++)
        for (int both = 0; both < (cimag(roots[i]) != 0.0 ? 2 : 1); both++) {
            const cplx s = both != 0 ? conj(roots[i]) : roots[i];
            int next = -1;
            for (int k = 0; k < ring.count; k++)
                if (!taken[k] && cabs(found[k] - s) < 1e-6 * (cabs(s) + search->spacing) &&
                    (next < 0 || cabs(found[k] - s) < cabs(found[next] - s)))
                    next = k;
            if (next >= 0)
                taken[next] = true;
        }
    for (int k = 0; k < ring.count && *known < room; k++) {
        const double scale = cabs(found[k]) + 1e-3 * search->spacing;
        if (fabs(cimag(found[k])) <= 1e-13 * scale)
            found[k] = creal(found[k]);
        if (!taken[k] && cimag(found[k]) >= 0.0 && taut_inside(box, found[k]) &&
            is_root(search, found[k], scale))
            roots[(*known)++] = found[k];
    }
}

static void find(taut_search *search, const taut_rectangle *box, long expected, cplx *roots,
                 size_t *known, size_t room, int depth)
{
    const double width = box->re_hi - box->re_lo, height = box->im_hi - box->im_lo;
    const bool symmetric = box->im_lo == -box->im_hi;
    for (int k = 0; k < 6 && count_known(box, roots, *known) < expected; k++) {
        static const double at[6][2] = {{0.5, 0.0},   {0.5, 0.5},   {0.25, 0.25},
                                        {0.75, 0.75}, {0.25, 0.75}, {0.75, 0.25}};
        cplx s = CMPLX(box->re_lo + at[k][0] * width, box->im_lo + at[k][1] * height);
        if (k == 0)
            s = creal(s); /* on the axis Newton's method stays there */
        if (k == 0 && !symmetric)
            continue;
        if (try_start(search, box, s, roots, known, room))
            k = -1;
        if (search->status != STRUM_OK)
            return;
    }
    if (count_known(box, roots, *known) < expected && expected <= TAUT_CLUSTER_MAX &&
        fmax(width, height) < 0.6 * search->spacing)
        find_by_ring(search, box, roots, known, room);
    if (count_known(box, roots, *known) >= expected || depth == 0 ||
        fmax(width, height) < 1e-9 * search->spacing || search->status != STRUM_OK)
        return;
    static const double cuts[4] = {0.5, 0.47, 0.55, 0.42};
    for (int k = 0; k < 4; k++) { /* another cut where a zero lies on it */
        taut_rectangle a = *box, b = *box;
        if (symmetric || width > height)
            a.re_hi = b.re_lo = box->re_lo + cuts[k] * width;
        else
            a.im_hi = b.im_lo = box->im_lo + cuts[k] * height;
        const long in_a = taut_count_zeros(search, &a);
        if (search->status != STRUM_OK)
            return;
        if (in_a < 0 || in_a > expected)
            continue;
        find(search, &a, in_a, roots, known, room, depth - 1);
        find(search, &b, expected - in_a, roots, known, room, depth - 1);
        return;
    }
}

void taut_find_missing(taut_search *search, const taut_rectangle *box, long expected,
                       cplx *roots, size_t *known, size_t room)
{
    find(search, box, expected, roots, known, room, 30);
}
