/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A cable with bending stiffness has layers of the width l_b = sqrt(EI/T) at the ends of each
 * piece, in which its direction turns: a cell of 14 l_b there, smooth ones between. Eigenvalue
 * errors are squares, so that e^-14 = 8e-7 may be left to the smooth cells. The layer takes the
 * tension at its own end: along a deep cable it differs.
 */
#include "core/cable/mesh.h"

#include <math.h>

#define LAYERS   14.0
#define DEGREE   36 /* beyond it a cell is halved */
#define RADIUS   60.0
#define HALVINGS 40

double mesh_tension(const cable_piece *piece, double s)
{
    if (piece->lies)
        return fmax(hypot(piece->h, piece->v) + piece->rate * s, 0);
    return hypot(piece->h, piece->v + piece->section->weight * s);
}

/* With stiff statics e = (F.t + Q0 th)/EA has layers too. */
static void cell(const mesh_cell *c, mesh *m)
{
    if (m->cells != NULL) {
        m->cells[m->count] = *c;
        if (m->rod)
            m->cells[m->count].strain_degree = c->degree;
    }
    m->count++;
}

typedef struct {
    const cable_piece *piece;
    size_t index;
    double waves; /* half waves in the piece */
    int least;    /* degree, for beams */
    int more;
} span;

/* The tension's branch points v = +-ih, seen from [a, b] as [-1, 1], lie on an ellipse of radius
 * rho: Legendre series fall as rho^-k. */
static double smoothness(const cable_piece *piece, double a, double b)
{
    if (piece->lies)
        return 1;
    const double va = piece->v + piece->section->weight * a;
    const double vb = piece->v + piece->section->weight * b;
    const double half = fabs(vb - va) / 2;
    if (half == 0)
        return 0;
    const double re = fabs(va + vb) / 2 / half, im = piece->h / half;
    const double axis = (hypot(re + 1, im) + hypot(re - 1, im)) / 2;
    const double rho = axis + sqrt(fmax(axis * axis - 1, 0));
    return rho > 1 ? fmin(9 / log10(rho), RADIUS) : RADIUS;
}

/* 12 + 1.8 k + 2 k^(1/3) + 9/log10 rho, k half waves in the cell. */
static void smooth(const span *s, double a, double b, int halved, mesh *m)
{
    const double waves = s->waves * (b - a) / s->piece->length;
    const double wanted = 12 + 1.8 * waves + 2 * cbrt(waves) + smoothness(s->piece, a, b);
    if (wanted > DEGREE && halved < HALVINGS) {
        smooth(s, a, (a + b) / 2, halved + 1, m);
        smooth(s, (a + b) / 2, b, halved + 1, m);
        return;
    }
    const int degree = (int)ceil(fmin(wanted, DEGREE));
    const double start = s->piece->start;
    const mesh_cell c = {start + a, start + b, s->index,
                         (degree > s->least ? degree : s->least) + s->more, degree + s->more};
    cell(&c, m);
}

static void layer(const span *s, double a, double b, mesh *m)
{
    const double waves = s->waves * (b - a) / s->piece->length;
    if (waves > 8) {
        layer(s, a, (a + b) / 2, m);
        layer(s, (a + b) / 2, b, m);
        return;
    }
    const int extra = (int)ceil(1.8 * waves) + s->more;
    const mesh_cell c = {s->piece->start + a, s->piece->start + b, s->index, 18 + extra,
                         9 + extra};
    cell(&c, m);
}

/* A piece not much longer than its layers. */
static void beam(const span *s, double layer_width, mesh *m)
{
    span thick = *s;
    const double l = s->piece->length;
    const int cells = l < 17 * layer_width ? 1 : 2;
    const double least = ceil(12 + 0.8 * l / layer_width / cells);
    thick.least = (int)fmin(fmax(least, 22), 28);
    for (int i = 0; i < cells; i++)
        smooth(&thick, l * i / cells, l * (i + 1) / cells, 0, m);
}

static void divide(const span *s, mesh *m)
{
    const double l = s->piece->length, stiffness = s->piece->section->bending_stiffness;
    if (!(stiffness > 0) || s->piece->lies) {
        smooth(s, 0, l, 0, m);
        return;
    }
    const double left = LAYERS * sqrt(stiffness / mesh_tension(s->piece, 0));
    const double right = LAYERS * sqrt(stiffness / mesh_tension(s->piece, l));
    if (!(l > 1.3 * (left + right))) {
        beam(s, fmax(left, right) / LAYERS, m);
        return;
    }
    layer(s, 0, left, m);
    smooth(s, left, l - right, 0, m);
    layer(s, l - right, l, m);
}

/* Half waves spread as the time that waves take. */
static double travel(const cable_piece *piece)
{
    const double tension = mesh_tension(piece, piece->length / 2);
    const double mass = piece->section->mass + piece->section->added_mass;
    return tension > 0 ? piece->length * sqrt(mass / tension) : 0;
}

void mesh_make(const strum_hanging *cable, const motion_choice *choice, mesh *m)
{
    double all = 0;
    m->count = 0;
    m->rod = cable->rod != NULL;
    for (size_t i = choice->first_piece; i < choice->last_piece; i++)
        all += travel(cable->pieces + i);
    for (size_t i = choice->first_piece; i < choice->last_piece; i++) {
        const cable_piece *piece = cable->pieces + i;
        const double share = all > 0 ? travel(piece) / all : 1;
        const span s = {piece, i, choice->modes * share, 0, choice->more};
        divide(&s, m);
    }
}
