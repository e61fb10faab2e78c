/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/identify/sag.h"

#include <math.h>
#include <stdbool.h>

#include "core/numerics/bracket.h"

/* W, the response to a unit load that moves as e^{iwt}: u^2 W'''' - W'' - om^2 W = 1, with z from
 * midspan. W = -1/om^2 + p cos bz + q E + r sin bz + t O, E and O = e^{-a(1/2+z)} +- e^{-a(1/2-z)}. */
typedef struct response {
    double om2, a, b, p, q, r, t;
    double integral;            /* of W */
    double slope[2], moment[2]; /* W' and W'' at the ends, seen from the left */
} response;

typedef struct question {
    double u, lambda2;
    const beam_end *ends;
    bool equal;            /* ends: only the symmetric motion answers */
    double om2_lo, om2_hi; /* poles beside the root */
} question;

static double square_frequency(double b, double u)
{
    return b * b * (1 + u * u * b * b);
}

/* Slope and curvature at the left end of the symmetric and the antisymmetric part, each c + d x
 * with x the free factor p or r. */
typedef struct part {
    double slope, slope_x, moment, moment_x;
} part;

static response respond(double b, const question *k)
{
    const double u = k->u;
    response w = {.om2 = square_frequency(b, u), .b = b};
    double s, c;
    sincos(0.5 * b, &s, &c);
    if (u == 0) {
        w.p = 1 / (w.om2 * c);
        w.integral = -1 / w.om2 + w.p * 2 / b * s;
        w.slope[0] = w.p * b * s;
        w.slope[1] = -w.slope[0];
        return w;
    }
    const double a = w.a = sqrt(b * b + 1 / u / u), e = a < 700 ? exp(-a) : 0;
    /* W = 0 at the ends: q = (1/om^2 - p c)/(1 + e), t = r s/(1 - e). */
    const double q0 = 1 / w.om2 / (1 + e), q1 = -c / (1 + e), t1 = s / (1 - e);
    const part even = {-q0 * a * (1 - e), b * s - q1 * a * (1 - e), q0 * a * a * (1 + e),
                       -b * b * c + q1 * a * a * (1 + e)};
    const part odd = {0, b * c - t1 * a * (1 + e), 0, b * b * s + t1 * a * a * (1 - e)};
    /* b_i W'' = a_i W' with the slope turned inward, at both ends. */
    double even_0[2], even_1[2], odd_1[2];
    for (int i = 0; i < 2; i++) {
        const beam_end *end = &k->ends[i];
        even_0[i] = end->b * even.moment - end->a * even.slope;
        even_1[i] = end->b * even.moment_x - end->a * even.slope_x;
        odd_1[i] = (i == 0 ? 1 : -1) * (end->b * odd.moment_x - end->a * odd.slope_x);
    }
    if (k->equal) {
        w.p = -even_0[0] / even_1[0];
    } else {
        const double det = even_1[0] * odd_1[1] - even_1[1] * odd_1[0];
        w.p = (-even_0[0] * odd_1[1] + even_0[1] * odd_1[0]) / det;
        w.r = (-even_1[0] * even_0[1] + even_1[1] * even_0[0]) / det;
    }
    w.q = q0 + q1 * w.p;
    w.t = t1 * w.r;
    w.integral = -1 / w.om2 + w.p * 2 / b * s + w.q * 2 / a * (1 - e);
    for (int i = 0; i < 2; i++) {
        const double side = i == 0 ? 1 : -1;
        w.slope[i] = side * (even.slope + even.slope_x * w.p) + odd.slope_x * w.r;
        w.moment[i] = even.moment + even.moment_x * w.p + side * odd.moment_x * w.r;
    }
    return w;
}

/* 1 + lambda^2 int W = 0 with its poles taken away; rises through the root. */
static double secular(double b, const void *data)
{
    const question *k = data;
    const response w = respond(b, k);
    return (1 + k->lambda2 * w.integral) * (w.om2 - k->om2_lo) * (k->om2_hi - w.om2);
}

/* Energies of W from closed integrals of products of its parts. */
static beam_mode shares(const response *w, const question *k)
{
    const double a = w->a, b = w->b, u = k->u, q = a * a + b * b;
    const double e = u > 0 && a < 700 ? exp(-a) : 0;
    double s, c, sb = sin(b);
    sincos(0.5 * b, &s, &c);
    const double cc = 0.5 + sb / (2 * b), ss = 0.5 - sb / (2 * b);
    const double ee = u > 0 ? (1 - e * e) / a + 2 * e : 0,
                 oo = u > 0 ? (1 - e * e) / a - 2 * e : 0;
    const double ce = u > 0 ? 2 * (a * c * (1 - e) + b * s * (1 + e)) / q : 0;
    const double so = u > 0 ? 2 * (b * c * (1 - e) - a * s * (1 + e)) / q : 0;
    const double p = w->p, g = w->q, r = w->r, t = w->t;
    const double mean = p * 2 / b * s + (u > 0 ? g * 2 / a * (1 - e) : 0);
    const double mass = 1 / (w->om2 * w->om2) + p * p * cc + g * g * ee + 2 * p * g * ce -
                        2 / w->om2 * mean + r * r * ss + t * t * oo + 2 * r * t * so;
    const double slope = p * p * b * b * ss + 2 * p * g * a * b * so + g * g * a * a * oo +
                         r * r * b * b * cc - 2 * r * t * a * b * ce + t * t * a * a * ee;
    const double a2 = a * a, b2 = b * b;
    const double curve = p * p * b2 * b2 * cc - 2 * p * g * a2 * b2 * ce +
                         g * g * a2 * a2 * ee + r * r * b2 * b2 * ss -
                         2 * r * t * a2 * b2 * so + t * t * a2 * a2 * oo;
    const double kinetic = w->om2 * mass;
    beam_mode mode = {.om = sqrt(w->om2), .b = b, .tension = slope / kinetic};
    mode.bending = u * u * curve / kinetic;
    mode.sag = k->lambda2 * w->integral * w->integral / kinetic;
    for (int i = 0; i < 2 && u > 0; i++) {
        const beam_end *end = &k->ends[i];
        /* k L/EI = (1 + 3 u) rho/(u (1 - rho)); its energy by slope or by moment, what is not
         * small */
        const double slope2 = w->slope[i] * w->slope[i], moment2 = w->moment[i] * w->moment[i];
        const double spring = end->a < end->b            ? slope2 * end->a / end->b
                              : end->b > 0 || end->a > 0 ? moment2 * end->b / end->a
                                                         : 0;
        mode.ends[i] = u * u * spring / kinetic;
        const double rise = end->a_rho, fall = -end->b_rho;
        if (rise > 0)
            /* d(a/b) = (a_rho b - a b_rho)/b^2 drho, of the scaled numbers */
            mode.by_rho[i] =
                u * u / kinetic *
                (end->a < end->b ? slope2 / (end->b * end->b) : moment2 / (end->a * end->a)) *
                (rise * end->b + fall * end->a);
    }
    return mode;
}

/* Root of the secular equation between two unshifted modes. */
static beam_mode shifted(const beam_mode *lo, const beam_mode *hi, question *k)
{
    k->om2_lo = lo->om * lo->om;
    k->om2_hi = hi->om * hi->om;
    const double gap = hi->b - lo->b;
    double from = lo->b + 1e-13 * lo->b, to = hi->b - 1e-13 * hi->b;
    if (!(gap > 1e-12 * hi->b))
        return *lo;
    /* So weak a pull that the root is the pole itself to the last bits. */
    if (!(secular(from, k) < 0))
        return *lo;
    if (!(secular(to, k) > 0))
        return *hi;
    const double b = bracket_root(secular, k, from, to);
    const response w = respond(b, k);
    return shares(&w, k);
}

/* A symmetric one lies between symmetric neighbours and may pass the antisymmetric mode between
 * them, which stays: the two change places at lambda^2 = 4 pi^2 for a string. */
static beam_mode equal_ends(int n, question *k)
{
    const int odd = n % 2 ? n : n - 1;
    const beam_mode lo = beam_solve(odd, k->u, k->ends);
    const beam_mode still = beam_solve(odd + 1, k->u, k->ends);
    const beam_mode hi = beam_solve(odd + 2, k->u, k->ends);
    const beam_mode moved = shifted(&lo, &hi, k);
    const bool moved_first = moved.om <= still.om;
    return (n % 2 == 1) == moved_first ? moved : still;
}

beam_mode sag_solve(int n, double u, const beam_end ends[2], double lambda2)
{
    question k = {.u = u, .lambda2 = lambda2, .ends = ends};
    k.equal = u == 0 || (ends[0].a == ends[1].a && ends[0].b == ends[1].b);
    if (k.equal)
        return equal_ends(n, &k);
    const beam_mode lo = beam_solve(n, u, ends), hi = beam_solve(n + 1, u, ends);
    return shifted(&lo, &hi, &k);
}
