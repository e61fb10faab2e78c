/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * An oracle for characteristic roots that shares nothing with the Galerkin methods: the
 * first-order system X_chi = cosh(chi) [tt' kappa_t + nn' (1/S + kappa_n)] F, F_chi = cosh(chi)
 * [tt' (m_t s^2 + eta_t s) + nn' (m_n s^2 + eta_n s)] X is integrated from X = 0 at end 1 by an
 * eighth-order Runge-Kutta method for two starting forces. s is a root where the 2 x 2 matrix
 * of the displacements at end 2 is singular.
 */
#ifndef TESTS_SHOOTING_H
#define TESTS_SHOOTING_H

#include <complex.h>
#include <gsl/gsl_odeiv2.h>

#include <strum/catenary.h>

#include "check.h"

typedef struct shooting {
    const strum_cable *cable;
    double _Complex s;
} shooting;

static int shooting_slope(double chi, const double y[], double dy[], void *data)
{
    const shooting *shot = data;
    const strum_cable *k = shot->cable;
    const double c = cosh(chi), t[2] = {1 / c, tanh(chi)}, n[2] = {-t[1], t[0]};
    const double _Complex s = shot->s;
    const double _Complex along = k->mass_t * s * s + k->eta_t * s;
    const double _Complex across = k->mass_n * s * s + k->eta_n * s;
    for (int column = 0; column < 2; column++) {
        const double *z = y + 8 * column;
        double *dz = dy + 8 * column;
        double _Complex x[2], f[2];
        for (int i = 0; i < 2; i++) {
            x[i] = CMPLX(z[2 * i], z[2 * i + 1]);
            f[i] = CMPLX(z[4 + 2 * i], z[5 + 2 * i]);
        }
        const double _Complex tf = t[0] * f[0] + t[1] * f[1], nf = n[0] * f[0] + n[1] * f[1];
        const double _Complex tx = t[0] * x[0] + t[1] * x[1], nx = n[0] * x[0] + n[1] * x[1];
        for (int i = 0; i < 2; i++) {
            const double _Complex dx =
                c * (t[i] * k->kappa_t * tf + n[i] * (1 / c + k->kappa_n) * nf);
            const double _Complex df = c * (t[i] * along * tx + n[i] * across * nx);
            dz[2 * i] = creal(dx);
            dz[2 * i + 1] = cimag(dx);
            dz[4 + 2 * i] = creal(df);
            dz[5 + 2 * i] = cimag(df);
        }
    }
    return 0;
}

/* Determinant of the end displacements at s; *scale is the size of its terms. */
static double _Complex shooting_determinant(const strum_cable *cable, double _Complex s)
{
    shooting shot = {cable, s};
    gsl_odeiv2_system system = {shooting_slope, NULL, 16, &shot};
    gsl_odeiv2_driver *driver =
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-3, 1e-13, 1e-13);
    double y[16] = {0};
    /* starting forces along and across the tangent at end 1 */
    const double chi_1 = cable->chi_m - cable->mu, c = cosh(chi_1);
    y[4] = 1 / c;
    y[6] = tanh(chi_1);
    y[12] = -tanh(chi_1);
    y[14] = 1 / c;
    double at = chi_1;
    assert_int_equal(gsl_odeiv2_driver_apply(driver, &at, cable->chi_m + cable->mu, y), 0);
    gsl_odeiv2_driver_free(driver);
    return CMPLX(y[0], y[1]) * CMPLX(y[10], y[11]) - CMPLX(y[2], y[3]) * CMPLX(y[8], y[9]);
}

/* Relative distance from s to the nearest root, by one Newton step with a difference
 * derivative. */
static double shooting_error(const strum_cable *cable, double _Complex s)
{
    const double h = 1e-5;
    const double _Complex d = shooting_determinant(cable, s);
    const double _Complex slope =
        (shooting_determinant(cable, s * (1 + h)) - shooting_determinant(cable, s * (1 - h))) /
        (2 * h);
    return cabs(d / slope);
}

#endif
