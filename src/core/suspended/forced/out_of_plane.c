/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Forced motion out of plane (the equations of out_of_plane.c):
 *     V_chi = -R cosh(chi) W,
 *     W_chi = e V,
 *     e = 1 + kappa_n cosh(chi),
 *     R = m_n w^2 - i eta_n w.
 * With
 *     W = lift ((1 + x)/2 + sum w_k q_k),   k >= 1,
 * the coefficients are those of
 *     (K - R M) w = R g - l,
 *     K = INT p p/(e chi_x),
 *     M = INT q q cosh(chi) chi_x,
 * where g and l are the same integrals of the lifting.
 */
#include <math.h>
#include <string.h>

#include "core/suspended/forced/modal.h"
#include "core/numerics/linalg.h"

static strum_status make(strum_forced *f, arena *scratch)
{
    arena *a = &f->memory;
    legendre b;
    strum_status status =
        legendre_make(f->size, mapping_singularity(&f->coordinate), false, scratch, &b);
    if (status != STRUM_OK)
        return status;
    const size_t n = (size_t)f->size - 1, points = (size_t)b.points;
    double *w = arena_room(scratch, 2 * points * n), *m = arena_room(scratch, 2 * n * n);
    f->out_nu = arena_doubles(a, n);
    f->out_v = arena_room(a, n * n);
    f->out_inertia = arena_doubles(a, 2 * n);
    if (w == NULL || m == NULL || f->out_nu == NULL || f->out_v == NULL ||
        f->out_inertia == NULL)
        return STRUM_ERR_MEMORY;
    f->out_stretch = f->out_inertia + n;
    double *slopes = w + points * n, *k = m + n * n;
    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i < points; i++) {
            const double c = cosh(f->cable.chi_m + mapping_offset(&f->coordinate, b.x[i]));
            const double slope = mapping_slope(&f->coordinate, b.x[i]);
            const double inertia = b.w[i] * slope * c;
            const double stiffness = b.w[i] / (slope * (1 + f->cable.kappa_n * c));
            const double q = b.q[(j + 1) * points + i], p = b.p[(j + 1) * points + i];
            w[i + j * points] = sqrt(inertia) * q;
            slopes[i + j * points] = sqrt(stiffness) * p;
            f->out_inertia[j] += inertia * q * (1 + b.x[i]) / 2;
            f->out_stretch[j] += stiffness * p / 2;
        }
    status = linalg_gram((int)n, b.points, w, b.points, m, (int)n, scratch->work);
    if (status == STRUM_OK)
        status = linalg_gram((int)n, b.points, slopes, b.points, k, (int)n, scratch->work);
    if (status == STRUM_OK)
        status = linalg_symmetric((int)n, m, (int)n, k, (int)n, (int)n, f->out_nu, f->out_v,
                                  scratch->work);
    return status;
}

strum_status forced_out_of_plane_make(strum_forced *f)
{
    arena scratch = {.work = f->memory.work};
    const strum_status status = make(f, &scratch);
    arena_free(&scratch);
    return status;
}

/* v.(R g - l) */
static double _Complex share_of(const strum_forced *f, int j, double _Complex r)
{
    const int n = f->size - 1;
    const double *v = f->out_v + (size_t)j * (size_t)n;
    double inertia = 0, stretch = 0;
    for (int i = 0; i < n; i++) {
        inertia += v[i] * f->out_inertia[i];
        stretch += v[i] * f->out_stretch[i];
    }
    return r * inertia - stretch;
}

strum_status forced_out_of_plane_solve(const strum_forced *f, double frequency,
                                       double _Complex lift, strum_response *response,
                                       strum_resonance *at)
{
    const int n = f->size - 1;
    const double _Complex r =
        CMPLX(f->cable.mass_n * frequency * frequency, -f->cable.eta_n * frequency);
    memset(response->w, 0, (size_t)f->size * sizeof *response->w);
    response->lift = lift;
    for (int j = 0; j < n; j++) {
        const double *v = f->out_v + (size_t)j * (size_t)n;
        const double _Complex share = share_of(f, j, r);
        const double _Complex distance = 1 - r * f->out_nu[j];
        if (cabs(distance) < 2 * RESONANCE_WIDTH) {
            if (at != NULL)
                *at = (strum_resonance){.plane = STRUM_OUT_OF_PLANE,
                                        .frequency = forced_out_of_plane_frequency(f, j)};
            return STRUM_ERR_METHOD;
        }
        const double _Complex factor = lift * share / distance;
        for (int i = 0; i < n; i++)
            response->w[i + 1] += v[i] * factor;
    }
    return STRUM_OK;
}

double forced_out_of_plane_frequency(const strum_forced *f, int j)
{
    return 1 / sqrt(f->out_nu[j] * f->cable.mass_n);
}

double forced_out_of_plane_residue(const strum_forced *f, int j, double _Complex lift,
                                   double *table)
{
    const int n = f->size - 1;
    const double *v = f->out_v + (size_t)j * (size_t)n;
    const double _Complex share = share_of(f, j, 1 / f->out_nu[j]);
    double largest = 0;
    for (int i = 0; i <= 8 * f->size; i++) {
        double w = 0;
        legendre_at(i / (4.0 * f->size) - 1, f->size, table, table + f->size);
        for (int k = 0; k < n; k++)
            w += v[k] * table[f->size + k + 1];
        largest = fmax(largest, fabs(w));
    }
    /* 1 - R nu -> -2 delta */
    return largest * cabs(share * lift) / 2;
}
