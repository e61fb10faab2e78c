/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The WKB matrix of a cable whose tension varies linearly: Li's own, an approximation. */
#include "core/taut/assembly.h"
#include "core/taut/shape.h"

/* Li (A.2), with cos W = cosh(W' s), sin W/w = sinh(W' s)/s, W' = W/w. Its determinant is 1: it
 * is the exact matrix of a cable that besides rests on an elastic foundation T'^2/(16 T). */
static void wkb_factor(const taut_component *c, const taut_at *at, taut_factor *f)
{
    const double t0 = c->varying.tension_0, t1 = c->varying.tension_1;
    const double slope = (t1 - t0) / c->length, ratio = pow(t0 / t1, 0.25);
    const double z = sqrt(c->varying.mass * sqrt(t0 * t1)); /* (rho^2 T0 T1)^{1/4} */
    const dual s2 = dual_mul(at->s, at->s);
    dual cosine, sine;
    *f = (taut_factor){.den = {1.0, 0.0}};
    taut_wave(s2, at->s.v, taut_varying_phase(c, 1.0), &cosine, &sine, &f->log_scale);
    f->n11 = dual_add(dual_scale(ratio, cosine), dual_scale(0.25 * slope / z, sine));
    f->n12 = dual_scale(1.0 / z, sine);
    f->n21 = dual_add(dual_scale(0.25 * slope * (1.0 / ratio - ratio), cosine),
                      dual_sub(dual_scale(z, dual_mul(s2, sine)),
                               dual_scale(slope * slope / (16.0 * z), sine)));
    f->n22 = dual_sub(dual_scale(1.0 / ratio, cosine), dual_scale(0.25 * slope / z, sine));
}

static long wkb_zeros(const taut_component *c, double w, const taut_factor *f)
{
    return taut_half_waves(taut_varying_phase(c, w), creal(f->n12.v));
}

/* The foundation holds it in place. */
static void wkb_rigid(const taut_component *c, taut_rigid *rigid)
{
    (void)c;
    rigid->loose = false;
}

static void wkb_place(taut_cursor *at, const taut_component *c)
{
    const taut_element_cable cable = {.length = c->length,
                                      .tension_0 = c->varying.tension_0,
                                      .tension_1 = c->varying.tension_1,
                                      .mass = c->varying.mass,
                                      .foundation = true};
    taut_elements_place(at, &cable);
}

const taut_model taut_wkb = {
    .states = 2,
    .flexible = true,
    .factor = wkb_factor,
    .zeros = wkb_zeros,
    .travel_time = taut_varying_travel_time,
    .rigid = wkb_rigid,
    .part = taut_varying_part,
    .inside = taut_part_inside,
    .survey = taut_varying_survey,
    .place = wkb_place,
};
