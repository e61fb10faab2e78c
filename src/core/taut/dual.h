/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Complex numbers with a derivative along one direction. */
#ifndef CORE_TAUT_DUAL_H
#define CORE_TAUT_DUAL_H

#include <complex.h>
#include <math.h>

typedef double _Complex cplx;

/* A number and its derivative along a direction (forward differentiation). */
typedef struct dual {
    cplx v, d;
} dual;

static inline dual dual_of(double a)
{
    return (dual){a, 0.0};
}
static inline dual dual_add(dual a, dual b)
{
    return (dual){a.v + b.v, a.d + b.d};
}
static inline dual dual_sub(dual a, dual b)
{
    return (dual){a.v - b.v, a.d - b.d};
}
static inline dual dual_scale(double k, dual a)
{
    return (dual){k * a.v, k * a.d};
}
/* Products and quotients by hand: C's own check every product for infinities. */
static inline cplx times(cplx a, cplx b)
{
    return CMPLX(creal(a) * creal(b) - cimag(a) * cimag(b),
                 creal(a) * cimag(b) + cimag(a) * creal(b));
}
static inline cplx over(cplx a, cplx b)
{
    const double size = fmax(fabs(creal(b)), fabs(cimag(b)));
    const cplx u = CMPLX(creal(b) / size, -cimag(b) / size);
    return times(a, u) / (size * (creal(u) * creal(u) + cimag(u) * cimag(u)));
}
static inline dual dual_mul(dual a, dual b)
{
    return (dual){times(a.v, b.v), times(a.v, b.d) + times(a.d, b.v)};
}
static inline dual dual_div(dual a, dual b)
{
    const cplx q = over(a.v, b.v);
    return (dual){q, over(a.d - times(q, b.d), b.v)};
}

#endif
