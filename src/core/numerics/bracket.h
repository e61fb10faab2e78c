/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A root between two points where a function has opposite signs. */
#ifndef CORE_NUMERICS_BRACKET_H
#define CORE_NUMERICS_BRACKET_H

typedef double bracket_function(double x, const void *data);

/* The root of `f` between a and b, to the last bits; f(a) f(b) <= 0. */
double bracket_root(bracket_function *f, const void *data, double a, double b);

/* The ends of a bracket for false position by Illinois' rule (M. Dowell and P. Jarratt, A
 * modified regula falsi method, BIT 11, 1971): an end that stays twice counts half. */
typedef struct bracket_ends {
    double low, high, f_low, f_high; /* f_low > 0 > f_high, or both the other way round */
    int kept;                        /* 1: high stayed last, -1: low did, 0: begin so */
} bracket_ends;

/* Takes a point within, and the function there, for the end on its side of the root. */
void bracket_take(bracket_ends *b, double x, double fx);

#endif
