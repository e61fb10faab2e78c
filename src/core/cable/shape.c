/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is asked of a cable that hangs. */
#include <math.h>

#include "core/cable/form.h"

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
    const cable_piece *left = cable->pieces + k - 1, *right = cable->pieces + k;
    const form_state before = form_at(left, left->length);
    const double from = form_angle(left, left->length), to = form_angle(right, 0);
    *joint = (strum_cable_joint){
        .position = cable->stations[k].position,
        .x = cable->stations[k].x,
        .z = cable->stations[k].z,
        .tension_left = hypot(before.h, before.v),
        .tension_right = hypot(right->h, right->v),
        .kink = fabs(remainder(to - from, 2 * M_PI)),
    };
    return STRUM_OK;
}

static strum_cable_point point_at(const strum_hanging *cable, double position)
{
    const cable_piece *piece = piece_at(cable, position);
    const double s = fmin(position - piece->start, piece->length);
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
