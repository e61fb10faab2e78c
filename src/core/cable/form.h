/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The form that a line takes: its arcs as they hang or lie, cut at the edges of contacts, and what
 * can be measured on them.
 */
#ifndef CORE_CABLE_FORM_H
#define CORE_CABLE_FORM_H

#include "core/cable/cable.h"
#include "core/cable/line.h"

typedef struct {
    cable_piece *pieces;
    size_t *origin; /* of the line's piece that each is, or is part of */
    size_t count;
    strum_cable_contact *contacts;
    size_t contact_count;
    double h, v, x, z; /* force and place at end 2, by summation from end 1 */
    double reaction;   /* smallest of the bed; NAN where nothing lies */
    bool slack;
} cable_form;

/* Of the given force at end 1, nothing lying. */
void form_hang(const cable_line *line, const strum_cable_section *sections, double h, double v,
               cable_form *form);

/* ---- one piece ---- */

typedef struct {
    double x, z, h, v;
} form_state;

/* At `s` from the start of a piece. */
form_state form_at(const cable_piece *piece, double s);
cable_arc form_arc(const cable_piece *piece);
/* Stretched length of its first `s`. */
double form_stretched(const cable_piece *piece, double s);
/* Of the tangent at `s`, from x. */
double form_angle(const cable_piece *piece, double s);
/* The force just before station `i` (1 .. count). */
void form_force_before(const cable_form *form, size_t i, double *h, double *v);

/* ---- the whole ---- */

/* All figures but those that only the solver knows. */
void form_measure(const cable_form *form, double span, double rise, strum_cable_statics *s);
/* What `given` asks for; NAN where the form has none. `section`: of the catenary parameter. */
double form_given(const cable_form *form, strum_cable_given given, double span, double rise,
                  const strum_cable_section *section);

#endif
