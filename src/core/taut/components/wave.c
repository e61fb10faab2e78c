/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What cables of all kinds are made of: one wave to and fro. */
#include "core/taut/components/component.h"

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

void taut_wave(dual q, cplx gamma, double length, dual *cosine, dual *sine, double *log_scale)
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

long taut_half_waves(double phase, double sine)
{
    const double turns = fmin(phase / M_PI, 1e15); /* beyond, a sine tells nothing */
    long whole = (long)turns;
    if ((whole & 1) != (signbit(sine) != 0))
        whole += turns - (double)whole > 0.5 ? 1 : -1;
    return whole < 0 ? 0 : whole;
}
