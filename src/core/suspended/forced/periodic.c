/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The largest tension of a sum of harmonics over cable and period: the largest |S| of
 *     S(x, phase) = Re sum T_k(x) e^{i k_m phase}
 * on a grid of x and phase; every grid point above its neighbours that may hide the largest is
 * refined.
 */
#include <cblas.h>
#include <math.h>

#include "core/suspended/forced/modal.h"
#include "core/numerics/peak.h"

#define STEPS_A_WAVE 16 /* of the highest harmonic */
/* Values closer than this are equal; the first in time is the answer. */
#define TIED 1e-9

typedef struct sum {
    strum_response *const *responses;
    const int *multiples;
    int count, steps, samples;
    double *grid;              /* S at [phase + x steps] */
    double _Complex *tensions; /* of the harmonics at the last x */
    double centre, phase;      /* where the maximum in time is looked for, and found */
    double value;              /* S there */
} sum;

/* S and its first two derivatives by the phase. */
static void derivatives(const sum *s, double phase, double d[3])
{
    d[0] = d[1] = d[2] = 0;
    for (int k = 0; k < s->count; k++) {
        const double m = s->multiples[k];
        const double _Complex term = s->tensions[k] * cexp(CMPLX(0, m * phase));
        d[0] += creal(term);
        d[1] -= m * cimag(term);
        d[2] -= m * m * creal(term);
    }
}

/* The maximum of |S| at x within two steps of the grid: Newton's method, where the curve bends
 * down, else small steps up. */
static double largest_in_time(void *data, double x)
{
    sum *s = data;
    const double step = 2 * M_PI / s->steps;
    double _Complex slope;
    double d[3], phase = s->centre;
    for (int k = 0; k < s->count; k++)
        response_tension(s->responses[k], x, &s->tensions[k], &slope);
    for (int i = 0; i < 30; i++) {
        derivatives(s, phase, d);
        double move = d[0] * d[2] < 0 ? -d[1] / d[2] : copysign(step / 4, d[0] * d[1]);
        move = fmin(fmax(move, s->centre - 2 * step - phase), s->centre + 2 * step - phase);
        if (d[1] == 0 || fabs(move) < 1e-14)
            break;
        phase += move;
    }
    derivatives(s, phase, d);
    s->phase = phase;
    s->value = d[0];
    return fabs(d[0]);
}

static strum_status make_grid(sum *s, arena *a)
{
    const size_t n = (size_t)s->count, steps = (size_t)s->steps, samples = (size_t)s->samples;
    double *waves = arena_doubles(a, 2 * n * steps);
    double *tensions = arena_doubles(a, 2 * n * samples);
    s->grid = arena_doubles(a, steps * samples);
    s->tensions = arena_alloc(a, n, sizeof *s->tensions);
    if (waves == NULL || tensions == NULL || s->grid == NULL || s->tensions == NULL)
        return STRUM_ERR_MEMORY;
    for (size_t k = 0; k < n; k++) {
        double *c = waves + 2 * k * steps, *re = tensions + 2 * k * samples;
        for (size_t j = 0; j < steps; j++) {
            const double phase = 2 * M_PI * s->multiples[k] * (double)j / (double)steps;
            c[j] = cos(phase);
            c[j + steps] = -sin(phase);
        }
        response_sample(s->responses[k], re, re + samples);
    }
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, s->steps, s->samples, 2 * s->count, 1,
                waves, s->steps, tensions, s->samples, 0, s->grid, s->steps);
    return STRUM_OK;
}

/* Value at a grid point where its neighbours in x and phase are not larger, and what a maximum
 * beside it may reach; else -1. */
static double promise(const sum *s, int i, int j)
{
    const int n = s->steps, before = (j + n - 1) % n, after = (j + 1) % n;
    const double *column = s->grid + (size_t)i * (size_t)n, value = fabs(column[j]);
    const double earlier = fabs(column[before]), later = fabs(column[after]);
    if (earlier > value || later > value)
        return -1;
    const double in_time = peak_excess(earlier, value, later);
    if (i == 0 || i == s->samples - 1) {
        const double inside = fabs(column[i == 0 ? j + n : j - n]);
        return inside > value ? -1 : value * 1.02 + 2 * in_time;
    }
    const double left = fabs(column[j - n]), right = fabs(column[j + n]);
    return left > value || right > value
               ? -1
               : value + 2 * (in_time + peak_excess(left, value, right));
}

strum_status strum_periodic_peak_find(strum_response *const *responses, const int *multiples,
                                      size_t count, strum_periodic_peak *peak)
{
    int highest = 1;
    for (size_t k = 0; k < count; k++)
        highest = multiples[k] > highest ? multiples[k] : highest;
    const strum_forced *f = responses[0]->forced;
    sum s = {.responses = responses,
             .multiples = multiples,
             .count = (int)count,
             .steps = STEPS_A_WAVE * highest,
             .samples = f->samples};
    arena a = {0};
    if (make_grid(&s, &a) != STRUM_OK) {
        arena_free(&a);
        return STRUM_ERR_MEMORY;
    }
    double sampled = 0;
    for (int i = 0; i < s.steps * s.samples; i++)
        sampled = fmax(sampled, fabs(s.grid[i]));
    *peak = (strum_periodic_peak){.chi = f->cable.chi_m - f->cable.mu};
    for (int i = 0; i < s.samples && sampled > 0; i++)
        for (int j = 0; j < s.steps; j++) {
            const double largest = fabs(peak->tension);
            if (promise(&s, i, j) < fmax(sampled, largest))
                continue;
            const double step = 2.0 / (s.samples - 1), at = i * step - 1;
            double x;
            s.centre = 2 * M_PI * j / s.steps;
            (void)peak_golden(largest_in_time, &s, fmax(at - step, -1), fmin(at + step, 1), &x);
            const double found = largest_in_time(&s, x);
            double phase = fmod(s.phase + 2 * M_PI, 2 * M_PI);
            if (2 * M_PI - phase < 1e-9) /* of the period before */
                phase = 0;
            if (found > largest * (1 + TIED) ||
                (found > largest * (1 - TIED) && phase < peak->phase - TIED))
                *peak = (strum_periodic_peak){
                    s.value, f->cable.chi_m + mapping_offset(&f->coordinate, x), phase};
        }
    arena_free(&a);
    return STRUM_OK;
}
