/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/rod_element.h"

#include <math.h>
#include <string.h>

#include "core/numerics/gauss.h"
#include "core/numerics/linalg.h"

/* Sizes of which the nodes are constants. */
static int points_for(int degree)
{
    return degree <= 22 ? 32 : 64;
}

strum_status rod_rule_make(int degree, arena *memory, rod_rule *rule)
{
    double bubble[ROD_DEGREE_MAX];
    const int n = points_for(degree);
    *rule = (rod_rule){.degree = degree, .points = n};
    rule->x = arena_doubles(memory, (size_t)n * (size_t)(degree + 3));
    if (rule->x == NULL)
        return STRUM_ERR_MEMORY;
    rule->w = rule->x + n;
    rule->value = rule->w + n;
    gauss_legendre(n, rule->x, rule->w);
    for (int q = 0; q < n; q++) {
        rod_bubbles(degree, rule->x[q], bubble);
        rule->value[q] = (1 - rule->x[q]) / 2;
        rule->value[n + q] = (1 + rule->x[q]) / 2;
        for (int k = 2; k <= degree; k++)
            rule->value[k * n + q] = bubble[k - 2];
    }
    return STRUM_OK;
}

size_t rod_element_room(int degree)
{
    const size_t functions = (size_t)degree + 1, points = (size_t)points_for(degree);
    return functions * functions + functions * ROD_COLUMNS + points * (functions + 8);
}

/* At the points: what multiplies each function, with the weight of the point. */
typedef struct {
    double *angle, *stiffness, *column[ROD_COLUMNS];
} fields;

static void angles(const strum_hanging *cable, const rod_element *e, const rod_rule *rule,
                   double *angle)
{
    const cable_rod *rod = cable->rod;
    const int n = rule->points;
    for (int q = 0; q < n; q++)
        angle[q] =
            rod->angle[e->node] * rule->value[q] + rod->angle[e->node + 1] * rule->value[n + q];
    for (int k = 2; k <= e->degree; k++) {
        const double c = rod->bubble[e->first + (size_t)k - 2];
        for (int q = 0; q < n; q++)
            angle[q] += c * rule->value[k * n + q];
    }
}

/* th'' of the energy: N (1 + e) - Q^2/EA; th': -(1 + e) Q; with the force: -(1 + e) n - Q t/EA. */
static void at_points(const strum_hanging *cable, const rod_element *e, const rod_rule *rule,
                      const fields *f, rod_condensed *out)
{
    const cable_piece *piece = cable->pieces + e->piece;
    const double flexibility = 1 / piece->section->axial_stiffness;
    for (int q = 0; q < rule->points; q++) {
        const double s = e->from + e->half * (1 + rule->x[q]), weight = e->half * rule->w[q];
        const double h = piece->h, v = piece->v + piece->section->weight * s;
        const double c = cos(f->angle[q]), d = sin(f->angle[q]);
        const double normal = h * c + v * d, shear = v * c - h * d;
        const double stretch = 1 + normal * flexibility;
        f->stiffness[q] = weight * (normal * stretch - shear * shear * flexibility);
        f->column[ROD_GRADIENT][q] = -weight * stretch * shear;
        f->column[ROD_FORCE_X][q] = weight * (stretch * d - shear * c * flexibility);
        f->column[ROD_FORCE_Z][q] = -weight * (stretch * c + shear * d * flexibility);
        out->reach[0] += weight * stretch * c;
        out->reach[1] += weight * stretch * d;
        out->force[0][0] += weight * flexibility * c * c;
        out->force[0][1] += weight * flexibility * c * d;
        out->force[1][1] += weight * flexibility * d * d;
        out->tension = fmax(out->tension, hypot(h, v));
    }
}

/* The stiffness [column * count + row], and the columns. */
static void integrate(const strum_hanging *cable, const rod_element *e, const rod_rule *rule,
                      const fields *f, double *weighted, double *k, double *columns)
{
    const int n = rule->points, count = e->degree + 1;
    for (int a = 0; a < count; a++)
        for (int q = 0; q < n; q++)
            weighted[a * n + q] = rule->value[a * n + q] * f->stiffness[q];
    /* the columns follow the weighted functions */
    linalg_multiply('T', 'N', count, count + ROD_COLUMNS, n, rule->value, n, weighted, n, k,
                    count);
    /* INT EI th'^2/2: bubbles' derivatives are orthonormal */
    const double bending = cable->pieces[e->piece].section->bending_stiffness / e->half;
    const double *angle = cable->rod->angle + e->node;
    k[0] += bending / 2;
    k[1] -= bending / 2;
    k[count + 1] += bending / 2;
    columns[0] -= bending * (angle[1] - angle[0]) / 2;
    columns[1] += bending * (angle[1] - angle[0]) / 2;
    for (int a = 2; a < count; a++) {
        k[a * count + a] += bending;
        columns[a] += bending * cable->rod->bubble[e->first + (size_t)a - 2];
    }
}

/* Cholesky of the bubbles' block; false: it is not positive definite. */
static bool factor(int count, double *k)
{
    for (int j = 2; j < count; j++) {
        double *column = k + j * count;
        if (!(column[j] > 0))
            return false;
        const double root = sqrt(column[j]);
        for (int i = j; i < count; i++)
            column[i] /= root;
        for (int i = j + 1; i < count; i++)
            for (int l = i; l < count; l++)
                k[i * count + l] -= column[i] * column[l];
    }
    return true;
}

static void solve(int count, const double *k, double *x)
{
    for (int j = 2; j < count; j++) {
        x[j - 2] /= k[j * count + j];
        for (int i = j + 1; i < count; i++)
            x[i - 2] -= k[j * count + i] * x[j - 2];
    }
    for (int j = count - 1; j >= 2; j--) {
        for (int i = j + 1; i < count; i++)
            x[j - 2] -= k[j * count + i] * x[i - 2];
        x[j - 2] /= k[j * count + j];
    }
}

static double dot(int n, const double *a, const double *b)
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

static void condense(int count, const double *k, const double *columns, double *solved,
                     rod_condensed *out)
{
    const int m = count - 2;
    const double *gradient = columns + 2;
    for (int c = 0; c < 2 + ROD_COLUMNS; c++) {
        const double *from = c < 2 ? k + c * count + 2 : columns + (c - 2) * count + 2;
        memcpy(solved + c * m, from, (size_t)m * sizeof *solved);
        solve(count, k, solved + c * m);
    }
    out->hats[0][0] = k[0] - dot(m, k + 2, solved);
    out->hats[0][1] = out->hats[1][0] = k[1] - dot(m, k + 2, solved + m);
    out->hats[1][1] = k[count + 1] - dot(m, k + count + 2, solved + m);
    for (int a = 0; a < 2; a++)
        for (int c = 0; c < ROD_COLUMNS; c++)
            out->column[a][c] =
                columns[c * count + a] - dot(m, columns + c * count + 2, solved + a * m);
    for (int a = 0; a < 2; a++) {
        const double *force = columns + (ROD_FORCE_X + a) * count + 2;
        out->along[a] = dot(m, gradient, solved + (2 + ROD_FORCE_X + a) * m);
        for (int b = a; b < 2; b++)
            out->force[a][b] += dot(m, force, solved + (2 + ROD_FORCE_X + b) * m);
    }
    out->force[1][0] = out->force[0][1];
}

rod_condensed rod_condense(const strum_hanging *cable, const rod_element *e,
                           const rod_rule *rule, double *solved, double *room)
{
    const int n = rule->points, count = e->degree + 1;
    rod_condensed out = {.stable = true};
    double *k = room, *columns = k + count * count;
    double *weighted = columns + ROD_COLUMNS * count, *fields_at = weighted + n * count;
    const fields f = {.angle = fields_at + 3 * n,
                      .stiffness = fields_at + 4 * n,
                      .column = {fields_at, fields_at + n, fields_at + 2 * n}};
    angles(cable, e, rule, f.angle);
    at_points(cable, e, rule, &f, &out);
    integrate(cable, e, rule, &f, weighted, k, columns);
    if (!factor(count, k)) {
        /* compressed beyond what its bending bears: as if it were not, for a step */
        out.stable = false;
        for (int q = 0; q < n; q++)
            f.stiffness[q] = fabs(f.stiffness[q]);
        integrate(cable, e, rule, &f, weighted, k, columns);
        (void)factor(count, k);
    }
    condense(count, k, columns, solved, &out);
    return out;
}

void rod_reach(const strum_hanging *cable, const rod_element *e, const rod_rule *rule,
               double *room, double *x, double *z, double *length)
{
    const cable_piece *piece = cable->pieces + e->piece;
    angles(cable, e, rule, room);
    *x = *z = *length = 0;
    for (int q = 0; q < rule->points; q++) {
        const double s = e->from + e->half * (1 + rule->x[q]), weight = e->half * rule->w[q];
        const double c = cos(room[q]), d = sin(room[q]);
        const double normal = piece->h * c + (piece->v + piece->section->weight * s) * d;
        const double by = weight * (1 + normal / piece->section->axial_stiffness);
        *x += by * c;
        *z += by * d;
        *length += by;
    }
}
