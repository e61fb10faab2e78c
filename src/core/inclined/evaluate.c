/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mode shapes of inclined cables point by point, before they are normalised. */
#include <math.h>

#include "core/inclined/inclined.h"
#include "core/numerics/linalg.h"

/* Points that are tabulated together: bounds the memory. */
#define CHUNK 256

/* Values from force F and its slope dF/dx along the fixed axes: F' = -omega^2 (tt' h + nn') X
 * with ' = d/dsigma; forces in T_a cos(phi_a), displacements in a = L/length. */
static void from_force(const strum_inclined_modes *m, const strum_cable *cable, int mode,
                       double x, const double force[2], const double slope[2],
                       strum_inclined_point *out)
{
    double cosh_chi, c, s;
    in_plane_frame_at(&m->along, x, &cosh_chi, &c, &s);
    const double unit = m->cable.epsilon / sqrt(cos(m->cable.inclination));
    const double omega = m->modes[mode].kl / unit;
    const double scale = -1 / (mapping_slope(&m->along, x) * cosh_chi * omega * omega);
    out->longitudinal = (c * slope[0] + s * slope[1]) * scale / cable->mass_t;
    out->transverse = (c * slope[1] - s * slope[0]) * scale / cable->mass_n;
    out->tension = (c * force[0] + s * force[1]) * m->cable.epsilon;
}

/*
 * The momentum equation gives u as a difference of forces over h omega^2, which a taut cable
 * does not have to spare: its transverse forces are 1/epsilon times and more what moves it
 * along. There u follows from the strain, u' = K w + T/EA; beyond the first longitudinal wave
 * it is the other way round, the strain of a soft cable being T over little.
 */
static bool from_strain(const strum_inclined_modes *m, int mode)
{
    return m->modes[mode].kl * sqrt(m->cable.mass_ratio / m->statics.stiffness) < M_PI;
}

strum_status inclined_stretch(strum_inclined_modes *m)
{
    arena scratch = {0};
    legendre b;
    strum_status status =
        legendre_make(m->size, mapping_singularity(&m->along), false, &scratch, &b);
    const size_t points = (size_t)b.points, count = (size_t)m->count;
    strum_inclined_point *at = NULL;
    double *ux = NULL;
    if (status == STRUM_OK) {
        at = arena_alloc(&scratch, points * count, sizeof *at);
        ux = arena_doubles(&scratch, points * count);
        status = at == NULL || ux == NULL
                     ? STRUM_ERR_MEMORY
                     : inclined_sample(m, 0, m->count, b.points, b.x, at, &scratch);
    }
    for (size_t i = 0; status == STRUM_OK && i < points; i++) {
        const double slope = b.w[i] * mapping_slope(&m->along, b.x[i]);
        const double c = cosh(m->along.chi_m + mapping_offset(&m->along, b.x[i]));
        for (size_t mode = 0; mode < count; mode++)
            ux[i + mode * points] =
                slope / c * at[i * count + mode].transverse +
                slope * c / m->length * at[i * count + mode].tension / m->statics.stiffness;
    }
    if (status == STRUM_OK)
        linalg_multiply('T', 'N', m->size, m->count, b.points, b.p, b.points, ux, b.points,
                        m->stretch, m->size);
    arena_free(&scratch);
    return status;
}

static strum_status full_sample(const strum_inclined_modes *m, int first, int last, int points,
                                const double *x, strum_inclined_point *out, arena *scratch)
{
    const strum_cable cable = inclined_mechanics(&m->cable, &m->statics);
    const int columns = 2 * (last - first), most = points < CHUNK ? points : CHUNK;
    const size_t size = (size_t)m->size, chunk = (size_t)most;
    double *p = arena_doubles(scratch, 2 * size * chunk);
    double *force = arena_doubles(scratch, 5 * chunk * (size_t)(columns / 2));
    double *factors = arena_doubles(scratch, 4 * size);
    if (p == NULL || force == NULL || factors == NULL)
        return STRUM_ERR_MEMORY;
    legendre_factors(m->size, factors);
    double *q = p + size * chunk, *slope = force + chunk * (size_t)columns;
    double *along = slope + chunk * (size_t)columns;
    const double *coefficients = m->forces + 2 * (size_t)first * size;
    const double *stretch = m->stretch + (size_t)first * size;
    for (int start = 0; start < points; start += most) {
        const int n = points - start < most ? points - start : most;
        for (int i = 0; i < n; i++)
            legendre_at_with(factors, x[start + i], m->size, p + (size_t)i * size,
                             q + (size_t)i * size);
        linalg_multiply('T', 'N', n, columns, m->size, q, m->size, coefficients, m->size, force,
                        most);
        linalg_multiply('T', 'N', n, columns, m->size, p, m->size, coefficients, m->size, slope,
                        most);
        linalg_multiply('T', 'N', n, last - first, m->size, q, m->size, stretch, m->size, along,
                        most);
        for (int i = 0; i < n; i++)
            for (int mode = first; mode < last; mode++) {
                const size_t at = (size_t)i + 2 * (size_t)(mode - first) * chunk;
                const double f[2] = {m->constants[2 * mode] + force[at],
                                     m->constants[2 * mode + 1] + force[at + chunk]};
                const double df[2] = {slope[at], slope[at + chunk]};
                strum_inclined_point *to = &out[(start + i) * (last - first) + mode - first];
                from_force(m, &cable, mode, x[start + i], f, df, to);
                if (from_strain(m, mode)) /* q_0 lacks its value at x = 0 */
                    to->longitudinal = along[i + (mode - first) * most] +
                                       M_SQRT1_2 * stretch[(size_t)(mode - first) * size];
            }
    }
    return STRUM_OK;
}

strum_status inclined_sample(const strum_inclined_modes *m, int first, int last, int points,
                             const double *x, strum_inclined_point *out, arena *scratch)
{
    const bool airy =
        m->model == STRUM_INCLINED_AIRY || m->model == STRUM_INCLINED_AIRY_TANGENT;
    for (int i = 0; i < points; i++) {
        const double s = inclined_s_of_x(m, x[i]);
        const double phase = airy ? inclined_phase(&m->cable, &m->statics.profile, &m->rule,
                                                   mapping_offset(&m->along, x[i]))
                                  : 0;
        for (int mode = first; mode < last; mode++) {
            strum_inclined_point *at = &out[i * (last - first) + mode - first];
            at->s = s;
            if (airy)
                inclined_airy_sample(m, &m->waves[mode], x[i], phase, at);
            else if (m->model != STRUM_INCLINED_FULL)
                inclined_closed_sample(m, &m->waves[mode], at);
        }
    }
    return m->model == STRUM_INCLINED_FULL
               ? full_sample(m, first, last, points, x, out, scratch)
               : STRUM_OK;
}
