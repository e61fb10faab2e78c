/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CORE_NUMERICS_PEAK_H
#define CORE_NUMERICS_PEAK_H

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

/* Maximum of f by golden section, as precise as values can tell: half the digits of x. */
double peak_golden(double (*f)(void *data, double x), void *data, double low, double high,
                   double *x);

#endif
