/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Grinfogel's equations (1)-(5) in weak form, unknowns w and e (L. Grinfogel, Dynamics of
 * Elastic Taut Inclined Cables, 1984; with ' = d/d sigma, K = curvature, S = tension):
 *   e = u' - K w,   g = w' + K u,
 *   INT e^2/kappa_t + g^2/(1/S + kappa_n) d sigma = omega^2 INT m_t u^2 + m_n w^2 d sigma.
 * u follows from e and w, and u = 0 at end 2 fixes the mean strain e_0 = -INT K w/length, so
 * that a stiff cable enters by one term only, INT e_0^2/kappa_t, and nothing locks. A
 * reflection of w's coefficients makes e_0 depend on the first of them alone: the large term
 * then spoils no other, and an inextensible cable merely loses that unknown.
 */
#include "core/suspended/strain.h"

#include <math.h>

#include "core/numerics/linalg.h"

typedef struct strain_problem {
    const strum_cable *cable;
    const mapping *along;
    legendre b;
    int size; /* w = sum a_k q_k, k = 1..size; e = e_0 + sqrt(kappa_t) sum b_k p_k/sigma_x */
    int first, columns;             /* unknowns kept: first is 1 where inextensible */
    double mean;                    /* e_0 of the first unknown of w */
    double *sigma, *bend, *tension; /* d sigma/dx, K d sigma/dx and S at the nodes */
    double *w, *wx; /* values and slopes of the reflected functions, points x size */
} strain_problem;

/* w = q_k and w_x = p_k, reflected so that INT K q_k survives in the first column only. */
static strum_status reflect(strain_problem *s, arena *a)
{
    const size_t points = (size_t)s->b.points, size = (size_t)s->size;
    double *v = arena_doubles(a, size);
    s->w = arena_doubles(a, 2 * points * size);
    if (v == NULL || s->w == NULL)
        return STRUM_ERR_MEMORY;
    s->wx = s->w + points * size;
    double norm = 0, length = 0, square = 0;
    for (size_t k = 0; k < size; k++) {
        const double *q = s->b.q + (k + 1) * points, *p = s->b.p + (k + 1) * points;
        for (size_t i = 0; i < points; i++) {
            s->w[i + k * points] = q[i];
            s->wx[i + k * points] = p[i];
            v[k] += s->b.w[i] * s->bend[i] * q[i];
        }
        norm += v[k] * v[k];
    }
    for (size_t i = 0; i < points; i++)
        length += s->b.w[i] * s->sigma[i];
    norm = copysign(sqrt(norm), v[0]);
    s->mean = norm / length; /* -INT K w = norm for the reflected first function */
    v[0] += norm;
    for (size_t k = 0; k < size; k++)
        square += v[k] * v[k];
    for (int part = 0; part < 2; part++) {
        double *columns = part == 0 ? s->w : s->wx;
        for (size_t i = 0; i < points; i++) {
            double along = 0;
            for (size_t k = 0; k < size; k++)
                along += v[k] * columns[i + k * points];
            for (size_t k = 0; k < size; k++)
                columns[i + k * points] -= 2 * along / square * v[k];
        }
    }
    return STRUM_OK;
}

/* u at the nodes from u_x there: expanded in p_k, integrated to q_k; its mean is zero. */
static void integrate(const strain_problem *s, const double *ux, double *u)
{
    const int points = s->b.points;
    for (int i = 0; i < points; i++)
        u[i] = 0;
    for (int k = 1; k < s->b.count; k++) {
        const double *p = s->b.p + (size_t)k * (size_t)points;
        const double *q = s->b.q + (size_t)k * (size_t)points;
        double c = 0;
        for (int i = 0; i < points; i++)
            c += s->b.w[i] * ux[i] * p[i];
        for (int i = 0; i < points; i++)
            u[i] += c * q[i];
    }
}

/* Column `j` of the samples whose Gram matrices are K (strain) and M (motion). */
static void sample(const strain_problem *s, int j, double *ux, double *u, double *strain,
                   double *motion)
{
    const strum_cable *cable = s->cable;
    const int points = s->b.points, of_w = s->first + j;
    const bool transverse = of_w < s->size;
    const double *w = s->w + (size_t)of_w * (size_t)points;
    const double *wx = s->wx + (size_t)of_w * (size_t)points;
    const double *p =
        transverse ? NULL : s->b.p + (size_t)(of_w - s->size + 1) * (size_t)points;
    for (int i = 0; i < points; i++)
        ux[i] = transverse ? s->bend[i] * w[i] + (of_w == 0 ? s->mean * s->sigma[i] : 0)
                           : sqrt(cable->kappa_t) * p[i];
    integrate(s, ux, u);
    for (int i = 0; i < points; i++) {
        const double sigma = s->sigma[i], dx = s->b.w[i];
        const double soft = 1 / s->tension[i] + cable->kappa_n;
        strain[i] = sqrt(dx / (sigma * soft)) * ((transverse ? wx[i] : 0) + s->bend[i] * u[i]);
        /* e^2/kappa_t of the varying part; the mean is its own row, and orthogonal to it */
        strain[points + i] = transverse ? 0 : sqrt(dx / sigma) * p[i];
        motion[i] = sqrt(dx * sigma * cable->mass_t) * u[i];
        motion[points + i] = transverse ? sqrt(dx * sigma * cable->mass_n) * w[i] : 0;
    }
    double length = 0;
    for (int i = 0; i < points; i++)
        length += s->b.w[i] * s->sigma[i];
    strain[2 * points] =
        transverse && of_w == 0 ? fabs(s->mean) * sqrt(length / cable->kappa_t) : 0;
}

static strum_status prepare(strain_problem *s, arena *a)
{
    /* u carries the curvature's own series beside that of w */
    const double series = fmin(39 / asinh(mapping_singularity(s->along)), 1500);
    strum_status status = legendre_make(s->size + 2 + (int)series / 2,
                                        mapping_singularity(s->along), false, a, &s->b);
    if (status != STRUM_OK)
        return status;
    s->sigma = arena_doubles(a, 3 * (size_t)s->b.points);
    if (s->sigma == NULL)
        return STRUM_ERR_MEMORY;
    s->bend = s->sigma + s->b.points;
    s->tension = s->bend + s->b.points;
    for (int i = 0; i < s->b.points; i++) {
        const double x = s->b.x[i], slope = mapping_slope(s->along, x);
        s->tension[i] = cosh(s->cable->chi_m + mapping_offset(s->along, x));
        s->sigma[i] = slope * s->tension[i];
        s->bend[i] = slope / s->tension[i];
    }
    return reflect(s, a);
}

static strum_status make_roots(const strum_cable *cable, const mapping *x, int size, int want,
                               arena *scratch, arena *a, root_list *list)
{
    const bool elastic = cable->kappa_t > 0;
    strain_problem s = {.cable = cable, .along = x, .size = size, .first = elastic ? 0 : 1};
    s.columns = elastic ? 2 * size : size - 1;
    strum_status status = prepare(&s, scratch);
    if (status != STRUM_OK)
        return status;
    const size_t points = (size_t)s.b.points, n = (size_t)s.columns, rows = 2 * points + 1;
    want = want < s.columns ? want : s.columns;
    double *strain = arena_doubles(scratch, rows * n),
           *motion = arena_doubles(scratch, rows * n);
    double *k_matrix = arena_doubles(scratch, n * n), *m_matrix = arena_doubles(scratch, n * n);
    double *mu = arena_doubles(scratch, n), *v = arena_doubles(scratch, n * (size_t)want);
    double *u = arena_doubles(scratch, 2 * points);
    if (strain == NULL || motion == NULL || k_matrix == NULL || m_matrix == NULL ||
        mu == NULL || v == NULL || u == NULL)
        return STRUM_ERR_MEMORY;
    for (int j = 0; j < s.columns && status == STRUM_OK; j++) {
        sample(&s, j, u, u + points, strain + (size_t)j * rows, motion + (size_t)j * rows);
        status = work_poll(a->work);
    }
    if (status == STRUM_OK)
        status =
            linalg_gram(s.columns, (int)rows, strain, (int)rows, k_matrix, s.columns, a->work);
    if (status == STRUM_OK)
        status =
            linalg_gram(s.columns, (int)rows, motion, (int)rows, m_matrix, s.columns, a->work);
    if (status == STRUM_OK)
        status = linalg_symmetric(s.columns, m_matrix, s.columns, k_matrix, s.columns, want, mu,
                                  v, a->work);
    if (status == STRUM_OK)
        status = root_list_grow(list, want, a);
    for (int i = 0; status == STRUM_OK && i < want; i++) {
        const root r = {.symmetry = STRUM_NO_SYMMETRY};
        roots_of_natural(1 / sqrt(mu[i]), 0, &r, list);
    }
    return status;
}

strum_status strain_roots(const strum_cable *cable, const mapping *x, int size, int want,
                          arena *a, root_list *list)
{
    arena scratch = {.work = a->work};
    const strum_status status = make_roots(cable, x, size, want, &scratch, a, list);
    arena_free(&scratch);
    return status;
}
