/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The state (y, V) of a shape between its stations. */
#include "core/taut/shape.h"

void taut_part_inside(const strum_taut_shape *shape, size_t i, double x, cplx *y, cplx *v)
{
    const taut_component *c = &shape->chain->components[i];
    const cplx state[2] = {shape->y[i], shape->v[i]};
    const taut_component part = c->model->part(c, x);
    taut_factor f;
    part.model->factor(&part, &shape->at, &f);
    const double size = exp(f.log_scale);
    *y = size * (times(f.n11.v, state[0]) + times(f.n12.v, state[1]));
    *v = size * (times(f.n21.v, state[0]) + times(f.n22.v, state[1]));
}

void taut_shape_inside(const strum_taut_shape *shape, size_t i, double x, cplx *y, cplx *v)
{
    const taut_model *model = shape->chain->components[i].model;
    *y = shape->y[i];
    *v = shape->v[i];
    if (model->inside != NULL)
        model->inside(shape, i, x, y, v);
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
