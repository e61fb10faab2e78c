/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A cable whose tension varies linearly, exactly: (T y')' = rho s^2 y. Its solutions are Bessel
 * functions of order 0 of u = 2 w sqrt(rho T)/|T'|, w = -i s; V = T y' = -(T'/2) u (order 1).
 * Where |u| >= 20 on a stretch, Hankel's expansions give it in one step whatever the number of
 * waves (smallest term e^{-2 |u|} < 1e-17); below, power series about successive points.
 */
#include "core/taut/assembly.h"
#include "core/taut/shape.h"

#define HANKEL_FROM 20.0
/* Largest |change of T|/T and |rho s^2 h^2/T| of one power series. */
#define SERIES_SLOPE 0.4
#define SERIES_WAVE  2.0

static const cplx imaginary = CMPLX(0.0, 1.0);

typedef struct stretch {
    double t0, t1, slope, mass; /* tensions at its ends, T' */
} stretch;

static int series_steps(const stretch *p, cplx s)
{
    const double u = 2.0 * cabs(s) * sqrt(p->mass * fmax(p->t0, p->t1)) / fabs(p->slope);
    /* geometric steps T -> r T: |rho s^2 h^2/T| <= (u (r - 1)/2)^2 */
    const double ratio = fmin(SERIES_SLOPE, 2.0 * sqrt(SERIES_WAVE) / u);
    return (int)fmin(fmax(ceil(fabs(log(p->t1 / p->t0)) / log1p(ratio)), 1.0), 1e6);
}

/* y = sum alpha_n x^n with x from 0 to 1 over the step h:
 * alpha_{n+2} = [Q alpha_n - tau (n+1)^2 alpha_{n+1}]/((n+1)(n+2)), Q = rho s^2 h^2/T0,
 * tau = T' h/T0. */
static void series(const stretch *p, const taut_at *at, taut_factor *f)
{
    const double h = (p->t1 - p->t0) / p->slope, tau = (p->t1 - p->t0) / p->t0;
    const dual q = dual_scale(p->mass * h * h / p->t0, dual_mul(at->s, at->s));
    dual value[2], slope[2];
    for (int k = 0; k < 2; k++) {
        dual a = dual_of(k == 0), b = dual_of(k == 0 ? 0.0 : h / p->t0);
        value[k] = dual_add(a, b);
        slope[k] = b;
        for (int n = 0; n < 100; n++) {
            const double m = n + 1;
            const dual next = dual_scale(1.0 / (m * (m + 1)),
                                         dual_sub(dual_mul(q, a), dual_scale(tau * m * m, b)));
            value[k] = dual_add(value[k], next);
            slope[k] = dual_add(slope[k], dual_scale(m + 1, next));
            a = b;
            b = next;
            const double small = 1e-19 * cabs(value[k].v);
            if (n > 4 && cabs(a.v) <= small && cabs(b.v) <= small / 100.0)
                break;
        }
    }
    *f = (taut_factor){.den = {1.0, 0.0}};
    f->n11 = value[0];
    f->n12 = value[1];
    f->n21 = dual_scale(p->t1 / h, slope[0]);
    f->n22 = dual_scale(p->t1 / h, slope[1]);
}

/* P +- i Q of Hankel's expansion of order nu (Watson, 7.2): sum (+-i)^k a_k/u^k,
 * a_k = a_{k-1} (4 nu^2 - (2k-1)^2)/(8 k). */
static void hankel(double order, dual u, dual *upper, dual *lower)
{
    const cplx x = over(1.0, u.v);
    cplx sum[2] = {1.0, 0.0}, derivative[2] = {0.0, 0.0}, power = 1.0;
    double a = 1.0, last = INFINITY;
    for (int k = 1; k < 60; k++) {
        a *= (4.0 * order * order - (2.0 * k - 1.0) * (2.0 * k - 1.0)) / (8.0 * k);
        const double sign = (k & 2) ? -1.0 : 1.0;
        derivative[k & 1] += sign * k * a * power;
        power = times(power, x);
        const double size = fabs(a) * cabs(power);
        if (size > last)
            break; /* past the smallest term */
        sum[k & 1] += sign * a * power;
        last = size;
        if (size < 1e-18)
            break;
    }
    const cplx dx = -times(times(x, x), u.d), iq = times(imaginary, sum[1]);
    const cplx dp = times(derivative[0], dx), diq = times(imaginary, times(derivative[1], dx));
    *upper = (dual){sum[0] + iq, dp + diq};
    *lower = (dual){sum[0] - iq, dp - diq};
}

/* F = Phi(u1) Phi(u0)^{-1}, Phi of H_0^(1), H_0^(2); the phase u1 - u0 without cancellation.
 * `turns` (may be NULL): zeros with both ends held, s = i w. */
static void asymptotic(const stretch *p, const taut_at *at, taut_factor *f, long *zeros)
{
    const double sign = p->slope > 0.0 ? 1.0 : -1.0;
    const double root = sqrt(p->mass), length = (p->t1 - p->t0) / p->slope;
    dual w = {times(-imaginary, at->s.v), times(-imaginary, at->s.d)};
    if (creal(w.v) < 0.0)
        w = dual_scale(-1.0, w); /* everything is even in w */
    const dual u0 = dual_scale(2.0 * root * sqrt(p->t0) / fabs(p->slope), w);
    const dual u1 = dual_scale(2.0 * root * sqrt(p->t1) / fabs(p->slope), w);
    const double travel = 2.0 * root * length / (sqrt(p->t0) + sqrt(p->t1));
    const dual phase = dual_scale(sign * travel, w);
    dual p0, q0, p1, q1, r0, t0, r1, t1; /* order 0: p, q; order 1: r, t */
    hankel(0.0, u0, &p0, &q0);
    hankel(0.0, u1, &p1, &q1);
    hankel(1.0, u0, &r0, &t0);
    hankel(1.0, u1, &r1, &t1);
    const double grow = fabs(cimag(phase.v));
    const cplx up = cexp(times(imaginary, phase.v) - grow);
    const cplx down = cexp(-times(imaginary, phase.v) - grow);
    const dual e = {up, times(times(imaginary, phase.d), up)};
    const dual g = {down, -times(times(imaginary, phase.d), down)};
    const double z = sqrt(p->mass * sqrt(p->t0 * p->t1)), ratio = pow(p->t0 / p->t1, 0.25);
    *f = (taut_factor){.den = {1.0, 0.0}, .log_scale = grow};
    const dual y_v = dual_sub(dual_mul(e, dual_mul(p1, q0)), dual_mul(g, dual_mul(q1, p0)));
    const dual v_y = dual_sub(dual_mul(e, dual_mul(r1, t0)), dual_mul(g, dual_mul(t1, r0)));
    const dual zw = dual_scale(sign * z, w);
    const dual half_i = {0.5 * imaginary, 0.0};
    f->n11 = dual_scale(0.5 * ratio,
                        dual_add(dual_mul(e, dual_mul(p1, t0)), dual_mul(g, dual_mul(q1, r0))));
    f->n12 = dual_div(dual_scale(-1.0, dual_mul(half_i, y_v)), zw);
    f->n21 = dual_mul(dual_mul(half_i, zw), v_y);
    f->n22 = dual_scale(0.5 / ratio,
                        dual_add(dual_mul(e, dual_mul(r1, q0)), dual_mul(g, dual_mul(t1, p0))));
    if (zeros != NULL) /* M(u0) M(u1) sin(theta(u1) - theta(u0)) */
        *zeros =
            taut_half_waves(fabs(creal(phase.v) + carg(times(p1.v, q0.v))), creal(f->n12.v));
}

static void factor_join(taut_factor *f, const taut_factor *next)
{
    const taut_factor a = *f;
    f->n11 = dual_add(dual_mul(next->n11, a.n11), dual_mul(next->n12, a.n21));
    f->n12 = dual_add(dual_mul(next->n11, a.n12), dual_mul(next->n12, a.n22));
    f->n21 = dual_add(dual_mul(next->n21, a.n11), dual_mul(next->n22, a.n21));
    f->n22 = dual_add(dual_mul(next->n21, a.n12), dual_mul(next->n22, a.n22));
    f->log_scale = a.log_scale + next->log_scale;
}

/* Appends a stretch to `f`, and its zeros to those of the solution that starts with y = 0. */
static void append(const stretch *p, const taut_at *at, bool by_series, taut_factor *f,
                   long *zeros)
{
    const int steps = by_series ? series_steps(p, at->s.v) : 1;
    for (int i = 0; i < steps; i++) {
        stretch part = *p;
        part.t0 = p->t0 * pow(p->t1 / p->t0, (double)i / steps);
        part.t1 = i + 1 == steps ? p->t1 : p->t0 * pow(p->t1 / p->t0, (i + 1.0) / steps);
        if (part.t1 == part.t0)
            continue; /* the whole change of tension is one rounding */
        taut_factor next;
        long inside = 0;
        if (by_series)
            series(&part, at, &next);
        else
            asymptotic(&part, at, &next, zeros != NULL ? &inside : NULL);
        const bool before = signbit(creal(f->n12.v));
        factor_join(f, &next);
        if (zeros != NULL)
            *zeros += inside + (before ^ (signbit(creal(f->n12.v)) != 0) ^
                                (signbit(creal(next.n12.v)) != 0));
    }
}

static void varying(const taut_component *c, const taut_at *at, taut_factor *f, long *zeros)
{
    stretch whole = {c->varying.tension_0, c->varying.tension_1, 0.0, c->varying.mass};
    whole.slope = (whole.t1 - whole.t0) / c->length;
    *f = (taut_factor){.n11 = {1.0, 0.0}, .n22 = {1.0, 0.0}, .den = {1.0, 0.0}};
    /* tension at which |u| = HANKEL_FROM */
    const double border = HANKEL_FROM * fabs(whole.slope) / (2.0 * cabs(at->s.v));
    const double split = border * border / whole.mass;
    const double low = fmin(whole.t0, whole.t1), high = fmax(whole.t0, whole.t1);
    if (series_steps(&whole, at->s.v) <= 4 || split >= high) {
        append(&whole, at, true, f, zeros);
    } else if (split <= low) {
        append(&whole, at, false, f, zeros);
    } else {
        stretch left = whole, right = whole;
        left.t1 = right.t0 = split;
        append(&left, at, whole.t0 < whole.t1, f, zeros);
        append(&right, at, whole.t0 > whole.t1, f, zeros);
    }
}

static void varying_factor(const taut_component *c, const taut_at *at, taut_factor *f)
{
    varying(c, at, f, NULL);
}

static long varying_zeros(const taut_component *c, double w, const taut_factor *f)
{
    const taut_at at = taut_at_s(CMPLX(0.0, w), 0.0);
    taut_factor again;
    long zeros = 0;
    (void)f;
    varying(c, &at, &again, &zeros);
    return zeros;
}

static void varying_place(taut_cursor *at, const taut_component *c)
{
    const taut_element_cable cable = {.length = c->length,
                                      .tension_0 = c->varying.tension_0,
                                      .tension_1 = c->varying.tension_1,
                                      .mass = c->varying.mass};
    taut_elements_place(at, &cable);
}

static const taut_model varying_model = {
    .states = 2,
    .flexible = true,
    .factor = varying_factor,
    .zeros = varying_zeros,
    .travel_time = taut_varying_travel_time,
    .part = taut_varying_part,
    .inside = taut_part_inside,
    .survey = taut_varying_survey,
    .place = varying_place,
};

/* ---- making one ready ---- */

static const char *varying_fault(const strum_taut_component *g)
{
    if (fmax(g->tension_left, g->tension_right) >
        STRUM_TAUT_TENSION_FACTOR_MAX * fmin(g->tension_left, g->tension_right))
        return "the tensions of a varying cable differ by a factor of 1e9 at most";
    return taut_positive(g->varying.length) && taut_positive(g->varying.mass_per_length)
               ? NULL
               : "length and mass must be positive";
}

static strum_status varying_make(const strum_taut_component *g, taut_component *c,
                                 strum_error *error)
{
    (void)error;
    c->length = g->varying.length;
    if (g->tension_left == g->tension_right) {
        taut_cable_set(c, g->tension_left, g->varying.mass_per_length, 0.0);
        return STRUM_OK;
    }
    c->model = g->varying.wkb ? &taut_wkb : &varying_model;
    c->varying.tension_0 = g->tension_left;
    c->varying.tension_1 = g->tension_right;
    c->varying.mass = g->varying.mass_per_length;
    return STRUM_OK;
}

const taut_kind taut_varying_kind = {true, varying_fault, varying_make};
