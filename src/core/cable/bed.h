/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A line on a rigid bed. Without friction the energy of a line that bears tension only, over a half
 * plane, is convex: whatever passes the inequalities is the shape, with any number of contacts.
 * Friction acts on what lies from end 1 on, against the pull of end 2:
 *     dT/dS = w (sin(slope) + friction cos(slope)),  not below T = 0,
 * and friction times the reaction at a joint that lies.
 */
#ifndef CORE_CABLE_BED_H
#define CORE_CABLE_BED_H

#include "core/cable/form.h"
#include "core/cable/touch.h"
#include "core/numerics/status.h"

/* Whether a form stays above the bed: its smallest height between the ends (normal to the bed; of
 * what hangs), INFINITY where it has no minimum there. */
double bed_clearance(const cable_form *form, const strum_cable_bed *bed);
/* Whether a free form leaves the ends that stand on the bed upwards. */
bool bed_leaves(const cable_form *form, const strum_cable_bed *bed);
/* Refuses ends below the bed. */
strum_status bed_check(const strum_cable_params *p, double span, strum_error *error);
/* The form of a line that would hang through the bed with the force (h, v) at end 1. `form` has
 * room for five pieces, and a contact, for each of the line. */
strum_status bed_settle(const cable_line *line, const strum_hanging *cable, double span,
                        double h, double v, cable_form *form, bed_contact *contacts, work *w,
                        strum_error *error);

#endif
