/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The full model: equations (1)-(5) of the report without approximation, as the in-plane modes
 * of the suspended cable that it is. */
#include <complex.h>
#include <math.h>

#include "core/inclined/cluster.h"
#include "core/inclined/statics.h"
#include "core/numerics/linalg.h"
#include "core/numerics/status.h"
#include "core/suspended/modes.h"
#include "core/suspended/strain.h"

/* Curvature squared over stiffness, in T_a and L, above which the second method loses more than
 * 1e-9: the strains of a cable that soft are a small difference of displacements. */
#define SOFTNESS_MAX 1e7

/* Points that are tabulated together: bounds the memory. */
#define CHUNK 256

/* The frame of the cable at one point. */
typedef struct frame {
    double slope, cosh_chi, c, s;
} frame;

/* Values from force F and its slope dF/dx along the fixed axes:
 *     F' = -omega^2 (tt' h + nn') X,  ' = d/dsigma,
 * forces in T_a cos(phi_a), displacements in a = L/length. */
static void from_force(const strum_inclined *m, const strum_cable *cable, int mode,
                       const frame *at, const double force[2], const double slope[2],
                       strum_inclined_point *out)
{
    const double c = at->c, s = at->s;
    const double unit = m->cable.epsilon / sqrt(cos(m->cable.inclination));
    const double omega = m->modes[mode].kl / unit;
    const double scale = -1 / (at->slope * at->cosh_chi * omega * omega);
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
static bool from_strain(const strum_inclined *m, int mode)
{
    return m->modes[mode].kl * sqrt(m->cable.mass_ratio / m->statics.stiffness) < M_PI;
}

/* Some points at a time: functions, forces, their slopes, and displacements along from the
 * strain; `rows` points a column. */
typedef struct tables {
    int rows;
    double *factors, *p, *q, *force, *slope, *along;
} tables;

static strum_status tables_make(const strum_inclined *m, const inclined_samples *at, arena *a,
                                tables *t)
{
    t->rows = at->points < CHUNK ? at->points : CHUNK;
    const size_t size = (size_t)m->size, rows = (size_t)t->rows;
    const size_t columns = 2 * (size_t)(at->last - at->first);
    t->p = arena_doubles(a, 2 * size * rows);
    t->force = arena_doubles(a, 5 * rows * (columns / 2));
    t->factors = arena_doubles(a, 4 * size);
    if (t->p == NULL || t->force == NULL || t->factors == NULL)
        return STRUM_ERR_MEMORY;
    legendre_factors(m->size, t->factors);
    t->q = t->p + size * rows;
    t->slope = t->force + rows * columns;
    t->along = t->slope + rows * columns;
    return STRUM_OK;
}

static void tabulate(const strum_inclined *m, const inclined_samples *at, int start, int n,
                     const tables *t)
{
    const int size = m->size, modes = at->last - at->first;
    const double *forces = m->forces + 2 * (size_t)at->first * (size_t)size;
    const double *stretch = m->stretch + (size_t)at->first * (size_t)size;
    for (int i = 0; i < n; i++)
        legendre_at_with(t->factors, at->x[start + i], size, t->p + (size_t)i * (size_t)size,
                         t->q + (size_t)i * (size_t)size);
    linalg_multiply('T', 'N', n, 2 * modes, size, t->q, size, forces, size, t->force, t->rows);
    linalg_multiply('T', 'N', n, 2 * modes, size, t->p, size, forces, size, t->slope, t->rows);
    linalg_multiply('T', 'N', n, modes, size, t->q, size, stretch, size, t->along, t->rows);
}

/* Row `i` of the tables, which is point `start + i`. */
static void put_point(const strum_inclined *m, const inclined_samples *at, int start, int i,
                      const tables *t)
{
    const strum_cable cable = inclined_mechanics(&m->cable, &m->statics);
    const double x = at->x[start + i];
    const size_t rows = (size_t)t->rows;
    frame here = {.slope = mapping_slope(&m->along, x)};
    in_plane_frame_at(&m->along, x, &here.cosh_chi, &here.c, &here.s);
    for (int mode = at->first; mode < at->last; mode++) {
        const size_t k = (size_t)(mode - at->first), row = (size_t)i + 2 * k * rows;
        const double f[2] = {m->constants[2 * mode] + t->force[row],
                             m->constants[2 * mode + 1] + t->force[row + rows]};
        const double df[2] = {t->slope[row], t->slope[row + rows]};
        strum_inclined_point *out =
            &at->out[(start + i) * (at->last - at->first) + mode - at->first];
        from_force(m, &cable, mode, &here, f, df, out);
        if (from_strain(m, mode)) /* q_0 lacks its value at x = 0 */
            out->longitudinal = t->along[(size_t)i + k * rows] +
                                M_SQRT1_2 * m->stretch[(size_t)mode * (size_t)m->size];
    }
}

static strum_status evaluate(const strum_inclined *m, const inclined_samples *at,
                             arena *scratch, work *w)
{
    tables t;
    strum_status status = tables_make(m, at, scratch, &t);
    for (int start = 0; status == STRUM_OK && start < at->points; start += t.rows) {
        const int n = at->points - start < t.rows ? at->points - start : t.rows;
        status = work_spend(w, 0);
        if (status != STRUM_OK)
            break;
        tabulate(m, at, start, n, &t);
        for (int i = 0; i < n; i++)
            put_point(m, at, start, i, &t);
    }
    return status;
}

/* du/dx of all modes, without which a shape cannot be told. */
static strum_status find_stretch(strum_inclined *m, work *w)
{
    arena scratch = {.work = w};
    legendre b;
    strum_status status =
        legendre_make(m->size, mapping_singularity(&m->along), false, &scratch, &b);
    const size_t points = (size_t)b.points, count = (size_t)m->count;
    strum_inclined_point *at = NULL;
    double *ux = NULL;
    if (status == STRUM_OK) {
        at = arena_alloc(&scratch, points * count, sizeof *at);
        ux = arena_doubles(&scratch, points * count);
        status =
            at == NULL || ux == NULL
                ? STRUM_ERR_MEMORY
                : evaluate(m, &(inclined_samples){0, m->count, b.points, b.x, at}, &scratch, w);
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

/* Frequencies and force coefficients of the core's spectrum. */
static strum_status keep_spectrum(strum_inclined *m, const strum_modes *sp)
{
    const size_t size = (size_t)strum_modes_size(sp);
    const double unit = m->cable.epsilon / sqrt(cos(m->cable.inclination));
    m->size = (int)size;
    m->along = sp->coordinate;
    m->forces = arena_doubles(&m->memory, 2 * size * (size_t)m->count);
    m->constants = arena_doubles(&m->memory, 2 * (size_t)m->count);
    m->stretch = arena_doubles(&m->memory, size * (size_t)m->count);
    if (m->forces == NULL || m->constants == NULL || m->stretch == NULL)
        return STRUM_ERR_MEMORY;
    for (int i = 0; i < m->count; i++) {
        const root *r = &sp->roots[i];
        const in_plane_part *part = sp->parts[r->symmetry];
        m->modes[i] =
            (strum_inclined_mode){.kl = sp->modes[i].frequency * unit, .symmetry = r->symmetry};
        for (int j = 0; j < r->length; j++)
            m->forces[(size_t)(2 * i + part->component[j]) * size + (size_t)part->index[j]] =
                creal(r->vector[j]);
        for (int k = 0; k < 2; k++)
            m->constants[2 * i + k] = creal(r->constant[k]);
    }
    return STRUM_OK;
}

/* Measured: the roots, and the shapes sampled for their maxima and energies. */
static double work_us(const strum_cable *mechanics, int count, double size)
{
    return strum_modes_work(&(strum_modes_params){*mechanics, STRUM_IN_PLANE, count, true}) +
           count * (60 + 0.004 * size * size);
}

static strum_status solve(strum_inclined *m, work *w, strum_error *error)
{
    const strum_cable cable = inclined_mechanics(&m->cable, &m->statics);
    strum_modes *spectrum;
    strum_status status = spectrum_unscaled(&cable, m->count, w, &spectrum, error);
    if (status != STRUM_OK) {
        if (error != NULL) /* a parameter of that call is none of ours */
            error->argument = 0;
        return status;
    }
    status = keep_spectrum(m, spectrum);
    strum_modes_free(spectrum);
    if (status == STRUM_OK)
        status = find_stretch(m, w);
    return status == STRUM_OK ? status
                              : error_set(error, status, "%s", strum_status_text(status));
}

/* What Galerkin's method leaves free and the exact solution has not: displacement at a support,
 * relative to the largest. */
static strum_status closure(const strum_inclined *m, double *worst, arena *a, work *w)
{
    const double supports[] = {-1, 1};
    strum_inclined_point *p = arena_alloc(a, 2 * (size_t)m->count, sizeof *p);
    const strum_status status =
        p == NULL ? STRUM_ERR_MEMORY
                  : evaluate(m, &(inclined_samples){0, m->count, 2, supports, p}, a, w);
    for (int i = 0; status == STRUM_OK && i < 2 * m->count; i++)
        *worst = fmax(*worst,
                      hypot(p[i].transverse, p[i].longitudinal) / fabs(m->unit[i % m->count]));
    return status;
}

static strum_status compare(const strum_inclined *m, strum_verification *v, arena *a, work *w)
{
    v->method = "strain and displacement Galerkin, modes counted by the phases of the transfer";
    const strum_cable cable = inclined_mechanics(&m->cable, &m->statics);
    const double unit = m->cable.epsilon / sqrt(cos(m->cable.inclination));
    root_list list = {0};
    double kl[STRUM_MODES_MAX + BEYOND];
    strum_status status = closure(m, &v->max_residual, a, w);
    /* the strains' problem is of three times the unknowns of the forces' in all */
    if (status == STRUM_OK)
        status = work_spend(w, 2 * work_us(&cable, m->count, m->size));
    if (status == STRUM_OK)
        status = strain_roots(&cable, &m->along, m->size + BEYOND, m->count + BEYOND, a, &list);
    if (status != STRUM_OK || list.count < m->count + BEYOND)
        return status != STRUM_OK ? status : STRUM_ERR_INTERNAL;
    for (int i = 0; i < list.count; i++)
        kl[i] = cimag(list.items[i].s) * unit;
    for (int i = 0; i < m->count; i++)
        v->max_relative_difference =
            fmax(v->max_relative_difference, fabs(kl[i] - m->modes[i].kl) / m->modes[i].kl);
    status = work_spend(w, 0);
    if (status != STRUM_OK)
        return status;
    const int n = gap_after(kl, m->count);
    int counted = 0;
    status = modes_count_below(&cable, (kl[n - 1] + kl[n]) / 2 / unit, w, &counted, NULL);
    v->modes_expected = counted - (n - m->count);
    return status;
}

static strum_status verify(const strum_inclined *m, strum_verification *v, arena *a, work *w,
                           strum_error *error)
{
    const double curvature = fmin(m->cable.epsilon, 1) * cos(m->cable.inclination);
    if (curvature * curvature > SOFTNESS_MAX * m->statics.stiffness)
        return error_set(error, STRUM_ERR_METHOD,
                         "the second method does not reach a cable that its tension "
                         "stretches %.1g times: it is answered without verify only",
                         1 / m->statics.stiffness);
    const strum_status status = compare(m, v, a, w);
    return status == STRUM_OK ? status
                              : error_set(error, status, "%s", strum_status_text(status));
}

const inclined_model inclined_full = {
    .name = "full",
    .has_longitudinal = true,
    .meets_supports = true,
    .solve = solve,
    .evaluate = evaluate,
    .verify = verify,
    .work_us = work_us,
};
