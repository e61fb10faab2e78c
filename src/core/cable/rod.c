/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/rod.h"

#include <math.h>

#include "core/numerics/gauss.h"

/* Norms of P_k, sqrt(k + 1/2), and of INT P_(k-1) = (P_k - P_(k-2))/(2k - 1):
 * sqrt(k - 1/2)/(2k - 1). */
/* clang-format off */
static const double norm[ROD_DEGREE_MAX + 1] = {
    0.70710678118654757, 1.2247448713915889, 1.5811388300841898, 1.8708286933869707, 2.1213203435596424, 2.3452078799117149, 2.5495097567963922, 2.7386127875258306, 2.9154759474226504, 3.082207001484488, 3.2403703492039302, 3.3911649915626341, 3.5355339059327378, 3.6742346141747673, 3.8078865529319543, 3.9370039370059056, 4.0620192023179804, 4.1833001326703778, 4.3011626335213133, 4.4158804331639239, 4.5276925690687087, 4.636809247747852, 4.7434164902525691, 4.8476798574163293, 4.9497474683058327, 5.0497524691810387, 5.1478150704935004, 5.2440442408507577, 5.3385391260156556, 5.4313902456001077, 5.5226805085936306, 5.6124860801609122, 5.7008771254956896};
static const double integral_norm[ROD_DEGREE_MAX + 1] = {
    0, 0.70710678118654757, 0.40824829046386296, 0.31622776601683794, 0.2672612419124244, 0.23570226039551581, 0.21320071635561044, 0.19611613513818402, 0.18257418583505539, 0.17149858514250885, 0.16222142113076252, 0.15430334996209191, 0.14744195615489714, 0.1414213562373095, 0.13608276348795434, 0.13130643285972257, 0.1270001270001905, 0.12309149097933274, 0.11952286093343936, 0.11624763874381928, 0.11322770341445959, 0.11043152607484655, 0.10783277320343841, 0.10540925533894598, 0.10314212462587935, 0.10101525445522108, 0.099014754297667429, 0.097128586235726427, 0.095346258924559238, 0.093658581158169399, 0.092057461789832332, 0.090535746042518531, 0.089087080637474794};
/* clang-format on */

/* P_0 .. P_degree at x. */
static void plain_legendre(int degree, double x, double *p)
{
    p[0] = 1;
    p[1] = x;
    for (int k = 1; k < degree; k++)
        p[k + 1] = ((2 * k + 1) * x * p[k] - k * p[k - 1]) / (k + 1);
}

void rod_legendre(int degree, double x, double *p)
{
    plain_legendre(degree, x, p);
    for (int k = 0; k <= degree; k++)
        p[k] *= norm[k];
}

void rod_bubbles(int degree, double x, double *bubble)
{
    double p[ROD_DEGREE_MAX + 1];
    plain_legendre(degree, x, p);
    for (int k = 2; k <= degree; k++)
        bubble[k - 2] = integral_norm[k] * (p[k] - p[k - 2]);
}

static double angle_at(const cable_rod *rod, const rod_element *e, double x, double *turn)
{
    double p[ROD_DEGREE_MAX + 1];
    const double left = rod->angle[e->node], right = rod->angle[e->node + 1];
    const double *c = rod->bubble + e->first;
    double angle = left * (1 - x) / 2 + right * (1 + x) / 2, slope = (right - left) / 2;
    plain_legendre(e->degree, x, p);
    for (int k = 2; k <= e->degree; k++) {
        angle += c[k - 2] * integral_norm[k] * (p[k] - p[k - 2]);
        slope += c[k - 2] * norm[k - 1] * p[k - 1];
    }
    *turn = slope / e->half;
    return angle;
}

static rod_point point_at(const strum_hanging *cable, const rod_element *e, double x)
{
    const cable_piece *piece = cable->pieces + e->piece;
    const double s = e->from + e->half * (1 + x);
    const double h = piece->h, v = piece->v + piece->section->weight * s;
    rod_point at = {0};
    at.angle = angle_at(cable->rod, e, x, &at.turn);
    const double c = cos(at.angle), d = sin(at.angle);
    at.normal = h * c + v * d;
    at.shear = v * c - h * d;
    at.stretch = 1 + at.normal / piece->section->axial_stiffness;
    return at;
}

/* r' = (1 + e) t from the start of the element to x. */
static void add_place(const strum_hanging *cable, const rod_element *e, double x, rod_point *at)
{
    enum { POINTS = 32 };
    double node[POINTS], weight[POINTS];
    gauss_legendre(POINTS, node, weight);
    at->x = e->x;
    at->z = e->z;
    for (int i = 0; i < POINTS; i++) {
        const rod_point q = point_at(cable, e, -1 + (1 + x) * (1 + node[i]) / 2);
        const double by = weight[i] * e->half * (1 + x) / 2 * q.stretch;
        at->x += by * cos(q.angle);
        at->z += by * sin(q.angle);
    }
}

rod_point rod_at(const strum_hanging *cable, size_t piece, double s, bool place)
{
    const cable_rod *rod = cable->rod;
    size_t i = rod->first[piece];
    while (i + 1 < rod->first[piece + 1] &&
           s > rod->elements[i].from + 2 * rod->elements[i].half)
        i++;
    const rod_element *e = rod->elements + i;
    const double x = fmin(fmax((s - e->from) / e->half - 1, -1), 1);
    rod_point at = point_at(cable, e, x);
    if (place)
        add_place(cable, e, x, &at);
    return at;
}
