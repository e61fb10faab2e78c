/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/suspended/displacement.h"

#include <math.h>

#include "core/numerics/linalg.h"

/*
 * Samples of the functions phi_k, phi_k'' = p_k, k = first, first + step, ..: their Gram
 * matrices are stiffness and inertia. phi_k = norm (q_{k+1}/sqrt(k+3/2) - q_{k-1}/sqrt(k-1/2))
 * is clamped for k >= 2.
 */
typedef struct samples {
    int count, points;
    double *strain, *motion; /* points x count, 2 points x count */
} samples;

static strum_status sample(const strum_cable *cable, const legendre *b, int first, int step,
                           arena *a, samples *s)
{
    const size_t points = (size_t)b->points, n = (size_t)s->count;
    s->points = b->points;
    double *weight = arena_room(a, 5 * points);
    s->strain = arena_room(a, 3 * points * n);
    if (weight == NULL || s->strain == NULL)
        return STRUM_ERR_MEMORY;
    s->motion = s->strain + points * n;
    double *on_u2 = weight, *on_u1 = weight + points, *on_u = weight + 2 * points;
    double *along = weight + 3 * points, *across = weight + 4 * points;
    const double mu = cable->mu;
    for (size_t i = 0; i < points; i++) {
        const double chi = cable->chi_m + mu * b->x[i], c = cosh(chi), w = sqrt(b->w[i] * mu);
        on_u2[i] = w * c / (mu * mu);
        on_u1[i] = w * sinh(chi) / mu;
        on_u[i] = w / c;
        along[i] = w * sqrt(cable->mass_t * c);
        across[i] = w * sqrt(cable->mass_n * c) * c / mu;
    }
    for (size_t j = 0; j < n; j++) {
        const size_t k = (size_t)first + j * (size_t)step;
        const double norm = sqrt((double)k + 0.5) / (2 * (double)k + 1);
        const double up = norm / sqrt((double)k + 1.5), down = norm / sqrt((double)k - 0.5);
        const double *p = b->p + k * points, *q = b->q + k * points;
        const double *above = q + points, *below = q - points;
        double *strain = s->strain + j * points, *motion = s->motion + 2 * j * points;
        for (size_t i = 0; i < points; i++) {
            const double u = up * above[i] - down * below[i];
            strain[i] = on_u2[i] * p[i] + on_u1[i] * q[i] + on_u[i] * u;
            motion[i] = along[i] * u;
            motion[points + i] = across[i] * q[i];
        }
    }
    return STRUM_OK;
}

/* Modes of the first `n` functions: M v = (1/w^2) K v, M and then K of `full` functions. */
static strum_status solve(const root_search *q, strum_symmetry symmetry, const double *inertia,
                          int full, int n, arena *a, arena *scratch, root_list *list)
{
    const int want = q->want < n ? q->want : n;
    const double *stiffness = inertia + (size_t)full * (size_t)full;
    double *mu = arena_doubles(scratch, (size_t)n);
    if (mu == NULL)
        return STRUM_ERR_MEMORY;
    /* graded from its first row on, so that its eigenvalues need no vectors to mend them */
    strum_status status =
        linalg_symmetric(n, inertia, full, stiffness, full, want, mu, NULL, a->work);
    if (status == STRUM_OK)
        status = root_list_grow(list, 2 * want, a);
    const root model = {.symmetry = symmetry};
    for (int i = 0; status == STRUM_OK && i < want; i++)
        roots_of_natural(1 / sqrt(mu[i]), q->cable->eta_t / q->cable->mass_t, &model, list);
    return status;
}

/* Functions first, first + step, .. : one symmetry class, or all. */
typedef struct class_of {
    strum_symmetry symmetry;
    int first, step;
    int count, inner; /* functions, and those of the smaller size */
} class_of;

static strum_status class_roots(const root_search *q, const legendre *b, const class_of *c,
                                arena *a, arena *scratch, root_list *list, root_list *inner)
{
    const int n = c->count;
    samples s = {.count = n};
    strum_status status = sample(q->cable, b, c->first, c->step, scratch, &s);
    double *matrices = arena_room(scratch, 2 * (size_t)n * (size_t)n);
    if (status != STRUM_OK || matrices == NULL)
        return STRUM_ERR_MEMORY;
    status = linalg_gram(n, s.points, s.strain, s.points, matrices + (size_t)n * (size_t)n, n,
                         a->work);
    if (status == STRUM_OK)
        status = linalg_gram(n, 2 * s.points, s.motion, 2 * s.points, matrices, n, a->work);
    if (status == STRUM_OK)
        status = solve(q, c->symmetry, matrices, n, n, a, scratch, list);
    if (status == STRUM_OK && inner != NULL)
        status = solve(q, c->symmetry, matrices, n, c->inner, a, scratch, inner);
    return status;
}

strum_status displacement_roots(const root_search *q, bool by_symmetry, arena *a,
                                root_list *list, root_list *inner)
{
    legendre b;
    arena functions = {.work = a->work};
    strum_status status =
        legendre_make(q->size + 3, M_PI_2 / q->cable->mu, by_symmetry, &functions, &b);
    const int classes = by_symmetry ? 2 : 1;
    for (int i = 0; i < classes && status == STRUM_OK; i++) {
        /* phi_k has the parity of k; u is even in an antisymmetric mode */
        const class_of c = {.symmetry = !by_symmetry ? STRUM_NO_SYMMETRY
                                        : i == 0     ? STRUM_ANTISYMMETRIC
                                                     : STRUM_SYMMETRIC,
                            .first = 2 + i,
                            .step = classes,
                            .count = (q->size - i + classes - 1) / classes,
                            .inner = (q->block - i + classes - 1) / classes};
        arena scratch = {.work = a->work};
        status = class_roots(q, &b, &c, a, &scratch, list, inner);
        arena_free(&scratch);
    }
    arena_free(&functions);
    return status;
}

/*
 * Two demands, and a bit more where they are alike: the waves, about (count + 1)/2 of them,
 * and the cable's own shape, whose Legendre series shrinks as Bernstein's ellipse through chi =
 * i pi/2 says. Too small a size costs a second round, never digits.
 */
int displacement_first_size(const strum_cable *cable, int count)
{
    const double k = (count + 1) * M_PI_2;
    const double waves = k + 4.5 * cbrt(k) + 1, shape = 14 / asinh(M_PI_2 / cable->mu) + 5;
    return (int)ceil(cbrt(pow(waves, 3) + pow(shape, 3)));
}

int displacement_margin(const strum_cable *cable, int size)
{
    return 4 + size / 32 + (int)(2 / asinh(M_PI_2 / cable->mu));
}
