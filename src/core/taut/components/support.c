/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A rigid lever through which the chain passes, pinned to ground. */
#include "core/taut/assembly.h"
#include "core/taut/shape.h"

/* Li (A.26); his end support (A.27) is its case T_{i-1} = 0, a free end on the left. */
static void support_factor(const taut_component *c, const taut_at *at, taut_factor *f)
{
    const double arms = (c->length - c->support.pivot) * c->support.pivot;
    *f = (taut_factor){.den = {1.0, 0.0}};
    f->n11 = dual_of(-c->support.ratio);
    f->n22 = dual_of(-1.0 / c->support.ratio);
    f->n21 =
        dual_scale(-1.0 / arms, dual_add(dual_scale(c->support.inertia, dual_mul(at->s, at->s)),
                                         dual_of(c->support.stiffness)));
}

static void support_rigid(const taut_component *c, taut_rigid *rigid)
{
    (void)c;
    rigid->loose = false;
}

static void support_inside(const strum_taut_shape *shape, size_t i, double x, cplx *y, cplx *v)
{
    const taut_component *c = &shape->chain->components[i];
    *y = shape->y[i] * (1.0 - x / c->support.pivot);
    *v = x < c->support.pivot ? shape->v[i] : shape->v[i + 1];
}

static void support_slopes(const strum_taut_shape *shape, size_t i, double *left, double *right)
{
    *left = *right = -creal(shape->y[i]);
}

/* The pin, unless the lever rests. */
static strum_status support_survey(strum_taut_shape *shape, size_t i, strum_error *error)
{
    if (!(fabs(creal(shape->y[i])) > 1e-9))
        return STRUM_OK;
    return taut_node_add(shape, shape->x[i] + shape->chain->components[i].support.pivot, error);
}

/* The lever turns by y_left/pivot; y_right = -ratio y_left. */
static void support_place(taut_cursor *at, const taut_component *c)
{
    const double square = c->support.pivot * c->support.pivot;
    const double k = c->support.stiffness / square, m = c->support.inertia / square;
    taut_element_place(at, 1, &k, NULL, &m);
    at->lever *= -c->support.ratio;
}

static const taut_model support_model = {
    .states = 2,
    .factor = support_factor,
    .rigid = support_rigid,
    .inside = support_inside,
    .slopes = support_slopes,
    .survey = support_survey,
    .place = support_place,
};

static const char *support_fault(const strum_taut_component *g)
{
    if (!taut_not_negative(g->tension_left) || !taut_not_negative(g->tension_right) ||
        !(g->tension_left + g->tension_right > 0.0))
        return "the tensions cannot be negative, and one of them is positive";
    return taut_positive(g->support.pivot) &&
                   taut_positive(g->support.length - g->support.pivot) &&
                   taut_not_negative(g->support.inertia)
               ? NULL
               : "the pivot lies inside the support, the inertia cannot be negative";
}

static strum_status support_make(const strum_taut_component *g, taut_component *c,
                                 strum_error *error)
{
    (void)error;
    c->model = &support_model;
    c->length = g->support.length;
    c->support.pivot = g->support.pivot;
    c->support.ratio = (c->length - g->support.pivot) / g->support.pivot;
    c->support.stiffness =
        g->tension_right * (c->length - g->support.pivot) + g->tension_left * g->support.pivot;
    c->support.inertia = g->support.inertia;
    return STRUM_OK;
}

/* Its own check of the tensions: an end support has none on its outer side. */
const taut_kind taut_support_kind = {false, support_fault, support_make};
