/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/krylov.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* A vector of which orthogonalising leaves less is rounding. */
#define NOTHING_LEFT 1e-13
#define LITTLE_LEFT  1e-2
#define ROUNDS       4

/* Takes from x (and z = K x) its part in the basis; returns the square of its norm. */
static double orthogonalise(const krylov *b, double *x, double *z)
{
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k < b->size; k++) {
            const double *q = b->q + (size_t)k * b->n;
            const double part = motion_dot(b->n, q, z);
            motion_add(b->n, -part, q, x);
            motion_add(b->n, -part, b->z + (size_t)k * b->n, z);
        }
    return motion_dot(b->n, x, z);
}

bool krylov_add(krylov *b, const double *load)
{
    if (b->size == b->most)
        return false;
    double *q = b->q + (size_t)b->size * b->n, *z = b->z + (size_t)b->size * b->n;
    double first = 0, square = 0;
    for (int round = 0; round < ROUNDS; round++) {
        stiffness_solve(b->stiffness, load, q, z);
        const double before = motion_dot(b->n, q, z);
        if (round == 0)
            first = before;
        square = orthogonalise(b, q, z);
        if (!(square > NOTHING_LEFT * NOTHING_LEFT * first))
            return false;
        if (square > LITTLE_LEFT * before)
            break;
        /* q and z = K q have errors of what they were: what is left is solved for by itself */
        memcpy(b->load, z, b->n * sizeof *z);
        load = b->load;
    }
    const double scale = 1 / sqrt(square);
    for (size_t i = 0; i < b->n; i++) {
        q[i] *= scale;
        z[i] *= scale;
    }
    motion_mass(b->motion, q, b->room, b->y + (size_t)b->size * b->n);
    b->size++;
    return true;
}

double krylov_left(krylov *b, const double *load)
{
    stiffness_solve(b->stiffness, load, b->x, b->load);
    return fmax(orthogonalise(b, b->x, b->load), 0);
}

double krylov_tail(krylov *b, int i)
{
    return sqrt(krylov_left(b, b->y + (size_t)i * b->n));
}

/* The load of inertia of an arbitrary motion: every mode has a part in it. */
static void generic_load(const krylov *b, uint64_t seed, double *load)
{
    const motion *m = b->motion;
    double *u = b->room, *nodes = u + m->components * m->points;
    for (int i = 0; i < m->components * m->points; i++) {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        const double mass = m->mass_normal[i % m->points];
        u[i] = mass * (1 + 0.5 * (double)(seed >> 40) / (double)(1 << 24));
    }
    memset(nodes, 0, 2 * (size_t)(m->element_count + 1) * sizeof *nodes);
    motion_load(m, u, nodes, load);
}

strum_status krylov_begin(const motion *m, stiffness *k, int generic, int most, arena *memory,
                          krylov *b)
{
    const size_t n = (size_t)m->columns;
    if (most > m->columns)
        most = m->columns;
    *b = (krylov){.motion = m, .stiffness = k, .n = n, .most = most};
    b->start = m->link_count + generic;
    b->q = arena_room(memory, 3 * (size_t)most * n);
    b->links = arena_room(memory, (size_t)m->link_count * n + 2 * n + motion_room(m));
    if (b->q == NULL || b->links == NULL)
        return STRUM_ERR_MEMORY;
    b->z = b->q + (size_t)most * n;
    b->y = b->z + (size_t)most * n;
    b->x = b->links + (size_t)m->link_count * n;
    b->load = b->x + n;
    b->room = b->load + n;
    for (int i = 0; i < m->link_count; i++)
        motion_row_load(m, m->links[i].node, m->links[i].x, m->links[i].z, b->room,
                        b->links + (size_t)i * n);
    return STRUM_OK;
}

/* Microseconds of one more vector. */
static double work_of(const krylov *b)
{
    return 2e-3 * (double)b->n * (b->size + 80);
}

strum_status krylov_extend(krylov *b, int size, work *w)
{
    if (size > b->most)
        size = b->most;
    while (b->size < size) {
        const strum_status status = work_spend(w, work_of(b));
        if (status != STRUM_OK)
            return status;
        if (b->started < b->start) {
            const int i = b->started++;
            if (i >= b->motion->link_count) {
                generic_load(b, (uint64_t)i * 7919 + 1, b->load);
                krylov_add(b, b->load);
            } else {
                krylov_add(b, b->links + (size_t)i * b->n);
            }
        } else if (b->next < b->size) {
            krylov_add(b, b->y + (size_t)b->next++ * b->n);
        } else {
            b->exhausted = true;
            break;
        }
    }
    if (b->size == b->motion->columns - b->stiffness->rank)
        b->exhausted = true;
    return STRUM_OK;
}
