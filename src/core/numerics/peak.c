/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/numerics/peak.h"

#include <math.h>
#include <stdbool.h>

/* Values closer than this are equal, and the first of them is the answer. */
#define TIED 1e-12
/* No maximum is larger than this times the sample beside it. */
#define SAMPLED 1.25

double peak_excess(double left, double middle, double right)
{
    const double bend = 2 * middle - left - right, tilt = right - left;
    return bend > 0 ? tilt * tilt / (4 * bend) : 0;
}

/* At an end the parabola has nothing to stand on. */
static double promise(const double *value, int i, int samples)
{
    return i == 0 || i == samples - 1
               ? value[i] * 1.02
               : value[i] + peak_excess(fabs(value[i - 1]), value[i], fabs(value[i + 1]));
}

/* The largest local maximum among the samples that was not looked at; -1 where there is none.
 */
static int unseen(const double *value, int samples)
{
    int best = -1;
    for (int i = 0; i < samples; i++)
        if (value[i] >= 0 && (i == 0 || fabs(value[i - 1]) <= value[i]) &&
            (i == samples - 1 || fabs(value[i + 1]) <= value[i]) &&
            (best < 0 || value[i] > value[best]))
            best = i;
    return best;
}

double peak_largest(double *value, int samples, peak_refine refine, void *data, double *x)
{
    const double step = 2.0 / (samples - 1);
    double largest = -1;
    int i;
    *x = 1;
    /* the largest sample first, so that most others need no look */
    while ((i = unseen(value, samples)) >= 0 && SAMPLED * value[i] > largest) {
        const bool earlier = value[i] > largest * (1 - TIED) && i * step - 1 < *x;
        if (earlier || promise(value, i, samples) > largest) {
            double at;
            const double found =
                refine(data, fmax((i - 1) * step - 1, -1), fmin((i + 1) * step - 1, 1), &at);
            if (found > largest * (1 + TIED) || (found > largest * (1 - TIED) && at < *x))
                *x = at;
            largest = fmax(largest, found);
        }
        value[i] = -value[i] - 1e-300; /* seen */
    }
    return largest;
}

double peak_golden(double (*f)(void *data, double x), void *data, double low, double high,
                   double *x)
{
    const double golden = 0.6180339887498949;
    double left = high - golden * (high - low), right = low + golden * (high - low);
    double at_left = f(data, left), at_right = f(data, right);
    for (int i = 0; i < 40; i++) {
        const bool to_left = at_left >= at_right;
        *(to_left ? &high : &low) = to_left ? right : left;
        const double next =
            to_left ? high - golden * (high - low) : low + golden * (high - low);
        if (to_left) {
            right = left;
            at_right = at_left;
            left = next;
            at_left = f(data, left);
        } else {
            left = right;
            at_left = at_right;
            right = next;
            at_right = f(data, right);
        }
    }
    /* an end that is not passed is a support, and may be the place itself */
    const double ends[] = {low, high};
    *x = at_left >= at_right ? left : right;
    double largest = fmax(at_left, at_right);
    for (int i = 0; i < 2; i++) {
        const double value = f(data, ends[i]);
        if (value > largest) {
            largest = value;
            *x = ends[i];
        }
    }
    return largest;
}
