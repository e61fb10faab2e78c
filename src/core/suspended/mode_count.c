/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * How many in-plane natural frequencies lie below a given one: an exact count by the phases of
 * the solution that starts at rest at end 1.
 *
 * X' = w B F, F' = -w C X, X(chi_1) = 0, F(chi_1) = I, B >= 0 and C > 0 symmetric. F + iX is
 * unitary up to a real factor on the right, and its eigenphases never fall, for B >= 0, C > 0.
 * X is singular where a phase passes a multiple of pi, and the number of such points inside the
 * cable is the number of frequencies below w (index theorem; Wittrick and Williams count the
 * same by stiffness matrices, but an inextensible element has none). The sum of the phases is
 * arg det(F + iX). Its growth over a step is bounded beforehand, so that no point can be missed
 * between two steps; sampling the sign of det X would miss pairs. With n the number sought,
 * n = floor(sum/pi) or one less, and det X has the sign of (-1)^n.
 */
#include <complex.h>
#include <math.h>
#include <string.h>

#include <strum/modes.h>

#include "core/numerics/gauss.h"
#include "core/numerics/legendre.h"
#include "core/suspended/in_plane.h"
#include "core/suspended/modes.h"

#define NODES      8    /* Gauss collocation: order 16 */
#define STEP_PHASE 0.8  /* most that the two phases may grow in a step */
#define STEP_CHI   0.25 /* and how far the cable may bend in it */
/* A count of more steps than this would take seconds: some 10^5 modes. */
#define STEPS_MAX 500000
#define STEP_US   4 /* a step takes about so long */

typedef struct counting {
    const strum_cable *cable;
    mapping along;
    double frequency;
    double tau;                    /* unit of displacement along the middle tangent */
    double z;                      /* unit of force over displacement */
    double node[NODES];            /* on [-1, 1] */
    double integral[NODES][NODES]; /* INT from -1 to node i of the interpolant */
    double weight[NODES];
} counting;

/* B and C without w, as [00, 01, 11], in the units of `k`. */
static void coefficients(const counting *k, double x, double b[3], double c[3])
{
    const strum_cable *cable = k->cable;
    double cosh_chi, t0, t1; /* tangent; the normal is (-t1, t0) */
    in_plane_frame_at(&k->along, x, &cosh_chi, &t0, &t1);
    const double along = cable->mu * cosh_chi * cable->kappa_t;
    const double across = cable->mu * (1 + cable->kappa_n * cosh_chi);
    const double mass_t = cable->mu * cosh_chi * cable->mass_t;
    const double mass_n = cable->mu * cosh_chi * cable->mass_n;
    const double up = k->z, down = 1 / k->z, tau = k->tau;
    b[0] = (t0 * t0 * along + t1 * t1 * across) / (tau * tau) * up;
    b[1] = t0 * t1 * (along - across) / tau * up;
    b[2] = (t1 * t1 * along + t0 * t0 * across) * up;
    c[0] = (t0 * t0 * mass_t + t1 * t1 * mass_n) * (tau * tau) * down;
    c[1] = t0 * t1 * (mass_t - mass_n) * tau * down;
    c[2] = (t1 * t1 * mass_t + t0 * t0 * mass_n) * down;
}

/* Units in which B and C are alike, and both their components: a taut cable moves far less
 * along its middle tangent than across. Returns the bound on the growth of the two phases in
 * unit x at unit frequency. */
static double choose_units(counting *k)
{
    double largest[4] = {0}, b[3], c[3];
    k->tau = k->z = 1;
    for (int pass = 0; pass < 2; pass++) {
        memset(largest, 0, sizeof largest);
        for (int i = 0; i <= 64; i++) {
            coefficients(k, i / 32.0 - 1, b, c);
            largest[0] = fmax(largest[0], b[0]);
            largest[1] = fmax(largest[1], b[2]);
            largest[2] = fmax(largest[2], b[0] + b[2]);
            largest[3] = fmax(largest[3], c[0] + c[2]);
        }
        if (pass == 0)
            k->tau = sqrt(largest[0] / largest[1]);
    }
    k->z = sqrt(largest[3] / largest[2]);
    return 2 * sqrt(largest[3] * largest[2]);
}

static void make_rule(counting *k)
{
    gauss_legendre(NODES, k->node, k->weight);
    double p[NODES][NODES], q[NODES][NODES];
    for (size_t i = 0; i < NODES; i++)
        legendre_at(k->node[i], NODES, p[i], q[i]);
    for (int i = 0; i < NODES; i++)
        for (int j = 0; j < NODES; j++) {
            double sum = 0.5 * (1 + k->node[i]); /* the constant: q_0 lacks it */
            for (int m = 1; m < NODES; m++)
                sum += q[i][m] * p[j][m];
            k->integral[i][j] = k->weight[j] * sum;
        }
}

/* State: columns (F_0, F_1, X_0, X_1) of the two solutions. */
typedef double state[2][4];

/* One step by collocation; the stage equations are solved by iteration, which halves the error
 * at least: the phase of a step is below STEP_PHASE. */
static void step(const counting *k, double from, double width, state y)
{
    double b[NODES][3], c[NODES][3], slope[NODES][2][4] = {{{0}}};
    for (int i = 0; i < NODES; i++)
        coefficients(k, from + width * (1 + k->node[i]) / 2, b[i], c[i]);
    const double h = width / 2 * k->frequency;
    for (int pass = 0; pass < 40; pass++) {
        double change = 0;
        for (int i = 0; i < NODES; i++)
            for (int column = 0; column < 2; column++) {
                double at[4];
                for (int m = 0; m < 4; m++) {
                    at[m] = y[column][m];
                    for (int j = 0; j < NODES; j++)
                        at[m] += h * k->integral[i][j] * slope[j][column][m];
                }
                const double next[4] = {
                    -(c[i][0] * at[2] + c[i][1] * at[3]), -(c[i][1] * at[2] + c[i][2] * at[3]),
                    b[i][0] * at[0] + b[i][1] * at[1], b[i][1] * at[0] + b[i][2] * at[1]};
                for (int m = 0; m < 4; m++) {
                    change = fmax(change, fabs(h * (next[m] - slope[i][column][m])));
                    slope[i][column][m] = next[m];
                }
            }
        if (change < 1e-17)
            break;
    }
    for (int column = 0; column < 2; column++)
        for (int m = 0; m < 4; m++)
            for (int j = 0; j < NODES; j++)
                y[column][m] += h * k->weight[j] * slope[j][column][m];
}

/* Orthonormal columns; the positive factor this takes out leaves the phase alone. */
static void normalise(state y)
{
    for (int column = 0; column < 2; column++) {
        for (int pass = 0; pass < 2 && column == 1; pass++) {
            double along = 0;
            for (int m = 0; m < 4; m++)
                along += y[0][m] * y[1][m];
            for (int m = 0; m < 4; m++)
                y[1][m] -= along * y[0][m];
        }
        double size = 0;
        for (int m = 0; m < 4; m++)
            size += y[column][m] * y[column][m];
        for (int m = 0; m < 4; m++)
            y[column][m] /= sqrt(size);
    }
}

strum_status strum_modes_below(const strum_cable *cable, double frequency,
                               const strum_options *options, int *count, strum_error *error)
{
    work w = work_begin(options);
    return modes_count_below(cable, frequency, &w, count, error);
}

strum_status modes_count_below(const strum_cable *cable, double frequency, work *w, int *count,
                               strum_error *error)
{
    if (cable->eta_t > 0 || cable->eta_n > 0)
        return error_at(error, STRUM_ERR_METHOD, STRUM_MODES_ARG_CABLE, STRUM_NO_INDEX,
                        "modes are counted without damping only");
    if (!(frequency > 0 && cable->mu > 0 && fabs(cable->chi_m) + cable->mu < 1e3 &&
          cable->mass_t > 0 && cable->mass_n > 0 && cable->kappa_t >= 0 && cable->kappa_n >= 0))
        return error_at(error, STRUM_ERR_RANGE, STRUM_MODES_ARG_CABLE, STRUM_NO_INDEX,
                        "a property of the cable is out of range");
    counting k = {.cable = cable, .along = mapping_linear(cable), .frequency = frequency};
    make_rule(&k);
    const double phases = 2 * frequency * choose_units(&k);
    const double needed = fmax(phases / STEP_PHASE, 2 * cable->mu / STEP_CHI);
    if (!(needed < STEPS_MAX))
        return error_set(error, STRUM_ERR_RANGE, "there are too many modes to count");
    const int steps = (int)needed + 1;
    state y = {{1, 0, 0, 0}, {0, 1, 0, 0}};
    double sum = 0;
    double _Complex before = 1;
    for (int i = 0; i < steps; i++) {
        if (work_spend(w, STEP_US) != STRUM_OK)
            return work_error(w, error);
        step(&k, 2.0 * i / steps - 1, 2.0 / steps, y);
        normalise(y);
        const double _Complex now = CMPLX(y[0][0], y[0][2]) * CMPLX(y[1][1], y[1][3]) -
                                    CMPLX(y[0][1], y[0][3]) * CMPLX(y[1][0], y[1][2]);
        sum += carg(now * conj(before));
        before = now;
    }
    *count = (int)floor(sum / M_PI);
    const double determinant = y[0][2] * y[1][3] - y[0][3] * y[1][2];
    *count -= (*count % 2 == 0) != (determinant > 0);
    return STRUM_OK;
}
