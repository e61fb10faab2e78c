/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/numerics/bracket.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

/* T. R. Chandrupatla, A new hybrid quadratic/bisection algorithm, 1997: inverse quadratic
 * interpolation wherever the three last points are monotone enough for it, else bisection. */
double bracket_root(bracket_function *f, const void *data, double a, double b)
{
    double fa = f(a, data), fb = f(b, data), c = a, fc = fa, t = 0.5;
    while (fa != 0 && fb != 0) {
        const double x = a + t * (b - a), fx = f(x, data);
        /* a: the newest point, b: the other side of the root, c: the point before */
        if ((fx > 0) == (fa > 0)) {
            c = a;
            fc = fa;
        } else {
            c = b;
            fc = fb;
            b = a;
            fb = fa;
        }
        a = x;
        fa = fx;
        const double best = fabs(fa) < fabs(fb) ? a : b;
        const double limit = (2 * DBL_EPSILON * fabs(best) + DBL_MIN) / fabs(b - a);
        if (limit > 0.5 || fa == 0)
            return best;
        const double xi = (a - b) / (c - b), phi = (fa - fb) / (fc - fb);
        const bool smooth = phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi;
        t = smooth ? fa / (fb - fa) * fc / (fb - fc) +
                         (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
                   : 0.5;
        t = fmin(fmax(t, limit), 1 - limit);
    }
    return fa == 0 ? a : b;
}

void bracket_take(bracket_ends *b, double x, double fx)
{
    if ((fx > 0) == (b->f_low > 0)) {
        b->low = x;
        b->f_low = fx;
        b->f_high *= b->kept == 1 ? 0.5 : 1;
        b->kept = 1;
    } else {
        b->high = x;
        b->f_high = fx;
        b->f_low *= b->kept == -1 ? 0.5 : 1;
        b->kept = -1;
    }
}
