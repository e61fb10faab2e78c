/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cables of uniform tension; without mass, an elastic string that only pulls. */
#include "core/taut/assembly.h"
#include "core/taut/shape.h"

/* Li (A.3): k^2 = (rho w^2 - i R w)/T, that is gamma^2 = (rho s^2 + R s)/T = -k^2;
 * F = [cos kL, sin kL/(kT); -kT sin kL, cos kL]. */
static void cable_factor(const taut_component *c, const taut_at *at, taut_factor *f)
{
    const double t = c->cable.tension;
    dual q = dual_scale(c->cable.mass / t, dual_mul(at->s, at->s)), sine;
    cplx gamma;
    *f = (taut_factor){.den = {1.0, 0.0}};
    if (c->cable.drag > 0.0 && at->factor.v != 0.0) {
        q = dual_add(q, dual_scale(c->cable.drag / t, dual_mul(at->factor, at->s)));
        gamma = csqrt(q.v);
    } else {
        /* the direction may still turn the drag on */
        q.d += c->cable.drag / t * times(at->factor.d, at->s.v);
        gamma = c->cable.slowness * at->s.v;
    }
    taut_wave(q, gamma, c->length, &f->n11, &sine, &f->log_scale);
    f->n22 = f->n11;
    f->n12 = dual_scale(1.0 / t, sine);
    f->n21 = dual_scale(t, dual_mul(q, sine));
}

static bool cable_damped(const taut_component *c)
{
    return c->cable.drag > 0.0;
}

static double cable_travel_time(const taut_component *c)
{
    return c->length * c->cable.slowness;
}

static void cable_rigid(const taut_component *c, taut_rigid *rigid)
{
    rigid->resisted = rigid->resisted || c->cable.drag > 0.0;
}

static taut_component cable_part(const taut_component *c, double x)
{
    taut_component part = *c;
    part.length = x;
    return part;
}

/* sin and cos once, the rest is a rotation: d/dw turns by the travel time. */
static long cable_shoot(const taut_component *c, double w, taut_station *p)
{
    const double travel = c->length * c->cable.slowness, z = c->cable.impedance;
    double sine, cosine;
    sincos(w * travel, &sine, &cosine);
    const double y = cosine * p->y + sine / z * p->u, u = cosine * p->u - z * sine * p->y;
    const double dy = cosine * p->dy + sine / z * p->du + travel / z * u;
    const double du = cosine * p->du - z * sine * p->dy - travel * z * y;
    const bool crosses = (signbit(p->y) != 0) ^ (signbit(y) != 0) ^ (signbit(sine) != 0);
    *p = (taut_station){y, u, dy, du, p->exponent};
    return taut_half_waves(w * travel, sine) + crosses;
}

static long cable_zeros(const taut_component *c, double w, const taut_factor *f)
{
    return taut_half_waves(w * cable_travel_time(c), creal(f->n12.v));
}

/* y = a cos(kx) + b sin(kx). Where the two shots are joined, only the sign of y is common to
 * this component and the next: the number of nodes is the one of that parity which fits the
 * phase. */
static strum_status cable_survey(strum_taut_shape *shape, size_t i, strum_error *error)
{
    const taut_component *c = &shape->chain->components[i];
    const double w = cimag(shape->at.s.v), k = w * c->cable.slowness, phase = k * c->length;
    const double a = creal(shape->y[i]), b = creal(shape->v[i]) / (w * c->cable.impedance);
    double zero = atan2(a, -b), top = atan2(b, a);
    if (signbit(a))
        zero += M_PI;
    if (top <= 0.0)
        top += M_PI;
    strum_status status = taut_nodes_fit(phase / M_PI, error);
    if (status != STRUM_OK)
        return status;
    if (!isfinite(zero) || !isfinite(top))
        return error_set(error, STRUM_ERR_ACCURACY,
                         "the shape spans more than doubles resolve");
    const bool odd = taut_signs_differ(a, creal(shape->y[i + 1]));
    const long nodes = odd + 2 * lround(((phase - zero) / M_PI + 0.5 - odd) / 2.0);
    for (long n = 0; n < nodes && status == STRUM_OK; n++)
        status =
            taut_node_add(shape, shape->x[i] + fmin(zero + (double)n * M_PI, phase) / k, error);
    for (; top < phase && status == STRUM_OK; top += M_PI)
        status = taut_antinode_add(shape, shape->x[i] + top / k, hypot(a, b), error);
    return status;
}

/* Without mass: straight. */
static strum_status massless_survey(strum_taut_shape *shape, size_t i, strum_error *error)
{
    return taut_straight_survey(shape, i, 0.0, creal(shape->y[i]),
                                shape->chain->components[i].length, creal(shape->y[i + 1]),
                                error);
}

static void massless_place(taut_cursor *at, const taut_component *c)
{
    const taut_element_cable cable = {.length = c->length,
                                      .tension_0 = c->cable.tension,
                                      .tension_1 = c->cable.tension,
                                      .mass = c->cable.mass,
                                      .drag = c->cable.drag};
    taut_elements_place(at, &cable);
}

static void cable_place(taut_cursor *at, const taut_component *c)
{
    if (at->dynamic)
        taut_wire_place(at, c->length, c->cable.slowness, c->cable.impedance);
    else
        massless_place(at, c);
}

static const taut_model cable_model = {
    .states = 2,
    .flexible = true,
    .factor = cable_factor,
    .zeros = cable_zeros,
    .shoot = cable_shoot,
    .damped = cable_damped,
    .travel_time = cable_travel_time,
    .rigid = cable_rigid,
    .part = cable_part,
    .inside = taut_part_inside,
    .survey = cable_survey,
    .place = cable_place,
};

static const taut_model massless_model = {
    .states = 2,
    .flexible = true,
    .factor = cable_factor,
    .damped = cable_damped,
    .travel_time = cable_travel_time,
    .rigid = cable_rigid,
    .part = cable_part,
    .inside = taut_part_inside,
    .survey = massless_survey,
    .place = massless_place,
};

void taut_cable_set(taut_component *c, double tension, double mass, double drag)
{
    c->model = &cable_model;
    c->cable.tension = tension;
    c->cable.mass = mass;
    c->cable.drag = drag;
    c->cable.slowness = sqrt(mass / tension);
    c->cable.impedance = sqrt(mass * tension);
    /* So light that one of them is below doubles: without mass, in both. */
    if (c->cable.slowness == 0.0 || c->cable.impedance == 0.0) {
        c->model = &massless_model;
        c->cable.slowness = c->cable.impedance = 0.0;
    }
}

static const char *cable_fault(const strum_taut_component *g)
{
    if (g->tension_left != g->tension_right)
        return "a uniform cable has one tension; a varying cable has two";
    if (!taut_positive(g->cable.length) || !taut_not_negative(g->cable.mass_per_length) ||
        !taut_not_negative(g->cable.drag))
        return "length must be positive, mass and drag cannot be negative";
    return NULL;
}

static strum_status cable_make(const strum_taut_component *g, taut_component *c,
                               strum_error *error)
{
    (void)error;
    c->length = g->cable.length;
    taut_cable_set(c, g->tension_left, g->cable.mass_per_length, g->cable.drag);
    return STRUM_OK;
}

const taut_kind taut_cable_kind = {true, cable_fault, cable_make};
