/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Modes of a general cable in an answer. */
#ifndef ENDPOINTS_CABLE_MOTION_H
#define ENDPOINTS_CABLE_MOTION_H

#include <strum/cable_modes.h>

#include "endpoints/cable/fields.h"

/* The modes of one plane; `sliding`: of the same cable where what lies slides, or NULL; `held`:
 * something lies on a bed and is held there. */
typedef struct motion {
    strum_cable_modes *modes, *sliding;
    bool held;
} motion;

void motion_free(motion planes[2]);
/* The members in_plane, out_of_plane, overdamped and count of an open object. */
strum_status motion_write(const motion planes[2], size_t shape_points, json_writer *json);
/* The member "verification": each plane by the core's second method, the worse of both. Where that
 * method cannot reach a cable, a warning says so instead. */
strum_status motion_verify(const motion planes[2], const strum_options *options, answer *a,
                           strum_error *error);
/* Does a link of this direction act in the plane? */
bool motion_acts(strum_cable_direction direction, strum_plane plane);
/* Of links that do not act, and of held and sliding modes that differ. */
void motion_warn(const hung_input *in, const motion planes[2], answer *a);
/* The least part that a mode's shape takes. */
double motion_bytes(size_t modes, size_t shape_points);

#endif
