/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/numerics/mapping.h"

#include <complex.h>
#include <math.h>

mapping mapping_linear(const strum_cable *cable)
{
    return (mapping){.chi_m = cable->chi_m, .mu = cable->mu};
}

mapping mapping_stretched(const strum_cable *cable, double stretch)
{
    mapping c = mapping_linear(cable);
    const double first = sinh((c.chi_m - c.mu) / stretch),
                 last = sinh((c.chi_m + c.mu) / stretch);
    c.stretch = stretch;
    c.middle = c.chi_m == 0 ? 0 : (first + last) / 2;
    c.half = (last - first) / 2;
    return c;
}

double mapping_offset(const mapping *c, double x)
{
    if (c->stretch == 0)
        return c->mu * x;
    return c->stretch * asinh(c->middle + c->half * x) - c->chi_m;
}

double mapping_slope(const mapping *c, double x)
{
    return c->stretch == 0 ? c->mu : c->stretch * c->half / hypot(1, c->middle + c->half * x);
}

double mapping_bend(const mapping *c, double x)
{
    const double y = c->middle + c->half * x;
    return c->stretch == 0 ? 0 : -c->half * y / (1 + y * y);
}

double mapping_x(const mapping *c, double chi)
{
    const double x = c->stretch == 0 ? (chi - c->chi_m) / c->mu
                                     : (sinh(chi / c->stretch) - c->middle) / c->half;
    return fmin(fmax(x, -1), 1);
}

double mapping_singularity(const mapping *c)
{
    return c->stretch == 0 ? M_PI_2 / c->mu : sin(M_PI_2 / c->stretch) / c->half;
}

double mapping_ellipse_rate(const mapping *c)
{
    const double _Complex z = c->stretch == 0
                                  ? CMPLX(-c->chi_m, M_PI_2) / c->mu
                                  : CMPLX(-c->middle, sin(M_PI_2 / c->stretch)) / c->half;
    return fabs(creal(cacosh(z)));
}
