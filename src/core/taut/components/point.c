/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Components that act at a point of the chain: masses, springs, dampers and inerters to ground,
 * hanging absorbers, and supports. */
#include "core/taut/taut.h"

/* V_right = V_left + (k + s R + b s^2) y; a point mass is an inerter (Li, A.8: -M w^2). */
static void ground_factor(const taut_component *c, const taut_at *at, taut_factor *f)
{
    const dual one = dual_of(1.0), s = at->s;
    const dual rs = dual_scale(c->ground.damping, dual_mul(at->factor, s));
    f->n11 = f->n22 = one;
    f->n21 = dual_add(dual_add(dual_of(c->ground.stiffness), rs),
                      dual_scale(c->ground.mass, dual_mul(s, s)));
}

/* Levesque (4-5), t21 = -m w^2 g/(g - m w^2) with g = k + i w R, times its denominator. */
static void hanging_factor(const taut_component *c, const taut_at *at, taut_factor *f)
{
    const dual s = at->s, inertia = dual_scale(c->hanging.mass, dual_mul(s, s));
    const dual g = dual_add(dual_of(c->hanging.stiffness),
                            dual_scale(c->hanging.damping, dual_mul(at->factor, s)));
    f->den = f->n11 = f->n22 = dual_add(g, inertia);
    f->n21 = dual_mul(inertia, g);
}

/* Li (A.26); his end support (A.27) is its case T_{i-1} = 0, a free end on the left. */
static void support_factor(const taut_component *c, const taut_at *at, taut_factor *f)
{
    const double arms = (c->length - c->support.pivot) * c->support.pivot;
    f->n11 = dual_of(-c->support.ratio);
    f->n22 = dual_of(-1.0 / c->support.ratio);
    f->n21 =
        dual_scale(-1.0 / arms, dual_add(dual_scale(c->support.inertia, dual_mul(at->s, at->s)),
                                         dual_of(c->support.stiffness)));
}

void taut_point_factor(const taut_component *c, const taut_at *at, taut_factor *f)
{
    *f = (taut_factor){.den = {1.0, 0.0}};
    if (c->kind == TAUT_GROUND)
        ground_factor(c, at, f);
    else if (c->kind == TAUT_HANGING)
        hanging_factor(c, at, f);
    else
        support_factor(c, at, f);
}
