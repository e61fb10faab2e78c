/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Inside of taut chains. Motion ~ e^{s t}, s = i w: then every characteristic function is real
 * on the real axis, and roots come as conjugates. Each component has its transfer matrix as
 * N/den with N and den entire in s; the product of the N gives an entire characteristic
 * function, whose zeros are the modes and nothing else.
 */
#ifndef CORE_TAUT_TAUT_H
#define CORE_TAUT_TAUT_H

#include <complex.h>
#include <math.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

#include <strum/taut.h>

#include "core/numerics/status.h"
#include "core/numerics/work.h"

typedef double _Complex cplx;

/* A number and its derivative along a direction (forward differentiation). */
typedef struct dual {
    cplx v, d;
} dual;

static inline dual dual_of(double a)
{
    return (dual){a, 0.0};
}
static inline dual dual_add(dual a, dual b)
{
    return (dual){a.v + b.v, a.d + b.d};
}
static inline dual dual_sub(dual a, dual b)
{
    return (dual){a.v - b.v, a.d - b.d};
}
static inline dual dual_scale(double k, dual a)
{
    return (dual){k * a.v, k * a.d};
}
/* Products and quotients by hand: C's own check every product for infinities. */
static inline cplx times(cplx a, cplx b)
{
    return CMPLX(creal(a) * creal(b) - cimag(a) * cimag(b),
                 creal(a) * cimag(b) + cimag(a) * creal(b));
}
static inline cplx over(cplx a, cplx b)
{
    const double size = fmax(fabs(creal(b)), fabs(cimag(b)));
    const cplx u = CMPLX(creal(b) / size, -cimag(b) / size);
    return times(a, u) / (size * (creal(u) * creal(u) + cimag(u) * cimag(u)));
}
static inline dual dual_mul(dual a, dual b)
{
    return (dual){times(a.v, b.v), times(a.v, b.d) + times(a.d, b.v)};
}
static inline dual dual_div(dual a, dual b)
{
    const cplx q = over(a.v, b.v);
    return (dual){q, over(a.d - times(q, b.d), b.v)};
}

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

typedef enum taut_kind {
    TAUT_CABLE,
    TAUT_WKB,
    TAUT_VARYING,
    TAUT_BODY,
    TAUT_HANGING,
    TAUT_GROUND,
    TAUT_SUPPORT
} taut_kind;

typedef struct taut_link {
    double left, right, length; /* of its ends from the centre of mass; their sum */
    double mass, inertia;
    double pull; /* axial forces times arms: the stiffness that turning it meets, N m */
} taut_link;

typedef struct taut_joint {
    double stiffness, damping; /* N m, N m s */
} taut_joint;

/* A component made ready: checked, limits resolved (a locked joint makes one link of two, a
 * body without length is a point mass, and so on). */
typedef struct taut_component {
    taut_kind kind;
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
            taut_link *links;
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

struct strum_taut {
    atomic_uint references; /* the caller's, and one of each shape */
    bool free_left, free_right, damped;
    bool moves;     /* some component lets y differ at its ends */
    int dampers;    /* components with finite damping */
    double length;  /* m */
    double travel;  /* time a wave takes from end to end, s */
    double tension; /* mean along the length, N */
    size_t count;
    taut_component *components;
};

/* A counted reference, given back by strum_taut_free. */
strum_taut *taut_ref(const strum_taut *chain);

/* ---- component models: one file a physical model ---- */

/* cosh(g), sinh(g)/gamma and their derivatives for a wave of gamma^2 = q along `length`. */
void taut_wave(dual q, double length, dual *cosine, dual *sine, double *log_scale);
/* Zeros (half waves completed) up to phase `phase`, told apart by the sign of its computed
 * sine: never by comparing roundings of pi. */
long taut_half_waves(double phase, double sine);

void taut_cable_factor(const taut_component *c, const taut_at *at, taut_factor *f);
void taut_wkb_factor(const taut_component *c, const taut_at *at, taut_factor *f);
double taut_wkb_phase(const taut_component *c, double w);
void taut_varying_factor(const taut_component *c, const taut_at *at, taut_factor *f);
/* Modes of a varying cable with both ends held below w. */
long taut_varying_zeros(const taut_component *c, double w);
void taut_body_factor(const taut_component *c, const taut_at *at, taut_factor *f);
long taut_body_zeros(const taut_component *c, double w, double n12);
/* y at the count + 1 ends of the links, for the state (y, V) at the left end. */
void taut_body_joints(const taut_component *c, const taut_at *at, const cplx state[2], cplx *y);
strum_status taut_body_make(const strum_taut_component *given, taut_component *c,
                            strum_error *fault);
void taut_point_factor(const taut_component *c, const taut_at *at, taut_factor *f);

/* Time a wave takes through a component, s. */
double taut_travel_time(const taut_component *c);
/* Any component. */
void taut_component_factor(const taut_component *c, const taut_at *at, taut_factor *f);
/* The first `x` of a cable (uniform, WKB or varying) as a component of its own. */
taut_component taut_component_part(const taut_component *c, double x);

/* ---- shooting ---- */

/* A shot without damping at w: the mode count below w, the end condition f and df/dw, both
 * times 2^-exponent. */
typedef struct taut_shot {
    double w, f, df;
    long count, exponent;
} taut_shot;

void taut_shoot(const strum_taut *chain, double w, taut_shot *shot);

/* The characteristic function at a point, and its derivative along at's direction, both times
 * e^{-log_scale}. */
typedef struct taut_value {
    cplx f, d;
    double log_scale;
} taut_value;

void taut_characteristic(const strum_taut *chain, const taut_at *at, taut_value *value);

/* Typical distance of modes, rad/s. */
double taut_spacing(const strum_taut *chain);

/* ---- damped roots ---- */

/* Shared by the searches of one solve. */
typedef struct taut_search {
    const strum_taut *chain;
    work work;
    double spacing; /* typical distance of modes, rad/s */
    long evaluations;
    strum_status status; /* of the first failure; searches end early when not STRUM_OK */
} taut_search;

/* F and dF/ds at full damping. */
taut_value taut_search_value(taut_search *search, cplx s);
/* Newton's method at full damping from `s`; true when it converged. A real start stays real. */
bool taut_newton(taut_search *search, cplx *s);

/* ds/dfactor of a root, and about how far the nearest other root lies. */
cplx taut_speed(taut_search *search, cplx s, double factor, double *nearest);

typedef enum taut_branch_state {
    TAUT_OSCILLATES,
    TAUT_OVERDAMPED,
    TAUT_LOST
} taut_branch_state;

/* One branch at some damping: s[0] (upper half plane) or the two real roots. */
typedef struct taut_branch {
    long mode;
    double factor;
    taut_branch_state state;
    cplx s[2];
} taut_branch;

/* From mode `mode` with undamped frequency w whose neighbours lie `gap` away. */
void taut_branch_start(taut_branch *branch, long mode, double w);
/* On to a larger factor; branch->state says what became of it. `reach` (<= 1) shortens steps.
 */
void taut_branch_follow(taut_search *search, taut_branch *branch, double gap, double factor,
                        double reach);

/* Zeros in [re_lo, re_hi] x [im_lo, im_hi] of the s plane; -1 when a zero lies on the boundary.
 * im_lo < 0 = -im_hi: symmetric, only the upper half is walked. */
typedef struct taut_rectangle {
    double re_lo, re_hi, im_lo, im_hi;
} taut_rectangle;

long taut_count_zeros(taut_search *search, const taut_rectangle *box);
/* Adds to roots[*known] (room for `room`) the zeros in `box` that are missing among them, which
 * number `expected` - those known. Roots in the lower half plane are never stored. */
void taut_find_missing(taut_search *search, const taut_rectangle *box, long expected,
                       cplx *roots, size_t *known, size_t room);
bool taut_inside(const taut_rectangle *box, cplx s);
/* Does the list hold s (to the digits that a root has)? */
bool taut_known(const cplx *roots, size_t count, cplx s, double tolerance);

/* Muller's method from guess i w_k, deflated by what it found; see taut_muller.c. */
bool taut_muller(taut_search *search, cplx guess, const cplx *found, size_t count, cplx *root);

#endif
