/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From a cable in its static shape to the operator of its small motion. */
#include <math.h>
#include <string.h>

#include "core/cable/mesh.h"
#include "core/cable/motion.h"
#include "core/cable/rod.h"
#include "core/cable/rule.h"
#include "core/cable/spans.h"

/* ---- elements ---- */

/* Whether the rotation is continuous there and resists: what lies turns sideways only. */
static bool bends(const motion *m, size_t piece)
{
    const cable_piece *p = m->cable->pieces + piece;
    return p->section->bending_stiffness > 0 && (!p->lies || m->plane == STRUM_OUT_OF_PLANE);
}

/* What has no tension stays where it lies. */
static bool turns(const motion *m, size_t piece)
{
    const cable_piece *p = m->cable->pieces + piece;
    if (!p->lies)
        return true;
    return m->plane == STRUM_OUT_OF_PLANE &&
           (mesh_tension(p, 0) > 0 || mesh_tension(p, p->length) > 0);
}

/* The end of the cable at which the motion begins (0) or ends (1); NULL: at the bed, pinned. */
static const strum_cable_end *end_of(const motion *m, int which)
{
    const strum_cable_params *p = &m->cable->params;
    if (which == 0)
        return m->first_piece == 0 ? &p->end_1 : NULL;
    return m->last_piece == m->cable->piece_count ? &p->end_2 : NULL;
}

static bool clamped(const motion *m, int which)
{
    const strum_cable_end *end = end_of(m, which);
    return end != NULL && end->rotation == STRUM_CABLE_CLAMPED;
}

static void number_columns(motion *m)
{
    int next = 0;
    for (int i = 0; i < m->element_count; i++) {
        motion_element *e = m->elements + i;
        const bool first = i == 0, last = i + 1 == m->element_count;
        const bool stiff = bends(m, e->piece);
        e->left = e->right = e->inner = -1;
        if (e->rotations == 0)
            continue;
        if (!first && stiff && e[-1].rotations > 0 && bends(m, e[-1].piece))
            e->left = e[-1].right;
        else if (!(first && stiff && clamped(m, 0)))
            e->left = next++;
        e->inner = next;
        next += e->rotations - 2;
        if (!(last && stiff && clamped(m, 1)))
            e->right = next++;
    }
    m->rotation_columns = next;
    for (int i = 0; i < m->element_count; i++) {
        m->elements[i].strain = next;
        next += m->elements[i].strains;
    }
    m->columns = next;
}

static void end_springs(motion *m)
{
    for (int i = 0; i < 2; i++) {
        const strum_cable_end *end = end_of(m, i);
        m->end_springs[i] =
            end != NULL && end->rotation == STRUM_CABLE_SPRUNG ? end->stiffness : 0;
    }
}

static strum_status make_elements(const motion_choice *choice, motion *m)
{
    mesh cells = {NULL, 0, false};
    rule_set rules = {.count = 0};
    mesh_make(m->cable, choice, &cells);
    cells.cells = arena_alloc(m->memory, (size_t)cells.count, sizeof *cells.cells);
    m->elements = arena_alloc(m->memory, (size_t)cells.count, sizeof *m->elements);
    if (cells.cells == NULL || m->elements == NULL)
        return STRUM_ERR_MEMORY;
    mesh_make(m->cable, choice, &cells);
    m->element_count = cells.count;
    for (int i = 0; i < cells.count; i++) {
        const mesh_cell *c = cells.cells + i;
        const strum_cable_section *section = m->cable->pieces[c->piece].section;
        motion_element *e = m->elements + i;
        e->rule = rule_for(c->degree, &rules, m->memory);
        if (e->rule == NULL)
            return STRUM_ERR_MEMORY;
        e->piece = c->piece;
        e->from = c->from;
        e->half = (c->to - c->from) / 2;
        e->rotations = turns(m, c->piece) ? c->degree + 1 : 0;
        e->strains =
            m->components == 2 && !isinf(section->axial_stiffness) ? c->strain_degree : 0;
        e->strain_scale = 1 / sqrt(e->half * section->axial_stiffness);
        e->bending = bends(m, c->piece) ? section->bending_stiffness : 0;
        e->point = m->points;
        m->points += e->rule->points;
    }
    number_columns(m);
    end_springs(m);
    return m->columns > 0 ? STRUM_OK : STRUM_ERR_IMPOSSIBLE;
}

/* ---- the static state at the points ---- */

motion_state motion_state_at(const strum_hanging *cable, size_t piece, double s)
{
    const cable_piece *p = cable->pieces + piece;
    if (rod_bends(cable, piece)) {
        const rod_point at = rod_at(cable, piece, s, false);
        return (motion_state){at.normal, at.shear, cos(at.angle), sin(at.angle), at.turn};
    }
    const double tension = mesh_tension(p, s);
    if (p->lies)
        return (motion_state){tension, 0, p->bed_x, p->bed_z, 0};
    return (motion_state){tension, 0, p->h / tension, (p->v + p->section->weight * s) / tension,
                          0};
}

static void fill_point(motion *m, const motion_element *e, int q)
{
    const cable_piece *piece = m->cable->pieces + e->piece;
    const strum_cable_section *section = piece->section;
    const double s = e->from - piece->start + e->half * (1 + e->rule->x[q]);
    const double weight = e->rule->w[q] * e->half;
    const motion_state at = motion_state_at(m->cable, e->piece, s);
    const int i = e->point + q;
    m->normal_x[i] = -at.tangent_z;
    m->normal_z[i] = at.tangent_x;
    m->stretch[i] = 1 + at.tension / section->axial_stiffness;
    m->tension[i] = at.tension * m->stretch[i];
    if (m->components == 1)
        m->tension[i] -= e->bending * at.turn * at.turn;
    m->mass_normal[i] = weight * (section->mass + section->added_mass);
    m->mass_tangential[i] = weight * (section->mass + section->added_mass_tangential);
    if (m->shear != NULL)
        m->shear[i] = at.shear;
    if (m->drag_normal != NULL) {
        m->drag_normal[i] = weight * section->drag_normal;
        m->drag_tangential[i] = weight * section->drag_tangential;
    }
}

static bool drags(const motion *m)
{
    bool some = false;
    for (size_t i = m->first_piece; i < m->last_piece; i++) {
        const strum_cable_section *s = m->cable->pieces[i].section;
        some = some || s->drag_normal > 0 || (s->drag_tangential > 0 && m->components == 2);
    }
    return some;
}

static strum_status make_states(motion *m)
{
    const size_t n = (size_t)m->points;
    double **tables[] = {&m->normal_x,    &m->normal_z,       &m->stretch,
                         &m->tension,     &m->mass_normal,    &m->mass_tangential,
                         &m->drag_normal, &m->drag_tangential};
    const bool sheared = m->cable->rod != NULL && m->components == 2;
    const size_t count = drags(m) ? 8 : 6;
    double *room = arena_room(m->memory, 9 * n);
    if (room == NULL)
        return STRUM_ERR_MEMORY;
    for (size_t i = 0; i < count; i++)
        *tables[i] = room + i * n;
    if (sheared)
        m->shear = room + 8 * n;
    for (int i = 0; i < m->element_count; i++)
        for (int q = 0; q < m->elements[i].rule->points; q++)
            fill_point(m, m->elements + i, q);
    for (size_t i = m->first_piece; i < m->last_piece; i++) {
        const strum_cable_section *s = m->cable->pieces[i].section;
        if (m->components == 2 && !isinf(s->axial_stiffness))
            m->loss_axial_max = fmax(m->loss_axial_max, s->axial_loss);
        if (bends(m, i))
            m->loss_bending_max = fmax(m->loss_bending_max, s->bending_loss);
    }
    return STRUM_OK;
}

/* ---- what is held ---- */

static int node_of(const motion *m, size_t piece)
{
    int node = 0;
    while (node < m->element_count && m->elements[node].piece < piece)
        node++;
    return node;
}

static void hold(motion *m, int node, double x, double z)
{
    m->rows[m->row_count++] = (motion_row){node, x, z, 0, true};
    m->held_count++;
}

/* Where the cable comes down to the bed it stays in the plane of it; so it does at its other edge,
 * since what lies between does not turn. */
static void hold_at_bed(motion *m, double slope)
{
    for (size_t i = m->first_piece + 1; i < m->last_piece; i++) {
        const cable_piece *before = m->cable->pieces + i - 1, *after = m->cable->pieces + i;
        if (!before->lies && (after->lies || after->run != before->run))
            hold(m, node_of(m, i), -sin(slope), cos(slope));
    }
}

/* The feet of hangers do not move up or down. */
static void hold_at_hangers(motion *m)
{
    spans_hanger hanger;
    for (size_t i = m->first_piece + 1; i < m->last_piece && m->components == 2; i++)
        if (spans_hanger_at(m->cable, i, &hanger))
            hold(m, node_of(m, i), 0, 1);
}

/* In directions along and across the chord: an inextensible cable that is almost straight hardly
 * moves along it. */
static void hold_end(motion *m)
{
    const cable_station *from = m->cable->stations + m->first_piece;
    const cable_station *to = m->cable->stations + m->last_piece;
    const cable_piece *last = m->cable->pieces + m->last_piece - 1;
    double x = to->x - from->x, z = to->z - from->z;
    const double chord = hypot(x, z);
    x = chord > 0 ? x / chord : 1;
    z = chord > 0 ? z / chord : 0;
    if (m->components == 1) {
        hold(m, m->element_count, 1, 0);
    } else if (last->lies) {
        hold(m, m->element_count, last->bed_x, last->bed_z);
    } else {
        hold(m, m->element_count, -z, x);
        hold(m, m->element_count, x, z);
    }
}

/* ---- what is attached ---- */

/* The directions in the plane of motion in which an attachment acts; returns how many. */
static int directions(const motion *m, const strum_cable_attachment *a, size_t station,
                      double d[2][2])
{
    if (m->components == 1) {
        d[0][0] = 1;
        d[0][1] = 0;
        return a->direction == STRUM_CABLE_ACROSS || a->direction == STRUM_CABLE_ALL;
    }
    const double end = m->cable->pieces[station - 1].length;
    const motion_state before = motion_state_at(m->cable, station - 1, end);
    const motion_state after = motion_state_at(m->cable, station, 0);
    double x = before.tangent_x + after.tangent_x, z = before.tangent_z + after.tangent_z;
    const double size = hypot(x, z);
    x /= size;
    z /= size;
    switch (a->direction) {
    case STRUM_CABLE_NORMAL:
        d[0][0] = -z;
        d[0][1] = x;
        return 1;
    case STRUM_CABLE_TANGENTIAL:
        d[0][0] = x;
        d[0][1] = z;
        return 1;
    case STRUM_CABLE_VERTICAL:
        d[0][0] = 0;
        d[0][1] = 1;
        return 1;
    case STRUM_CABLE_HORIZONTAL:
        d[0][0] = 1;
        d[0][1] = 0;
        return 1;
    case STRUM_CABLE_ANGLE:
        d[0][0] = cos(a->angle);
        d[0][1] = sin(a->angle);
        return 1;
    case STRUM_CABLE_ALL_IN_PLANE:
    case STRUM_CABLE_ALL:
        d[0][0] = d[1][1] = 1;
        d[0][1] = d[1][0] = 0;
        return 2;
    default:
        return 0;
    }
}

static void add_body(motion *m, int node, double mass, int count, double d[2][2], bool across)
{
    /* `across`: what is not along the directions, else along them */
    double xx = across ? mass : 0, zz = xx, xz = 0;
    const double sign = across ? -mass : mass;
    for (int i = 0; i < count; i++) {
        xx += sign * d[i][0] * d[i][0];
        xz += sign * d[i][0] * d[i][1];
        zz += sign * d[i][1] * d[i][1];
    }
    if (xx != 0 || xz != 0 || zz != 0)
        m->bodies[m->body_count++] = (motion_body){node, {xx, xz, zz}, {-1, -1}, 0};
}

static void add_point_mass(motion *m, int node, const strum_cable_attachment *a)
{
    const double mass = a->mass + a->added_mass;
    motion_body body = {node, {mass, 0, mass}, {-1, -1}, 0};
    const motion_element *after = m->elements + node, *before = after - 1;
    const bool stiff_before = bends(m, before->piece), stiff_after = bends(m, after->piece);
    if (a->rotary_inertia > 0 && (stiff_before || stiff_after)) {
        body.turning[0] = stiff_before ? before->right : after->left;
        body.inertia = a->rotary_inertia;
    }
    if (mass > 0 || body.inertia > 0)
        m->bodies[m->body_count++] = body;
}

static void add_attachment(motion *m, const strum_cable_attachment *a, size_t station, int node)
{
    double d[2][2];
    const int count = directions(m, a, station, d);
    if (a->kind == STRUM_CABLE_POINT_MASS)
        add_point_mass(m, node, a);
    else if (a->kind == STRUM_CABLE_INERTER)
        add_body(m, node, a->inertance, count, d, false);
    else if (a->kind == STRUM_CABLE_ABSORBER)
        add_body(m, node, a->mass, count, d, true);
    for (int i = 0; i < count; i++) {
        const motion_link link = {node, d[i][0], d[i][1], a->stiffness, a->damping, a->mass};
        if (a->kind == STRUM_CABLE_SPRING && a->stiffness > 0)
            m->rows[m->row_count++] =
                (motion_row){node, d[i][0], d[i][1], 1 / a->stiffness, false};
        else if (a->kind == STRUM_CABLE_DAMPER && a->damping > 0)
            m->links[m->link_count++] = (motion_link){node, d[i][0], d[i][1], 0, a->damping, 0};
        else if (a->kind == STRUM_CABLE_ABSORBER && a->mass > 0 &&
                 (a->stiffness > 0 || a->damping > 0))
            m->links[m->link_count++] = link;
    }
}

static strum_status make_attachments(const motion_choice *choice, motion *m)
{
    const strum_hanging *cable = m->cable;
    size_t attached = 0;
    for (size_t i = m->first_piece + 1; i < m->last_piece; i++)
        attached += cable->stations[i].count;
    const size_t pieces = m->last_piece - m->first_piece;
    m->rows = arena_alloc(m->memory, 2 * (attached + pieces) + 3, sizeof *m->rows);
    m->bodies = arena_alloc(m->memory, attached + pieces, sizeof *m->bodies);
    m->links = arena_alloc(m->memory, 2 * attached + 1, sizeof *m->links);
    if (m->rows == NULL || m->bodies == NULL || m->links == NULL)
        return STRUM_ERR_MEMORY;
    if (m->components == 2 && choice->sliding)
        hold_at_bed(m, cable->params.bed.slope);
    hold_at_hangers(m);
    hold_end(m);
    for (size_t i = m->first_piece + 1; i < m->last_piece; i++) {
        const cable_station *station = cable->stations + i;
        const int node = node_of(m, i);
        spans_hanger hanger;
        if (spans_hanger_at(cable, i, &hanger)) {
            m->rows[m->row_count++] = (motion_row){node, 1, 0, 1 / hanger.stiffness, false};
            m->bodies[m->body_count++] = (motion_body){node, {hanger.mass, 0, 0}, {-1, -1}, 0};
        }
        for (size_t k = 0; k < station->count; k++)
            add_attachment(m, cable->attachments + station->first + k, i, node);
    }
    return STRUM_OK;
}

strum_status motion_make(const strum_hanging *cable, const motion_choice *choice, arena *memory,
                         motion *m)
{
    *m = (motion){.cable = cable,
                  .plane = choice->plane,
                  .components = choice->plane == STRUM_IN_PLANE ? 2 : 1,
                  .first_piece = choice->first_piece,
                  .last_piece = choice->last_piece,
                  .memory = memory};
    strum_status status = make_elements(choice, m);
    if (status == STRUM_OK)
        status = make_states(m);
    if (status == STRUM_OK)
        status = make_attachments(choice, m);
    return status;
}
