/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A root between two points where a function has opposite signs. */
#ifndef CORE_NUMERICS_BRACKET_H
#define CORE_NUMERICS_BRACKET_H

typedef double bracket_function(double x, const void *data);

/* The root of `f` between a and b, to the last bits; f(a) f(b) <= 0. */
double bracket_root(bracket_function *f, const void *data, double a, double b);

#endif
