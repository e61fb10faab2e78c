/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Nodes and antinodes of undamped shapes, exactly. How many nodes a component holds follows
 * from the signs at its two ends (as in the mode count), so that one on a joint is met once;
 * where they are, from the phase. An antinode is a local maximum of |y|: where a cable is
 * level, or where the slope jumps towards the axis (a cusp at a mass).
 */
#include "core/taut/shape.h"

#include <float.h>
#include <stdlib.h>

static strum_status add_node(strum_taut_shape *shape, double x, strum_error *fault)
{
    if (shape->node_count == shape->node_room) {
        const size_t room = 2 * shape->node_room + 16;
        double *more = realloc(shape->nodes, room * sizeof *more);
        if (more == NULL)
            return error_set(fault, STRUM_ERR_MEMORY, "no memory for nodes");
        shape->nodes = more;
        shape->node_room = room;
    }
    shape->nodes[shape->node_count++] = x;
    return STRUM_OK;
}

static strum_status add_antinode(strum_taut_shape *shape, double x, double amplitude,
                                 strum_error *fault)
{
    if (shape->antinode_count == shape->antinode_room) {
        const size_t room = 2 * shape->antinode_room + 16;
        strum_taut_antinode *more = realloc(shape->antinodes, room * sizeof *more);
        if (more == NULL)
            return error_set(fault, STRUM_ERR_MEMORY, "no memory for antinodes");
        shape->antinodes = more;
        shape->antinode_room = room;
    }
    /* a level cable that ends there and the joint itself are one antinode */
    const size_t n = shape->antinode_count;
    if (n > 0 && x - shape->antinodes[n - 1].x <= 1e-9 * shape->chain->length)
        return STRUM_OK;
    shape->antinodes[shape->antinode_count++] = (strum_taut_antinode){x, fabs(amplitude)};
    return STRUM_OK;
}

/* Is station i a held end, or nothing but points between? */
static bool at_held_end(const strum_taut_shape *shape, size_t i)
{
    const strum_taut *chain = shape->chain;
    return (!chain->free_left && shape->x[i] == 0.0) ||
           (!chain->free_right && shape->x[i] == shape->x[chain->count]);
}

static bool differ(double a, double b)
{
    return (signbit(a) != 0) != (signbit(b) != 0);
}

/* y = a cos(kx) + b sin(kx). Where the two shots are joined, only the sign of y is common to
 * this component and the next: the number of nodes is the one of that parity which fits the
 * phase. */
static strum_status survey_cable(strum_taut_shape *shape, size_t i, strum_error *fault)
{
    const taut_component *c = &shape->chain->components[i];
    const double w = cimag(shape->at.s.v), k = w * c->cable.slowness, phase = k * c->length;
    const double a = creal(shape->y[i]), b = creal(shape->v[i]) / (w * c->cable.impedance);
    double zero = atan2(a, -b), top = atan2(b, a);
    if (signbit(a))
        zero += M_PI;
    if (top <= 0.0)
        top += M_PI;
    const bool odd = differ(a, creal(shape->y[i + 1]));
    const long nodes = odd + 2 * lround(((phase - zero) / M_PI + 0.5 - odd) / 2.0);
    strum_status status = STRUM_OK;
    for (long n = 0; n < nodes && status == STRUM_OK; n++)
        status = add_node(shape, shape->x[i] + fmin(zero + (double)n * M_PI, phase) / k, fault);
    for (; top < phase && status == STRUM_OK; top += M_PI)
        status = add_antinode(shape, shape->x[i] + top / k, hypot(a, b), fault);
    return status;
}

/* Zeros of the solution within the first x of a varying cable. */
static long zeros_before(const strum_taut_shape *shape, size_t i, double x)
{
    const taut_component part = taut_component_part(&shape->chain->components[i], x);
    const double w = cimag(shape->at.s.v);
    taut_factor f;
    taut_component_factor(&part, &shape->at, &f);
    const double n12 = creal(f.n12.v);
    const double y = creal(f.n11.v) * creal(shape->y[i]) + n12 * creal(shape->v[i]);
    const long held = part.kind == TAUT_WKB ? taut_half_waves(taut_wkb_phase(&part, w), n12)
                                            : taut_varying_zeros(&part, w);
    return held + (differ(creal(shape->y[i]), y) != (signbit(n12) != 0));
}

/* Where y or V changes sign between two distances into component i (Illinois' rule). */
static double crossing(const strum_taut_shape *shape, size_t i, bool force, double lo,
                       double hi)
{
    cplx y, v;
    taut_shape_inside(shape, i, lo, &y, &v);
    double f_lo = creal(force ? v : y);
    taut_shape_inside(shape, i, hi, &y, &v);
    double f_hi = creal(force ? v : y);
    int side = 0;
    for (int n = 0; n < 200 && hi - lo > 1e-15 * hi && f_lo != f_hi; n++) {
        double x = hi - f_hi * (hi - lo) / (f_hi - f_lo);
        if (!(x > lo && x < hi))
            x = lo + 0.5 * (hi - lo);
        taut_shape_inside(shape, i, x, &y, &v);
        const double f = creal(force ? v : y);
        if (f == 0.0)
            return x;
        if (differ(f, f_lo)) {
            hi = x;
            f_hi = f;
            f_lo *= side == 1 ? 0.5 : 1.0;
            side = 1;
        } else {
            lo = x;
            f_lo = f;
            f_hi *= side == 2 ? 0.5 : 1.0;
            side = 2;
        }
    }
    return lo + 0.5 * (hi - lo);
}

/* V is monotonous between two zeros of y, so that each loop holds one antinode at most. */
static strum_status survey_loop(strum_taut_shape *shape, size_t i, double from, double to,
                                strum_error *fault)
{
    cplx y, v_from, v_to, v;
    taut_shape_inside(shape, i, from, &y, &v_from);
    taut_shape_inside(shape, i, to, &y, &v_to);
    if (!differ(creal(v_from), creal(v_to)))
        return STRUM_OK;
    const double x = crossing(shape, i, true, from, to);
    taut_shape_inside(shape, i, x, &y, &v);
    return add_antinode(shape, shape->x[i] + x, creal(y), fault);
}

static strum_status survey_varying(strum_taut_shape *shape, size_t i, strum_error *fault)
{
    const double length = shape->chain->components[i].length;
    long nodes = zeros_before(shape, i, length);
    /* the next component sees the sign at the joint: a node there is the one's or the other's
     */
    if ((nodes & 1) != differ(creal(shape->y[i]), creal(shape->y[i + 1])))
        nodes += zeros_before(shape, i, length * (1.0 - 1e-6)) < nodes ? -1 : 1;
    double from = 0.0;
    strum_status status = STRUM_OK;
    for (long n = 1; n <= nodes && status == STRUM_OK; n++) {
        double lo = from, hi = length;
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
        const double x = crossing(shape, i, false, lo, hi);
        status = survey_loop(shape, i, from, x, fault);
        if (status == STRUM_OK)
            status = add_node(shape, shape->x[i] + x, fault);
        from = x;
    }
    return status == STRUM_OK ? survey_loop(shape, i, from, length, fault) : status;
}

/* Straight pieces: a body's links, or a support's lever. */
static strum_status survey_straight(strum_taut_shape *shape, size_t i, double from,
                                    double y_from, double length, double y_to,
                                    strum_error *fault)
{
    if (!differ(y_from, y_to))
        return STRUM_OK;
    const double share = y_from == y_to ? 0.0 : y_from / (y_from - y_to);
    return add_node(shape, shape->x[i] + from + length * share, fault);
}

/* Slopes of component i at its left and right end, up to positive factors. */
static void slopes(const strum_taut_shape *shape, size_t i, double *left, double *right)
{
    const taut_component *c = &shape->chain->components[i];
    if (c->kind == TAUT_BODY) {
        cplx y[STRUM_TAUT_LINKS_MAX + 1];
        const cplx state[2] = {shape->y[i], shape->v[i]};
        taut_body_joints(c, &shape->at, state, y);
        *left = creal(y[1] - y[0]);
        *right = creal(y[c->body.count] - y[c->body.count - 1]);
    } else if (c->kind == TAUT_SUPPORT) {
        *left = *right = -creal(shape->y[i]);
    } else {
        *left = creal(shape->v[i]);
        *right = creal(shape->v[i + 1]);
    }
}

static strum_status survey_body(strum_taut_shape *shape, size_t i, strum_error *fault)
{
    const taut_component *c = &shape->chain->components[i];
    const cplx state[2] = {shape->y[i], shape->v[i]};
    cplx joint[STRUM_TAUT_LINKS_MAX + 1];
    taut_body_joints(c, &shape->at, state, joint);
    joint[c->body.count] = shape->y[i + 1]; /* the same sign for the next component */
    /* at a held end y has the sign of the force there, and a body may turn against it */
    if (at_held_end(shape, i))
        joint[0] = copysign(DBL_MIN, creal(joint[1]));
    if (at_held_end(shape, i + 1))
        joint[c->body.count] = copysign(DBL_MIN, creal(joint[c->body.count - 1]));
    double from = 0.0;
    strum_status status = STRUM_OK;
    for (int k = 0; k < c->body.count && status == STRUM_OK; k++) {
        const double a = creal(joint[k]), b = creal(joint[k + 1]);
        status = survey_straight(shape, i, from, a, c->body.links[k].length, b, fault);
        from += c->body.links[k].length;
        if (k + 1 < c->body.count && status == STRUM_OK && b * (b - a) >= 0.0 &&
            b * (creal(joint[k + 2]) - b) <= 0.0 && b != 0.0)
            status = add_antinode(shape, shape->x[i] + from, b, fault);
    }
    return status;
}

/* Is the station before component i (after all points there) a local maximum of |y|? */
static strum_status survey_station(strum_taut_shape *shape, size_t before, size_t after,
                                   strum_error *fault)
{
    const strum_taut *chain = shape->chain;
    const size_t here = after < chain->count ? after : chain->count;
    const double y = creal(shape->y[here]);
    double in = y, out = -y, other; /* a free end: |y| rises towards it */
    if (before < chain->count)
        slopes(shape, before, &other, &in);
    if (after < chain->count)
        slopes(shape, after, &out, &other);
    if (at_held_end(shape, here) || !(y * in >= 0.0 && y * out <= 0.0) || y == 0.0)
        return STRUM_OK;
    return add_antinode(shape, shape->x[here], y, fault);
}

strum_status taut_shape_survey(strum_taut_shape *shape, strum_error *fault)
{
    const strum_taut *chain = shape->chain;
    size_t before = chain->count; /* the last component with a length; none yet */
    strum_status status = STRUM_OK;
    for (size_t i = 0; i <= chain->count && status == STRUM_OK; i++) {
        const taut_component *c = i < chain->count ? &chain->components[i] : NULL;
        if (c != NULL && c->length == 0.0)
            continue;
        status = survey_station(shape, before, i, fault);
        if (c == NULL || status != STRUM_OK)
            break;
        before = i;
        if (c->kind == TAUT_CABLE && c->cable.impedance > 0.0)
            status = survey_cable(shape, i, fault);
        else if (c->kind == TAUT_CABLE)
            status = survey_straight(shape, i, 0.0, creal(shape->y[i]), c->length,
                                     creal(shape->y[i + 1]), fault);
        else if (c->kind == TAUT_BODY)
            status = survey_body(shape, i, fault);
        else if (c->kind == TAUT_SUPPORT && fabs(creal(shape->y[i])) > 1e-9)
            status = add_node(shape, shape->x[i] + c->support.pivot, fault);
        else if (c->kind != TAUT_SUPPORT)
            status = survey_varying(shape, i, fault);
    }
    return status;
}
