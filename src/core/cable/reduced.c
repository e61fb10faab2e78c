/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/reduced.h"

#include <math.h>

#include "core/numerics/linalg.h"

static int absorbers(const motion *m)
{
    int count = 0;
    for (int i = 0; i < m->link_count; i++)
        count += m->links[i].mass > 0;
    return count;
}

static void project(const krylov *b, reduced *r)
{
    for (int i = 0; i < r->size; i++)
        for (int j = 0; j <= i; j++)
            r->mass[i * r->n + j] = r->mass[j * r->n + i] =
                motion_dot(b->n, b->q + (size_t)j * b->n, b->y + (size_t)i * b->n);
    for (int l = 0; l < b->motion->link_count; l++)
        for (int i = 0; i < r->size; i++)
            r->part[l * r->size + i] =
                motion_dot(b->n, b->links + (size_t)l * b->n, b->q + (size_t)i * b->n);
}

/* An absorber on a damper alone can be carried anywhere: a spring far below every other stiffness
 * keeps the matrix definite. Its own root -k/c is not one of the cable. */
#define NO_SPRING 1e-14

static double stiffness_of(const reduced *r, const motion_link *link)
{
    const double largest = r->mass[0];
    return fmax(link->stiffness, NO_SPRING * link->mass / largest);
}

static void attach(const krylov *b, reduced *r)
{
    for (int i = 0; i < r->size; i++)
        r->stiff[i * r->n + i] = 1;
    int own = r->size;
    for (int l = 0; l < b->motion->link_count; l++) {
        const motion_link *link = b->motion->links + l;
        const double *part = r->part + l * r->size;
        if (!(link->mass > 0))
            continue;
        const double k = stiffness_of(r, link);
        for (int i = 0; i < r->size; i++) {
            for (int j = 0; j < r->size; j++)
                r->stiff[i * r->n + j] += k * part[i] * part[j];
            r->stiff[i * r->n + own] = r->stiff[own * r->n + i] = -k * part[i];
        }
        r->stiff[own * r->n + own] = k;
        r->mass[own * r->n + own] = link->mass;
        own++;
    }
}

strum_status reduced_make(const krylov *basis, arena *memory, reduced *r)
{
    *r = (reduced){.basis = basis,
                   .size = basis->size,
                   .absorbers = absorbers(basis->motion),
                   .n = basis->size + absorbers(basis->motion)};
    const size_t square = (size_t)r->n * (size_t)r->n;
    r->mass = arena_doubles(memory, square);
    r->part = arena_doubles(memory, (size_t)(basis->motion->link_count * r->size) + 1);
    r->mu = arena_room(memory, (size_t)r->n);
    r->modes = arena_room(memory, square);
    if (r->mass == NULL || r->part == NULL || r->mu == NULL || r->modes == NULL)
        return STRUM_ERR_MEMORY;
    project(basis, r);
    if (r->absorbers == 0)
        return STRUM_OK;
    r->stiff = arena_doubles(memory, square);
    if (r->stiff == NULL)
        return STRUM_ERR_MEMORY;
    attach(basis, r);
    return STRUM_OK;
}

strum_status reduced_undamped(reduced *r, arena *memory)
{
    return linalg_symmetric(r->n, r->mass, r->n, r->stiff, r->n, r->n, r->mu, r->modes,
                            memory->work);
}
