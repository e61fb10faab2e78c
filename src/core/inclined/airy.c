/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The 4 x 4 determinant of the report's chapter 2, errata mended (units L = M = T_a = 1):
 *     w = K v + (C3 cos W - C4 sin W)/q
 *     u = v'/h + (K q/omega)(C3 sin W + C4 cos W)
 *     T = -omega^2 v
 *     v'' = -Q(s) v
 *     q = T0^(1/4)
 *     W = omega INT T0^(-1/2) ds
 *     Q = h epsilon^2 cos^2(phi_a) (kL^2/lambda^2 - 1 + 4 epsilon sin(phi_a)(s - c))
 * with K the curvature, and c = 1/2 by (17), (18), or s_a for Q's tangent there. v is the slow
 * pair: Ai(-z), Bi(-z) combined; as a power series of s it neither overflows nor loses its
 * sense as Q's slope goes to zero with the inclination.
 *
 * w = u = 0 at both ends gives
 *     (v, v') = -G0 y        at s = 0, y = (C3, C4), G = diag(1/(q K), h K q/omega)
 *     (v, v') = -G1 R(W) y   at s = 1
 * With F the transfer of (v, v'), the determinant vanishes where
 *     det(P - R(W)) = 0,     P = G1^-1 F G0
 * P and R have determinant 1, so that P R^-1 turns by an angle, lifted from det = 1 to whole
 * turns:
 *     theta = W + the turns of P
 * Zeros come in pairs, one where its trace rises through 2 and one where it falls again, at
 * each whole turn. So the number of zeros below a frequency is known from theta and the sign of
 * the determinant alone, the pair of an exact crossing included; the pair at no turn at all is
 * the spurious low root and its mirror image.
 */
#include <complex.h>
#include <math.h>

#include "core/inclined/approximation.h"
#include "core/inclined/statics.h"
#include "core/numerics/bracket.h"

typedef double _Complex complex2[2][2];

/* Q at s, for frequency kl. */
static double _Complex stiffness_deficit(const strum_inclined *m, double _Complex kl, double s)
{
    const strum_inclined_cable *c = &m->cable;
    const double slope = c->epsilon * cos(c->inclination);
    const double centre = m->kind == STRUM_INCLINED_AIRY ? 0.5 : m->statics.s_a;
    return c->mass_ratio * slope * slope *
           (kl * kl / c->lambda_squared - 1 +
            4 * c->epsilon * sin(c->inclination) * (s - centre));
}

/* (v, v') from `from` to `to` by Taylor series; |Q| width^2 is at most 1/4. */
static void advance(const strum_inclined *m, double _Complex kl, double from, double to,
                    double _Complex state[2])
{
    const double h = to - from;
    const double _Complex q0 = stiffness_deficit(m, kl, from) * h * h;
    const double _Complex q1 = stiffness_deficit(m, kl, to) * h * h - q0;
    double _Complex before = 0, a = state[0], next = state[1] * h; /* a_{n-1}, a_n, a_{n+1} */
    double _Complex value = 0, slope = 0;
    for (int n = 0; n < 18; n++) {
        value += a;
        slope += (n + 1) * next;
        const double _Complex after = -(q0 * a + q1 * before) * (1.0 / ((n + 2) * (n + 1)));
        before = a;
        a = next;
        next = after;
    }
    state[0] = value;
    state[1] = slope / h;
}

/* Largest wave number of v from 0 to `to`. */
static double steepest(const strum_inclined *m, double _Complex kl, double to)
{
    return sqrt(fmax(cabs(stiffness_deficit(m, kl, 0)), cabs(stiffness_deficit(m, kl, to))));
}

/* Steps from 0 to `to` that `advance` can take. */
static int steps_to(const strum_inclined *m, double _Complex kl, double to)
{
    return to > 0 ? (int)ceil(2 * to * steepest(m, kl, to)) + 1 : 0;
}

/* Angle by which the rotation in a real matrix's polar decomposition turns clockwise. */
static double turn(complex2 a)
{
    return atan2(creal(a[0][1] - a[1][0]), creal(a[0][0] + a[1][1]));
}

/* Transfer of (v, v') along the whole cable; `turns` (may be NULL) gets the lifted angle in
 * units in which no step turns it by much. */
static void transfer(const strum_inclined *m, double _Complex kl, complex2 out, double *turns)
{
    const int steps = steps_to(m, kl, 1);
    const double unit = fmax(1, steepest(m, kl, 1));
    double _Complex columns[2][2] = {{1, 0}, {0, unit}};
    double before = 0, sum = 0;
    for (int i = 0; i < steps; i++) {
        for (int j = 0; j < 2; j++) {
            advance(m, kl, (double)i / steps, (i + 1.0) / steps, columns[j]);
            out[0][j] = columns[j][0];
            out[1][j] = columns[j][1] / unit;
        }
        const double now = turn(out);
        sum += remainder(now - before, 2 * M_PI);
        before = now;
    }
    out[0][1] /= unit;
    out[1][0] *= unit;
    if (turns != NULL)
        *turns = sum;
}

/* G at either end. */
static void units_at(const strum_inclined *m, double _Complex kl, bool top,
                     double _Complex g[2])
{
    const double q = pow(top ? m->statics.tension_top : m->statics.tension_bottom, 0.25);
    const double curvature = top ? m->statics.curvature_top : m->statics.curvature_bottom;
    g[0] = 1 / (q * curvature);
    g[1] = m->cable.mass_ratio * curvature * q / kl;
}

/* P - R(W); `turns` (may be NULL) gets theta. */
static void end_matrix(const strum_inclined *m, double _Complex kl, complex2 out, double *turns)
{
    double _Complex g0[2], g1[2];
    units_at(m, kl, false, g0);
    units_at(m, kl, true, g1);
    double along = 0;
    transfer(m, kl, out, turns != NULL ? &along : NULL);
    for (int i = 0; i < 4; i++)
        out[i / 2][i % 2] *= g0[i % 2] / g1[i / 2];
    const double _Complex phase = kl * m->statics.phase;
    if (turns != NULL) /* positive units change the angle by less than half a turn */
        *turns = creal(phase) + along + remainder(turn(out) - along, 2 * M_PI);
    const double _Complex c = ccos(phase), s = csin(phase);
    out[0][0] -= c;
    out[0][1] += s;
    out[1][0] -= s;
    out[1][1] -= c;
}

static double _Complex determinant(complex2 a)
{
    return a[0][0] * a[1][1] - a[0][1] * a[1][0];
}

static double _Complex characteristic(const strum_inclined *m, double _Complex kl)
{
    complex2 a;
    end_matrix(m, kl, a, NULL);
    return determinant(a);
}

static double real_function(double kl, const void *data)
{
    return creal(characteristic(data, kl));
}

/* Zeros below kl, the spurious one not counted (-1: below that one). */
static int zeros_below(const strum_inclined *m, double kl)
{
    complex2 a;
    double theta;
    end_matrix(m, kl, a, &theta);
    return creal(determinant(a)) > 0 ? 2 * (int)floor(theta / (2 * M_PI))
                                     : 2 * (int)round(theta / (2 * M_PI)) - 1;
}

/* The vector y that P - R(W) maps to nothing. At the exact crossing of a level cable every y
 * is one; there the symmetric and the antisymmetric one are taken, whichever fits better, and
 * the other one for the second mode. */
static void find_vector(const strum_inclined *m, inclined_wave *wave,
                        const inclined_wave *before)
{
    complex2 a;
    end_matrix(m, wave->kl, a, NULL);
    const double half = wave->kl * m->statics.phase / 2;
    const double even[2] = {cos(half), -sin(half)}, odd[2] = {sin(half), cos(half)};
    if (m->cable.inclination == 0) {
        double rest[2] = {0, 0};
        for (int i = 0; i < 2; i++) {
            rest[0] += fabs(creal(a[i][0] * even[0] + a[i][1] * even[1]));
            rest[1] += fabs(creal(a[i][0] * odd[0] + a[i][1] * odd[1]));
        }
        bool symmetric = rest[0] < rest[1];
        if (before != NULL && wave->kl - before->kl < 1e-9 * wave->kl)
            symmetric = before->symmetry == STRUM_ANTISYMMETRIC;
        wave->symmetry = symmetric ? STRUM_SYMMETRIC : STRUM_ANTISYMMETRIC;
        wave->fast[0] = symmetric ? even[0] : odd[0];
        wave->fast[1] = symmetric ? even[1] : odd[1];
        return;
    }
    const int row =
        hypot(creal(a[1][0]), creal(a[1][1])) > hypot(creal(a[0][0]), creal(a[0][1]));
    wave->fast[0] = -creal(a[row][1]);
    wave->fast[1] = creal(a[row][0]);
}

/* The zero number k (from 1), which lies above `low`. */
static double zero(const strum_inclined *m, int k, double low)
{
    while (real_function(low, m) == 0) /* a zero found before */
        low *= 1 + 4e-16;
    const double step = M_PI * inclined_spacing(m);
    double high = low + step;
    while (zeros_below(m, high) < k) {
        low = high;
        high += step;
    }
    while (high - low > 4e-16 * high) {
        const int below = zeros_below(m, low), above = zeros_below(m, high);
        if (below == k - 1 && above == k)
            return bracket_root(real_function, m, low, high);
        const double middle = (low + high) / 2;
        if (zeros_below(m, middle) < k)
            low = middle;
        else
            high = middle;
    }
    return high;
}

/* Measured: the roots, and the shapes sampled for their maxima and energies. */
static double work_us(const strum_cable *mechanics, int count, double size)
{
    (void)mechanics;
    return count * (80 + 0.01 * size * size);
}

static strum_status roots(const strum_inclined *m, int count, inclined_wave *waves,
                          double *spurious, work *w)
{
    double low = 0.05 * M_PI * inclined_spacing(m);
    while (zeros_below(m, low) > 0)
        low /= 2;
    for (int k = 1; k <= count; k++) {
        const strum_status status = work_spend(w, work_us(NULL, 1, m->size));
        if (status != STRUM_OK)
            return status;
        waves[k - 1] = (inclined_wave){.kl = zero(m, k, low)};
        find_vector(m, &waves[k - 1], k > 1 ? &waves[k - 2] : NULL);
        if (zeros_below(m, waves[k - 1].kl) <= k)
            low = waves[k - 1].kl;
    }
    /* the determinant is negative below the spurious one, a level cable's too */
    double high = 0.9 * waves[0].kl;
    for (low = high / 2; zeros_below(m, low) == 0 && low > 1e-9 * high; low /= 2)
        high = low;
    *spurious = zeros_below(m, low) == -1 && zeros_below(m, high) == 0
                    ? bracket_root(real_function, m, low, high)
                    : 0;
    return STRUM_OK;
}

static void sample(const strum_inclined *m, const inclined_wave *wave, double x, double phase,
                   strum_inclined_point *out)
{
    const strum_catenary *p = &m->statics.profile;
    const double kl = wave->kl, c = cosh(p->chi_m + mapping_offset(&m->along, x));
    const double q = pow(cos(m->cable.inclination) * c, 0.25), curvature = m->length / (c * c);
    const double cosine = cos(kl * phase), sine = sin(kl * phase);
    double _Complex g0[2];
    units_at(m, kl, false, g0);
    double _Complex slow[2] = {-g0[0] * wave->fast[0], -g0[1] * wave->fast[1]};
    const int steps = steps_to(m, kl, out->s);
    for (int i = 0; i < steps; i++)
        advance(m, kl, out->s * i / steps, out->s * (i + 1) / steps, slow);
    const double v = creal(slow[0]), v1 = creal(slow[1]);
    out->transverse = curvature * v + (wave->fast[0] * cosine - wave->fast[1] * sine) / q;
    out->longitudinal = v1 / m->cable.mass_ratio +
                        curvature * q / kl * (wave->fast[0] * sine + wave->fast[1] * cosine);
    out->tension = -kl * kl * v;
}

#define AIRY                                                                                   \
    APPROXIMATION, .expansion = true, .has_longitudinal = true, .work_us = work_us,            \
                   .roots = roots, .function = characteristic, .sample = sample,               \
                   .wants_phase = true

const inclined_model inclined_airy = {.name = "airy", AIRY};
const inclined_model inclined_airy_tangent = {.name = "airy, tangent at s_a", AIRY};
