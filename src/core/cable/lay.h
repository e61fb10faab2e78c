/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The form of a line whose contacts are known: arcs between them, lying parts with their tension,
 * cut at their edges and where they become slack. */
#ifndef CORE_CABLE_LAY_H
#define CORE_CABLE_LAY_H

#include "core/cable/form.h"
#include "core/cable/touch.h"

typedef struct {
    double along;    /* of end 2 from end 1, along the bed */
    double slack;    /* length that lies without tension */
    bool compressed; /* something that lies would have to push */
} lay_result;

/* `fold`: the part of its length over which slack cable extends, 1 but where more of it lies than
 * the ends leave room for. */
lay_result lay_form(const bed_frame *f, const bed_touch *touch,
                    const strum_cable_section *sections, double fold, cable_form *form);

#endif
