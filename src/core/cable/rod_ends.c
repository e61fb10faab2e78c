/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/rod_ends.h"

#include <float.h>
#include <math.h>

#include "core/cable/unknown.h"

#define STEPS_MAX 30

static double figure_of(const strum_hanging *cable)
{
    const strum_cable_statics *f = &cable->statics;
    const strum_cable_params *p = &cable->params;
    switch (p->given) {
    case STRUM_CABLE_LENGTHS:
        break;
    case STRUM_CABLE_HORIZONTAL_TENSION:
        return f->horizontal_end_1;
    case STRUM_CABLE_TENSION_END_1:
        return f->tension_end_1;
    case STRUM_CABLE_TENSION_END_2:
        return f->tension_end_2;
    case STRUM_CABLE_TENSION_PARALLEL_TO_CHORD:
        return f->tension_parallel_to_chord;
    case STRUM_CABLE_CATENARY_PARAMETER:
        return f->horizontal_end_1 / fabs(p->sections[p->adjusted].weight);
    case STRUM_CABLE_SAG_MID:
        return f->sag_mid;
    case STRUM_CABLE_SAG_MAX:
        return f->sag_max;
    case STRUM_CABLE_DEPTH_BELOW_END_1:
        return -f->lowest.z;
    case STRUM_CABLE_STRETCHED_LENGTH:
        return f->length;
    case STRUM_CABLE_ANGLE_END_1:
        return f->angle_end_1;
    case STRUM_CABLE_ANGLE_END_2:
        return f->angle_end_2;
    }
    return NAN;
}

/* Solutions and the other length are those of the cable without bending stiffness: kept. */
static strum_status figure_at(cable_settler *s, double unknown, double *figure,
                              strum_error *error)
{
    unknown_set(s, unknown);
    strum_status status = settle(s, error);
    if (status == STRUM_OK)
        status = settle_keep(s, error);
    if (status == STRUM_OK)
        *figure = figure_of(s->cable);
    return status;
}

strum_status rod_ends_find(cable_settler *s, strum_error *error)
{
    const strum_cable_given given = s->cable->params.given;
    const bool angle = given == STRUM_CABLE_ANGLE_END_1 || given == STRUM_CABLE_ANGLE_END_2;
    const double value = s->cable->params.value, begin = unknown_now(s);
    const double scale = angle ? 1 : fabs(value);
    double last = begin * (1 + 1e-6), now = begin, f_last, f_now;
    /* without bending stiffness the figure is met: its slope there says where to go */
    unknown_set(s, last);
    strum_status status = settle(s, error);
    if (status != STRUM_OK)
        return status;
    f_last = unknown_figure(s);
    const double slope = (f_last - value) / (last - begin);
    status = figure_at(s, now, &f_now, error);
    for (int i = 0; i < STEPS_MAX && status == STRUM_OK; i++) {
        if (fabs(f_now - value) <= 1e-13 * scale || !isfinite(f_now))
            break;
        const double by = i == 0 ? (value - f_now) / slope
                                 : (value - f_now) * (now - last) / (f_now - f_last);
        const double cut = 0.05 * fabs(now);
        last = now;
        f_last = f_now;
        now += fmin(fmax(by, -cut), cut);
        if (!isfinite(now) || fabs(now - last) <= 2 * DBL_EPSILON * fabs(now))
            break;
        status = figure_at(s, now, &f_now, error);
    }
    if (status != STRUM_OK)
        return status;
    if (!(fabs(f_now - value) <= 1e-6 * scale))
        return error_at(
            error, STRUM_ERR_IMPOSSIBLE, STRUM_CABLE_ARG_VALUE, STRUM_NO_INDEX,
            "with bending stiffness the shape does not reach this: the nearest found "
            "is %.12g",
            f_now);
    return STRUM_OK;
}
