/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/field.h"

#include <math.h>
#include <string.h>

#include "core/numerics/legendre.h"

/* ---- displacements ---- */

/* Legendre coefficients of what has these values at the points, times `factor`, added. */
static void coefficients(const motion_rule *r, const double *values, double _Complex factor,
                         double _Complex *to)
{
    double weighted[POINTS_MAX];
    const size_t n = (size_t)r->points;
    for (size_t q = 0; q < n; q++)
        weighted[q] = r->w[q] * values[q];
    for (size_t k = 0; k < n; k++)
        to[k] += factor * motion_dot(n, r->strain + k * n, weighted);
}

static void add_part(field *f, const double *v, double _Complex factor, double *room)
{
    const motion *m = &f->spectrum->motion;
    const size_t all = (size_t)(m->components * m->points);
    double *u = room, *nodes = room + all, x[POINTS_MAX], z[POINTS_MAX];
    motion_displace(m, v, u, nodes);
    for (size_t i = 0; i < all; i++)
        f->u[i] += factor * u[i];
    for (int i = 0; i < 2 * (m->element_count + 1); i++)
        f->node_u[i] += factor * nodes[i];
    for (int i = 0; i < m->element_count; i++) {
        const motion_element *e = m->elements + i;
        motion_slopes(m, e, v, x, z);
        coefficients(e->rule, x, factor, f->slope + e->point);
        if (m->components == 2)
            coefficients(e->rule, z, factor, f->slope + m->points + e->point);
    }
}

static void find_largest(field *f)
{
    const motion *m = &f->spectrum->motion;
    for (int i = 0; i < m->components * m->points; i++)
        if (cabs(f->u[i]) > cabs(f->largest))
            f->largest = f->u[i];
    for (int i = 0; i < 2 * (m->element_count + 1); i++)
        if (cabs(f->node_u[i]) > cabs(f->largest))
            f->largest = f->node_u[i];
}

/* ---- forces ---- */

/* Of inertia and drag: -(lambda^2 m + lambda c) u, along n and t. */
static void inertia(field *f)
{
    const motion *m = &f->spectrum->motion;
    const double _Complex lambda = f->mode->lambda;
    const int n = m->points;
    for (int i = 0; i < n; i++) {
        double _Complex across = lambda * lambda * m->mass_normal[i];
        double _Complex along = lambda * lambda * m->mass_tangential[i];
        if (m->drag_normal != NULL) {
            across += lambda * m->drag_normal[i];
            along += lambda * m->drag_tangential[i];
        }
        if (m->components == 1) {
            f->force[i] = -across * f->u[i];
            continue;
        }
        const double nx = m->normal_x[i], nz = m->normal_z[i];
        across *= nx * f->u[i] + nz * f->u[n + i];
        along *= nz * f->u[i] - nx * f->u[n + i];
        f->force[i] = -(across * nx + along * nz);
        f->force[n + i] = -(across * nz - along * nx);
    }
}

/* Z(lambda) of a damper, or of an absorber along its line:
 * m lambda^2 (k + c lambda)/(m lambda^2 + k + c lambda). */
double _Complex field_impedance(const motion_link *link, double _Complex lambda)
{
    const double _Complex pull = link->stiffness + link->damping * lambda;
    if (!(link->mass > 0))
        return pull;
    const double _Complex carried = link->mass * lambda * lambda;
    return carried * pull / (carried + pull);
}

static void attached(field *f)
{
    const motion *m = &f->spectrum->motion;
    const double _Complex lambda = f->mode->lambda;
    for (int i = 0; i < m->body_count; i++) {
        const motion_body *b = m->bodies + i;
        const double _Complex *u = f->node_u + 2 * b->node;
        double _Complex *to = f->node_force + 2 * b->node;
        to[0] -= lambda * lambda * (b->mass[0] * u[0] + b->mass[1] * u[1]);
        to[1] -= lambda * lambda * (b->mass[1] * u[0] + b->mass[2] * u[1]);
    }
    for (int i = 0; i < m->link_count; i++) {
        const motion_link *link = m->links + i;
        const double _Complex *u = f->node_u + 2 * link->node;
        const double _Complex pull =
            field_impedance(link, lambda) * (link->x * u[0] + link->z * u[1]);
        f->node_force[2 * link->node] -= pull * link->x;
        f->node_force[2 * link->node + 1] -= pull * link->z;
    }
}

/* What turns with the cable, and structural loss: loads of the unknowns alone. */
static void add_inner(const field *f, const double *re, const double *im, double *load_re,
                      double *load_im, double *room)
{
    const motion *m = &f->spectrum->motion;
    const double _Complex square = f->mode->lambda * f->mode->lambda;
    for (int i = 0; i < m->body_count; i++) {
        const motion_body *b = m->bodies + i;
        if (!(b->inertia > 0) || b->turning[0] < 0)
            continue;
        const int k = b->turning[0];
        const double _Complex turned = re[k] + I * (im != NULL ? im[k] : 0);
        load_re[k] -= creal(square * turned) * b->inertia;
        load_im[k] -= cimag(square * turned) * b->inertia;
    }
    if (im == NULL || !(m->loss_axial_max > 0 || m->loss_bending_max > 0))
        return;
    stiffness_loss(m, re, room);
    motion_add((size_t)m->columns, -1, room, load_im);
    stiffness_loss(m, im, room);
    motion_add((size_t)m->columns, 1, room, load_re);
}

/* Forces of what holds the cable and of springs: stiffness.h's nu, with the sign of the cable. */
static void supports(field *f, double *room)
{
    const spectrum *s = f->spectrum;
    const motion *m = &s->motion;
    const size_t n = (size_t)m->columns, all = (size_t)(m->components * m->points);
    const size_t nodes = 2 * (size_t)(m->element_count + 1);
    double *load[2] = {room, room + n}, *x = room + 2 * n, *z = x + n;
    double *points = z + n, *at_nodes = points + all;
    stiffness local = s->stiffness;
    local.nu = at_nodes + nodes;
    for (int part = 0; part < 2; part++) {
        for (size_t i = 0; i < all; i++)
            points[i] = part == 0 ? creal(f->force[i]) : cimag(f->force[i]);
        for (size_t i = 0; i < nodes; i++)
            at_nodes[i] = part == 0 ? creal(f->node_force[i]) : cimag(f->node_force[i]);
        motion_load(m, points, at_nodes, load[part]);
    }
    add_inner(f, f->mode->re, f->mode->im, load[0], load[1], x);
    for (int part = 0; part < (f->mode->im != NULL ? 2 : 1); part++) {
        stiffness_solve(&local, load[part], x, z);
        for (int i = 0; i < m->row_count; i++) {
            const motion_row *row = m->rows + i;
            const double _Complex held = local.nu[i] * (part == 0 ? 1 : I);
            f->node_force[2 * row->node] -= held * row->x;
            f->node_force[2 * row->node + 1] -= held * row->z;
        }
    }
}

static void accumulate(field *f)
{
    const motion *m = &f->spectrum->motion;
    double _Complex sum[2] = {0, 0};
    double values[2][POINTS_MAX];
    for (int i = m->element_count - 1; i >= 0; i--) {
        const motion_element *e = m->elements + i;
        for (int c = 0; c < m->components; c++) {
            double _Complex *force = f->force + c * m->points + e->point;
            sum[c] += f->node_force[2 * i + 2 + c];
            f->behind[2 * i + c] = sum[c];
            for (int q = 0; q < e->rule->points; q++) {
                sum[c] += force[q];
                values[0][q] = creal(force[q]) / e->rule->w[q];
                values[1][q] = cimag(force[q]) / e->rule->w[q];
            }
            double _Complex *density = f->density + c * m->points + e->point;
            coefficients(e->rule, values[0], 1, density);
            coefficients(e->rule, values[1], I, density);
        }
    }
    f->end[0] = sum[0];
    f->end[1] = sum[1];
}

strum_status field_make(const spectrum *s, const spectrum_mode *mode, arena *memory, field *f)
{
    const motion *m = &s->motion;
    const size_t all = (size_t)(m->components * m->points), n = (size_t)m->columns;
    const size_t nodes = 2 * (size_t)(m->element_count + 1);
    *f = (field){.spectrum = s, .mode = mode};
    double _Complex *table = arena_alloc(memory, 4 * all + 3 * nodes, sizeof *table);
    double *room =
        arena_room(memory, motion_room(m) + 4 * n + all + nodes + (size_t)m->row_count);
    if (table == NULL || room == NULL)
        return STRUM_ERR_MEMORY;
    f->u = table;
    f->slope = f->u + all;
    f->force = f->slope + all;
    f->density = f->force + all;
    f->node_u = f->density + all;
    f->node_force = f->node_u + nodes;
    f->behind = f->node_force + nodes;
    add_part(f, mode->re, 1, room);
    if (mode->im != NULL)
        add_part(f, mode->im, I, room);
    find_largest(f);
    inertia(f);
    attached(f);
    supports(f, room);
    accumulate(f);
    return STRUM_OK;
}

/* ---- anywhere ---- */

static const motion_element *element_at(const motion *m, double position)
{
    int low = 0, high = m->element_count - 1;
    while (low < high) {
        const int middle = (low + high + 1) / 2;
        if (m->elements[middle].from <= position)
            low = middle;
        else
            high = middle - 1;
    }
    const motion_element *e = m->elements + low;
    return position >= e->from && position <= e->from + 2 * e->half * (1 + 1e-12) ? e : NULL;
}

static double _Complex unknown(const spectrum_mode *mode, int column)
{
    if (column < 0)
        return 0;
    return mode->im != NULL ? CMPLX(mode->re[column], mode->im[column]) : mode->re[column];
}

static void turn(const field *f, const motion_element *e, double x, const double *p,
                 const double *q, field_point *point)
{
    if (e->rotations == 0)
        return;
    const double _Complex left = unknown(f->mode, e->left), right = unknown(f->mode, e->right);
    point->rotation = left * (1 - x) / 2 + right * (1 + x) / 2;
    point->bend = (right - left) / 2;
    for (int k = 2; k < e->rotations; k++) {
        const double _Complex a = unknown(f->mode, motion_column(e, k));
        point->rotation += a * q[k - 1];
        point->bend += a * p[k - 1];
    }
    point->bend /= e->half;
}

field_point field_at(const field *f, double position)
{
    const motion *m = &f->spectrum->motion;
    field_point point = {.element = element_at(m, position)};
    const motion_element *e = point.element;
    if (e == NULL)
        return point;
    const int index = (int)(e - m->elements), n = e->rule->points;
    const double x = fmin(fmax((position - e->from) / e->half - 1, -1), 1);
    double p[POINTS_MAX], q[POINTS_MAX];
    legendre_at(x, n, p, q);
    turn(f, e, x, p, q, &point);
    q[0] = (x + 1) * sqrt(0.5);
    for (int c = 0; c < m->components; c++) {
        const double _Complex *slope = f->slope + c * m->points + e->point;
        const double _Complex *density = f->density + c * m->points + e->point;
        double _Complex moved = 0, passed = 0, all = 0;
        for (int k = 0; k < n; k++) {
            moved += slope[k] * q[k];
            passed += density[k] * q[k];
        }
        all = density[0] * sqrt(2); /* over the whole element */
        point.u[c] = f->node_u[2 * index + c] + e->half * moved;
        point.force[c] = f->behind[2 * index + c] + all - passed;
    }
    return point;
}
