/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The second method of forced motion: the first-order system of catenary.h,
 *     X_chi = cosh(chi) C F,
 *     F_chi = cosh(chi) [tt' a_t + nn' a_n] X,
 *     a = m s^2 + eta s,
 * from X = 0 at end 1 for two starting forces, and out of plane
 *     W_chi = (1 + kappa_n cosh(chi)) V,
 *     V_chi = a_n cosh(chi) W.
 * The combination that meets the motion of end 2 is the answer.
 */
#include <complex.h>
#include <math.h>

#include <strum/forced.h>

#include "core/numerics/arena.h"
#include "core/numerics/extrapolation.h"
#include "core/suspended/forced/modal.h"
#include "core/suspended/modes.h"

/* X, F for two starting forces, then W and V: ten complex numbers. */
#define STATE 20

typedef struct system_data {
    const strum_cable *cable;
    double _Complex a_t, a_n;
} system_data;

static double _Complex get(const double *y, int i)
{
    return CMPLX(y[2 * i], y[2 * i + 1]);
}

static void put(double *y, int i, double _Complex value)
{
    y[2 * i] = creal(value);
    y[2 * i + 1] = cimag(value);
}

static void slope_at(void *data, double chi, const double *y, double *dy)
{
    const system_data *d = data;
    const double c = cosh(chi), t[2] = {1 / c, tanh(chi)}, n[2] = {-t[1], t[0]};
    for (int start = 0; start < 2; start++) {
        const int x = 4 * start, f = x + 2;
        const double _Complex tf = t[0] * get(y, f) + t[1] * get(y, f + 1);
        const double _Complex nf = n[0] * get(y, f) + n[1] * get(y, f + 1);
        const double _Complex tx = t[0] * get(y, x) + t[1] * get(y, x + 1);
        const double _Complex nx = n[0] * get(y, x) + n[1] * get(y, x + 1);
        for (int i = 0; i < 2; i++) {
            put(dy, x + i,
                c * d->cable->kappa_t * tf * t[i] + (1 + c * d->cable->kappa_n) * nf * n[i]);
            put(dy, f + i, c * (d->a_t * tx * t[i] + d->a_n * nx * n[i]));
        }
    }
    put(dy, 8, (1 + c * d->cable->kappa_n) * get(y, 9));
    put(dy, 9, c * d->a_n * get(y, 8));
}

/* A slope takes about so long. */
#define SLOPE_US 0.2

/* Integrates to each point in turn; `states` gets STATE doubles a point, and at end 2. */
static strum_status integrate(system_data *data, const strum_forced_point *points, size_t count,
                              double *states, work *w)
{
    /* displacements and forces of each start, then W, then V */
    static const int block[STATE] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2,
                                     2, 2, 3, 3, 3, 3, 4, 4, 5, 5};
    const strum_cable *cable = data->cable;
    extrapolation e = {.size = STATE,
                       .slope = slope_at,
                       .data = data,
                       .block = block,
                       .tolerance = 1e-13,
                       .step = 1e-2 * cable->mu,
                       .steps_max = STRUM_SHOOT_STEPS_MAX,
                       .slope_us = SLOPE_US};
    double y[STATE] = {0}, chi = cable->chi_m - cable->mu;
    put(y, 2, 1);
    put(y, 7, 1);
    put(y, 9, 1);
    strum_status status = STRUM_OK;
    for (size_t i = 0; i <= count && status == STRUM_OK; i++) {
        const double to = i < count ? points[i].chi : cable->chi_m + cable->mu;
        status = extrapolation_advance(&e, &chi, to, y, w);
        for (size_t j = 0; j < STATE; j++)
            states[i * STATE + j] = y[j];
    }
    return status;
}

strum_status strum_forced_shoot(const strum_cable *cable, double frequency,
                                const strum_end_motion *motion, strum_forced_point *points,
                                size_t count, const strum_options *options, strum_error *error)
{
    const strum_status checked = spectrum_check_cable(cable, error);
    if (checked != STRUM_OK) {
        if (error != NULL)
            error->argument = STRUM_FORCED_ARG_CABLE;
        return checked;
    }
    if (!(isfinite(frequency) && frequency >= 0))
        return error_at(error, STRUM_ERR_RANGE, STRUM_FORCED_ARG_FREQUENCY, STRUM_NO_INDEX,
                        "the frequency must not be negative");
    const double _Complex s = CMPLX(0, frequency);
    system_data data = {cable, s * (cable->mass_t * s + cable->eta_t),
                        s * (cable->mass_n * s + cable->eta_n)};
    work spent = work_begin(options);
    arena memory = {.work = &spent};
    double *states = arena_doubles(&memory, (count + 1) * STATE);
    if (states == NULL)
        return work_result(&spent, STRUM_ERR_MEMORY, error);
    const strum_status status = integrate(&data, points, count, states, &spent);
    if (status != STRUM_OK) {
        arena_free(&memory);
        return status == STRUM_ERR_ACCURACY
                   ? error_set(error, status,
                               "the integration along the cable needs more than %d steps, or "
                               "overflows",
                               STRUM_SHOOT_STEPS_MAX)
                   : work_error(&spent, error);
    }
    const double *end = states + count * STATE;
    const double chi_2 = cable->chi_m + cable->mu, c = cosh(chi_2);
    const double _Complex d[2] = {motion->tangential / c - motion->normal * tanh(chi_2),
                                  motion->tangential * tanh(chi_2) + motion->normal / c};
    const double _Complex x11 = get(end, 0), x21 = get(end, 1), x12 = get(end, 4),
                          x22 = get(end, 5);
    const double _Complex det = x11 * x22 - x12 * x21;
    const double _Complex k[2] = {(d[0] * x22 - d[1] * x12) / det,
                                  (d[1] * x11 - d[0] * x21) / det};
    const double _Complex w = motion->out_of_plane / get(end, 8);
    for (size_t i = 0; i < count; i++) {
        const double *y = states + i * STATE, cosh_chi = cosh(points[i].chi);
        const double t[2] = {1 / cosh_chi, tanh(points[i].chi)};
        double _Complex z[4]; /* X, F */
        for (int j = 0; j < 4; j++)
            z[j] = k[0] * get(y, j) + k[1] * get(y, 4 + j);
        points[i].tangential = t[0] * z[0] + t[1] * z[1];
        points[i].normal = -t[1] * z[0] + t[0] * z[1];
        points[i].tension = t[0] * z[2] + t[1] * z[3];
        points[i].out_of_plane = w * get(y, 8);
    }
    arena_free(&memory);
    return STRUM_OK;
}

strum_status strum_response_verify(const strum_response *response, const strum_options *options,
                                   double *tension, double *displacement, strum_error *error)
{
    enum { POINTS = 33 };
    strum_forced_point shot[POINTS], at;
    const strum_cable *cable = &response->forced->cable;
    for (int i = 0; i < POINTS; i++)
        shot[i].chi = cable->chi_m + cable->mu * (2.0 * i / (POINTS - 1) - 1);
    const strum_status status = strum_forced_shoot(
        cable, response->frequency, &response->motion, shot, POINTS, options, error);
    double dt = 0, dx = 0, most_t = 0, most_x = 0;
    for (int i = 0; i < POINTS && status == STRUM_OK; i++) {
        strum_response_at(response, shot[i].chi, &at);
        dt = fmax(dt, cabs(at.tension - shot[i].tension));
        most_t = fmax(most_t, cabs(shot[i].tension));
        dx = fmax(dx, cabs(at.tangential - shot[i].tangential) +
                          cabs(at.normal - shot[i].normal) +
                          cabs(at.out_of_plane - shot[i].out_of_plane));
        most_x = fmax(most_x, cabs(shot[i].tangential) + cabs(shot[i].normal) +
                                  cabs(shot[i].out_of_plane));
    }
    *tension = most_t > 0 ? dt / most_t : 0;
    *displacement = most_x > 0 ? dx / most_x : 0;
    return status;
}
