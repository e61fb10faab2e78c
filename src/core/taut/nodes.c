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

strum_status taut_nodes_fit(double count, strum_error *error)
{
    return count <= STRUM_TAUT_NODES_MAX
               ? STRUM_OK
               : error_set(error, STRUM_ERR_METHOD, "the shape has more than %d nodes",
                           STRUM_TAUT_NODES_MAX);
}

strum_status taut_node_add(strum_taut_shape *shape, double x, strum_error *error)
{
    const strum_status status = taut_nodes_fit((double)shape->node_count + 1.0, error);
    if (status != STRUM_OK)
        return status;
    if (work_spend(shape->work, 0.1) != STRUM_OK)
        return work_error(shape->work, error);
    if (shape->node_count == shape->node_room) {
        const size_t room = 2 * shape->node_room + 16;
        double *more = realloc(shape->nodes, room * sizeof *more);
        if (more == NULL)
            return error_set(error, STRUM_ERR_MEMORY, "no memory for nodes");
        shape->nodes = more;
        shape->node_room = room;
    }
    shape->nodes[shape->node_count++] = x;
    return STRUM_OK;
}

strum_status taut_antinode_add(strum_taut_shape *shape, double x, double amplitude,
                               strum_error *error)
{
    if (shape->antinode_count == shape->antinode_room) {
        const size_t room = 2 * shape->antinode_room + 16;
        strum_taut_antinode *more = realloc(shape->antinodes, room * sizeof *more);
        if (more == NULL)
            return error_set(error, STRUM_ERR_MEMORY, "no memory for antinodes");
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

bool taut_at_held_end(const strum_taut_shape *shape, size_t i)
{
    const strum_taut *chain = shape->chain;
    return (!chain->free_left && shape->x[i] == 0.0) ||
           (!chain->free_right && shape->x[i] == shape->x[chain->count]);
}

double taut_crossing(const strum_taut_shape *shape, size_t i, bool force, double lo, double hi)
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
        if (taut_signs_differ(f, f_lo)) {
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

strum_status taut_straight_survey(strum_taut_shape *shape, size_t i, double from, double y_from,
                                  double length, double y_to, strum_error *error)
{
    if (!taut_signs_differ(y_from, y_to))
        return STRUM_OK;
    const double share = y_from == y_to ? 0.0 : y_from / (y_from - y_to);
    return taut_node_add(shape, shape->x[i] + from + length * share, error);
}

/* Slopes of component i at its left and right end, up to positive factors. */
static void slopes(const strum_taut_shape *shape, size_t i, double *left, double *right)
{
    const taut_model *model = shape->chain->components[i].model;
    *left = creal(shape->v[i]);
    *right = creal(shape->v[i + 1]);
    if (model->slopes != NULL)
        model->slopes(shape, i, left, right);
}

/* Is the station before component i (after all points there) a local maximum of |y|? */
static strum_status survey_station(strum_taut_shape *shape, size_t before, size_t after,
                                   strum_error *error)
{
    const strum_taut *chain = shape->chain;
    const size_t here = after < chain->count ? after : chain->count;
    const double y = creal(shape->y[here]);
    double in = y, out = -y, other; /* a free end: |y| rises towards it */
    if (before < chain->count)
        slopes(shape, before, &other, &in);
    if (after < chain->count)
        slopes(shape, after, &out, &other);
    if (taut_at_held_end(shape, here) || !(y * in >= 0.0 && y * out <= 0.0) || y == 0.0)
        return STRUM_OK;
    return taut_antinode_add(shape, shape->x[here], y, error);
}

strum_status taut_shape_survey(strum_taut_shape *shape, strum_error *error)
{
    const strum_taut *chain = shape->chain;
    size_t before = chain->count; /* the last component with a length; none yet */
    strum_status status = STRUM_OK;
    for (size_t i = 0; i <= chain->count && status == STRUM_OK; i++) {
        const taut_component *c = i < chain->count ? &chain->components[i] : NULL;
        if (c != NULL && c->length == 0.0)
            continue;
        status = survey_station(shape, before, i, error);
        if (c == NULL || status != STRUM_OK)
            break;
        before = i;
        if (c->model->survey != NULL)
            status = c->model->survey(shape, i, error);
    }
    return status;
}
