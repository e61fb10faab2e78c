/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A mass on a spring and a damper, hung to the chain: Levesque's hanging absorber. */
#include "core/taut/assembly.h"

/* Levesque (4-5), t21 = -m w^2 g/(g - m w^2) with g = k + i w R, times its denominator. */
static void hanging_factor(const taut_component *c, const taut_at *at, taut_factor *f)
{
    const dual s = at->s, inertia = dual_scale(c->hanging.mass, dual_mul(s, s));
    const dual g = dual_add(dual_of(c->hanging.stiffness),
                            dual_scale(c->hanging.damping, dual_mul(at->factor, s)));
    *f = (taut_factor){.log_scale = 0.0};
    f->den = f->n11 = f->n22 = dual_add(g, inertia);
    f->n21 = dual_mul(inertia, g);
}

static long hanging_zeros(const taut_component *c, double w, const taut_factor *f)
{
    (void)c;
    (void)w;
    return creal(f->den.v) < 0.0;
}

static bool hanging_damped(const taut_component *c)
{
    return c->hanging.damping > 0.0;
}

static void hanging_rigid(const taut_component *c, taut_rigid *rigid)
{
    if (c->hanging.stiffness == 0.0)
        rigid->zeros += c->hanging.damping > 0.0 ? 1 : 2;
}

static void hanging_place(taut_cursor *at, const taut_component *c)
{
    const double k = c->hanging.stiffness, r = c->hanging.damping;
    const double ks[4] = {k, -k, -k, k}, cs[4] = {r, -r, -r, r},
                 ms[4] = {0.0, 0.0, 0.0, c->hanging.mass};
    const taut_cursor here = *at;
    taut_element_place(at, 2, ks, cs, ms);
    at->node = here.node; /* the chain goes on where the absorber hangs */
    at->lever = here.lever;
}

static const taut_model hanging_model = {
    .states = 2,
    .point = true,
    .factor = hanging_factor,
    .zeros = hanging_zeros,
    .damped = hanging_damped,
    .rigid = hanging_rigid,
    .place = hanging_place,
};

static const char *hanging_fault(const strum_taut_component *g)
{
    return taut_not_negative(g->hanging.mass) && taut_not_negative(g->hanging.stiffness) &&
                   taut_damping_fits(g->hanging.damping)
               ? NULL
               : "mass, stiffness and damping cannot be negative";
}

static strum_status hanging_make(const strum_taut_component *g, taut_component *c,
                                 strum_error *error)
{
    (void)error;
    if (isinf(g->hanging.damping) || g->hanging.mass == 0.0) {
        /* R -> inf: a point mass (Levesque 4-5); without mass: nothing */
        taut_ground_set_mass(c, g->hanging.mass);
        return STRUM_OK;
    }
    c->model = &hanging_model;
    c->hanging.mass = g->hanging.mass;
    c->hanging.stiffness = g->hanging.stiffness;
    c->hanging.damping = g->hanging.damping;
    return STRUM_OK;
}

const taut_kind taut_hanging_kind = {false, hanging_fault, hanging_make};
