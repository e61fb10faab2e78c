/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Elements of the rod. At the ends of each piece its direction turns within some widths
 * l_b = sqrt(EI/T), as e^-r of the distance r in l_b: three elements there leave e^-38. Between
 * them the rod follows the cable without bending stiffness.
 */
#include <math.h>

#include "core/cable/form.h"
#include "core/cable/rod.h"
#include "core/numerics/gauss.h"

#define HALVINGS 12
#define SMOOTH   30 /* beyond this degree a smooth element is halved */

typedef struct {
    const strum_hanging *cable;
    cable_rod *rod; /* arrays NULL: only count */
    size_t piece;
    int halvings;
} maker;

static double tension_at(const cable_piece *p, double s)
{
    return hypot(p->h, p->v + p->section->weight * s);
}

static void add(maker *m, double from, double to, int degree, int halvings)
{
    cable_rod *rod = m->rod;
    if (halvings > 0) {
        add(m, from, (from + to) / 2, degree, halvings - 1);
        add(m, (from + to) / 2, to, degree, halvings - 1);
        return;
    }
    if (rod->elements != NULL)
        rod->elements[rod->count] = (rod_element){.piece = m->piece,
                                                  .from = from,
                                                  .half = (to - from) / 2,
                                                  .degree = degree,
                                                  .first = rod->bubbles,
                                                  .node = rod->nodes};
    rod->count++;
    rod->nodes++; /* its left one */
    rod->bubbles += (size_t)(degree - 1);
}

/* The angle of the cable is atan(v/h), with branch points at v = +-ih: on an ellipse of radius
 * rho about [from, to], Legendre series fall as rho^-k. */
static void smooth(maker *m, double from, double to, int halved)
{
    const cable_piece *p = m->cable->pieces + m->piece;
    const double v_1 = p->v + p->section->weight * from, v_2 = p->v + p->section->weight * to;
    const double half = fabs(v_2 - v_1) / 2;
    double degree = 8;
    if (half > 0) {
        const double re = fabs(v_1 + v_2) / 2 / half, im = p->h / half;
        const double axis = (hypot(re + 1, im) + hypot(re - 1, im)) / 2;
        const double rho = axis + sqrt(fmax(axis * axis - 1, 0));
        degree = 8 + (rho > 1 ? 14 / log10(rho) : 1e3);
    }
    if (degree > SMOOTH && halved < HALVINGS) {
        smooth(m, from, (from + to) / 2, halved + 1);
        smooth(m, (from + to) / 2, to, halved + 1);
        return;
    }
    add(m, from, to, (int)fmin(degree, SMOOTH), m->halvings);
}

/* Widths in l_b, and degrees that leave 1e-13 of e^-r over them. */
static const double widths[] = {4, 10, 22};
static const int degrees[] = {16, 20, 18};

static void piece_elements(maker *m)
{
    const cable_piece *p = m->cable->pieces + m->piece;
    const double l = p->length, stiffness = p->section->bending_stiffness;
    const double left = sqrt(stiffness / tension_at(p, 0)),
                 right = sqrt(stiffness / tension_at(p, l));
    const double layers = l / fmax(left, right);
    const int count = layers > 74 ? 3 : layers > 30 ? 2 : layers > 9 ? 1 : 0;
    double from = 0, to = l;
    if (count == 0) {
        add(m, 0, l, 20, m->halvings + (layers > 5));
        return;
    }
    for (int i = 0; i < count; i++) {
        add(m, from, from + widths[i] * left, degrees[i], m->halvings);
        from += widths[i] * left;
    }
    for (int i = 0; i < count; i++)
        to -= widths[i] * right;
    if (count == 3)
        smooth(m, from, to, 0);
    else
        add(m, from, to, count == 2 ? 24 : 28, m->halvings);
    for (int i = count; i-- > 0;) {
        add(m, to, to + widths[i] * right, degrees[i], m->halvings);
        to += widths[i] * right;
    }
}

static void all_elements(maker *m)
{
    cable_rod *rod = m->rod;
    rod->count = rod->nodes = rod->bubbles = 0;
    bool bent = false;
    for (m->piece = 0; m->piece < m->cable->piece_count; m->piece++) {
        const bool bends = m->cable->pieces[m->piece].section->bending_stiffness > 0;
        if (bent && !bends)
            rod->nodes++; /* the right node of the last element */
        if (rod->first != NULL)
            rod->first[m->piece] = rod->count;
        if (bends)
            piece_elements(m);
        bent = bends;
    }
    if (bent)
        rod->nodes++;
    if (rod->first != NULL)
        rod->first[m->piece] = rod->count;
}

/* ---- the first angles ---- */

static double turned(double from, double to)
{
    return from + remainder(to - from, 2 * M_PI);
}

/* The parts of th' = h w/T^2. */
static void first_bubbles(const cable_piece *p, const rod_element *e, double *bubble)
{
    enum { POINTS = 32 };
    double node[POINTS], weight[POINTS], polynomial[ROD_DEGREE_MAX + 1];
    gauss_legendre(POINTS, node, weight);
    for (int k = 0; k < e->degree - 1; k++)
        bubble[k] = 0;
    for (int q = 0; q < POINTS; q++) {
        const double t = tension_at(p, e->from + e->half * (1 + node[q]));
        const double turn = p->h * p->section->weight / (t * t) * e->half;
        rod_legendre(e->degree, node[q], polynomial);
        for (int k = 0; k < e->degree - 1; k++)
            bubble[k] += weight[q] * turn * polynomial[k + 1];
    }
}

/* Angles of the cable without bending stiffness at nodes, a kink shared by its sides. */
static void first_angles(const strum_hanging *cable, cable_rod *rod)
{
    double last = form_angle(cable->pieces, 0);
    for (size_t i = 0; i < rod->count; i++) {
        const rod_element *e = rod->elements + i;
        const cable_piece *p = cable->pieces + e->piece;
        const bool follows = i > 0 && rod->elements[i - 1].node + 1 == e->node;
        const double left = turned(last, form_angle(p, e->from));
        rod->angle[e->node] = follows ? (last + left) / 2 : left;
        last = turned(left, form_angle(p, e->from + 2 * e->half));
        rod->angle[e->node + 1] = last;
        first_bubbles(p, e, rod->bubble + e->first);
    }
}

strum_status rod_divide(strum_hanging *cable, int halvings, arena *memory, cable_rod **made)
{
    cable_rod *rod = arena_alloc(memory, 1, sizeof *rod);
    if (rod == NULL)
        return STRUM_ERR_MEMORY;
    maker m = {.cable = cable, .rod = rod, .halvings = halvings};
    all_elements(&m);
    rod->elements = arena_alloc(memory, rod->count + 1, sizeof *rod->elements);
    rod->first = arena_alloc(memory, cable->piece_count + 1, sizeof *rod->first);
    rod->angle = arena_doubles(memory, rod->nodes + 1);
    rod->bubble = arena_doubles(memory, rod->bubbles + 1);
    if (rod->elements == NULL || rod->first == NULL || rod->angle == NULL ||
        rod->bubble == NULL)
        return STRUM_ERR_MEMORY;
    all_elements(&m);
    first_angles(cable, rod);
    *made = rod;
    return STRUM_OK;
}
