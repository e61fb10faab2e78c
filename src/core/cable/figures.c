/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is told of a mode: energies, symmetry, ends, shape. */
#include <math.h>

#include "core/cable/field.h"
#include "core/cable/modes.h"
#include "core/numerics/status.h"

static double square(double _Complex z)
{
    return creal(z) * creal(z) + cimag(z) * cimag(z);
}

static double _Complex unknown(const spectrum_mode *mode, int column)
{
    if (column < 0)
        return 0;
    return mode->im != NULL ? CMPLX(mode->re[column], mode->im[column]) : mode->re[column];
}

/* ---- energies ---- */

static double bending_of(const spectrum_mode *mode, const motion_element *e)
{
    if (!(e->bending > 0))
        return 0;
    double sum = square(unknown(mode, e->right) - unknown(mode, e->left)) / 2;
    for (int k = 2; k < e->rotations; k++)
        sum += square(unknown(mode, motion_column(e, k)));
    return sum * e->bending / e->half;
}

static double tension_of(const motion *m, const spectrum_mode *mode, const motion_element *e)
{
    const int n = e->rule->points;
    double sum = 0;
    for (int q = 0; q < n; q++) {
        const double weight = e->rule->w[q] * e->half;
        double _Complex turned = 0, strained = 0;
        for (int k = 0; k < e->rotations; k++)
            turned += unknown(mode, motion_column(e, k)) * e->rule->rotation[k * n + q];
        sum += weight * m->tension[e->point + q] * square(turned);
        for (int k = 0; m->shear != NULL && k < e->strains; k++)
            strained += unknown(mode, e->strain + k) * e->rule->strain[k * n + q];
        if (m->shear != NULL)
            sum -= 2 * weight * m->shear[e->point + q] * e->strain_scale *
                   (creal(turned) * creal(strained) + cimag(turned) * cimag(strained));
    }
    return sum;
}

/* Displacement of an absorber's mass: (k + c lambda)/(m lambda^2 + k + c lambda) of the cable's. */
static double _Complex carried(const motion_link *link, double _Complex lambda,
                               double _Complex moved)
{
    const double _Complex pull = link->stiffness + link->damping * lambda;
    return moved * pull / (link->mass * lambda * lambda + pull);
}

typedef struct {
    double tension, bending, axial, attachments, moving, moving_attached;
} energies;

static void attached(const field *f, energies *sum)
{
    const motion *m = &f->spectrum->motion;
    for (int i = 0; i < m->row_count; i++) {
        const motion_row *row = m->rows + i;
        const double _Complex *u = f->node_u + 2 * row->node;
        if (!row->held)
            sum->attachments += square(row->x * u[0] + row->z * u[1]) / row->compliance;
    }
    for (int i = 0; i < m->link_count; i++) {
        const motion_link *link = m->links + i;
        const double _Complex *u = f->node_u + 2 * link->node;
        const double _Complex moved = link->x * u[0] + link->z * u[1];
        if (!(link->mass > 0))
            continue;
        const double _Complex mass = carried(link, f->mode->lambda, moved);
        sum->attachments += link->stiffness * square(moved - mass);
        sum->moving_attached += link->mass * square(mass);
    }
    for (int i = 0; i < m->body_count; i++) {
        const motion_body *b = m->bodies + i;
        const double _Complex *u = f->node_u + 2 * b->node;
        sum->moving_attached +=
            b->mass[0] * square(u[0]) + b->mass[2] * square(u[1]) +
            2 * b->mass[1] * (creal(u[0]) * creal(u[1]) + cimag(u[0]) * cimag(u[1])) +
            b->inertia * square(unknown(f->mode, b->turning[0]));
    }
    const motion_element *first = m->elements, *last = first + m->element_count - 1;
    if (first->bending > 0)
        sum->attachments += m->end_springs[0] * square(unknown(f->mode, first->left));
    if (last->bending > 0)
        sum->attachments += m->end_springs[1] * square(unknown(f->mode, last->right));
}

static energies energies_of(const field *f)
{
    const motion *m = &f->spectrum->motion;
    energies sum = {0};
    for (int i = 0; i < m->element_count; i++) {
        const motion_element *e = m->elements + i;
        sum.tension += tension_of(m, f->mode, e);
        sum.bending += bending_of(f->mode, e);
        for (int k = 0; k < e->strains; k++)
            sum.axial += square(unknown(f->mode, e->strain + k));
    }
    for (int i = 0; i < m->points; i++) {
        if (m->components == 1) {
            sum.moving += m->mass_normal[i] * square(f->u[i]);
            continue;
        }
        const double nx = m->normal_x[i], nz = m->normal_z[i];
        const double _Complex x = f->u[i], z = f->u[m->points + i];
        sum.moving += m->mass_normal[i] * square(nx * x + nz * z) +
                      m->mass_tangential[i] * square(nz * x - nx * z);
    }
    attached(f, &sum);
    return sum;
}

/* ---- symmetry ---- */

/* Share of |u|^2 along the stretch that mirrors itself about its middle: across the chord the
 * same, along it the opposite. */
static double symmetric_share(const field *f)
{
    const motion *m = &f->spectrum->motion;
    const cable_station *from = m->cable->stations + m->first_piece;
    const cable_station *to = m->cable->stations + m->last_piece;
    const double chord = hypot(to->x - from->x, to->z - from->z);
    const double cx = chord > 0 ? (to->x - from->x) / chord : 1;
    const double cz = chord > 0 ? (to->z - from->z) / chord : 0;
    double same = 0, all = 0;
    for (int i = 0; i < m->element_count; i++) {
        const motion_element *e = m->elements + i;
        for (int q = 0; q < e->rule->points; q++) {
            const double at = e->from + e->half * (1 + e->rule->x[q]);
            const double weight = e->rule->w[q] * e->half;
            const field_point other = field_at(f, from->position + to->position - at);
            const double _Complex x = f->u[e->point + q];
            if (m->components == 1) {
                same += weight * square(x + other.u[0]) / 4;
                all += weight * square(x);
                continue;
            }
            const double _Complex z = f->u[m->points + e->point + q];
            const double _Complex along = cx * (x - other.u[0]) + cz * (z - other.u[1]);
            const double _Complex across = cx * (z + other.u[1]) - cz * (x + other.u[0]);
            same += weight * (square(along) + square(across)) / 4;
            all += weight * (square(x) + square(z));
        }
    }
    return same / all;
}

/* ---- ends ---- */

static double _Complex tension_at(const motion *m, const field_point *p, double position)
{
    if (p->element == NULL || m->components == 1)
        return 0;
    const cable_piece *piece = m->cable->pieces + p->element->piece;
    const motion_state at =
        motion_state_at(m->cable, p->element->piece, position - piece->start);
    return p->force[0] * at.tangent_x + p->force[1] * at.tangent_z + at.shear * p->rotation;
}

static double _Complex moment_at(const motion *m, const field_point *p)
{
    if (p->element == NULL || !(p->element->bending > 0))
        return 0;
    const strum_cable_section *section = m->cable->pieces[p->element->piece].section;
    return section->bending_stiffness * CMPLX(1, section->bending_loss) * p->bend;
}

static void ends(const field *f, strum_cable_mode *mode)
{
    const motion *m = &f->spectrum->motion;
    const double at[2] = {0, m->cable->stations[m->cable->piece_count].position};
    for (int i = 0; i < 2; i++) {
        const field_point p = field_at(f, at[i]);
        mode->end_tension[i] = tension_at(m, &p, at[i]) / f->largest;
        mode->end_moment[i] = moment_at(m, &p) / f->largest;
    }
}

strum_status strum_cable_modes_get(const strum_cable_modes *modes, size_t index,
                                   strum_cable_mode *mode)
{
    if (index >= modes->count)
        return STRUM_ERR_RANGE;
    const modes_item *item = modes->items + index;
    arena scratch = {0};
    field f;
    const strum_status status = field_make(item->stretch, item->mode, &scratch, &f);
    if (status == STRUM_OK) {
        const energies e = energies_of(&f);
        const double stiff = e.tension + e.bending + e.axial + e.attachments;
        *mode = (strum_cable_mode){.frequency = cimag(item->mode->lambda),
                                   .decay = 0 - creal(item->mode->lambda),
                                   .energy_tension = e.tension / stiff,
                                   .energy_bending = e.bending / stiff,
                                   .energy_axial = e.axial / stiff,
                                   .energy_attachments = e.attachments / stiff,
                                   .attachment_share =
                                       e.moving_attached / (e.moving + e.moving_attached),
                                   .symmetric_share = symmetric_share(&f),
                                   .run = item->run,
                                   .damped = item->stretch->damped};
        ends(&f, mode);
    }
    arena_free(&scratch);
    return status;
}

/* ---- shape ---- */

static void shape_point(const field *f, double position, strum_cable_motion_point *point)
{
    const motion *m = &f->spectrum->motion;
    const field_point p = field_at(f, position);
    const bool in_plane = m->components == 2;
    *point = (strum_cable_motion_point){.position = position,
                                        .x = in_plane ? p.u[0] / f->largest : 0,
                                        .z = in_plane ? p.u[1] / f->largest : 0,
                                        .y = in_plane ? 0 : p.u[0] / f->largest,
                                        .tension = tension_at(m, &p, position) / f->largest};
    if (p.element != NULL && p.element->bending > 0)
        point->curvature = p.bend / f->largest;
}

strum_status strum_cable_modes_shape(const strum_cable_modes *modes, size_t index,
                                     const double *positions, size_t n,
                                     strum_cable_motion_point *points)
{
    const strum_hanging *cable = modes->line;
    const double length = cable->stations[cable->piece_count].position;
    if (index >= modes->count || (positions == NULL && n < 2))
        return STRUM_ERR_RANGE;
    for (size_t i = 0; positions != NULL && i < n; i++)
        if (!(positions[i] >= 0 && positions[i] <= length))
            return STRUM_ERR_RANGE;
    arena scratch = {0};
    field f;
    const modes_item *item = modes->items + index;
    const strum_status status = field_make(item->stretch, item->mode, &scratch, &f);
    for (size_t i = 0; i < n && status == STRUM_OK; i++)
        shape_point(&f, positions != NULL ? positions[i] : length * (double)i / (double)(n - 1),
                    points + i);
    arena_free(&scratch);
    return status;
}
