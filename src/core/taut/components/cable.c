/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cables of uniform tension, and the WKB matrix of a cable whose tension varies linearly. */
#include "core/taut/taut.h"

/* cosh(g) and sinh(g)/g with their derivatives by q, g^2 = q L^2 = x small: power series, where
 * the closed form of the derivative would cancel. */
static void wave_series(dual q, double length, dual *cosine, dual *sine)
{
    cplx c = 1.0, sh = 1.0, dsh = 0.0, power = 1.0;
    double even = 1.0, odd = 1.0;
    for (int n = 1; n <= 9; n++) { /* |x| <= 1/2: the next term is below 1e-18 */
        even *= (2 * n - 1) * (2 * n);
        odd *= (2 * n) * (2 * n + 1);
        dsh += n * power / odd;
        power = times(power, q.v * (length * length));
        c += power / even;
        sh += power / odd;
    }
    *cosine = (dual){c, times(0.5 * length * length * sh, q.d)};
    *sine = (dual){length * sh, times(length * length * length * dsh, q.d)};
}

static void wave(dual q, cplx gamma, double length, dual *cosine, dual *sine, double *log_scale)
{
    if (cabs(q.v) * length * length < 0.5) {
        wave_series(q, length, cosine, sine);
        return;
    }
    if (creal(gamma) < 0.0)
        gamma = -gamma; /* both functions are even in gamma */
    const double a = creal(gamma) * length, b = cimag(gamma) * length;
    double sin_b, cos_b;
    sincos(b, &sin_b, &cos_b);
    /* times e^{-a}, so that nothing overflows: (1 - e^{-2a})/2 and (1 + e^{-2a})/2 */
    const double minus = a == 0.0 ? 0.0 : -0.5 * expm1(-2.0 * a), plus = 1.0 - minus;
    const cplx c = CMPLX(plus * cos_b, minus * sin_b);
    const cplx s = over(CMPLX(minus * cos_b, plus * sin_b), gamma);
    *cosine = (dual){c, times(0.5 * length * s, q.d)};
    *sine = (dual){s, times(over(0.5 * (length * c - s), q.v), q.d)};
    *log_scale += a;
}

void taut_wave(dual q, double length, dual *cosine, dual *sine, double *log_scale)
{
    wave(q, csqrt(q.v), length, cosine, sine, log_scale);
}

long taut_half_waves(double phase, double sine)
{
    const double turns = fmin(phase / M_PI, 1e15); /* beyond, a sine tells nothing */
    long whole = (long)turns;
    if ((whole & 1) != (signbit(sine) != 0))
        whole += turns - (double)whole > 0.5 ? 1 : -1;
    return whole < 0 ? 0 : whole;
}

/* Li (A.3): k^2 = (rho w^2 - i R w)/T, that is gamma^2 = (rho s^2 + R s)/T = -k^2;
 * F = [cos kL, sin kL/(kT); -kT sin kL, cos kL]. */
void taut_cable_factor(const taut_component *c, const taut_at *at, taut_factor *f)
{
    const double t = c->cable.tension;
    dual q = dual_scale(c->cable.mass / t, dual_mul(at->s, at->s)), sine;
    cplx gamma;
    *f = (taut_factor){.den = {1.0, 0.0}};
    if (c->cable.drag > 0.0 && at->factor.v != 0.0) {
        q = dual_add(q, dual_scale(c->cable.drag / t, dual_mul(at->factor, at->s)));
        gamma = csqrt(q.v);
    } else {
        /* the direction may still turn the drag on */
        q.d += c->cable.drag / t * times(at->factor.d, at->s.v);
        gamma = c->cable.slowness * at->s.v;
    }
    wave(q, gamma, c->length, &f->n11, &sine, &f->log_scale);
    f->n22 = f->n11;
    f->n12 = dual_scale(1.0 / t, sine);
    f->n21 = dual_scale(t, dual_mul(q, sine));
}

/* Phase W = w integral of sqrt(rho/T) along the cable; tension linear (Li, below A.2). */
double taut_wkb_phase(const taut_component *c, double w)
{
    return 2.0 * w * sqrt(c->varying.mass) * c->length /
           (sqrt(c->varying.tension_0) + sqrt(c->varying.tension_1));
}

/* Li (A.2), with cos W = cosh(W' s), sin W/w = sinh(W' s)/s, W' = W/w. Its determinant is 1: it
 * is the exact matrix of a cable that besides rests on an elastic foundation T'^2/(16 T). */
void taut_wkb_factor(const taut_component *c, const taut_at *at, taut_factor *f)
{
    const double t0 = c->varying.tension_0, t1 = c->varying.tension_1;
    const double slope = (t1 - t0) / c->length, ratio = pow(t0 / t1, 0.25);
    const double z = sqrt(c->varying.mass * sqrt(t0 * t1)); /* (rho^2 T0 T1)^{1/4} */
    const dual s2 = dual_mul(at->s, at->s);
    dual cosine, sine;
    *f = (taut_factor){.den = {1.0, 0.0}};
    wave(s2, at->s.v, taut_wkb_phase(c, 1.0), &cosine, &sine, &f->log_scale);
    f->n11 = dual_add(dual_scale(ratio, cosine), dual_scale(0.25 * slope / z, sine));
    f->n12 = dual_scale(1.0 / z, sine);
    f->n21 = dual_add(dual_scale(0.25 * slope * (1.0 / ratio - ratio), cosine),
                      dual_sub(dual_scale(z, dual_mul(s2, sine)),
                               dual_scale(slope * slope / (16.0 * z), sine)));
    f->n22 = dual_sub(dual_scale(1.0 / ratio, cosine), dual_scale(0.25 * slope / z, sine));
}
