/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CORE_NUMERICS_PEAK_H
#define CORE_NUMERICS_PEAK_H

#include <stdbool.h>

/* The largest value between `low` and `high`, where a sample was larger than its neighbours;
 * `*x` is set to its place. */
typedef double (*peak_refine)(void *data, double low, double high, double *x);

/* The largest value of a function that is not negative, from samples equally spaced in x from
 * -1 to 1 (at least 3; their array is used up): every sample between smaller ones that may hide
 * it is refined. Of equals the first. */
double peak_largest(double *value, int samples, peak_refine refine, void *data, double *x);

/* What a maximum about three samples may reach beyond the middle one, the largest: twice what
 * the parabola through them does. */
double peak_excess(double left, double middle, double right);

/* Golden section towards a maximum between `low` and `high`: two places within and the values
 * there. */
typedef double (*golden_function)(void *data, double x);
typedef struct golden {
    double low, high, left, right, at_left, at_right;
    bool first; /* of equal values the left one counts as the better one, else the right one */
} golden;
golden golden_begin(golden_function f, void *data, double low, double high);
/* Leaves out the end beside the worse place. */
void golden_step(golden *g, golden_function f, void *data);

/* Maximum of f by golden section, as precise as values can tell: half the digits of x. */
double peak_golden(golden_function f, void *data, double low, double high, double *x);

#endif
