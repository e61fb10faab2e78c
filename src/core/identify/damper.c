/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A string with a damper to ground at a share x/L of its length: sin z + i R sin(z x/L)
 * sin(z (1 - x/L)) = 0, z = w L sqrt(m/T), R = c/sqrt(T m). Each mode is followed from R = 0: one
 * damping ratio belongs to two dampers, and a search would not know which branch it met. */
#include "core/identify/problem.h"

#include <complex.h>

#define NEWTON_MAX   12
#define HALVINGS_MAX 200

typedef struct damped {
    double _Complex z, by_r; /* root, and its derivative */
} damped;

/* Newton's method from a guess; false where it goes far away or not at all. */
static bool correct(double r, double share, double _Complex *z, double near,
                    double _Complex *by_r)
{
    for (int i = 0; i < NEWTON_MAX; i++) {
        const double other = 1 - share;
        const double _Complex s1 = csin(*z * share), c1 = ccos(*z * share);
        const double _Complex s2 = csin(*z * other), c2 = ccos(*z * other);
        const double _Complex f = csin(*z) + I * r * s1 * s2;
        const double _Complex f_z = ccos(*z) + I * r * (share * c1 * s2 + other * s1 * c2);
        const double _Complex d = f / f_z;
        *by_r = -I * s1 * s2 / f_z;
        if (!isfinite(creal(d)) || !isfinite(cimag(d)) || cabs(d) > near)
            return false;
        *z -= d;
        if (cabs(d) < 1e-12 * cabs(*z))
            return true;
    }
    return false;
}

/* In t = R/(R + R0), R0 = 1/(n pi x/L): about half a circle from t = 0 to 1. */
static bool follow(int n, double share, double r, damped *out)
{
    const double r0 = 1 / (n * M_PI * share), end = r / (r + r0);
    double t = 0, dt = 0.12;
    double _Complex z = n * M_PI,
                    by_r = -I * csin(z * share) * csin(z * (1 - share)) * (n % 2 ? -1 : 1);
    for (int i = 0; i < HALVINGS_MAX && t < end; i++) {
        const double to = t + dt < end ? t + dt : end;
        const double r_from = r0 * t / (1 - t), r_to = to < end ? r0 * to / (1 - to) : r;
        /* dR/dt = R0/(1 - t)^2 */
        const double _Complex ahead = by_r * r0 / (1 - t) / (1 - t) * (to - t);
        double _Complex next = z + ahead, slope = by_r;
        (void)r_from;
        if (cabs(ahead) < 0.3 && correct(r_to, share, &next, 0.1, &slope)) {
            z = next;
            by_r = slope;
            t = to;
            dt = fmin(1.5 * dt, 0.12);
        } else {
            dt /= 2;
        }
    }
    *out = (damped){z, by_r};
    return t >= end;
}

static double ratio_of(double _Complex z)
{
    return cimag(z) / cabs(z);
}

/* d(Im z/|z|) = (Re z dIm - Im z dRe) Re z/|z|^3 */
static double ratio_slope(double _Complex z, double _Complex dz)
{
    const double size = cabs(z);
    return creal(z) * (creal(z) * cimag(dz) - cimag(z) * creal(dz)) / (size * size * size);
}

strum_status model_predict_damper(const problem *p, const state *s, prediction *out)
{
    const double mass = state_mass(p, s), share = p->damper_position / s->q[LENGTH];
    const double r = s->q[DAMPING] / sqrt(s->q[TENSION] * mass);
    const double scale = sqrt(s->q[TENSION] / mass) / (2 * M_PI * s->q[LENGTH]);
    const double mass_share = s->q[MASS] / mass;
    const strum_status status = work_spend(p->work, 8.0 * (double)p->count);
    for (size_t i = 0; i < p->count && status == STRUM_OK; i++) {
        damped d;
        const bool ratio = i >= p->ratios_at;
        prediction *o = &out[i];
        *o = (prediction){.value = HUGE_VAL};
        if (p->skip[i] || !follow(p->modes[i], share, r, &d))
            continue;
        const double by_ln_r = r * (ratio ? ratio_slope(d.z, d.by_r) : scale * creal(d.by_r));
        o->value = ratio ? ratio_of(d.z) : scale * creal(d.z);
        o->by[DAMPING] = by_ln_r;
        o->by[TENSION] = -0.5 * by_ln_r + (ratio ? 0 : 0.5 * o->value);
        o->by[MASS] = mass_share * (-0.5 * by_ln_r - (ratio ? 0 : 0.5 * o->value));
        o->tension = 1;
    }
    return status;
}

bool damper_best(int n, double share, double *ratio, double *r)
{
    const double r0 = 1 / (n * M_PI * share);
    double low = -9, high = 9; /* of ln R/R0: the slope falls through 0 between */
    damped d;
    for (int i = 0; i < 60; i++) {
        const double middle = 0.5 * (low + high);
        if (!follow(n, share, r0 * exp(middle), &d))
            return false;
        *(ratio_slope(d.z, d.by_r) > 0 ? &low : &high) = middle;
    }
    *ratio = ratio_of(d.z);
    *r = r0 * exp(0.5 * (low + high));
    return true;
}
