/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/motion.h"

#include <string.h>

void motion_gather(const motion_element *e, const double *v, double *rotations, double *strains)
{
    for (int k = 0; k < e->rotations; k++) {
        const int column = motion_column(e, k);
        rotations[k] = column < 0 ? 0 : v[column];
    }
    for (int k = 0; k < e->strains; k++)
        strains[k] = v[e->strain + k] * e->strain_scale;
}

/* Rotation and strain at the points of an element. */
static void expand(const motion_element *e, const double *v, double *rotation, double *strain)
{
    const size_t n = (size_t)e->rule->points;
    double rotations[POINTS_MAX], strains[POINTS_MAX];
    motion_gather(e, v, rotations, strains);
    memset(rotation, 0, n * sizeof *rotation);
    memset(strain, 0, n * sizeof *strain);
    for (int k = 0; k < e->rotations; k++)
        motion_add(n, rotations[k], e->rule->rotation + (size_t)k * n, rotation);
    for (int k = 0; k < e->strains; k++)
        motion_add(n, strains[k], e->rule->strain + (size_t)k * n, strain);
}

/* From the slope of one component at the points: the component there, and its step over the
 * element. */
static double accumulate(const motion_element *e, const double *slope, double start, double *u)
{
    const size_t n = (size_t)e->rule->points;
    for (size_t q = 0; q < n; q++)
        u[q] = start;
    for (size_t k = 0; k < n; k++)
        motion_add(n, e->half * slope[k], e->rule->integral + k * n, u);
    return e->half * motion_dot(n, e->rule->w, slope);
}

void motion_slopes(const motion *m, const motion_element *e, const double *v, double *x,
                   double *z)
{
    double strain[POINTS_MAX];
    const size_t n = (size_t)e->rule->points, p = (size_t)e->point;
    const double *nx = m->normal_x + p, *nz = m->normal_z + p, *g = m->stretch + p;
    expand(e, v, x, strain);
    for (size_t q = 0; q < n; q++)
        x[q] *= g[q];
    if (m->components == 1)
        return;
    for (size_t q = 0; q < n; q++) {
        z[q] = x[q] * nz[q] - strain[q] * nx[q];
        x[q] = x[q] * nx[q] + strain[q] * nz[q];
    }
}

void motion_displace(const motion *m, const double *v, double *u, double *nodes)
{
    double at[2] = {0, 0}, x[POINTS_MAX], z[POINTS_MAX];
    nodes[0] = nodes[1] = 0;
    for (int i = 0; i < m->element_count; i++) {
        const motion_element *e = m->elements + i;
        motion_slopes(m, e, v, x, z);
        at[0] += accumulate(e, x, at[0], u + e->point);
        if (m->components == 2)
            at[1] += accumulate(e, z, at[1], u + m->points + e->point);
        nodes[2 * i + 2] = at[0];
        nodes[2 * i + 3] = at[1];
    }
}

/* Loads of the slope of one component, from forces within the element and the sum of those
 * behind it. */
static double gather_forces(const motion_element *e, const double *f, double behind,
                            double *slope)
{
    const size_t n = (size_t)e->rule->points;
    double sum = behind;
    for (size_t k = 0; k < n; k++)
        slope[k] = e->rule->w[k] * behind;
    for (size_t q = 0; f != NULL && q < n; q++) {
        motion_add(n, f[q], e->rule->integral_to + q * n, slope);
        sum += f[q];
    }
    for (size_t k = 0; k < n; k++)
        slope[k] *= e->half;
    return sum;
}

static void scatter(const motion_element *e, const double *rotation, const double *strain,
                    double *y)
{
    const size_t n = (size_t)e->rule->points;
    double sums[POINTS_MAX] = {0};
    const size_t rotations = (size_t)e->rotations, strains = (size_t)e->strains;
    for (size_t q = 0; q < n; q++)
        motion_add(rotations, rotation[q], e->rule->rotation_at + q * n, sums);
    for (int k = 0; k < e->rotations; k++) {
        const int column = motion_column(e, k);
        if (column >= 0)
            y[column] += sums[k];
    }
    if (strains == 0)
        return;
    memset(sums, 0, strains * sizeof *sums);
    for (size_t q = 0; q < n; q++)
        motion_add(strains, strain[q], e->rule->strain_at + q * n, sums);
    motion_add(strains, e->strain_scale, sums, y + e->strain);
}

/* f NULL: no forces at points. */
void motion_load(const motion *m, const double *f, const double *nodes, double *y)
{
    double behind[2] = {0, 0}, x[POINTS_MAX], z[POINTS_MAX], rotation[POINTS_MAX],
           strain[POINTS_MAX];
    memset(y, 0, (size_t)m->columns * sizeof *y);
    memset(strain, 0, sizeof strain);
    for (int i = m->element_count - 1; i >= 0; i--) {
        const motion_element *e = m->elements + i;
        const size_t n = (size_t)e->rule->points, p = (size_t)e->point;
        const double *nx = m->normal_x + p, *nz = m->normal_z + p, *g = m->stretch + p;
        behind[0] += nodes[2 * i + 2];
        behind[1] += nodes[2 * i + 3];
        behind[0] = gather_forces(e, f != NULL ? f + p : NULL, behind[0], x);
        if (m->components == 1) {
            for (size_t q = 0; q < n; q++)
                rotation[q] = g[q] * x[q];
        } else {
            behind[1] = gather_forces(e, f != NULL ? f + m->points + p : NULL, behind[1], z);
            for (size_t q = 0; q < n; q++) {
                rotation[q] = g[q] * (nx[q] * x[q] + nz[q] * z[q]);
                strain[q] = nz[q] * x[q] - nx[q] * z[q];
            }
        }
        scatter(e, rotation, strain, y);
    }
}

/* u becomes (normal nn' + tangential tt') u at each point. */
static void weigh(const motion *m, const double *normal, const double *tangential, double *u)
{
    const size_t n = (size_t)m->points;
    if (m->components == 1) {
        for (size_t q = 0; q < n; q++)
            u[q] *= normal[q];
        return;
    }
    for (size_t q = 0; q < n; q++) {
        const double nx = m->normal_x[q], nz = m->normal_z[q], x = u[q], z = u[n + q];
        const double across = normal[q] * (nx * x + nz * z);
        const double along = tangential[q] * (nz * x - nx * z);
        u[q] = across * nx + along * nz;
        u[n + q] = across * nz - along * nx;
    }
}

void motion_inertia(const motion *m, const double *v, double *u, double *nodes, double *turning)
{
    weigh(m, m->mass_normal, m->mass_tangential, u);
    double *force = nodes + 2 * (m->element_count + 1);
    memset(force, 0, 2 * (size_t)(m->element_count + 1) * sizeof *force);
    for (int i = 0; i < m->body_count; i++) {
        const motion_body *b = m->bodies + i;
        const double *at = nodes + 2 * b->node;
        force[2 * b->node] += b->mass[0] * at[0] + b->mass[1] * at[1];
        force[2 * b->node + 1] += b->mass[1] * at[0] + b->mass[2] * at[1];
        for (int side = 0; side < 2 && b->inertia > 0; side++)
            if (b->turning[side] >= 0)
                turning[b->turning[side]] += b->inertia * v[b->turning[side]];
    }
    memcpy(nodes, force, 2 * (size_t)(m->element_count + 1) * sizeof *force);
}

size_t motion_room(const motion *m)
{
    return (size_t)m->components * (size_t)m->points + 4 * (size_t)(m->element_count + 1) +
           (size_t)m->columns;
}

void motion_mass(const motion *m, const double *v, double *room, double *y)
{
    double *nodes = room + m->components * m->points;
    double *turning = nodes + 4 * (m->element_count + 1);
    memset(turning, 0, (size_t)m->columns * sizeof *turning);
    motion_displace(m, v, room, nodes);
    motion_inertia(m, v, room, nodes, turning);
    motion_load(m, room, nodes, y);
    motion_add((size_t)m->columns, 1, turning, y);
}

void motion_drag(const motion *m, const double *v, double *room, double *y)
{
    double *nodes = room + m->components * m->points;
    motion_displace(m, v, room, nodes);
    weigh(m, m->drag_normal, m->drag_tangential, room);
    memset(nodes, 0, 2 * (size_t)(m->element_count + 1) * sizeof *nodes);
    motion_load(m, room, nodes, y);
}

void motion_row_load(const motion *m, int node, double x, double z, double *room, double *y)
{
    double *nodes = room;
    memset(nodes, 0, 2 * (size_t)(m->element_count + 1) * sizeof *nodes);
    nodes[2 * node] = x;
    nodes[2 * node + 1] = z;
    motion_load(m, NULL, nodes, y);
}
