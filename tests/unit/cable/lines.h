/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines for tests of the cable that hangs, and a second method for what follows from them: the
 * balance r' = (1/|F| + 1/EA) F integrated by Gauss' rule, from the force at end 1. */
#ifndef TESTS_CABLE_LINES_H
#define TESTS_CABLE_LINES_H

#include <strum/cable.h>
#include <string.h>

#include "check.h"

#define COUNT(list) ((int)(sizeof(list) / sizeof *(list)))
#define PARTS_MAX   6
#define LOADS_MAX   4

typedef struct {
    double length, weight, axial_stiffness;
} part;
typedef struct {
    double position, weight, force_x, force_z;
} load;

/* A line and room for what its parameters point at. */
typedef struct {
    strum_cable_params params;
    strum_cable_section sections[PARTS_MAX];
    strum_cable_attachment attachments[2 * LOADS_MAX];
} line;

/* In place: its parameters point into it. */
static inline void make_line(line *l, double span, double rise, int part_count,
                             const part *parts, int load_count, const load *loads)
{
    memset(l, 0, sizeof *l);
    l->params = (strum_cable_params)STRUM_CABLE_PARAMS_INIT;
    l->params.span = span;
    l->params.rise = rise;
    l->params.sections = l->sections;
    l->params.section_count = (size_t)part_count;
    l->params.attachments = l->attachments;
    for (int i = 0; i < part_count; i++) {
        l->sections[i] = (strum_cable_section)STRUM_CABLE_SECTION_INIT;
        l->sections[i].length = parts[i].length;
        l->sections[i].weight = parts[i].weight;
        l->sections[i].mass = fabs(parts[i].weight) / 9.80665;
        l->sections[i].axial_stiffness = parts[i].axial_stiffness;
    }
    for (int i = 0; i < load_count; i++) {
        l->attachments[l->params.attachment_count++] =
            (strum_cable_attachment){.kind = STRUM_CABLE_POINT_MASS,
                                     .position = loads[i].position,
                                     .weight = loads[i].weight};
        if (loads[i].force_x != 0 || loads[i].force_z != 0)
            l->attachments[l->params.attachment_count++] =
                (strum_cable_attachment){.kind = STRUM_CABLE_FORCE,
                                         .position = loads[i].position,
                                         .force_x = loads[i].force_x,
                                         .force_z = loads[i].force_z};
    }
}

static inline strum_hanging *hang(const line *l)
{
    strum_hanging *cable = NULL;
    strum_error error = {0};
    if (strum_cable_hang(&l->params, NULL, &cable, &error) != STRUM_OK)
        fail_msg("status %d: %s", error.status, error.reason);
    return cable;
}

static inline strum_cable_statics statics_of(const strum_hanging *cable)
{
    strum_cable_statics s;
    strum_cable_statics_get(cable, &s);
    return s;
}

#endif
