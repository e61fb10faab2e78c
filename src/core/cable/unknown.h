/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The length or span that a given figure determines: trying values, and Newton's method on it and
 * the force at end 1 together, which holds where the length alone decides nothing (a straight
 * cable that does not stretch). */
#ifndef CORE_CABLE_UNKNOWN_H
#define CORE_CABLE_UNKNOWN_H

#include "core/cable/settle.h"

/* Sets the unstretched length of the whole cable, by the adjusted section, or the span. */
void unknown_set(cable_settler *s, double value);
double unknown_now(const cable_settler *s);
/* The given figure of the form as it is. */
double unknown_figure(const cable_settler *s);
/* From the unknown and the force (h, v) at end 1 that come near. False where it fails, and then
 * everything is as it was but for the form. */
bool unknown_solve(cable_settler *s, double h, double v);

#endif
