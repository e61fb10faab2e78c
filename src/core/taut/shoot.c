/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Shooting from the left end: the mode count without damping, and the characteristic function.
 *
 * The count (checked against Wittrick and Williams' on random chains): with y = 0, V = 1 (or y
 * = 1, V = 0 at a free end) at the left, J(w) = sum J0 + #{components with t12 != 0 and y_out
 * y_in t12 < 0}, J0 the modes of a component below w with both its ends held; at a free right
 * end one more when y V < 0. Only signs are looked at, a zero by its sign bit: so a node that
 * falls exactly on a joint counts once.
 */
#include "core/taut/taut.h"

/* Any component by its matrix at s = i w, where all of it is real; U = V/w. N without its
 * denominator turns the sign of the whole state at most, which no later count sees. */
static long shoot_matrix(const taut_component *c, double w, taut_station *p)
{
    const taut_at at = {{CMPLX(0.0, w), CMPLX(0.0, 1.0)}, {0.0, 0.0}};
    taut_factor f;
    c->model->factor(c, &at, &f);
    const double n11 = creal(f.n11.v), n12 = creal(f.n12.v), n21 = creal(f.n21.v),
                 n22 = creal(f.n22.v);
    const taut_station q = *p;
    /* without t12 a y of 0 keeps its sign bit: -0 + 0 would lose it */
    p->y = n12 != 0.0 ? n11 * q.y + n12 * w * q.u : n11 * q.y;
    p->u = n21 / w * q.y + n22 * q.u;
    p->dy =
        n11 * q.dy + n12 * w * q.du + creal(f.n11.d) * q.y + (creal(f.n12.d) * w + n12) * q.u;
    p->du = n21 / w * q.dy + n22 * q.du + (creal(f.n21.d) - n21 / w) / w * q.y +
            creal(f.n22.d) * q.u;
    long count = c->model->zeros != NULL ? c->model->zeros(c, w, &f) : 0;
    if (n12 != 0.0)
        count += (signbit(q.y) != 0) ^ (signbit(p->y) != 0) ^ (signbit(n12) != 0);
    return count;
}

/* Keeps the state near 1; powers of two change no digit. */
static void rescale(taut_station *p)
{
    const double size = fabs(p->y) + fabs(p->u);
    if (size > 0x1p-80 && size < 0x1p80)
        return;
    int exponent;
    frexp(size, &exponent);
    p->y = ldexp(p->y, -exponent);
    p->u = ldexp(p->u, -exponent);
    p->dy = ldexp(p->dy, -exponent);
    p->du = ldexp(p->du, -exponent);
    p->exponent += exponent;
}

double taut_shot_us(const strum_taut *chain)
{
    return 0.05 * (double)chain->count;
}

void taut_shoot(const strum_taut *chain, double w, taut_shot *shot)
{
    taut_station p = {.y = chain->free_left, .u = !chain->free_left};
    long count = 0;
    for (size_t i = 0; i < chain->count; i++) {
        const taut_component *c = &chain->components[i];
        count += c->model->shoot != NULL ? c->model->shoot(c, w, &p) : shoot_matrix(c, w, &p);
        rescale(&p);
    }
    if (chain->free_right)
        count += (signbit(p.y) != 0) ^ (signbit(p.u) != 0);
    *shot = (taut_shot){.w = w,
                        .f = chain->free_right ? p.u : p.y,
                        .df = chain->free_right ? p.du : p.dy,
                        .count = count,
                        .exponent = p.exponent};
}

long strum_taut_count(const strum_taut *chain, double frequency)
{
    taut_shot shot;
    taut_shoot(chain, frequency, &shot);
    return shot.count;
}

/* Largest of the four parts of y and V, which differ in unit: V is weighed by `force`. */
static double magnitude(dual y, dual v, double force)
{
    return fmax(fmax(fabs(creal(y.v)), fabs(cimag(y.v))),
                fmax(fabs(creal(v.v)), fabs(cimag(v.v))) / force);
}

void taut_characteristic(const strum_taut *chain, const taut_at *at, taut_value *value)
{
    dual y = dual_of(chain->free_left), v = dual_of(!chain->free_left);
    double log_scale = 0.0;
    for (size_t i = 0; i < chain->count; i++) {
        const taut_component *c = &chain->components[i];
        taut_factor f;
        c->model->factor(c, at, &f);
        log_scale += f.log_scale;
        const dual before = y;
        if (c->model->adds_only) {
            v = dual_add(v, dual_mul(f.n21, y));
        } else {
            y = dual_add(dual_mul(f.n11, y), dual_mul(f.n12, v));
            v = dual_add(dual_mul(f.n21, before), dual_mul(f.n22, v));
        }
        const double size = magnitude(y, v, 1e3);
        if (size < 0x1p-200 || size > 0x1p200) {
            int exponent;
            frexp(size, &exponent);
            y = dual_scale(ldexp(1.0, -exponent), y);
            v = dual_scale(ldexp(1.0, -exponent), v);
            log_scale += exponent * M_LN2;
        }
    }
    *value = chain->free_right ? (taut_value){v.v, v.d, log_scale}
                               : (taut_value){y.v, y.d, log_scale};
}
