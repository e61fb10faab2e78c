/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/arc.h"

#include <math.h>

/* What all figures of an arc are made of: |F| at both ends and INT dS/|F|. */
typedef struct {
    double v_1, t_0, t_1, sum, inverse;
} ends;

/* s - D without cancellation, of s = T0 + T1 and D = |v1 - v0| = |w| l. */
static double less_weight(double h, double v_0, double v_1, double t_0, double t_1)
{
    if (v_0 * v_1 < 0)
        return h * h / (t_0 + fabs(v_0)) + h * h / (t_1 + fabs(v_1));
    if (fabs(v_0) < fabs(v_1))
        return t_0 + fabs(v_0) + h * h / (t_1 + fabs(v_1));
    return t_1 + fabs(v_1) + h * h / (t_0 + fabs(v_0));
}

static ends ends_of(const cable_arc *a, double h, double v)
{
    ends e = {.v_1 = v + a->weight * a->length};
    e.t_0 = sqrt(h * h + v * v);
    e.t_1 = sqrt(h * h + e.v_1 * e.v_1);
    e.sum = e.t_0 + e.t_1;
    /* INT dS/|F| = l (2/s) atanh(u)/u, u = D/s */
    const double weight = fabs(a->weight * a->length), u = weight / e.sum, square = u * u;
    if (u < 1e-3)
        e.inverse = 2 * a->length / e.sum * (1 + square * (1. / 3 + square * (1. / 5)));
    else if (u < 0.5)
        e.inverse = 2 * a->length / e.sum * (atanh(u) / u);
    else
        e.inverse =
            a->length / weight * log((e.sum + weight) / less_weight(h, v, e.v_1, e.t_0, e.t_1));
    return e;
}

double arc_inverse_tension(const cable_arc *a, double h, double v)
{
    return ends_of(a, h, v).inverse;
}

void arc_reach(const cable_arc *a, double h, double v, double *x, double *z)
{
    const ends e = ends_of(a, h, v);
    const double vertical = v + e.v_1;
    /* dx = h INT dS/|F| + h l/EA: nothing of the first where it hangs straight down */
    *x = (h != 0 && e.sum > 0 ? h * e.inverse : 0) + h * a->length * a->flexibility;
    /* dz = l (v0 + v1)/(T0 + T1) + l (v0 + v1)/(2 EA) */
    *z = e.sum > 0 ? a->length * vertical * (1 / e.sum + a->flexibility / 2) : 0;
}

/* INT h^2/|F|^3 dS */
static double cubed(const cable_arc *a, double h, double v, const ends *e)
{
    if (v * e->v_1 < 0)
        return (e->v_1 / e->t_1 - v / e->t_0) / a->weight;
    const double vertical = v + e->v_1;
    if (vertical == 0)
        return a->length / e->t_0;
    return h * h * a->length * vertical / (e->t_0 * e->t_1 * (e->v_1 * e->t_0 + v * e->t_1));
}

cable_arc_reach arc_reach_slopes(const cable_arc *a, double h, double v)
{
    const ends e = ends_of(a, h, v);
    const double vertical = v + e.v_1, elastic = a->length * a->flexibility;
    const double third = cubed(a, h, v, &e);
    return (cable_arc_reach){
        .x = h * e.inverse + h * elastic,
        .z = vertical * (a->length / e.sum + elastic / 2),
        .xx = e.inverse - third + elastic,
        .xz = -h * a->length * vertical / (e.t_0 * e.t_1 * e.sum),
        .zz = third + elastic,
    };
}

/* INT |F| dS = l ((v0 + v1)^2/s + s)/4 + h^2/2 INT dS/|F| */
double arc_stretched(const cable_arc *a, double h, double v)
{
    const ends e = ends_of(a, h, v);
    if (a->flexibility == 0 || e.sum == 0)
        return a->length;
    const double vertical = v + e.v_1;
    const double tension = a->length * (vertical * vertical / e.sum + e.sum) / 4 +
                           (h != 0 ? h * h * e.inverse / 2 : 0);
    return a->length + a->flexibility * tension;
}
