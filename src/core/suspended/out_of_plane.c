/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Out-of-plane motion: V_chi = -w^2 cosh(chi) W, W_chi = e V, W = 0 at both ends, with e = 1
 * [Gale 2.38, 2.44] or, about the exact elastic catenary, e = 1 + kappa_n cosh(chi); damping
 * makes w^2 = -(m_n s^2 + eta_n s) exactly.
 *
 * Displacement form: W = sum a_k q_k (k >= 1), for which INT W'^2 is the identity, so that for
 * e = 1 and a linear coordinate mu INT q_i q_j cosh(chi) dx = (1/w^2) (1/mu) I. Force form
 * (dual): V = c + sum f_k q_k (k >= 0), -(V'/cosh)' = w^2 e V with natural ends and the
 * constant projected out.
 */
#include <math.h>

#include "core/numerics/linalg.h"
#include "core/suspended/roots.h"

/* Unknowns k < size of one parity class, in order of k. `odd_q`: the q_k that are odd (k even).
 */
static int choose(strum_symmetry symmetry, bool force_form, int size, int *index)
{
    int n = 0;
    for (int k = force_form ? 0 : 1; k < size; k++) {
        /* symmetric: W even, so q_k with k odd; V = W' odd, so q_k with k even */
        const bool odd_q = k % 2 == 0;
        if (symmetry == STRUM_NO_SYMMETRY ||
            odd_q == ((symmetry == STRUM_ANTISYMMETRIC) != force_form))
            index[n++] = k;
    }
    return n;
}

/* Makes a column orthogonal to the constant, whose column is `one`. */
static void remove_constant(int points, const double *one, double *column)
{
    double along = 0, square = 0;
    for (int i = 0; i < points; i++) {
        along += one[i] * column[i];
        square += one[i] * one[i];
    }
    for (int i = 0; i < points; i++)
        column[i] -= along / square * one[i];
}

/* A v = (1/w^2) K v of one class; K NULL for a multiple of the identity that is already divided
 * out. Leading blocks are smaller discretisations. */
typedef struct class_problem {
    strum_symmetry symmetry;
    int size, count; /* of all functions; of this class's */
    int *index;      /* k of each */
    double *a, *k;
} class_problem;

/* Roots of the first `n` unknowns. The matrices are graded: no vectors are needed to mend
 * values. */
static strum_status class_roots(const root_search *q, const class_problem *c, int n,
                                bool vectors, arena *a, arena *scratch, root_list *list)
{
    const strum_cable *cable = q->cable;
    const size_t count = (size_t)n;
    const int want = q->want < n ? q->want : n;
    double *mu = arena_doubles(scratch, count);
    double *v = vectors ? arena_doubles(scratch, count * (size_t)want) : NULL;
    if (mu == NULL || (vectors && v == NULL))
        return STRUM_ERR_MEMORY;
    strum_status status =
        linalg_symmetric(n, c->a, c->count, c->k, c->count, want, mu, v, a->work);
    if (status == STRUM_OK)
        status = root_list_grow(list, 2 * want, a);
    for (int i = 0; status == STRUM_OK && i < want && mu[i] > 1e-14 * mu[0]; i++) {
        root r = {.symmetry = c->symmetry};
        if (vectors) {
            r.vector = arena_alloc(a, (size_t)c->size, sizeof *r.vector);
            if (r.vector == NULL)
                return STRUM_ERR_MEMORY;
            r.length = c->size;
            for (int j = 0; j < n; j++)
                r.vector[c->index[j]] = v[j + (size_t)i * count];
        }
        roots_of_natural(1 / sqrt(mu[i] * cable->mass_n), cable->eta_n / cable->mass_n, &r,
                         list);
    }
    return status;
}

/* The form, and its weights at the nodes: of the unknowns' values and of their slopes. */
typedef struct weights {
    bool force_form;
    bool identity; /* the slopes' matrix is a multiple of it */
    double *value, *slope;
} weights;

static strum_status weigh(const strum_cable *cable, const mapping *x, const legendre *b,
                          arena *a, weights *w)
{
    const size_t points = (size_t)b->points;
    w->value = arena_room(a, 2 * points);
    if (w->value == NULL)
        return STRUM_ERR_MEMORY;
    w->slope = w->value + points;
    for (size_t i = 0; i < points; i++) {
        const double c = cosh(cable->chi_m + mapping_offset(x, b->x[i]));
        const double e = 1 + cable->kappa_n * c, stretch = mapping_slope(x, b->x[i]);
        w->value[i] = sqrt(b->w[i] * stretch * cable->mu * (w->force_form ? e : c));
        w->slope[i] = sqrt(b->w[i] / stretch * cable->mu / (w->force_form ? c : e));
    }
    return STRUM_OK;
}

static strum_status class_make(const legendre *b, const weights *by, arena *a, class_problem *c)
{
    const bool identity = by->identity;
    c->size = b->count;
    c->index = arena_alloc(a, (size_t)c->size, sizeof *c->index);
    if (c->index == NULL)
        return STRUM_ERR_MEMORY;
    c->count = choose(c->symmetry, by->force_form, c->size, c->index);
    const size_t points = (size_t)b->points, count = (size_t)c->count;
    double *w = arena_room(a, points * count);
    c->a = arena_room(a, (identity ? 1 : 2) * count * count);
    if (w == NULL || c->a == NULL)
        return STRUM_ERR_MEMORY;
    for (size_t j = 0; j < count; j++) {
        const double *q = b->q + (size_t)c->index[j] * points;
        for (size_t i = 0; i < points; i++)
            w[i + j * points] = by->value[i] * q[i];
        /* the constant is even: it only meets the even force of antisymmetric motion */
        if (by->force_form && c->symmetry != STRUM_SYMMETRIC)
            remove_constant(b->points, by->value, w + j * points);
    }
    strum_status status =
        linalg_gram(c->count, b->points, w, b->points, c->a, c->count, a->work);
    c->k = identity ? NULL : c->a + count * count;
    for (size_t j = 0; j < count && !identity && status == STRUM_OK; j++) {
        const double *p = b->p + (size_t)c->index[j] * points;
        for (size_t i = 0; i < points; i++)
            w[i + j * points] = by->slope[i] * p[i];
    }
    if (!identity && status == STRUM_OK)
        status = linalg_gram(c->count, b->points, w, b->points, c->k, c->count, a->work);
    return status;
}

strum_status out_of_plane_roots(const root_search *q, arena *a, root_list *list,
                                root_list *inner)
{
    const strum_cable *cable = q->cable;
    const mapping *x = q->x;
    const bool level = cable->chi_m == 0;
    weights by = {.force_form = q->form == IN_PLANE_CLAMPED_FORM};
    by.identity = !by.force_form && cable->kappa_n == 0 && x->stretch == 0;
    legendre b;
    arena functions = {.work = a->work};
    strum_status status = legendre_make(q->size, mapping_singularity(x), level, &functions, &b);
    if (status == STRUM_OK)
        status = weigh(cable, x, &b, &functions, &by);
    const strum_symmetry first = level ? STRUM_SYMMETRIC : STRUM_NO_SYMMETRY;
    const strum_symmetry last = level ? STRUM_ANTISYMMETRIC : STRUM_NO_SYMMETRY;
    for (strum_symmetry symmetry = first; status == STRUM_OK && symmetry <= last; symmetry++) {
        class_problem c = {.symmetry = symmetry};
        arena scratch = {.work = a->work};
        status = class_make(&b, &by, &scratch, &c);
        if (status == STRUM_OK)
            status = class_roots(q, &c, c.count, q->vectors, a, &scratch, list);
        int n = 0;
        while (status == STRUM_OK && n < c.count && c.index[n] < q->block)
            n++;
        if (status == STRUM_OK && inner != NULL)
            status = class_roots(q, &c, n, false, a, &scratch, inner);
        arena_free(&scratch);
    }
    arena_free(&functions);
    return status;
}
