/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/identify/beam.h"

#include <math.h>
#include <stdbool.h>

/* tanh and 1/cosh are 1 and 0 to the last bit beyond. */
#define DEEP 350.0
/* Newton's steps below this share of b are followed by one more, and then the root is right to the
 * last bits; smaller shares are drowned by rounding. */
#define STEP_SMALL 1e-9
#define STEP_NONE  4e-16

beam_end beam_end_by_fixity(double rho, double u)
{
    /* k L/EI = rho/(1 - rho) (3 + 1/u) */
    const double a = rho * (1 + 3 * u), b = (1 - rho) * u, scale = 1 / (a + b);
    return (beam_end){a * scale, b * scale, (1 + 3 * u) * scale, -u * scale};
}

beam_end beam_end_by_stiffness(double kappa)
{
    if (kappa > 1)
        return (beam_end){1 / (1 + 1 / kappa), 1 / kappa / (1 + 1 / kappa), 0, 0};
    return (beam_end){kappa / (1 + kappa), 1 / (1 + kappa), 0, 0};
}

/* The characteristic function and its derivatives. */
typedef struct characteristic {
    double f, by_b, by_xi2;
    double by_a[2], by_bb[2]; /* by the two numbers of each end */
} characteristic;

/* F = a1 a2 [2 a b (sech a - cos b) + xi^2 tanh a sin b]
 *   + (a1 b2 + a2 b1) q (a sin b - b tanh a cos b) + b1 b2 q^2 tanh a sin b,
 * a^2 = b^2 + xi^2, q = a^2 + b^2: the determinant of the four end conditions over cosh a. */
static characteristic evaluate(double b, double xi2, const beam_end ends[2])
{
    const double a = sqrt(b * b + xi2), q = a * a + b * b;
    double t = 1, sech = 0, s, c;
    if (a < DEEP) {
        const double e = exp(-a), e2 = e * e;
        t = (1 - e2) / (1 + e2);
        sech = 2 * e / (1 + e2);
    }
    sincos(b, &s, &c);
    const double ta = 1 - t * t, sech_a = -sech * t;
    const double d = 2 * a * b * (sech - c) + xi2 * t * s;
    const double d_a = 2 * b * (sech - c) + 2 * a * b * sech_a + xi2 * ta * s;
    const double d_b = 2 * a * (sech - c) + 2 * a * b * s + xi2 * t * c;
    const double m = a * s - b * t * c, p = q * m;
    const double p_a = 2 * a * m + q * (s - b * ta * c);
    const double p_b = 2 * b * m + q * (a * c - t * c + b * t * s);
    const double r = q * q * t * s;
    const double r_a = 4 * a * q * t * s + q * q * ta * s;
    const double r_b = 4 * b * q * t * s + q * q * t * c;
    const double k2 = ends[0].a * ends[1].a, k0 = ends[0].b * ends[1].b;
    const double k1 = ends[0].a * ends[1].b + ends[0].b * ends[1].a;
    const double by_a = k2 * d_a + k1 * p_a + k0 * r_a;
    characteristic f = {.f = k2 * d + k1 * p + k0 * r};
    f.by_b = k2 * d_b + k1 * p_b + k0 * r_b + by_a * b / a;
    f.by_xi2 = by_a * 0.5 / a + k2 * t * s;
    for (int i = 0; i < 2; i++) {
        f.by_a[i] = ends[1 - i].a * d + ends[1 - i].b * p;
        f.by_bb[i] = ends[1 - i].a * p + ends[1 - i].b * r;
    }
    return f;
}

/* The wave number that the end layers' phases give. */
static double guess(int n, double xi2, const beam_end ends[2])
{
    const bool equal = ends[0].a == ends[1].a && ends[0].b == ends[1].b;
    double b = n * M_PI;
    for (int pass = 0; pass < 2; pass++) {
        const double a = sqrt(b * b + xi2), q = a * a + b * b;
        const double one = atan2(ends[0].a * b, ends[0].b * q + ends[0].a * a);
        const double two = equal ? one : atan2(ends[1].a * b, ends[1].b * q + ends[1].a * a);
        b = n * M_PI + one + two;
    }
    return b;
}

/* Exactly one root lies in [n pi, (n + 3/4) pi): pinned is its lower end, clamped stays below
 * (n + 0.51) pi, and springs lie between, for each adds one positive rank-one term. `f`: there. */
static double root(int n, double xi2, const beam_end ends[2], characteristic *f)
{
    double low = n * M_PI, high = low + 0.75 * M_PI;
    const bool pinned = ends[0].a == 0 && ends[1].a == 0;
    double b = pinned ? low : guess(n, xi2, ends);
    const double sign = n % 2 ? -1 : 1; /* F has this sign above the root */
    bool close = pinned;
    for (int i = 0; i < 80; i++) {
        *f = evaluate(b, xi2, ends);
        const double by = pinned ? 0 : f->f / f->by_b;
        if (close || fabs(by) < STEP_NONE * b) /* only the last bits of b move */
            return b - by;
        close = fabs(by) < STEP_SMALL * b; /* no bracket: rounding decides the sign of F here */
        if (close) {
            b -= by;
            continue;
        }
        *(sign * f->f < 0 ? &low : &high) = b;
        b = b - by > low && b - by < high ? b - by : 0.5 * (low + high);
    }
    return b;
}

beam_mode beam_solve(int n, double u, const beam_end ends[2])
{
    if (u == 0)
        return (beam_mode){.om = n * M_PI, .b = n * M_PI, .tension = 1};
    characteristic f;
    const double xi2 = 1 / u / u, b = root(n, xi2, ends, &f), ub2 = u * u * b * b;
    const double bend = ub2 / (1 + ub2), factor = -2 * (1 + bend) / (b * f.by_b);
    beam_mode mode = {.om = b * sqrt(1 + ub2), .b = b};
    double by_kappa = 0;
    for (int i = 0; i < 2; i++) {
        /* At the root the two parts of F for one end are equal and opposite: take the smaller. */
        const beam_end *e = &ends[i];
        const double part = e->a < e->b ? e->a * f.by_a[i] : -e->b * f.by_bb[i];
        mode.ends[i] = factor * part;
        by_kappa += part;
        mode.by_rho[i] = factor * (f.by_a[i] * e->a_rho + f.by_bb[i] * e->b_rho);
    }
    mode.tension = factor * f.by_xi2 * xi2 + 1 - bend;
    mode.bending = -factor * (f.by_xi2 * xi2 + by_kappa) + bend;
    return mode;
}
