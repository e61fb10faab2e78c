/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/suspended/in_plane.h"

#include <math.h>
#include <string.h>

#include "core/numerics/linalg.h"

strum_status in_plane_part_make(strum_symmetry symmetry, in_plane_form form, int size, arena *a,
                                in_plane_part *part)
{
    part->symmetry = symmetry;
    part->count = 0;
    part->component = arena_alloc(a, 2 * (size_t)size, sizeof *part->component);
    part->index = arena_alloc(a, 2 * (size_t)size, sizeof *part->index);
    if (part->component == NULL || part->index == NULL)
        return STRUM_ERR_MEMORY;
    /* In a symmetric mode of a level cable the horizontal force is even and the vertical one
     * odd, so only the horizontal one has a constant. q_k is odd for even k, p_k even. */
    const int even_component = symmetry == STRUM_ANTISYMMETRIC ? 1 : 0;
    for (int k = form == IN_PLANE_FORCE_FORM ? 0 : 1; k < size; k++) {
        const int parity_component = k % 2 == (form == IN_PLANE_FORCE_FORM ? 1 : 0)
                                         ? even_component
                                         : 1 - even_component;
        for (int component = 0; component < 2; component++) {
            if (symmetry != STRUM_NO_SYMMETRY && component != parity_component)
                continue;
            part->component[part->count] = component;
            part->index[part->count++] = k;
        }
    }
    part->constant_count = symmetry == STRUM_NO_SYMMETRY ? 2 : 1;
    part->constants[0] = symmetry == STRUM_NO_SYMMETRY ? 0 : even_component;
    part->constants[1] = 1;
    return STRUM_OK;
}

void in_plane_frame_at(const mapping *along, double x, double *cosh_chi, double *c, double *s)
{
    /* The angle from the middle tangent by products: its difference would cancel on a taut
     * cable. */
    const double middle = along->chi_m, half = mapping_offset(along, x) / 2;
    const double chi = middle + 2 * half, both = cosh(chi) * cosh(middle);
    *cosh_chi = cosh(chi);
    *c = (1 + sinh(chi) * sinh(middle)) / both;
    *s = 2 * cosh(middle + half) * sinh(half) / both;
}

strum_status in_plane_frame_make(const mapping *along, const legendre *b, arena *a,
                                 in_plane_frame *frame)
{
    const size_t points = (size_t)b->points;
    frame->b = b;
    frame->cosh_chi = arena_room(a, 4 * points);
    if (frame->cosh_chi == NULL)
        return STRUM_ERR_MEMORY;
    frame->c = frame->cosh_chi + points;
    frame->s = frame->c + points;
    frame->slope = frame->s + points;
    for (size_t i = 0; i < points; i++) {
        in_plane_frame_at(along, b->x[i], &frame->cosh_chi[i], &frame->c[i], &frame->s[i]);
        frame->slope[i] = mapping_slope(along, b->x[i]);
    }
    return STRUM_OK;
}

/* Samples sqrt(weight) (direction . unknown): the Gram matrix of the columns is the wanted
 * integral. */
typedef struct rows {
    double *data;
    int count; /* rows; also the leading dimension */
} rows;

/* Roots of the weights at the points, NULL for a direction without weight. */
typedef struct weights {
    const double *t, *n;
    bool isotropic; /* both alike */
} weights;

/* Column of component `component` with values v (NULL: constant 1): tangential rows, then
 * normal rows; a direction without weight has no rows. Isotropic weights are sampled along the
 * fixed axes instead, which leaves the components uncoupled exactly. */
static void sample(const in_plane_frame *f, const weights *root, int component, const double *v,
                   double *column)
{
    const int points = f->b->points;
    int row = 0;
    if (root->t != NULL) {
        const double *d = component == 0 ? f->c : f->s;
        for (int i = 0; i < points; i++)
            column[row++] =
                root->t[i] * (root->isotropic ? (component == 0) : d[i]) * (v ? v[i] : 1);
    }
    if (root->n != NULL) {
        const double *d = component == 0 ? f->s : f->c, sign = component == 0 ? -1 : 1;
        for (int i = 0; i < points; i++)
            column[row++] = root->n[i] * (root->isotropic ? (component == 1) : sign * d[i]) *
                            (v ? v[i] : 1);
    }
}

static strum_status sample_part(const in_plane_frame *f, const in_plane_part *part,
                                const double *table, const weights *root, arena *scratch,
                                rows *out)
{
    const size_t points = (size_t)f->b->points;
    out->count = (int)points * ((root->t != NULL) + (root->n != NULL));
    out->data = arena_room(scratch, (size_t)out->count * (size_t)part->count);
    if (out->data == NULL)
        return STRUM_ERR_MEMORY;
    for (int j = 0; j < part->count; j++)
        sample(f, root, part->component[j], table + (size_t)part->index[j] * points,
               out->data + (size_t)j * (size_t)out->count);
    return STRUM_OK;
}

static double dot(int n, const double *a, const double *b)
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

static void invert_gram(const in_plane_part *part, double r[2][2], double inverse[2][2])
{
    const int i = part->constants[0], j = part->constants[1];
    inverse[0][0] = inverse[0][1] = inverse[1][0] = inverse[1][1] = 0;
    inverse[i][i] = 1 / (r[0][0] * r[0][0]);
    if (part->constant_count == 1)
        return;
    const double slope = r[0][1] / (r[0][0] * r[1][1]);
    inverse[i][i] += slope * slope;
    inverse[i][j] = inverse[j][i] = -slope / r[1][1];
    inverse[j][j] = 1 / (r[1][1] * r[1][1]);
}

/*
 * Least squares of the columns on the constants' samples: the columns keep their residual,
 * which makes A positive semidefinite as computed and keeps its digits on a taut cable.
 */
static strum_status project(const in_plane_frame *f, in_plane_part *part, const weights *root,
                            rows *w, arena *scratch)
{
    const int n = w->count, m = part->constant_count;
    double *q = arena_room(scratch, (size_t)n * 2);
    if (q == NULL)
        return STRUM_ERR_MEMORY;
    double r[2][2] = {{0}};
    for (int k = 0; k < m; k++) {
        double *column = q + (size_t)k * (size_t)n;
        sample(f, root, part->constants[k], NULL, column);
        for (int pass = 0; pass < 2 && k == 1; pass++) { /* twice is enough */
            const double along = dot(n, q, column);
            r[0][1] += along;
            for (int i = 0; i < n; i++)
                column[i] -= along * q[i];
        }
        r[k][k] = sqrt(dot(n, column, column));
        for (int i = 0; i < n; i++)
            column[i] /= r[k][k];
    }
    invert_gram(part, r, part->rule.from_motion); /* (W_c'W_c)^-1 = R^-1 R^-T */
    for (int j = 0; j < part->count; j++) {
        double *column = w->data + (size_t)j * (size_t)n, y[2] = {0};
        for (int pass = 0; pass < 2; pass++)
            for (int k = 0; k < m; k++) {
                const double *basis_k = q + (size_t)k * (size_t)n;
                const double along = dot(n, basis_k, column);
                y[k] += along;
                for (int i = 0; i < n; i++)
                    column[i] -= along * basis_k[i];
            }
        double *c = part->rule.from_unknowns + 2 * (size_t)j;
        c[0] = c[1] = 0;
        if (m == 2)
            y[0] -= r[0][1] / r[1][1] * y[1];
        for (int k = 0; k < m; k++)
            c[part->constants[k]] = -y[k] / r[k][k];
    }
    return STRUM_OK;
}

strum_status in_plane_compliance(const strum_cable *cable, const in_plane_frame *f,
                                 in_plane_form form, in_plane_part *part, arena *a)
{
    const int points = f->b->points;
    const size_t n = (size_t)part->count;
    double *root_n = arena_room(a, 2 * (size_t)points);
    part->compliance = arena_room(a, n * n);
    part->rule.from_unknowns = arena_room(a, 2 * n);
    if (root_n == NULL || part->compliance == NULL || part->rule.from_unknowns == NULL)
        return STRUM_ERR_MEMORY;
    double *root_t = cable->kappa_t > 0 ? root_n + points : NULL;
    for (int i = 0; i < points; i++) {
        const double w = f->b->w[i] * f->slope[i], cosh_chi = f->cosh_chi[i];
        root_n[i] = sqrt(w * (1 + cable->kappa_n * cosh_chi));
        if (root_t != NULL)
            root_t[i] = sqrt(w * cable->kappa_t * cosh_chi);
    }
    const weights root = {.t = root_t, .n = root_n};
    rows w;
    arena samples = {.work = a->work};
    strum_status status = sample_part(f, part, form == IN_PLANE_FORCE_FORM ? f->b->q : f->b->p,
                                      &root, &samples, &w);
    if (status == STRUM_OK)
        status = project(f, part, &root, &w, a);
    if (status == STRUM_OK)
        status = linalg_gram(part->count, w.count, w.data, w.count, part->compliance,
                             part->count, a->work);
    arena_free(&samples);
    return status;
}

/* INT v_i . (tt' weight_t + nn' weight_n) v_j (cosh dchi/dx)^power dx. */
static strum_status weighted(double weight_t, double weight_n, int power,
                             const in_plane_frame *f, const in_plane_part *part,
                             const double *table, double *matrix, arena *scratch)
{
    const int points = f->b->points;
    const size_t n = (size_t)part->count;
    double *root = arena_room(scratch, 2 * (size_t)points);
    if (root == NULL)
        return STRUM_ERR_MEMORY;
    double *root_t = weight_t > 0 ? root : NULL, *root_n = weight_n > 0 ? root + points : NULL;
    if (root_t == NULL && root_n == NULL) {
        memset(matrix, 0, n * n * sizeof *matrix);
        return STRUM_OK;
    }
    for (int i = 0; i < points; i++) {
        const double length = f->cosh_chi[i] * f->slope[i]; /* dsigma/dx */
        const double w = f->b->w[i] * (power > 0 ? length : 1 / length);
        root[i] = sqrt(w * weight_t);
        root[i + points] = sqrt(w * weight_n);
    }
    const weights both = {.t = root_t, .n = root_n, .isotropic = weight_t == weight_n};
    rows w;
    arena samples = {.work = scratch->work};
    strum_status status = sample_part(f, part, table, &both, &samples, &w);
    if (status == STRUM_OK)
        status = linalg_gram(part->count, w.count, w.data, w.count, matrix, part->count,
                             scratch->work);
    arena_free(&samples);
    return status;
}

strum_status in_plane_inertia(double weight_t, double weight_n, const in_plane_frame *f,
                              const in_plane_part *part, in_plane_form form, double *matrix,
                              arena *scratch)
{
    return weighted(weight_t, weight_n, 1, f, part,
                    form == IN_PLANE_FORCE_FORM ? f->b->p : f->b->q, matrix, scratch);
}

strum_status in_plane_complementary(double weight_t, double weight_n, const in_plane_frame *f,
                                    const in_plane_part *part, double *matrix, arena *scratch)
{
    return weighted(weight_t, weight_n, -1, f, part, f->b->p, matrix, scratch);
}
