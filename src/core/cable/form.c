/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/form.h"

#include <math.h>

void form_hang(const cable_line *line, const strum_cable_section *sections, double h, double v,
               cable_form *form)
{
    double x = 0, z = 0;
    form->count = line->count;
    form->contact_count = 0;
    form->reaction = NAN;
    form->slack = false;
    for (size_t i = 0; i < line->count; i++) {
        const line_piece *from = line->pieces + i;
        double dx, dz;
        line_step(from, &h, &v);
        form->origin[i] = i;
        form->pieces[i] = (cable_piece){.section = sections + from->section,
                                        .start = from->start,
                                        .length = from->arc.length,
                                        .h = h,
                                        .v = v,
                                        .x = x,
                                        .z = z};
        arc_reach(&from->arc, h, v, &dx, &dz);
        x += dx;
        z += dz;
        v += from->arc.weight * from->arc.length;
    }
    form->h = h;
    form->v = v;
    form->x = x;
    form->z = z;
}

cable_arc form_arc(const cable_piece *piece)
{
    return (cable_arc){piece->section->weight, piece->length,
                       1 / piece->section->axial_stiffness};
}

/* INT dS (1 + T/EA) of what lies, T = T0 + rate s. */
static double lying_length(const cable_piece *piece, double s)
{
    const double tension = hypot(piece->h, piece->v) + piece->rate * s / 2;
    return s + s * tension / piece->section->axial_stiffness;
}

form_state form_at(const cable_piece *piece, double s)
{
    form_state at = {piece->x, piece->z, piece->h, piece->v};
    double x, z;
    if (piece->lies) {
        const double length = lying_length(piece, s);
        at.x += length * piece->bed_x;
        at.z += length * piece->bed_z;
        at.h += piece->rate * s * piece->bed_x;
        at.v += piece->rate * s * piece->bed_z;
        return at;
    }
    const cable_arc arc = {piece->section->weight, s, 1 / piece->section->axial_stiffness};
    arc_reach(&arc, piece->h, piece->v, &x, &z);
    at.x += x;
    at.z += z;
    at.v += arc.weight * s;
    return at;
}

double form_stretched(const cable_piece *piece, double s)
{
    cable_arc arc = form_arc(piece);
    arc.length = s;
    return piece->lies ? lying_length(piece, s) : arc_stretched(&arc, piece->h, piece->v);
}

void form_force_before(const cable_form *form, size_t i, double *h, double *v)
{
    const form_state end = form_at(form->pieces + i - 1, form->pieces[i - 1].length);
    *h = end.h;
    *v = end.v;
}

double form_angle(const cable_piece *piece, double s)
{
    const form_state at = form_at(piece, s);
    if (piece->lies && at.h == 0 && at.v == 0)
        return atan2(piece->bed_z, piece->bed_x);
    return atan2(at.v, at.h);
}
