/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A component of a taut chain: what it holds, and the table of its functions. One file a model;
 * table.c names the models that a kind of the public header is made of. Nothing outside this
 * folder asks what a component is.
 *
 * With motion ~ e^{s t} each component has its transfer matrix as N/den, N and den entire in s.
 */
#ifndef CORE_TAUT_COMPONENTS_COMPONENT_H
#define CORE_TAUT_COMPONENTS_COMPONENT_H

#include <stdbool.h>
#include <stddef.h>

#include <strum/taut.h>

#include "core/numerics/status.h"
#include "core/taut/dual.h"

/* Where a chain is evaluated, and along which direction the derivative is taken: `factor`
 * multiplies every finite damping. */
typedef struct taut_at {
    dual s, factor;
} taut_at;

static inline taut_at taut_at_s(cplx s, double factor)
{
    return (taut_at){{s, 1.0}, {factor, 0.0}};
}

/* N (scaled by e^{-log_scale}) and den of a component. */
typedef struct taut_factor {
    dual n11, n12, n21, n22, den;
    double log_scale;
} taut_factor;

typedef struct taut_link {
    double left, right, length; /* of its ends from the centre of mass; their sum */
    double mass, inertia;
    double pull; /* axial forces times arms: the stiffness that turning it meets, N m */
} taut_link;

typedef struct taut_joint {
    double stiffness, damping; /* N m, N m s */
} taut_joint;

typedef struct taut_model taut_model;

/* A component made ready: checked, limits resolved (a locked joint makes one link of two, a
 * body without length is a point mass, and so on). */
typedef struct taut_component {
    const taut_model *model;
    double length;
    union {
        struct {
            double tension, mass, drag; /* per length */
            double slowness, impedance; /* sqrt(mass/tension), sqrt(mass tension) */
        } cable;
        struct {
            double tension_0, tension_1, mass;
        } varying;
        struct {
            taut_link *links; /* owns the block of all three */
            taut_joint *joints;
            double *poles; /* w^2 of the body with both ends held, ascending; `pole_count` */
            int count, pole_count;
        } body;
        struct {
            double mass, stiffness, damping;
        } hanging, ground; /* ground: inertance, stiffness, damping */
        struct {
            double pivot, ratio, stiffness, inertia;
        } support;
    };
} taut_component;

/* Where a real shot stands: y, U = V/w (then a cable only turns the state) and their
 * derivatives by w, times 2^-exponent. */
typedef struct taut_station {
    double y, u, dy, du;
    long exponent;
} taut_station;

/* What is known of the motions at s = 0. */
typedef struct taut_rigid {
    bool loose;    /* nothing holds the chain in place */
    bool resisted; /* a damper resists its motion as a whole */
    int zeros;     /* of masses hung without a spring */
} taut_rigid;

struct taut_cursor; /* core/taut/assembly.h */

/* Entries that may be NULL say what holds then. `shape` and `i`: component i of a shape. */
struct taut_model {
    int states;     /* numbers that it passes on: 2, y and V = T y' */
    bool point;     /* y is the same on both sides */
    bool adds_only; /* N = [1, 0; n21, 1], den = 1 */
    bool flexible;  /* lets y differ at its ends as they will */
    void (*factor)(const taut_component *c, const taut_at *at, taut_factor *f);
    /* Modes below w with both ends held; f: its factor at s = i w. NULL: none. */
    long (*zeros)(const taut_component *c, double w, const taut_factor *f);
    /* Passes a real shot at w, and returns what it adds to the mode count. NULL: by `factor`
     * and `zeros`. */
    long (*shoot)(const taut_component *c, double w, taut_station *station);
    bool (*damped)(const taut_component *c);                   /* NULL: never */
    double (*travel_time)(const taut_component *c);            /* of a wave, s; NULL: 0 */
    void (*rigid)(const taut_component *c, taut_rigid *rigid); /* NULL: moves with the chain */
    /* Its first x as a component of its own; NULL: cannot be cut. */
    taut_component (*part)(const taut_component *c, double x);
    /* y and V at x into it. NULL: those at its left end. */
    void (*inside)(const strum_taut_shape *shape, size_t i, double x, cplx *y, cplx *v);
    /* Slopes at its ends, up to positive factors. NULL: V there. */
    void (*slopes)(const strum_taut_shape *shape, size_t i, double *left, double *right);
    /* Adds the nodes and antinodes within it, of a shape without damping. NULL: none. */
    strum_status (*survey)(strum_taut_shape *shape, size_t i, strum_error *error);
    /* Adds its stiffness, damping and mass to the second method's matrices. */
    void (*place)(struct taut_cursor *at, const taut_component *c);
    void (*release)(taut_component *c); /* frees what it owns; NULL: nothing */
};

/* A kind of the public header: why such a component cannot be (NULL: it can), and making it
 * ready, with its model. */
typedef struct taut_kind {
    bool tensioned; /* reads tension_left and tension_right */
    const char *(*fault)(const strum_taut_component *given);
    strum_status (*make)(const strum_taut_component *given, taut_component *c,
                         strum_error *error);
} taut_kind;

/* NULL: there is no such kind. */
const taut_kind *taut_kind_of(strum_taut_kind kind);

extern const taut_kind taut_cable_kind, taut_varying_kind, taut_body_kind, taut_hanging_kind,
    taut_ground_kind, taut_support_kind;
extern const taut_model taut_wkb;

/* ---- pieces that several components share ---- */

/* `inside` of what can be cut: the factor of the part before x. */
void taut_part_inside(const strum_taut_shape *shape, size_t i, double x, cplx *y, cplx *v);

/* Makes `c` (its length is set) a cable of uniform tension. */
void taut_cable_set(taut_component *c, double tension, double mass, double drag);
/* Makes `c` a mass at a point. */
void taut_ground_set_mass(taut_component *c, double mass);

/* cosh(g), sinh(g)/gamma and their derivatives for a wave of gamma^2 = q along `length`; gamma
 * is one of the two roots. */
void taut_wave(dual q, cplx gamma, double length, dual *cosine, dual *sine, double *log_scale);
/* Zeros (half waves completed) up to phase `phase`, told apart by the sign of its computed
 * sine: never by comparing roundings of pi. */
long taut_half_waves(double phase, double sine);

/* Of a cable whose tension varies linearly (linear.c): the phase W = w integral of
 * sqrt(rho/T) along it. */
double taut_varying_phase(const taut_component *c, double w);
double taut_varying_travel_time(const taut_component *c);
taut_component taut_varying_part(const taut_component *c, double x);
strum_status taut_varying_survey(strum_taut_shape *shape, size_t i, strum_error *error);

static inline bool taut_positive(double x)
{
    return x > 0.0 && isfinite(x);
}
static inline bool taut_not_negative(double x)
{
    return x >= 0.0 && isfinite(x);
}
/* Damping: INFINITY is a value. */
static inline bool taut_damping_fits(double x)
{
    return x >= 0.0;
}

#endif
