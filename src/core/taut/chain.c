/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chains: checking what was given, resolving limits, and their transfer matrices. */
#include "core/taut/taut.h"

#include <stdint.h>
#include <stdlib.h>

strum_taut_link strum_taut_bar(double length, double mass)
{
    return (strum_taut_link){0.5 * length, 0.5 * length, mass, mass * length * length / 12.0};
}

strum_taut_link strum_taut_sphere(double diameter, double mass)
{
    return (strum_taut_link){0.5 * diameter, 0.5 * diameter, mass,
                             mass * diameter * diameter / 10.0};
}

/* Li (A.7): the centre lies 3 h/4 from the apex; L_c = h (he prints D). */
strum_taut_link strum_taut_cone(double height, double base_radius, double mass, bool apex_left)
{
    const double far = 0.75 * height, near = 0.25 * height;
    const double inertia =
        mass * 3.0 * (base_radius * base_radius + 0.25 * height * height) / 20.0;
    return (strum_taut_link){apex_left ? far : near, apex_left ? near : far, mass, inertia};
}

/* ---- checking ---- */

static bool positive(double x)
{
    return x > 0.0 && isfinite(x);
}

static bool not_negative(double x)
{
    return x >= 0.0 && isfinite(x);
}

/* Damping: INFINITY is a value. */
static bool damping_fits(double x)
{
    return x >= 0.0;
}

static const char *body_fault(const strum_taut_component *g)
{
    if (g->body.links == NULL || g->body.count < 1 || g->body.count > STRUM_TAUT_LINKS_MAX ||
        (g->body.count > 1 && g->body.joints == NULL))
        return "a body has 1 to 16 links, and a joint between any two";
    for (size_t i = 0; i < g->body.count; i++) {
        const strum_taut_link *l = &g->body.links[i];
        if (!not_negative(l->left) || !not_negative(l->right) || !not_negative(l->mass) ||
            !not_negative(l->inertia))
            return "arms, masses and inertias of links cannot be negative";
        if (g->body.count > 1 && !positive(l->left + l->right))
            return "every link of several has a length";
        if (i + 1 == g->body.count)
            continue;
        const strum_taut_joint *j = &g->body.joints[i];
        if (!not_negative(j->spring_arm) || !not_negative(j->damper_arm) ||
            !not_negative(j->stiffness) || !damping_fits(j->damping) || !positive(j->force))
            return "arms, stiffness and damping of joints cannot be negative, their force is "
                   "positive";
    }
    return NULL;
}

/* Why a component cannot be, or NULL. */
static const char *component_fault(const strum_taut_component *g)
{
    if (g->kind != STRUM_TAUT_HANGING && g->kind != STRUM_TAUT_GROUND &&
        (!positive(g->tension_left) || !positive(g->tension_right)))
        return "the tension must be positive";
    switch (g->kind) {
    case STRUM_TAUT_CABLE:
        if (g->tension_left != g->tension_right)
            return "a uniform cable has one tension; a varying cable has two";
        if (!positive(g->cable.length) || !not_negative(g->cable.mass_per_length) ||
            !not_negative(g->cable.drag))
            return "length must be positive, mass and drag cannot be negative";
        return NULL;
    case STRUM_TAUT_VARYING:
        if (fmax(g->tension_left, g->tension_right) >
            STRUM_TAUT_TENSION_FACTOR_MAX * fmin(g->tension_left, g->tension_right))
            return "the tensions of a varying cable differ by a factor of 1e9 at most";
        return positive(g->varying.length) && positive(g->varying.mass_per_length)
                   ? NULL
                   : "length and mass must be positive";
    case STRUM_TAUT_BODY:
        return body_fault(g);
    case STRUM_TAUT_HANGING:
        return not_negative(g->hanging.mass) && not_negative(g->hanging.stiffness) &&
                       damping_fits(g->hanging.damping)
                   ? NULL
                   : "mass, stiffness and damping cannot be negative";
    case STRUM_TAUT_GROUND:
        return not_negative(g->ground.stiffness) && not_negative(g->ground.damping) &&
                       not_negative(g->ground.inertance)
                   ? NULL
                   : "stiffness, damping and inertance to ground must be finite and cannot be "
                     "negative";
    case STRUM_TAUT_SUPPORT:
        return positive(g->support.pivot) && positive(g->support.length - g->support.pivot) &&
                       not_negative(g->support.inertia)
                   ? NULL
                   : "the pivot lies inside the support, the inertia cannot be negative";
    }
    return "unknown kind";
}

/* ---- making ready ---- */

static void set_cable(taut_component *c, double tension, double mass, double drag)
{
    c->kind = TAUT_CABLE;
    c->cable.tension = tension;
    c->cable.mass = mass;
    c->cable.drag = drag;
    c->cable.slowness = sqrt(mass / tension);
    c->cable.impedance = sqrt(mass * tension);
    /* So light that one of them is below doubles: without mass, in both. */
    if (c->cable.slowness == 0.0 || c->cable.impedance == 0.0)
        c->cable.slowness = c->cable.impedance = 0.0;
}

static void make_cable(const strum_taut_component *g, taut_component *c)
{
    const bool varies = g->kind == STRUM_TAUT_VARYING && g->tension_left != g->tension_right;
    if (varies) {
        c->kind = g->varying.wkb ? TAUT_WKB : TAUT_VARYING;
        c->length = g->varying.length;
        c->varying.tension_0 = g->tension_left;
        c->varying.tension_1 = g->tension_right;
        c->varying.mass = g->varying.mass_per_length;
        return;
    }
    const bool uniform = g->kind == STRUM_TAUT_CABLE;
    c->length = uniform ? g->cable.length : g->varying.length;
    set_cable(c, g->tension_left,
              uniform ? g->cable.mass_per_length : g->varying.mass_per_length,
              uniform ? g->cable.drag : 0.0);
}

static void make_hanging(const strum_taut_component *g, taut_component *c)
{
    const bool held = isinf(g->hanging.damping) || g->hanging.mass == 0.0;
    if (held) { /* R -> inf: a point mass (Levesque 4-5); without mass: nothing */
        c->kind = TAUT_GROUND;
        c->ground.mass = g->hanging.mass;
        c->ground.stiffness = c->ground.damping = 0.0;
        return;
    }
    c->kind = TAUT_HANGING;
    c->hanging.mass = g->hanging.mass;
    c->hanging.stiffness = g->hanging.stiffness;
    c->hanging.damping = g->hanging.damping;
}

static strum_status make_component(const strum_taut_component *g, taut_component *c,
                                   strum_error *fault)
{
    switch (g->kind) {
    case STRUM_TAUT_CABLE:
    case STRUM_TAUT_VARYING:
        make_cable(g, c);
        break;
    case STRUM_TAUT_BODY:
        c->kind = TAUT_BODY;
        return taut_body_make(g, c, fault);
    case STRUM_TAUT_HANGING:
        make_hanging(g, c);
        break;
    case STRUM_TAUT_GROUND:
        c->kind = TAUT_GROUND;
        c->ground.mass = g->ground.inertance;
        c->ground.stiffness = g->ground.stiffness;
        c->ground.damping = g->ground.damping;
        break;
    case STRUM_TAUT_SUPPORT:
        c->kind = TAUT_SUPPORT;
        c->length = g->support.length;
        c->support.pivot = g->support.pivot;
        c->support.ratio = (c->length - g->support.pivot) / g->support.pivot;
        c->support.stiffness = g->tension_right * (c->length - g->support.pivot) +
                               g->tension_left * g->support.pivot;
        c->support.inertia = g->support.inertia;
        break;
    }
    return STRUM_OK;
}

static bool is_damped(const taut_component *c)
{
    switch (c->kind) {
    case TAUT_CABLE:
        return c->cable.drag > 0.0;
    case TAUT_BODY:
        for (int i = 0; i + 1 < c->body.count; i++)
            if (c->body.joints[i].damping > 0.0)
                return true;
        return false;
    case TAUT_HANGING:
        return c->hanging.damping > 0.0;
    case TAUT_GROUND:
        return c->ground.damping > 0.0;
    default:
        return false;
    }
}

double taut_travel_time(const taut_component *c)
{
    if (c->kind == TAUT_CABLE)
        return c->length * c->cable.slowness;
    return c->kind == TAUT_WKB || c->kind == TAUT_VARYING ? taut_wkb_phase(c, 1.0) : 0.0;
}

static strum_status fill(strum_taut *chain, const strum_taut_component *given, size_t count,
                         strum_error *fault)
{
    for (size_t i = 0; i < count; i++) {
        const char *why = component_fault(&given[i]);
        if (why != NULL)
            return error_at(fault, STRUM_ERR_RANGE, STRUM_TAUT_ARG_COMPONENTS, i,
                            "component %zu: %s", i + 1, why);
        taut_component *c = &chain->components[i];
        const strum_status status = make_component(&given[i], c, fault);
        chain->count = i + 1;
        if (status != STRUM_OK) {
            if (fault != NULL) {
                fault->argument = STRUM_TAUT_ARG_COMPONENTS;
                fault->index = i;
            }
            return status;
        }
        chain->length += c->length;
        if (c->length > 0.0)
            chain->tension +=
                c->length * 0.5 * (given[i].tension_left + given[i].tension_right);
        chain->travel += taut_travel_time(c);
        chain->dampers += is_damped(c);
        chain->moves = chain->moves || (c->length > 0.0 && c->kind != TAUT_SUPPORT);
    }
    chain->damped = chain->dampers > 0;
    if (chain->length > 0.0)
        chain->tension /= chain->length;
    return STRUM_OK;
}

strum_status strum_taut_make(const strum_taut_component *components, size_t count,
                             strum_taut_end left, strum_taut_end right, strum_taut **chain,
                             strum_error *fault)
{
    *chain = NULL;
    if (components == NULL || count < 1 || count > STRUM_TAUT_COMPONENTS_MAX)
        return error_set(fault, STRUM_ERR_RANGE, "a chain has 1 to %d components",
                         STRUM_TAUT_COMPONENTS_MAX);
    strum_taut *made = calloc(1, sizeof *made);
    if (made != NULL)
        made->components = calloc(count, sizeof *made->components);
    if (made == NULL || made->components == NULL) {
        free(made);
        return error_set(fault, STRUM_ERR_MEMORY, "no memory for %zu components", count);
    }
    made->references = 1;
    made->free_left = left == STRUM_TAUT_FREE;
    made->free_right = right == STRUM_TAUT_FREE;
    const strum_status status = fill(made, components, count, fault);
    if (status != STRUM_OK)
        strum_taut_free(&made);
    *chain = made;
    return status;
}

strum_taut *taut_ref(const strum_taut *chain)
{
    strum_taut *counted = (strum_taut *)(uintptr_t)chain; /* only its count changes */
    atomic_fetch_add(&counted->references, 1);
    return counted;
}

void strum_taut_free(strum_taut **chain)
{
    strum_taut *c = *chain;
    *chain = NULL;
    if (c == NULL || atomic_fetch_sub(&c->references, 1) > 1)
        return;
    for (size_t i = 0; i < c->count; i++)
        if (c->components[i].kind == TAUT_BODY)
            free(c->components[i].body.links);
    free(c->components);
    free(c);
}

double strum_taut_length(const strum_taut *chain)
{
    return chain->length;
}

bool strum_taut_is_damped(const strum_taut *chain)
{
    return chain->damped;
}

/* ---- transfer matrices ---- */

void taut_component_factor(const taut_component *c, const taut_at *at, taut_factor *f)
{
    switch (c->kind) {
    case TAUT_CABLE:
        taut_cable_factor(c, at, f);
        break;
    case TAUT_WKB:
        taut_wkb_factor(c, at, f);
        break;
    case TAUT_VARYING:
        taut_varying_factor(c, at, f);
        break;
    case TAUT_BODY:
        taut_body_factor(c, at, f);
        break;
    case TAUT_HANGING:
    case TAUT_GROUND:
    case TAUT_SUPPORT:
        taut_point_factor(c, at, f);
        break;
    }
}

taut_component taut_component_part(const taut_component *c, double x)
{
    taut_component part = *c;
    part.length = x;
    if (c->kind == TAUT_CABLE)
        return part;
    const double t0 = c->varying.tension_0, t1 = c->varying.tension_1;
    part.varying.tension_1 = t0 + (t1 - t0) * (x / c->length);
    if (part.varying.tension_1 == t0) /* too short for the tension to differ */
        set_cable(&part, t0, c->varying.mass, 0.0);
    return part;
}

static strum_status multiply(const strum_taut *chain, size_t first, size_t last, cplx w,
                             cplx matrix[4], strum_error *fault)
{
    const taut_at at = taut_at_s(times(CMPLX(0.0, 1.0), w), 1.0);
    if (!isfinite(creal(w)) || !isfinite(cimag(w)))
        return error_set(fault, STRUM_ERR_RANGE, "the frequency is not finite");
    cplx f[4] = {1.0, 0.0, 0.0, 1.0};
    for (size_t i = first; i < last; i++) {
        taut_factor n;
        taut_component_factor(&chain->components[i], &at, &n);
        if (n.den.v == 0.0)
            return error_at(fault, STRUM_ERR_IMPOSSIBLE, STRUM_TAUT_ARG_COMPONENTS, i,
                            "component %zu resonates with both ends held: its matrix has a "
                            "pole at this frequency",
                            i + 1);
        const cplx scale = over(exp(n.log_scale), n.den.v);
        const cplx a = f[0], b = f[1];
        f[0] = times(scale, times(n.n11.v, a) + times(n.n12.v, f[2]));
        f[1] = times(scale, times(n.n11.v, b) + times(n.n12.v, f[3]));
        f[2] = times(scale, times(n.n21.v, a) + times(n.n22.v, f[2]));
        f[3] = times(scale, times(n.n21.v, b) + times(n.n22.v, f[3]));
    }
    for (int k = 0; k < 4; k++) {
        if (!isfinite(creal(f[k])) || !isfinite(cimag(f[k])))
            return error_set(fault, STRUM_ERR_RANGE,
                             "an entry of the matrix is beyond a double at this frequency");
        matrix[k] = f[k];
    }
    return STRUM_OK;
}

strum_status strum_taut_component_matrix(const strum_taut *chain, size_t index,
                                         double frequency, double decay,
                                         double _Complex matrix[4], strum_error *fault)
{
    if (index >= chain->count)
        return error_set(fault, STRUM_ERR_RANGE, "the chain has %zu components", chain->count);
    return multiply(chain, index, index + 1, CMPLX(frequency, decay), matrix, fault);
}

strum_status strum_taut_matrix(const strum_taut *chain, double frequency, double decay,
                               double _Complex matrix[4], strum_error *fault)
{
    return multiply(chain, 0, chain->count, CMPLX(frequency, decay), matrix, fault);
}
