/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/damped.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/numerics/linalg.h"

#define NEWTON_STEPS 12
/* A root that turns from the real axis by less is real. */
#define REAL_BELOW 1e-8

bool damped_needed(const motion *m)
{
    bool some = m->drag_normal != NULL || m->loss_axial_max > 0 || m->loss_bending_max > 0;
    for (int i = 0; i < m->link_count; i++)
        some = some || m->links[i].damping > 0;
    return some;
}

/* ---- the matrices ---- */

/* What each damper moves with: the cable along its line, less its absorber's mass. */
static void parts_of_links(const reduced *r, damped *d)
{
    const motion *m = r->basis->motion;
    int own = r->size;
    for (int l = 0; l < m->link_count; l++) {
        const motion_link *link = m->links + l;
        const bool absorbs = link->mass > 0;
        if (link->damping > 0) {
            double *part = d->part + (size_t)d->rank * (size_t)d->n;
            for (int k = 0; k < d->n; k++) {
                const double *mode = r->modes + (size_t)k * (size_t)r->n;
                part[k] =
                    motion_dot((size_t)r->size, r->part + (size_t)l * (size_t)r->size, mode) -
                    (absorbs ? mode[own] : 0);
            }
            d->constant[d->rank++] = link->damping;
        }
        own += absorbs;
    }
}

/* Adds W' A W for an operator A on the full unknowns, W the undamped modes. */
static strum_status project(const reduced *r, arena *memory, bool loss, double *to)
{
    const krylov *b = r->basis;
    const size_t n = (size_t)r->n, size = (size_t)r->size;
    arena scratch = {.work = memory->work};
    double *small = arena_doubles(&scratch, n * n), *half = arena_room(&scratch, n * n);
    double *y = arena_room(&scratch, b->n + motion_room(b->motion) + n * n), *room = y + b->n;
    strum_status status =
        small == NULL || half == NULL || y == NULL ? STRUM_ERR_MEMORY : STRUM_OK;
    for (size_t j = 0; j < size && status == STRUM_OK; j++) {
        status = work_spend(memory->work, 2e-2 * (double)b->n);
        if (loss)
            stiffness_loss(b->motion, b->q + j * b->n, y);
        else
            motion_drag(b->motion, b->q + j * b->n, room, y);
        for (size_t i = 0; i <= j; i++)
            small[i + j * n] = small[j + i * n] = motion_dot(b->n, b->q + i * b->n, y);
    }
    if (status == STRUM_OK) {
        double *product = room + motion_room(b->motion);
        linalg_multiply('N', 'N', r->n, r->n, r->n, small, r->n, r->modes, r->n, half, r->n);
        linalg_multiply('T', 'N', r->n, r->n, r->n, r->modes, r->n, half, r->n, product, r->n);
        motion_add(n * n, 1, product, to);
    }
    arena_free(&scratch);
    return status;
}

static strum_status matrices(const reduced *r, arena *memory, damped *d)
{
    const motion *m = r->basis->motion;
    const size_t n = (size_t)r->n;
    d->damping = arena_doubles(memory, n * n);
    d->part = arena_doubles(memory, (size_t)(m->link_count + 1) * (n + 1));
    if (d->damping == NULL || d->part == NULL)
        return STRUM_ERR_MEMORY;
    d->constant = d->part + (size_t)(m->link_count + 1) * n;
    parts_of_links(r, d);
    for (int l = 0; l < d->rank; l++)
        for (size_t j = 0; j < n; j++)
            motion_add(n, d->constant[l] * d->part[(size_t)l * n + j], d->part + (size_t)l * n,
                       d->damping + j * n);
    strum_status status = STRUM_OK;
    if (m->drag_normal != NULL) {
        d->rank = 0;
        status = project(r, memory, false, d->damping);
    }
    if (status == STRUM_OK && (m->loss_axial_max > 0 || m->loss_bending_max > 0)) {
        d->rank = 0;
        d->loss = arena_doubles(memory, n * n);
        status = d->loss == NULL ? STRUM_ERR_MEMORY : project(r, memory, true, d->loss);
    }
    return status;
}

/* P(lambda) with `share` of the structural loss, column-major. */
static void characteristic(const damped *d, double _Complex lambda, double share,
                           double _Complex *p)
{
    const size_t n = (size_t)d->n;
    for (size_t j = 0; j < n; j++) {
        for (size_t i = 0; i < n; i++) {
            const double lost = d->loss != NULL ? share * d->loss[i + j * n] : 0;
            p[i + j * n] = lambda * d->damping[i + j * n] + CMPLX(0, lost);
        }
        p[j + j * n] += 1 + lambda * lambda * d->reduced->mu[j];
    }
}

/* ---- Newton ---- */

/* One step of Rayleigh's quotient g'P(lambda) g = 0; P and C are symmetric. */
static double _Complex quotient_step(const damped *d, double share, double _Complex lambda,
                                     const double _Complex *g)
{
    const size_t n = (size_t)d->n;
    double _Complex value = 0, slope = 0;
    for (size_t j = 0; j < n; j++) {
        double _Complex damping = 0, lost = 0;
        for (size_t i = 0; i < n; i++) {
            damping += d->damping[i + j * n] * g[i];
            if (d->loss != NULL)
                lost += share * d->loss[i + j * n] * g[i];
        }
        const double mu = d->reduced->mu[j];
        value += g[j] * (g[j] * (1 + lambda * lambda * mu) + lambda * damping + I * lost);
        slope += g[j] * (2 * lambda * mu * g[j] + damping);
    }
    return lambda - value / slope;
}

static void normalise(size_t n, double _Complex *g)
{
    double square = 0;
    for (size_t i = 0; i < n; i++)
        square += creal(g[i]) * creal(g[i]) + cimag(g[i]) * cimag(g[i]);
    const double scale = 1 / sqrt(square);
    for (size_t i = 0; i < n; i++)
        g[i] *= scale;
}

/* Inverse iteration and quotient by turns: the error is cubed each time. */
static strum_status newton(const damped *d, double share, damped_root *root, work *w)
{
    const size_t n = (size_t)d->n;
    arena scratch = {.work = w};
    double _Complex *p = arena_alloc(&scratch, n * n, sizeof *p);
    strum_status status = p == NULL ? STRUM_ERR_MEMORY : STRUM_OK;
    for (int step = 0; step < NEWTON_STEPS && status == STRUM_OK; step++) {
        const double _Complex next = quotient_step(d, share, root->lambda, root->vector);
        const double change = cabs(next - root->lambda) / cabs(next);
        root->lambda = next;
        if (change < 1e-14)
            break;
        characteristic(d, next * (1 + 1e-13), share, p);
        status = linalg_complex_solve(d->n, p, root->vector, w);
        if (status == STRUM_ERR_INTERNAL) /* singular: there already */
            status = STRUM_OK;
        normalise(n, root->vector);
    }
    arena_free(&scratch);
    return status;
}

/* ---- all roots ---- */

static int by_imaginary(const void *a, const void *b)
{
    const damped_root *x = a, *y = b;
    const double p = cimag(x->lambda), q = cimag(y->lambda);
    return p < q ? -1 : p > q;
}

static int by_modulus(const void *a, const void *b)
{
    const damped_root *x = a, *y = b;
    const double p = cabs(x->lambda), q = cabs(y->lambda);
    return p < q ? -1 : p > q;
}

static strum_status pencil(damped *d, arena *memory)
{
    const size_t n = (size_t)d->n;
    double _Complex *values = arena_alloc(memory, 2 * n + 2 * n * n, sizeof *values);
    double *mass = arena_doubles(memory, n * n);
    d->roots = arena_alloc(memory, 4 * n, sizeof *d->roots);
    if (values == NULL || mass == NULL || d->roots == NULL)
        return STRUM_ERR_MEMORY;
    d->real = d->roots + 2 * n;
    double _Complex *vectors = values + 2 * n;
    for (size_t j = 0; j < n; j++)
        mass[j + j * n] = d->reduced->mu[j];
    const strum_status status =
        linalg_quadratic(d->n, d->damping, mass, values, vectors, memory->work);
    for (size_t k = 0; k < 2 * n && status == STRUM_OK; k++) {
        /* of masses that are nothing */
        if (cabs(values[k]) < DBL_EPSILON * sqrt(d->reduced->mu[0]))
            continue;
        const damped_root root = {1 / values[k], vectors + k * n};
        if (cimag(root.lambda) > REAL_BELOW * cabs(root.lambda))
            d->roots[d->count++] = root;
        else if (cimag(root.lambda) >= -REAL_BELOW * cabs(root.lambda))
            d->real[d->real_count++] = root;
    }
    return status;
}

/* From the roots without structural loss to those with it, in steps short beside the gaps. */
static strum_status follow_loss(damped *d, int count, work *w)
{
    const motion *m = d->reduced->basis->motion;
    const int steps = 1 + (int)ceil(20 * fmin(fmax(m->loss_axial_max, m->loss_bending_max), 2));
    strum_status status = STRUM_OK;
    for (int i = 0; i < count && status == STRUM_OK; i++)
        for (int k = 1; k <= steps && status == STRUM_OK; k++)
            status = newton(d, (double)k / steps, d->roots + i, w);
    return status;
}

strum_status damped_make(const reduced *r, int want, arena *memory, damped *d)
{
    *d = (damped){.reduced = r, .n = r->n};
    strum_status status = matrices(r, memory, d);
    if (status == STRUM_OK)
        status = pencil(d, memory);
    if (status != STRUM_OK)
        return status;
    qsort(d->roots, (size_t)d->count, sizeof *d->roots, by_imaginary);
    qsort(d->real, (size_t)d->real_count, sizeof *d->real, by_modulus);
    const int exact = want + 6 < d->count ? want + 6 : d->count;
    for (int i = 0; i < d->count; i++)
        normalise((size_t)d->n, d->roots[i].vector);
    for (int i = 0; i < d->real_count; i++)
        normalise((size_t)d->n, d->real[i].vector);
    if (d->loss != NULL) {
        status = follow_loss(d, exact, memory->work);
        d->count = exact;
        qsort(d->roots, (size_t)d->count, sizeof *d->roots, by_imaginary);
        return status;
    }
    for (int i = 0; i < exact; i++)
        for (int k = 0; k < 2; k++)
            d->roots[i].lambda = quotient_step(d, 0, d->roots[i].lambda, d->roots[i].vector);
    return status;
}

/* ---- determinants ---- */

bool damped_has_poles(const damped *d)
{
    return d->rank > 0;
}

size_t damped_phase_room(const damped *d)
{
    const size_t n = (size_t)(d->rank > 0 ? d->rank : d->n);
    return n * n;
}

/* The unit of a determinant, by elimination with row pivots. */
static double _Complex unit_of_determinant(size_t n, double _Complex *a)
{
    double _Complex unit = 1;
    for (size_t j = 0; j < n; j++) {
        size_t best = j;
        for (size_t i = j + 1; i < n; i++)
            if (cabs(a[i + j * n]) > cabs(a[best + j * n]))
                best = i;
        if (best != j) {
            unit = -unit;
            for (size_t k = j; k < n; k++) {
                const double _Complex kept = a[j + k * n];
                a[j + k * n] = a[best + k * n];
                a[best + k * n] = kept;
            }
        }
        const double size = cabs(a[j + j * n]);
        if (size == 0)
            return 0;
        unit *= a[j + j * n] / size;
        for (size_t k = j + 1; k < n; k++) {
            const double _Complex factor = a[j + k * n] / a[j + j * n];
            for (size_t i = j + 1; i < n && factor != 0; i++)
                a[i + k * n] -= factor * a[i + j * n];
        }
    }
    return unit / cabs(unit);
}

strum_status damped_phase(const damped *d, double _Complex lambda, double _Complex *room,
                          work *w, double _Complex *phase)
{
    const size_t n = (size_t)d->n, rank = (size_t)d->rank;
    const size_t size = rank > 0 ? rank : n;
    const strum_status status =
        work_spend(w, 2e-3 * (double)(size * size * size) + 1e-2 * (double)(n * rank * rank));
    if (status != STRUM_OK)
        return status;
    if (rank == 0) {
        characteristic(d, lambda, 1, room);
    } else {
        for (size_t i = 0; i < rank * rank; i++)
            room[i] = i % (rank + 1) == 0;
        for (size_t k = 0; k < n; k++) {
            const double _Complex mode = lambda / (1 + lambda * lambda * d->reduced->mu[k]);
            for (size_t j = 0; j < rank; j++)
                for (size_t i = 0; i < rank; i++)
                    room[i + j * rank] +=
                        d->constant[i] * mode * d->part[i * n + k] * d->part[j * n + k];
        }
    }
    *phase = unit_of_determinant(size, room);
    return STRUM_OK;
}
