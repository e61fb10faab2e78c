/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is asked of a cable that hangs. */
#include <math.h>

#include "core/cable/form.h"
#include "core/cable/rod.h"

void strum_cable_statics_get(const strum_hanging *cable, strum_cable_statics *statics)
{
    *statics = cable->statics;
}

strum_status strum_cable_contact_get(const strum_hanging *cable, size_t i,
                                     strum_cable_contact *contact)
{
    if (i >= cable->statics.contacts)
        return STRUM_ERR_RANGE;
    *contact = cable->contacts[i];
    return STRUM_OK;
}

strum_status strum_cable_section_get(const strum_hanging *cable, size_t i,
                                     strum_cable_section *section)
{
    if (i >= cable->params.section_count)
        return STRUM_ERR_RANGE;
    *section = cable->sections[i];
    return STRUM_OK;
}

/* The last piece that begins at or before a place. */
static const cable_piece *piece_at(const strum_hanging *cable, double position)
{
    size_t low = 0, high = cable->piece_count;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (cable->pieces[middle].start <= position)
            low = middle;
        else
            high = middle;
    }
    return cable->pieces + low;
}

/* Angle and tension of a piece at one of its ends. */
static void side_of(const strum_hanging *cable, size_t piece, double s, double *angle,
                    double *tension)
{
    if (rod_bends(cable, piece)) {
        const rod_point at = rod_at(cable, piece, s, false);
        *angle = at.angle;
        *tension = at.normal;
        return;
    }
    const form_state at = form_at(cable->pieces + piece, s);
    *angle = form_angle(cable->pieces + piece, s);
    *tension = hypot(at.h, at.v);
}

strum_status strum_cable_attachment_get(const strum_hanging *cable, size_t i,
                                        strum_cable_joint *joint)
{
    if (i >= cable->params.attachment_count)
        return STRUM_ERR_RANGE;
    const size_t place = cable->order[i];
    /* among the stations by their attachments */
    size_t k = 0;
    while (k < cable->piece_count &&
           !(place >= cable->stations[k].first &&
             place < cable->stations[k].first + cable->stations[k].count))
        k++;
    if (k == 0 || k == cable->piece_count)
        return STRUM_ERR_INTERNAL;
    const cable_piece *left = cable->pieces + k - 1;
    double from, to, tension_left, tension_right;
    side_of(cable, k - 1, left->length, &from, &tension_left);
    side_of(cable, k, 0, &to, &tension_right);
    *joint = (strum_cable_joint){
        .position = cable->stations[k].position,
        .x = cable->stations[k].x,
        .z = cable->stations[k].z,
        .tension_left = tension_left,
        .tension_right = tension_right,
        .kink = fabs(remainder(to - from, 2 * M_PI)),
    };
    return STRUM_OK;
}

static strum_cable_point point_at(const strum_hanging *cable, double position)
{
    const cable_piece *piece = piece_at(cable, position);
    const double s = fmin(position - piece->start, piece->length);
    const size_t index = (size_t)(piece - cable->pieces);
    if (rod_bends(cable, index)) {
        const rod_point at = rod_at(cable, index, s, true);
        return (strum_cable_point){position, at.x, at.z, at.normal, at.angle};
    }
    const form_state at = form_at(piece, s);
    return (strum_cable_point){position, at.x, at.z, hypot(at.h, at.v), form_angle(piece, s)};
}

strum_status strum_cable_shape(const strum_hanging *cable, const double *positions, size_t n,
                               strum_cable_point *points)
{
    const double length = cable->statics.unstretched_length;
    if (positions == NULL && n < 2)
        return STRUM_ERR_RANGE;
    for (size_t i = 0; i < n; i++) {
        const double position = positions != NULL ? positions[i]
                                : i + 1 == n      ? length
                                                  : length * (double)i / (double)(n - 1);
        if (!(position >= 0 && position <= length))
            return STRUM_ERR_RANGE;
        points[i] = point_at(cable, position);
    }
    return STRUM_OK;
}
