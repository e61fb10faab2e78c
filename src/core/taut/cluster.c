/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Clusters: roots so close together that Newton's method cannot tell them apart. On a circle
 * that holds m of them the power sums
 *     p_j = 1/(2 pi i) integral of ((s - centre)/radius)^j F'/F ds
 * are smooth in all that moves the roots (Delves and Lyness 1967); p_0 = m counts them, p_1 is
 * m times their mean, and Newton's identities make the polynomial whose zeros they are. These
 * start Aberth's iteration, Newton's method on F without the pull of the other roots, which
 * has the digits of F itself.
 */
#include "core/taut/taut.h"

#include <float.h>

#define MOST TAUT_CLUSTER_MAX
/* Points of a circle: roots within 0.8 of the radius leave 6e-7, or within 0.65 1e-6. */
#define TURNS     64
#define TURNS_FEW 32

static bool ring_of(taut_search *search, int turns, cplx centre, double radius, double factor,
                    taut_ring *ring)
{
    cplx power[MOST + 1] = {0.0};
    for (int k = 0; k < turns; k++) {
        const double turn = 2.0 * M_PI * (k + 0.5) / turns;
        const cplx u = CMPLX(cos(turn), sin(turn));
        const taut_value f = taut_search_at(search, centre + radius * u, factor);
        if (search->status != STRUM_OK || f.f == 0.0)
            return false;
        cplx term = times(u, over(f.d, f.f)) * radius / turns;
        for (int j = 0; j <= MOST; j++) {
            power[j] += term;
            term = times(term, u);
        }
    }
    const double whole = round(creal(power[0]));
    *ring = (taut_ring){.centre = centre, .radius = radius};
    if (!(cabs(power[0] - whole) < 1e-5) || whole < 0.0 || whole > MOST)
        return false;
    ring->count = (int)whole;
    for (int j = 0; j <= MOST; j++)
        ring->power[j] = power[j];
    return true;
}

bool taut_ring_make(taut_search *search, cplx centre, double radius, double factor,
                    taut_ring *ring)
{
    return ring_of(search, TURNS, centre, radius, factor, ring);
}

bool taut_ring_glance(taut_search *search, cplx centre, double radius, double factor,
                      taut_ring *ring)
{
    return ring_of(search, TURNS_FEW, centre, radius, factor, ring);
}

/* x^m - e[1] x^{m-1} + e[2] x^{m-2} - ... at x. */
static cplx polynomial(int m, const cplx *e, cplx x)
{
    cplx sum = 1.0;
    for (int k = 1; k <= m; k++)
        sum = times(sum, x) + ((k & 1) != 0 ? -e[k] : e[k]);
    return sum;
}

/* Zeros of the polynomial with the ring's power sums, about their mean (Durand and Kerner). */
static void by_power_sums(const taut_ring *ring, cplx *x)
{
    const int m = ring->count;
    const cplx mean = ring->power[1] / m;
    cplx about[MOST + 1] = {m}, e[MOST + 1] = {1.0};
    for (int j = 1; j <= m; j++) { /* sum of (x - mean)^j, by the binomial theorem */
        cplx shift = 1.0;
        double choose = 1.0;
        for (int i = j; i >= 0; i--) {
            about[j] += choose * times(shift, i == 0 ? (cplx)m : ring->power[i]);
            shift = times(shift, -mean);
            choose = choose * i / (j - i + 1);
        }
    }
    for (int k = 1; k <= m; k++) { /* Newton's identities */
        cplx sum = 0.0;
        for (int i = 1; i <= k; i++)
            sum += ((i & 1) != 0 ? 1.0 : -1.0) * times(e[k - i], about[i]);
        e[k] = sum / k;
    }
    double size = 0.0;
    for (int k = 1; k <= m; k++)
        size = fmax(size, pow(cabs(e[k]), 1.0 / k));
    for (int i = 0; i < m; i++)
        x[i] = (size + DBL_MIN) *
               CMPLX(cos(2.0 * M_PI * i / m + 0.4), sin(2.0 * M_PI * i / m + 0.4));
    for (int n = 0; n < 200 && m > 1 && size > 0.0; n++)
        for (int i = 0; i < m; i++) {
            cplx product = 1.0;
            for (int k = 0; k < m; k++)
                if (k != i && x[k] != x[i])
                    product = times(product, x[i] - x[k]);
            x[i] -= over(polynomial(m, e, x[i]), product);
        }
    for (int i = 0; i < m; i++)
        x[i] = m == 1 ? mean : mean + x[i];
}

/* One sweep of Aberth's iteration over all roots; the longest step. */
static double sweep(taut_search *search, double factor, double longest, int m, cplx *s)
{
    double most = 0.0;
    for (int i = 0; i < m && search->status == STRUM_OK; i++) {
        const taut_value f = taut_search_at(search, s[i], factor);
        if (f.f == 0.0)
            continue;
        cplx slope = over(f.d, f.f);
        for (int k = 0; k < m; k++)
            if (s[k] != s[i])
                slope -= over(1.0, s[i] - s[k]);
        if (slope == 0.0)
            continue;
        cplx step = over(1.0, slope);
        const double size = cabs(step);
        if (!isfinite(size))
            continue;
        if (size > longest)
            step *= longest / size;
        s[i] -= step;
        most = fmax(most, size);
    }
    return most;
}

/* From near to all digits; false when it does not come to rest or leaves the ring. */
static bool polish(taut_search *search, const taut_ring *ring, double factor, cplx *s)
{
    const double scale = cabs(ring->centre) + 1e-3 * search->spacing;
    double last = INFINITY;
    bool rests = false;
    int still = 0;
    for (int n = 0; n < 120 && !rests && search->status == STRUM_OK; n++) {
        const double most = sweep(search, factor, 0.3 * ring->radius, ring->count, s);
        still += most >= 0.8 * last; /* towards nearly double roots it halves each time */
        rests = most <= 4.0 * DBL_EPSILON * scale || (still > 4 && most <= 1e-7 * scale);
        last = most;
    }
    cplx sum = 0.0;
    for (int i = 0; i < ring->count; i++) {
        sum += (s[i] - ring->centre) / ring->radius;
        rests = rests && cabs(s[i] - ring->centre) < ring->radius;
    }
    return rests && cabs(sum - ring->power[1]) < 1e-5;
}

/* About a centre on the real axis: what comes within rounding of it lies on it. */
static void settle_on_axis(taut_search *search, const taut_ring *ring, double factor, cplx *s)
{
    cplx real[MOST];
    const double scale = cabs(ring->centre) + 1e-3 * search->spacing;
    bool off = false;
    for (int i = 0; i < ring->count; i++) {
        const bool near = fabs(cimag(s[i])) < 1e-6 * scale;
        real[i] = near ? creal(s[i]) : s[i];
        off = off || (near && cimag(s[i]) != 0.0);
        for (int k = 0; k < i; k++) /* from two different places */
            if (real[k] == real[i])
                real[i] += 1e-9 * scale;
    }
    if (!off)
        return;
    const bool rests = polish(search, ring, factor, real);
    for (int i = 0; i < ring->count; i++)
        if (rests)
            s[i] = real[i];
        else if (fabs(cimag(s[i])) < 3e-8 * scale) /* rounding does not tell them apart */
            s[i] = creal(s[i]);
}

/* By frequency, then decay. */
static bool before(cplx a, cplx b, double same)
{
    if (fabs(cimag(a) - cimag(b)) > same)
        return cimag(a) < cimag(b);
    return creal(a) > creal(b);
}

/* A narrower circle as long as all roots lie about one place: their power sums tell them apart
 * to the m-th root of rounding, in radii. */
static void zoom(taut_search *search, taut_ring *ring, double factor, cplx *x)
{
    by_power_sums(ring, x);
    for (int n = 0; n < 12 && ring->count > 1; n++) {
        const cplx mean = ring->power[1] / ring->count;
        double spread = 0.0;
        for (int i = 0; i < ring->count; i++)
            spread = fmax(spread, cabs(x[i] - mean));
        taut_ring next;
        if (spread > 0.02 || cabs(mean) > 0.9 ||
            !taut_ring_make(search, ring->centre + ring->radius * mean,
                            ring->radius * fmax(5.0 * spread, 0.01), factor, &next) ||
            next.count != ring->count)
            return;
        if (cimag(ring->centre) == 0.0 && fabs(cimag(mean)) < 1e-9) {
            const cplx real = creal(next.centre);
            if (!taut_ring_make(search, real, next.radius, factor, &next) ||
                next.count != ring->count)
                return;
        }
        *ring = next;
        by_power_sums(ring, x);
    }
}

void taut_ring_roots(taut_search *search, const taut_ring *given, double factor, cplx *roots)
{
    cplx x[MOST], s[MOST];
    taut_ring narrow = *given, *ring = &narrow;
    if (given->count == 0)
        return;
    zoom(search, ring, factor, x);
    for (int i = 0; i < ring->count; i++)
        s[i] = ring->centre + ring->radius * x[i];
    for (int i = 0; i < ring->count; i++)
        roots[i] = s[i];
    if (polish(search, ring, factor, s))
        for (int i = 0; i < ring->count; i++)
            roots[i] = s[i];
    if (cimag(given->centre) == 0.0)
        settle_on_axis(search, ring, factor, roots);
    const double same = 1e-12 * cabs(ring->centre);
    for (int i = 1; i < ring->count; i++)
        for (int k = i; k > 0 && before(roots[k], roots[k - 1], same); k--) {
            const cplx kept = roots[k];
            roots[k] = roots[k - 1];
            roots[k - 1] = kept;
        }
}

void taut_ring_rough(const taut_ring *ring, cplx *roots)
{
    if (ring->count == 0)
        return;
    by_power_sums(ring, roots);
    for (int i = 0; i < ring->count; i++)
        roots[i] = ring->centre + ring->radius * roots[i];
}

double taut_ring_apart(const taut_ring *ring, const cplx *roots)
{
    double least = INFINITY;
    for (int i = 0; i < ring->count; i++)
        for (int k = 0; k < i; k++)
            least = fmin(least, cabs(roots[i] - roots[k]));
    return least;
}
