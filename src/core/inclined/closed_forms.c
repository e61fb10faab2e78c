/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The report's closed forms, with x = kL/2:
 *   (11), (20)  sin x {x cos x (4 x^2/lambda^2 - 1) + sin x} = 0           (Irvine)
 *   (21)        the same - (49/64) epsilon^2 sin^2(phi_a) cos 2x = 0
 * and the shapes (34), (37) and tension (38) that belong to them, errata mended: the last group
 * of (34) carries sin^2(phi_a), and the w of (34) goes with the u of (37) times
 * epsilon cos(phi_a)/kL.
 */
#include <complex.h>
#include <math.h>

#include <strum/handbook.h>

#include "core/inclined/approximation.h"
#include "core/numerics/bracket.h"

typedef struct closed {
    double four;     /* 4/lambda^2; 0: inextensible */
    double coupling; /* (49/64) epsilon^2 sin^2(phi_a), 0 for (11) */
} closed;

static closed closed_of(const strum_inclined *m)
{
    const double slope = m->cable.epsilon * sin(m->cable.inclination);
    return (closed){.four = 4 / m->cable.lambda_squared,
                    .coupling =
                        m->kind == STRUM_INCLINED_ASYMPTOTIC ? 49.0 / 64 * slope * slope : 0};
}

static double characteristic(double x, const void *data)
{
    const closed *c = data;
    return sin(x) * (sin(x) + x * cos(x) * (c->four * x * x - 1)) - c->coupling * cos(2 * x);
}

static double _Complex analytic(const strum_inclined *m, double _Complex kl)
{
    const closed c = closed_of(m);
    const double _Complex x = kl / 2, s = csin(x);
    return s * (s + x * ccos(x) * (c.four * x * x - 1)) - c.coupling * ccos(2 * x);
}

/* The next root of (11), antisymmetric before symmetric where they coincide: `sines` and
 * `others` count those of either factor that came before. */
static inclined_wave next_uncoupled(double lambda_squared, int *sines, int *others)
{
    const double sine = 2 * M_PI * (*sines + 1);
    const double other = strum_handbook_root(lambda_squared, *others + 1);
    const bool antisymmetric = sine <= other;
    (*(antisymmetric ? sines : others))++;
    return (inclined_wave){.kl = antisymmetric ? sine : other,
                           .symmetry = antisymmetric ? STRUM_ANTISYMMETRIC : STRUM_SYMMETRIC};
}

/* Measured, as for Airy's. */
static double work_us(const strum_cable *mechanics, int count, double size)
{
    (void)mechanics;
    return count * (25 + 0.001 * size * size);
}

/* (21) has one root between the midpoints of neighbouring roots of (11), and one more, which no
 * cable has, below them all: at x = 0 the coupling alone remains. */
static strum_status roots(const strum_inclined *m, int count, inclined_wave *waves,
                          double *spurious, work *w)
{
    const closed c = closed_of(m);
    int sines = 0, others = 0;
    inclined_wave here = next_uncoupled(m->cable.lambda_squared, &sines, &others);
    double low = 0.3 * here.kl; /* in x: 0.6 of the first root */
    *spurious = 0;
    if (c.coupling > 0 && characteristic(low, &c) > 0)
        *spurious = 2 * bracket_root(characteristic, &c, 0, low);
    for (int i = 0; i < count; i++) {
        const strum_status status = work_spend(w, work_us(NULL, 1, m->size));
        if (status != STRUM_OK)
            return status;
        const inclined_wave next = next_uncoupled(m->cable.lambda_squared, &sines, &others);
        const double high = (here.kl + next.kl) / 4;
        waves[i] = here;
        if (c.coupling > 0) {
            if ((characteristic(low, &c) > 0) == (characteristic(high, &c) > 0))
                return STRUM_ERR_METHOD;
            waves[i].kl = 2 * bracket_root(characteristic, &c, low, high);
            waves[i].symmetry = STRUM_NO_SYMMETRY;
        }
        here = next;
        low = high;
    }
    return STRUM_OK;
}

/* Shapes of (11): (28), (35), (38) without epsilon, divided by 2 sin^2 x where that is not 0.
 */
static void uncoupled_sample(const inclined_wave *wave, double slope, strum_inclined_point *out)
{
    const double kl = wave->kl, angle = kl * out->s;
    if (wave->symmetry == STRUM_ANTISYMMETRIC) {
        out->transverse = sin(angle);
        out->longitudinal = slope / kl * (1 - cos(angle));
        out->tension = 0;
        return;
    }
    const double t = tan(kl / 2);
    out->transverse = cos(angle) - 1 + t * sin(angle);
    out->longitudinal = slope / kl * (sin(angle) - 2 * t * out->s - t * (cos(angle) - 1));
    out->tension = kl * kl / slope;
}

static void sample(const strum_inclined *m, const inclined_wave *wave, double x, double phase,
                   strum_inclined_point *out)
{
    (void)x;
    (void)phase;
    const double slope = m->cable.epsilon * cos(m->cable.inclination);
    if (wave->symmetry != STRUM_NO_SYMMETRY) {
        uncoupled_sample(wave, slope, out);
        return;
    }
    const double kl = wave->kl, s = out->s, middle = s - 0.5, angle = kl * s;
    const double e = m->cable.epsilon * sin(m->cable.inclination);
    const double sin_s = sin(angle), cos_s = cos(angle), twice = 2 * pow(sin(kl / 2), 2);
    const double excess = kl * (kl * kl / m->cable.lambda_squared - 1);
    const double bracket = sin(kl) + excess;
    const double sway = angle * (s - 1); /* kL s/L (s/L - 1) */
    out->transverse =                    /* (34) */
        twice * (cos_s - 1) - sin_s * bracket +
        e / 4 *
            (twice * (sway * sin_s - middle * cos_s) + 0.5 * cos_s * (15 - cos(kl)) +
             (sway * cos_s + (middle - 0.5) * sin_s) * bracket +
             4 * (-1 - 0.75 * cos(kl) + 2 * twice * middle)) +
        e * e *
            (3.5 * middle + 1.75 * cos_s - 7.0 / 16 * middle * cos_s - 7.0 / 32 +
             7.0 / 16 * sway * sin_s);
    out->longitudinal = /* (37) */
        slope / kl * (bracket * (cos_s - 1) + twice * (excess * s + sin_s) + 1.75 * e * sin_s);
    out->tension = kl * kl * (twice + 1.75 * e) / slope; /* (38) */
}

#define CLOSED_FORM                                                                            \
    APPROXIMATION, .work_us = work_us, .roots = roots, .function = analytic, .sample = sample

const inclined_model inclined_asymptotic = {
    .name = "asymptotic", .expansion = true, CLOSED_FORM};
const inclined_model inclined_irvine = {.name = "irvine", CLOSED_FORM};
