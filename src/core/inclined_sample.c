/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mode shapes of inclined cables point by point, before they are normalised. */
#include <math.h>

#include "core/inclined.h"
#include "core/linalg.h"

/* Points that are tabulated together: bounds the memory. */
#define CHUNK 256

/* Values from force F and its slope dF/dx along the fixed axes: F' = -omega^2 (tt' h + nn') X
 * with ' = d/dsigma; forces in T_a cos(phi_a), displacements in a = L/length. */
static void from_force(const strum_inclined_modes *m, const strum_cable *cable, int mode,
                       double x, const double force[2], const double slope[2],
                       strum_inclined_point *out)
{
    double cosh_chi, c, s;
    inplane_frame_at(&m->along, x, &cosh_chi, &c, &s);
    const double unit = m->cable.epsilon / sqrt(cos(m->cable.inclination));
    const double omega = m->modes[mode].kl / unit;
    const double scale = -1 / (coordinate_slope(&m->along, x) * cosh_chi * omega * omega);
    out->longitudinal = (c * slope[0] + s * slope[1]) * scale / cable->mass_t;
    out->transverse = (c * slope[1] - s * slope[0]) * scale / cable->mass_n;
    out->tension = (c * force[0] + s * force[1]) * m->cable.epsilon;
}

static strum_status full_sample(const strum_inclined_modes *m, int first, int last, int points,
                                const double *x, strum_inclined_point *out, arena *scratch)
{
    const strum_cable cable = inclined_mechanics(&m->cable, &m->statics);
    const int columns = 2 * (last - first), most = points < CHUNK ? points : CHUNK;
    const size_t size = (size_t)m->size, chunk = (size_t)most;
    double *p = arena_doubles(scratch, 2 * size * chunk);
    double *force = arena_doubles(scratch, 2 * chunk * (size_t)columns);
    double *factors = arena_doubles(scratch, 4 * size);
    if (p == NULL || force == NULL || factors == NULL)
        return STRUM_ERR_MEMORY;
    basis_factors(m->size, factors);
    double *q = p + size * chunk, *slope = force + chunk * (size_t)columns;
    const double *coefficients = m->forces + 2 * (size_t)first * size;
    for (int start = 0; start < points; start += most) {
        const int n = points - start < most ? points - start : most;
        for (int i = 0; i < n; i++)
            basis_at_with(factors, x[start + i], m->size, p + (size_t)i * size,
                          q + (size_t)i * size);
        linalg_multiply('T', 'N', n, columns, m->size, q, m->size, coefficients, m->size, force,
                        most);
        linalg_multiply('T', 'N', n, columns, m->size, p, m->size, coefficients, m->size, slope,
                        most);
        for (int i = 0; i < n; i++)
            for (int mode = first; mode < last; mode++) {
                const size_t at = (size_t)i + 2 * (size_t)(mode - first) * chunk;
                const double f[2] = {m->constants[2 * mode] + force[at],
                                     m->constants[2 * mode + 1] + force[at + chunk]};
                const double df[2] = {slope[at], slope[at + chunk]};
                from_force(m, &cable, mode, x[start + i], f, df,
                           &out[(start + i) * (last - first) + mode - first]);
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
                                                   coordinate_offset(&m->along, x[i]))
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
