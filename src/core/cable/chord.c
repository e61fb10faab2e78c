/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/chord.h"

#include <math.h>

/* An arc whose weight is less than this part of its tension is integrated by Gauss' rule: its
 * tension is analytic within 20 half lengths, and six points leave (1/40)^12. */
#define LIGHT 0.1

/* Gauss and Legendre's rule of six points. */
static const double nodes[CHORD_POINTS] = {-0.93246951420315202781, -0.66120938646626451366,
                                           -0.23861918608319690863, 0.23861918608319690863,
                                           0.66120938646626451366,  0.93246951420315202781};
static const double weights[CHORD_POINTS] = {0.17132449237917034504, 0.36076157304813860757,
                                             0.46791393457269104739, 0.46791393457269104739,
                                             0.36076157304813860757, 0.17132449237917034504};

/* a^2 as a sum of two doubles. */
static double square(double a, double *rest)
{
    const double high = a * a;
    *rest = fma(a, a, -high);
    return high;
}

/* a - b as a sum of two doubles (Knuth). */
static double difference(double a, double b, double *rest)
{
    const double high = a - b, back = high - a;
    *rest = (a - (high - back)) - (b + back);
    return high;
}

/* L - |R| = (L^2 - X^2 - Z^2)/(L + |R|), squares and differences with their rests. */
static double excess_of(const cable_line *line, double span, double rise, double distance)
{
    double rest_l, rest_x, rest_z, rest_1, rest_2;
    const double l = square(line->length, &rest_l), x = square(span, &rest_x),
                 z = square(rise, &rest_z);
    const double first = difference(l, fmax(x, z), &rest_1),
                 second = difference(first, fmin(x, z), &rest_2);
    const double rests =
        (rest_1 + rest_2) + (rest_l - rest_x - rest_z) + 2 * line->length * line->length_rest;
    return (second + rests) / (line->length + line->length_rest + distance);
}

cable_chord chord_of(const cable_line *line, double span, double rise)
{
    cable_chord c = {.line = line, .along_x = 1, .distance = hypot(span, rise)};
    if (c.distance > 0) {
        c.along_x = span / c.distance;
        c.along_z = rise / c.distance;
    }
    c.excess = excess_of(line, span, rise, c.distance);
    for (size_t i = 0; i < line->count; i++) {
        const line_piece *piece = line->pieces + i;
        c.flexibility += piece->arc.length * piece->arc.flexibility;
        c.load += fabs(piece->arc.weight) * piece->arc.length +
                  hypot(piece->load_x, piece->load_z) + fabs(piece->jump);
    }
    return c;
}

/* A light arc; its shortfall against its own length as it is:
 *     l - INT p/|F| dS = INT q^2/(|F| (|F| + p)) dS. */
static void add_light(const cable_chord *c, const cable_arc *a, double p, double q,
                      chord_miss *m)
{
    const double w_p = a->weight * c->along_z, w_q = a->weight * c->along_x;
    const double half = a->length / 2, elastic = a->length * a->flexibility;
    double shortfall = 0, across = 0, pp = 0, pq = 0, qq = 0;
    for (int i = 0; i < CHORD_POINTS; i++) {
        const double s = half * (1 + nodes[i]), weight = half * weights[i];
        const double p_s = p + w_p * s, q_s = q + w_q * s;
        const double t = sqrt(p_s * p_s + q_s * q_s), cube = weight / (t * t * t);
        shortfall += weight * (p_s > 0 ? q_s * q_s / (t * (t + p_s)) : 1 - p_s / t);
        across += weight * q_s / t;
        pp += cube * q_s * q_s;
        pq -= cube * p_s * q_s;
        qq += cube * p_s * p_s;
    }
    m->along += elastic * (p + w_p * half) - shortfall;
    m->across += across + elastic * (q + w_q * half);
    m->pp += pp + elastic;
    m->pq += pq;
    m->qq += qq + elastic;
}

static void add_weightless(const cable_chord *c, const cable_arc *a, double p, double q,
                           chord_miss *m)
{
    const double l = a->length, elastic = l * a->flexibility;
    const double q_2 = q * q + c->rounding * c->rounding, t = sqrt(p * p + q_2);
    const double cube = l / (t * t * t);
    m->along += elastic * p - l * (p > 0 ? q_2 / (t * (t + p)) : 1 - p / t);
    m->across += l * q / t + elastic * q;
    m->pp += cube * q_2 + elastic;
    m->pq -= cube * p * q;
    m->qq += cube * (p * p + c->rounding * c->rounding) + elastic;
}

static void add_heavy(const cable_chord *c, const cable_arc *a, double p, double q,
                      chord_miss *m)
{
    const double x = c->along_x, z = c->along_z;
    double h, v, along, across;
    chord_to_world(c, p, q, &h, &v);
    const cable_arc_reach r = arc_reach_slopes(a, h, v);
    chord_from_world(c, r.x, r.z, &along, &across);
    m->along += along - a->length;
    m->across += across;
    m->pp += x * x * r.xx + 2 * x * z * r.xz + z * z * r.zz;
    m->pq += x * z * (r.zz - r.xx) + (x - z) * (x + z) * r.xz;
    m->qq += z * z * r.xx - 2 * x * z * r.xz + x * x * r.zz;
}

/* The derivatives of the force by that at end 1: the identity but for tension jumps. */
typedef struct {
    double pp, pq, qp, qq;
} spread;

/* The step of the force at the start of a piece. */
static void step(const cable_chord *c, const line_piece *piece, double *p, double *q, spread *d)
{
    if (piece->jump != 0) {
        /* F + J F/|F|, by F: I + J/|F| (I - tt') */
        const double t = hypot(*p, *q), part = piece->jump / t;
        const double t_p = *p / t, t_q = *q / t;
        const double pp = 1 + part * t_q * t_q, pq = -part * t_p * t_q,
                     qq = 1 + part * t_p * t_p;
        *d = (spread){pp * d->pp + pq * d->qp, pp * d->pq + pq * d->qq, pq * d->pp + qq * d->qp,
                      pq * d->pq + qq * d->qq};
        *p += piece->jump * t_p;
        *q += piece->jump * t_q;
    }
    double load_p, load_q;
    chord_from_world(c, piece->load_x, piece->load_z, &load_p, &load_q);
    *p += load_p;
    *q += load_q;
}

chord_miss chord_reach(const cable_chord *c, double p, double q)
{
    chord_miss all = {.along = c->excess};
    spread d = {1, 0, 0, 1};
    for (size_t i = 0; i < c->line->count; i++) {
        const line_piece *piece = c->line->pieces + i;
        const cable_arc *a = &piece->arc;
        step(c, piece, &p, &q, &d);
        const double tension = sqrt(p * p + q * q);
        chord_miss m = {0};
        if (a->weight == 0)
            add_weightless(c, a, p, q, &m);
        else if (fabs(a->weight) * a->length < LIGHT * tension)
            add_light(c, a, p, q, &m);
        else
            add_heavy(c, a, p, q, &m);
        all.along += m.along;
        all.across += m.across;
        all.pp += m.pp * d.pp + m.pq * d.qp;
        all.pq += m.pp * d.pq + m.pq * d.qq;
        all.qp += m.pq * d.pp + m.qq * d.qp;
        all.qq += m.pq * d.pq + m.qq * d.qq;
        p += a->weight * a->length * c->along_z;
        q += a->weight * a->length * c->along_x;
        all.tension = fmax(all.tension, fmax(tension, sqrt(p * p + q * q)));
    }
    return all;
}

/* Mean of the resultant of the loads along (0) and across (1), or the half of the integral of the
 * square of the one across about `mean`. */
static double resultant(const cable_chord *c, int across, const double *mean)
{
    double at = 0, sum = 0;
    for (size_t i = 0; i < c->line->count; i++) {
        const line_piece *piece = c->line->pieces + i;
        double load[2];
        chord_from_world(c, piece->load_x, piece->load_z, load, load + 1);
        at += load[across] + (across == 0 ? piece->jump : 0);
        const double l = piece->arc.length;
        const double by = piece->arc.weight * l * (across == 0 ? c->along_z : c->along_x);
        if (mean == NULL) {
            sum += l * (at + by / 2);
        } else {
            const double from = at - *mean;
            sum += l * (from * from + from * by + by * by / 3) / 2;
        }
        at += by;
    }
    return mean == NULL ? sum / c->line->length : sum;
}

/* Positive root of F^3 SUM l/EA + F^2 (L - |R|) = c, from above. */
static double straight_tension(const cable_chord *c, double half_square)
{
    const double cubic = c->flexibility, quadratic = c->excess;
    double f = 0;
    if (cubic > 0)
        f = cbrt(half_square / cubic) + fmax(0, -quadratic / cubic);
    if (quadratic > 0 && (cubic == 0 || f > sqrt(half_square / quadratic)))
        f = sqrt(half_square / quadratic);
    for (int i = 0; i < 50 && f > 0; i++) {
        const double slope = f * (3 * cubic * f + 2 * quadratic);
        const double by = (f * f * (cubic * f + quadratic) - half_square) / slope;
        if (!(by > 1e-3 * f))
            break;
        f -= by;
    }
    return f;
}

void chord_guess(const cable_chord *c, double *p, double *q)
{
    const double along = resultant(c, 0, NULL), across = resultant(c, 1, NULL);
    const double f = straight_tension(c, resultant(c, 1, &across));
    *p = fmax(f, 1e-3 * c->load) - along;
    *q = -across;
}
