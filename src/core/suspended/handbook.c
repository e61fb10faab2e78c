/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Closed forms of the shallow cable and the taut string (include/strum/handbook.h). */
#include <strum/handbook.h>

#include <math.h>

void strum_handbook_of(const strum_catenary *c, const strum_cable *cable, strum_handbook *s)
{
    s->chord = hypot(c->span, c->rise);
    const double slope = s->chord / c->span; /* 1/cos of the chord's inclination */
    s->tension = slope;
    /* the sag of the catenary is measured vertically */
    s->sag_ratio = 8 * strum_catenary_sag(c) / slope / s->chord;
    const double squared = s->sag_ratio * s->sag_ratio;
    /* kappa = H/EA, T = H slope; Irvine (1981) 3.14 with Le of 2.25 */
    s->lambda_squared = squared / (cable->kappa_t * slope * (1 + squared / 8));
    s->mass = cable->mass_n;
}

double strum_handbook_string(const strum_handbook *s, int n)
{
    return n * M_PI / s->chord * sqrt(s->tension / s->mass);
}

/*
 * With x = b/2 = (k - 1/2) pi + y the equation is cos y + sin y (x - (4/lambda^2) x^3) = 0,
 * which has exactly one root in 0 < y < pi: no poles, and a taut cable keeps the digits of y.
 */
double strum_handbook_root(double lambda_squared, int k)
{
    const double base = (k - 0.5) * M_PI, stretch = 4 / lambda_squared;
    double low = 0, high = M_PI;
    for (int i = 0; i < 60; i++) {
        const double y = (low + high) / 2, x = base + y;
        if (cos(y) + sin(y) * x * (1 - stretch * x * x) > 0)
            low = y;
        else
            high = y;
    }
    return 2 * (base + low);
}

double strum_handbook_in_plane(const strum_handbook *s, strum_symmetry symmetry, int k)
{
    /* antisymmetric modes stretch nothing: the string's even ones */
    return symmetry == STRUM_ANTISYMMETRIC
               ? strum_handbook_string(s, 2 * k)
               : strum_handbook_root(s->lambda_squared, k) / M_PI * strum_handbook_string(s, 1);
}
