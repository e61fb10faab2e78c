/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Spring, damper and inerter to ground; a point mass is an inerter. */
#include "core/taut/assembly.h"

/* V_right = V_left + (k + s R + b s^2) y; a point mass is an inerter (Li, A.8: -M w^2). */
static void ground_factor(const taut_component *c, const taut_at *at, taut_factor *f)
{
    const dual one = dual_of(1.0), s = at->s;
    const dual rs = dual_scale(c->ground.damping, dual_mul(at->factor, s));
    *f = (taut_factor){.den = one};
    f->n11 = f->n22 = one;
    f->n21 = dual_add(dual_add(dual_of(c->ground.stiffness), rs),
                      dual_scale(c->ground.mass, dual_mul(s, s)));
}

/* As the factor, without damping. */
static long ground_shoot(const taut_component *c, double w, taut_station *p)
{
    const double k = c->ground.stiffness / w, m = c->ground.mass;
    p->du += (k - m * w) * p->dy - (k / w + m) * p->y;
    p->u += (k - m * w) * p->y;
    return 0;
}

static bool ground_damped(const taut_component *c)
{
    return c->ground.damping > 0.0;
}

static void ground_rigid(const taut_component *c, taut_rigid *rigid)
{
    rigid->loose = rigid->loose && !(c->ground.stiffness > 0.0);
    rigid->resisted = rigid->resisted || c->ground.damping > 0.0;
}

static void ground_place(taut_cursor *at, const taut_component *c)
{
    taut_element_place(at, 1, &c->ground.stiffness, &c->ground.damping, &c->ground.mass);
}

static const taut_model ground_model = {
    .states = 2,
    .point = true,
    .adds_only = true,
    .factor = ground_factor,
    .shoot = ground_shoot,
    .damped = ground_damped,
    .rigid = ground_rigid,
    .place = ground_place,
};

void taut_ground_set_mass(taut_component *c, double mass)
{
    c->model = &ground_model;
    c->ground.mass = mass;
    c->ground.stiffness = c->ground.damping = 0.0;
}

static const char *ground_fault(const strum_taut_component *g)
{
    return taut_not_negative(g->ground.stiffness) && taut_not_negative(g->ground.damping) &&
                   taut_not_negative(g->ground.inertance)
               ? NULL
               : "stiffness, damping and inertance to ground must be finite and cannot be "
                 "negative";
}

static strum_status ground_make(const strum_taut_component *g, taut_component *c,
                                strum_error *error)
{
    (void)error;
    c->model = &ground_model;
    c->ground.mass = g->ground.inertance;
    c->ground.stiffness = g->ground.stiffness;
    c->ground.damping = g->ground.damping;
    return STRUM_OK;
}

const taut_kind taut_ground_kind = {false, ground_fault, ground_make};
