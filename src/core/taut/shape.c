/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Mode shapes by shooting from both ends. A localised mode decays in both directions away from
 * where it lives, and shooting only follows growth faithfully (shot from one end, 30 of 500
 * modes of a cable with 380 masses get a node too many); so both shots are joined where their
 * product, the square of the mode, is largest.
 */
#include "core/taut/shape.h"

#include <float.h>
#include <stdlib.h>

/* A state of size 1 and the logarithm of what it was divided by. */
typedef struct arrow {
    cplx y, v;
    double log;
} arrow;

static arrow arrow_set(cplx y, cplx v, double log_size, double force)
{
    const double size = fmax(cabs(y), cabs(v) / force);
    if (!(size > 0.0))
        return (arrow){0.0, 0.0, -INFINITY};
    return (arrow){y / size, v / size, log_size + log(size)};
}

/* Right = N left/den, left = N^{-1} right den (det N = den^2). At a pole the state beyond is
 * infinitely larger; one rounding off it is as good. */
static arrow arrow_pass(const taut_factor *f, arrow a, bool forward, double force)
{
    cplx den = f->den.v;
    const double size = fmax(fmax(cabs(f->n11.v), cabs(f->n22.v)),
                             fmax(cabs(f->n12.v) * force, cabs(f->n21.v) / force));
    if (cabs(den) < DBL_EPSILON * DBL_EPSILON * size)
        den = DBL_EPSILON * DBL_EPSILON * size;
    const cplx n11 = forward ? f->n11.v : f->n22.v, n22 = forward ? f->n22.v : f->n11.v;
    const double sign = forward ? 1.0 : -1.0;
    const cplx y = times(n11, a.y) + sign * times(f->n12.v, a.v);
    const cplx v = sign * times(f->n21.v, a.y) + times(n22, a.v);
    return arrow_set(over(y, den), over(v, den), a.log + f->log_scale, force);
}

/* The station where both arrows together are longest, and the factor that turns the right one
 * into the left one there. */
static size_t join(const arrow *left, const arrow *right, size_t stations, double force,
                   cplx *factor)
{
    size_t best = 0;
    for (size_t i = 1; i < stations; i++)
        if (left[i].log + right[i].log > left[best].log + right[best].log)
            best = i;
    const arrow a = left[best], b = right[best];
    const double f2 = force * force;
    *factor = (times(conj(b.y), a.y) + times(conj(b.v), a.v) / f2) /
              (creal(times(conj(b.y), b.y)) + creal(times(conj(b.v), b.v)) / f2);
    return best;
}

/* Where y is 0 but for rounding its sign still tells on which side of a station the node lies:
 * a held end lies beyond the last node, and both sides of a point have the same y. */
static void settle_signs(strum_taut_shape *shape)
{
    const strum_taut *chain = shape->chain;
    const size_t n = chain->count;
    if (!chain->free_left)
        shape->y[0] = copysign(DBL_MIN, creal(shape->v[0]));
    else
        shape->v[0] = 0.0; /* at a free end V is what is only rounding */
    for (size_t i = 0; i < n; i++)
        if (chain->components[i].model->point)
            shape->y[i + 1] = shape->y[i];
    if (chain->free_right) {
        shape->v[n] = 0.0;
        return;
    }
    shape->y[n] = -copysign(DBL_MIN, creal(shape->v[n]));
    for (size_t i = n; i-- > 0 && chain->components[i].model->point;)
        shape->y[i] = shape->y[n];
}

static void fill_states(strum_taut_shape *shape, arrow *left, arrow *right)
{
    const strum_taut *chain = shape->chain;
    const size_t n = chain->count;
    /* a force that a displacement of 1 meets: weighs V against y */
    const double force =
        chain->tension * (1.0 + cabs(shape->at.s.v) * chain->travel) / chain->length;
    taut_factor f;
    left[0] = chain->free_left ? (arrow){1.0, 0.0, 0.0} : (arrow){0.0, force, 0.0};
    right[n] = chain->free_right ? (arrow){1.0, 0.0, 0.0} : (arrow){0.0, force, 0.0};
    shape->x[0] = 0.0;
    for (size_t i = 0; i < n; i++) {
        const taut_component *c = &chain->components[i];
        c->model->factor(c, &shape->at, &f);
        left[i + 1] = arrow_pass(&f, left[i], true, force);
        shape->x[i + 1] = shape->x[i] + chain->components[i].length;
    }
    for (size_t i = n; i-- > 0;) {
        const taut_component *c = &chain->components[i];
        c->model->factor(c, &shape->at, &f);
        right[i] = arrow_pass(&f, right[i + 1], false, force);
    }
    cplx factor;
    const size_t best = join(left, right, n + 1, force, &factor);
    for (size_t i = 0; i <= n; i++) {
        const arrow a = i <= best ? left[i] : right[i];
        const double size = exp(a.log - (i <= best ? left[best].log : right[best].log));
        const cplx scale = i <= best ? size : size * factor;
        shape->y[i] = times(scale, a.y);
        shape->v[i] = times(scale, a.v);
    }
    settle_signs(shape);
}

/* ---- the largest displacement of a damped shape ---- */

static double size_at(const strum_taut_shape *shape, size_t i, double x)
{
    cplx y, v;
    taut_shape_inside(shape, i, x, &y, &v);
    return cabs(y);
}

static cplx largest(const strum_taut_shape *shape)
{
    const strum_taut *chain = shape->chain;
    double best = 0.0, best_x = 0.0, best_step = 0.0;
    size_t best_i = 0;
    for (size_t i = 0; i < chain->count; i++) {
        const taut_component *c = &chain->components[i];
        const double waves = cabs(shape->at.s.v) * taut_travel_time(c) / M_PI;
        const int samples = 4 * STRUM_TAUT_LINKS_MAX + (int)fmin(16.0 * waves, 1e5);
        if (c->length == 0.0 || work_spend(shape->work, 0.3 * samples) != STRUM_OK)
            continue;
        for (int k = 0; k <= samples; k++) {
            const double x = c->length * k / samples, size = size_at(shape, i, x);
            if (size > best * (1.0 + 1e-9)) {
                best = size;
                best_x = x;
                best_i = i;
                best_step = c->length / samples;
            }
        }
    }
    double lo = fmax(best_x - best_step, 0.0);
    double hi = fmin(best_x + best_step, chain->components[best_i].length);
    for (int k = 0; k < 60; k++) { /* golden section */
        const double a = hi - 0.6180339887498949 * (hi - lo), b = lo + hi - a;
        if (size_at(shape, best_i, a) >= size_at(shape, best_i, b))
            hi = b;
        else
            lo = a;
    }
    cplx y, v, y_sample;
    taut_shape_inside(shape, best_i, 0.5 * (lo + hi), &y, &v);
    taut_shape_inside(shape, best_i, best_x, &y_sample, &v);
    return cabs(y) >= cabs(y_sample) ? y : y_sample;
}

/* Where only a hung mass moves, the chain itself stays at rest: nothing to scale by. */
static void scale_states(strum_taut_shape *shape, cplx unit)
{
    if (!(cabs(unit) > 0.0))
        return;
    for (size_t i = 0; i <= shape->chain->count; i++) {
        shape->y[i] = over(shape->y[i], unit);
        shape->v[i] = over(shape->v[i], unit);
    }
}

/* The leftmost antinode of the largest amplitude becomes +1. */
static void scale_by_antinodes(strum_taut_shape *shape)
{
    size_t best = 0;
    for (size_t k = 1; k < shape->antinode_count; k++)
        if (shape->antinodes[k].amplitude > shape->antinodes[best].amplitude * (1.0 + 1e-9))
            best = k;
    const double top = shape->antinodes[best].amplitude;
    strum_taut_point there;
    taut_shape_point(shape, shape->antinodes[best].x, &there);
    scale_states(shape, copysign(top, creal(there.displacement)));
    for (size_t k = 0; k < shape->antinode_count; k++)
        shape->antinodes[k].amplitude /= top > 0.0 ? top : 1.0;
}

/* ---- public ---- */

strum_status strum_taut_shape_make(const strum_taut *chain, const strum_taut_root *root,
                                   const strum_options *options, strum_taut_shape **shape,
                                   strum_error *error)
{
    work spent = work_begin(options);
    *shape = NULL;
    if (!(root->frequency > 0.0) || !isfinite(root->frequency) || !isfinite(root->decay))
        return error_set(error, STRUM_ERR_RANGE, "a shape needs a frequency above 0");
    const strum_status fits = taut_frequency_fits(root->frequency, error);
    if (fits != STRUM_OK)
        return fits;
    if (!chain->moves)
        return error_set(error, STRUM_ERR_IMPOSSIBLE, "nothing in the chain can move");
    const size_t stations = chain->count + 1;
    strum_taut_shape *made = calloc(1, sizeof *made);
    double *block = malloc(stations * (sizeof(double) + 2 * sizeof(cplx)));
    arrow *arrows = malloc(2 * stations * sizeof *arrows);
    strum_status status = STRUM_OK;
    if (made == NULL || block == NULL || arrows == NULL) {
        status = error_set(error, STRUM_ERR_MEMORY, "no memory for a shape");
        free(block);
    } else {
        made->chain = taut_ref(chain);
        made->work = &spent;
        made->at = taut_at_s(CMPLX(-root->decay, root->frequency), 1.0);
        made->y = (cplx *)block;
        made->v = made->y + stations;
        made->x = (double *)(made->v + stations);
        fill_states(made, arrows, arrows + stations);
        if (!chain->damped)
            status = taut_shape_survey(made, error);
        if (status == STRUM_OK && made->antinode_count > 0)
            scale_by_antinodes(made);
        else if (status == STRUM_OK)
            scale_states(made, largest(made));
        if (status == STRUM_OK && spent.status != STRUM_OK)
            status = work_error(&spent, error);
        made->work = NULL;
    }
    free(arrows);
    if (status == STRUM_OK)
        *shape = made;
    else
        strum_taut_shape_free(made);
    return status;
}

void strum_taut_shape_free(strum_taut_shape *shape)
{
    if (shape == NULL)
        return;
    strum_taut_free(shape->chain);
    free(shape->y);
    free(shape->nodes);
    free(shape->antinodes);
    free(shape);
}

strum_status strum_taut_shape_sample(const strum_taut_shape *shape, size_t count,
                                     strum_taut_point *points, strum_error *error)
{
    if (count < 2)
        return error_set(error, STRUM_ERR_RANGE, "a shape has at least 2 points");
    for (size_t k = 0; k < count; k++)
        taut_shape_point(shape, shape->chain->length * ((double)k / (double)(count - 1)),
                         &points[k]);
    for (size_t k = 0; k < count; k++)
        if (!isfinite(cabs(points[k].displacement)) || !isfinite(cabs(points[k].force)))
            return error_set(error, STRUM_ERR_RANGE,
                             "the shape spans more than a double does: its decay is too large");
    /* exact where the ends are held */
    if (!shape->chain->free_left)
        points[0].displacement = 0.0;
    if (!shape->chain->free_right)
        points[count - 1].displacement = 0.0;
    return STRUM_OK;
}

size_t strum_taut_shape_nodes(const strum_taut_shape *shape, const double **nodes)
{
    *nodes = shape->nodes;
    return shape->node_count;
}

size_t strum_taut_shape_antinodes(const strum_taut_shape *shape,
                                  const strum_taut_antinode **antinodes)
{
    *antinodes = shape->antinodes;
    return shape->antinode_count;
}
