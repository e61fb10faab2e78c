/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The state (y, V) of a shape between its stations. */
#include "core/taut/shape.h"

void taut_shape_inside(const strum_taut_shape *shape, size_t i, double x, cplx *y, cplx *v)
{
    const taut_component *c = &shape->chain->components[i];
    const cplx state[2] = {shape->y[i], shape->v[i]};
    *y = state[0];
    *v = state[1];
    if (c->kind == TAUT_CABLE || c->kind == TAUT_WKB || c->kind == TAUT_VARYING) {
        const taut_component part = taut_component_part(c, x);
        taut_factor f;
        taut_component_factor(&part, &shape->at, &f);
        const double size = exp(f.log_scale);
        *y = size * (times(f.n11.v, state[0]) + times(f.n12.v, state[1]));
        *v = size * (times(f.n21.v, state[0]) + times(f.n22.v, state[1]));
    } else if (c->kind == TAUT_SUPPORT) {
        *y = state[0] * (1.0 - x / c->support.pivot);
        *v = x < c->support.pivot ? state[1] : shape->v[i + 1];
    } else if (c->kind == TAUT_BODY) {
        cplx joint[STRUM_TAUT_LINKS_MAX + 1];
        taut_body_joints(c, &shape->at, state, joint);
        double start = 0.0;
        int k = 0;
        while (k + 1 < c->body.count && x > start + c->body.links[k].length)
            start += c->body.links[k++].length;
        const double share = (x - start) / c->body.links[k].length;
        *y = joint[k] + share * (joint[k + 1] - joint[k]);
        /* V is what the cable carries at either end; inside, it changes at the masses */
        *v = x < 0.5 * c->length ? state[1] : shape->v[i + 1];
    }
}

void taut_shape_point(const strum_taut_shape *shape, double x, strum_taut_point *point)
{
    size_t lo = 0, hi = shape->chain->count; /* the last component that starts at or before x */
    while (hi - lo > 1) {
        const size_t middle = lo + (hi - lo) / 2;
        if (shape->x[middle] <= x)
            lo = middle;
        else
            hi = middle;
    }
    while (lo > 0 && shape->chain->components[lo].length == 0.0)
        lo--; /* a point at the right end: what carries it */
    point->x = x;
    const double inside = fmin(x - shape->x[lo], shape->chain->components[lo].length);
    taut_shape_inside(shape, lo, inside, &point->displacement, &point->force);
}
