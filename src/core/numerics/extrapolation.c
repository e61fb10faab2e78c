/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/numerics/extrapolation.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define COLUMNS 7 /* of the tableau, with 2, 4, .. 2 COLUMNS substeps */

/* The modified midpoint rule over a step H in n substeps, smoothed at its end. */
static void midpoint(const extrapolation *e, double at, double H, int n, const double *y,
                     const double *first, double *end)
{
    const double h = H / n;
    double before[EXTRAPOLATION_STATE_MAX], now[EXTRAPOLATION_STATE_MAX],
        slope[EXTRAPOLATION_STATE_MAX];
    for (int i = 0; i < e->size; i++) {
        before[i] = y[i];
        now[i] = y[i] + h * first[i];
    }
    for (int k = 1; k < n; k++) {
        e->slope(e->data, at + k * h, now, slope);
        for (int i = 0; i < e->size; i++) {
            const double next = before[i] + 2 * h * slope[i];
            before[i] = now[i];
            now[i] = next;
        }
    }
    e->slope(e->data, at + H, now, slope);
    for (int i = 0; i < e->size; i++)
        end[i] = 0.5 * (before[i] + now[i] + h * slope[i]);
}

/* One step of length H; returns its error over the tolerance. */
static double try_step(extrapolation *e, double at, double H, const double *y, double *end)
{
    double first[EXTRAPOLATION_STATE_MAX], row[COLUMNS][EXTRAPOLATION_STATE_MAX], error = 0;
    e->slope(e->data, at, y, first);
    for (int k = 0; k < COLUMNS; k++) {
        midpoint(e, at, H, 2 * (k + 1), y, first, row[k]);
        /* Aitken and Neville in 1/n^2: row[j] becomes T_{k,k-j} */
        for (int j = k - 1; j >= 0; j--) {
            const double ratio = (k + 1.0) / (j + 1.0), share = 1 / (ratio * ratio - 1);
            for (int i = 0; i < e->size; i++)
                row[j][i] = row[j + 1][i] + (row[j + 1][i] - row[j][i]) * share;
        }
    }
    double scale[EXTRAPOLATION_STATE_MAX];
    memcpy(scale, e->largest, sizeof scale);
    for (int i = 0; i < e->size; i++)
        scale[e->block[i]] = fmax(scale[e->block[i]], fmax(fabs(y[i]), fabs(row[0][i])));
    for (int i = 0; i < e->size; i++) {
        const double off = fabs(row[0][i] - row[1][i]);
        if (off > 0)
            error = fmax(error, off / (e->tolerance * scale[e->block[i]]));
        if (!isfinite(row[0][i]))
            return INFINITY;
        end[i] = row[0][i];
    }
    return error;
}

strum_status extrapolation_advance(extrapolation *e, double *at, double end, double *y, work *w)
{
    const double slopes = 1 + COLUMNS * (COLUMNS + 1); /* of a step */
    double next[EXTRAPOLATION_STATE_MAX];
    while (*at < end) {
        if (e->steps++ >= e->steps_max)
            return STRUM_ERR_ACCURACY;
        const strum_status status = work_spend(w, slopes * e->slope_us);
        if (status != STRUM_OK)
            return status;
        const double left = end - *at, H = fmin(e->step, left);
        if (!(H > 4 * DBL_EPSILON * fmax(fabs(*at), fabs(end))) && H < left)
            return STRUM_ERR_ACCURACY;
        const double error = try_step(e, *at, H, y, next);
        const double grow = error > 0 ? 0.9 * pow(error, -1.0 / (2 * COLUMNS - 1)) : 4;
        if (error <= 1) {
            for (int i = 0; i < e->size; i++) {
                y[i] = next[i];
                e->largest[e->block[i]] = fmax(e->largest[e->block[i]], fabs(y[i]));
            }
            *at = H < left ? *at + H : end;
            /* a step cut short by `end` says nothing against the one before it */
            e->step = fmax(H * fmin(grow, 4), H < e->step ? e->step : 0);
        } else {
            e->step = H * (isfinite(error) ? fmax(fmin(grow, 0.9), 0.1) : 0.1);
        }
    }
    return STRUM_OK;
}
