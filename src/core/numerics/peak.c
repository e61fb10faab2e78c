/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/numerics/peak.h"

#include <math.h>

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

#define GOLDEN 0.6180339887498949

golden golden_begin(golden_function f, void *data, double low, double high)
{
    golden g = {.low = low, .high = high};
    g.left = high - GOLDEN * (high - low);
    g.right = low + GOLDEN * (high - low);
    g.at_left = f(data, g.left);
    g.at_right = f(data, g.right);
    return g;
}

void golden_step(golden *g, golden_function f, void *data)
{
    if (g->at_left > g->at_right || (g->first && g->at_left == g->at_right)) {
        g->high = g->right;
        g->right = g->left;
        g->at_right = g->at_left;
        g->left = g->high - GOLDEN * (g->high - g->low);
        g->at_left = f(data, g->left);
    } else {
        g->low = g->left;
        g->left = g->right;
        g->at_left = g->at_right;
        g->right = g->low + GOLDEN * (g->high - g->low);
        g->at_right = f(data, g->right);
    }
}

double peak_golden(golden_function f, void *data, double low, double high, double *x)
{
    golden g = golden_begin(f, data, low, high);
    g.first = true;
    for (int i = 0; i < 40; i++)
        golden_step(&g, f, data);
    /* an end that is not passed is a support, and may be the place itself */
    const double ends[] = {g.low, g.high};
    *x = g.at_left >= g.at_right ? g.left : g.right;
    double largest = fmax(g.at_left, g.at_right);
    for (int i = 0; i < 2; i++) {
        const double value = f(data, ends[i]);
        if (value > largest) {
            largest = value;
            *x = ends[i];
        }
    }
    return largest;
}
