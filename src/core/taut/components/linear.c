/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What both models of a cable of linearly varying tension share: its phase, its parts, and the
 * nodes and antinodes of its shapes. */
#include "core/taut/shape.h"

/* Estimated microseconds to find one node: some 60 solutions of the cable. */
#define NODE_US 1000.0

/* Phase W = w integral of sqrt(rho/T) along the cable; tension linear (Li, below A.2). */
double taut_varying_phase(const taut_component *c, double w)
{
    return 2.0 * w * sqrt(c->varying.mass) * c->length /
           (sqrt(c->varying.tension_0) + sqrt(c->varying.tension_1));
}

double taut_varying_travel_time(const taut_component *c)
{
    return taut_varying_phase(c, 1.0);
}

taut_component taut_varying_part(const taut_component *c, double x)
{
    taut_component part = *c;
    const double t0 = c->varying.tension_0, t1 = c->varying.tension_1;
    part.length = x;
    part.varying.tension_1 = t0 + (t1 - t0) * (x / c->length);
    if (part.varying.tension_1 == t0) /* too short for the tension to differ */
        taut_cable_set(&part, t0, c->varying.mass, 0.0);
    return part;
}

/* ---- nodes and antinodes ---- */

/* Zeros of the solution within the first x of a varying cable. */
static long zeros_before(const strum_taut_shape *shape, size_t i, double x)
{
    const taut_component *c = &shape->chain->components[i];
    const taut_component part = c->model->part(c, x);
    const double w = cimag(shape->at.s.v);
    taut_factor f;
    part.model->factor(&part, &shape->at, &f);
    const double n12 = creal(f.n12.v);
    const double y = creal(f.n11.v) * creal(shape->y[i]) + n12 * creal(shape->v[i]);
    const long held = part.model->zeros != NULL ? part.model->zeros(&part, w, &f) : 0;
    return held + (taut_signs_differ(creal(shape->y[i]), y) != (signbit(n12) != 0));
}

/* V is monotonous between two zeros of y, so that each loop holds one antinode at most. */
static strum_status survey_loop(strum_taut_shape *shape, size_t i, double from, double to,
                                strum_error *error)
{
    cplx y, v_from, v_to, v;
    taut_shape_inside(shape, i, from, &y, &v_from);
    taut_shape_inside(shape, i, to, &y, &v_to);
    if (!taut_signs_differ(creal(v_from), creal(v_to)))
        return STRUM_OK;
    const double x = taut_crossing(shape, i, true, from, to);
    taut_shape_inside(shape, i, x, &y, &v);
    return taut_antinode_add(shape, shape->x[i] + x, creal(y), error);
}

strum_status taut_varying_survey(strum_taut_shape *shape, size_t i, strum_error *error)
{
    const double length = shape->chain->components[i].length;
    long nodes = zeros_before(shape, i, length);
    /* the next component sees the sign at the joint: a node there is the one's or the other's
     */
    if ((nodes & 1) != taut_signs_differ(creal(shape->y[i]), creal(shape->y[i + 1])))
        nodes += zeros_before(shape, i, length * (1.0 - 1e-6)) < nodes ? -1 : 1;
    double from = 0.0;
    strum_status status = STRUM_OK;
    for (long n = 1; n <= nodes && status == STRUM_OK; n++) {
        double lo = from, hi = length;
        if (work_spend(shape->work, NODE_US) != STRUM_OK)
            return work_error(shape->work, error);
        long after = nodes;
        /* until node n is alone, and not at either end, where the sign of y is rounding */
        while ((after > n || lo == from || hi == length) && hi - lo > 1e-15 * length) {
            const double x = lo + 0.5 * (hi - lo);
            const long count = zeros_before(shape, i, x);
            if (count >= n) {
                hi = x;
                after = count;
            } else {
                lo = x;
            }
        }
        const double x = taut_crossing(shape, i, false, lo, hi);
        status = survey_loop(shape, i, from, x, error);
        if (status == STRUM_OK)
            status = taut_node_add(shape, shape->x[i] + x, error);
        from = x;
    }
    return status == STRUM_OK ? survey_loop(shape, i, from, length, error) : status;
}
