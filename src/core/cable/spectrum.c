/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/spectrum.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "core/cable/damped.h"
#include "core/cable/inertia.h"
#include "core/cable/spectrum_damped.h"

/* Of a mode's error: what leaves the basis, squared, and the last coefficients on each element,
 * squared, both relative to 1. */
#define BASIS_ERROR 1e-15
#define MESH_ERROR  1e-13
#define MORE_STEP   6
#define MORE_MAX    24
#define ROUNDS      40

/* ---- errors ---- */

/* Squares of what the last two functions of each kind carry, over all elements; the stiffness
 * energy of the mode is 1. */
double spectrum_mesh_error(const motion *m, const double *v)
{
    double sum = 0;
    for (int i = 0; i < m->element_count; i++) {
        const motion_element *e = m->elements + i;
        const double tension = m->tension[e->point + e->rule->points / 2];
        for (int k = 1; k <= 2 && k < e->strains; k++) {
            const double last = v[e->strain + e->strains - k];
            sum += last * last;
        }
        for (int k = 1; k <= 2 && k + 2 < e->rotations; k++) {
            const int degree = e->rotations - k;
            const double last = v[e->inner + e->rotations - 2 - k];
            /* the integral of the orthonormal polynomial has the norm 1/degree */
            sum += last * last *
                   (e->bending / e->half + e->half * tension / ((double)degree * degree));
        }
    }
    return sum;
}

/* sqrt(SUM (v_k tail_k)^2) over the vectors that were not multiplied yet. */
static double basis_error(const krylov *b, const double *v, const double *tails)
{
    double sum = 0;
    for (int k = b->next; k < b->size; k++)
        sum += v[k] * v[k] * tails[k] * tails[k];
    return sum;
}

/* ---- undamped ---- */

static void expand(const krylov *b, const double *v, double *x)
{
    memset(x, 0, b->n * sizeof *x);
    for (int k = 0; k < b->size; k++)
        motion_add(b->n, v[k], b->q + (size_t)k * b->n, x);
}

/* Rayleigh's quotient in the full unknowns: far above the first frequency, or beside a heavy body,
 * the reduced eigenvalue has no more digits than eps times the largest allows. */
static double quotient(const motion *m, const reduced *r, const double *v, const double *x,
                       double *room)
{
    const krylov *b = r->basis;
    double *y = room + motion_room(m);
    motion_mass(m, x, room, y);
    double mass = motion_dot(b->n, x, y), stiff = motion_dot((size_t)r->size, v, v);
    int own = r->size;
    for (int l = 0; l < m->link_count; l++) {
        const motion_link *link = m->links + l;
        if (!(link->mass > 0))
            continue;
        const double moved = motion_dot((size_t)r->size, r->part + l * r->size, v);
        mass += link->mass * v[own] * v[own];
        stiff += link->stiffness * (v[own] - moved) * (v[own] - moved);
        own++;
    }
    return mass / stiff;
}

static strum_status keep_undamped(const motion *m, const reduced *r, int count, arena *memory,
                                  spectrum *s)
{
    const size_t n = (size_t)m->columns;
    double *vectors = arena_room(memory, (size_t)count * n);
    double *room = arena_room(memory, motion_room(m) + n);
    s->modes = arena_alloc(memory, (size_t)count + 1, sizeof *s->modes);
    if (vectors == NULL || room == NULL || s->modes == NULL)
        return STRUM_ERR_MEMORY;
    for (int i = 0; i < count; i++) {
        const double *v = r->modes + (size_t)i * (size_t)r->n;
        double *x = vectors + (size_t)i * n;
        expand(r->basis, v, x);
        const double mu = quotient(m, r, v, x, room);
        const double error = spectrum_mesh_error(m, x);
        s->modes[i] = (spectrum_mode){I / sqrt(mu), x, NULL, error};
        s->error = fmax(s->error, error);
    }
    s->count = count;
    return STRUM_OK;
}

/* Until the wanted modes do not leave the basis. */
static strum_status converge(krylov *b, int want, int first, arena *memory, reduced *r)
{
    double *tails = arena_room(memory, (size_t)b->most);
    if (tails == NULL)
        return STRUM_ERR_MEMORY;
    int size = first;
    for (int round = 0; round < ROUNDS; round++, size = b->size + 4 + b->start) {
        strum_status status = krylov_extend(b, size, memory->work);
        if (status == STRUM_OK)
            status = reduced_make(b, memory, r);
        if (status == STRUM_OK)
            status = reduced_undamped(r, memory);
        if (status != STRUM_OK || b->exhausted)
            return status;
        for (int k = b->next; k < b->size; k++)
            tails[k] = krylov_tail(b, k);
        double worst = 0;
        for (int i = 0; i < want && i < r->n; i++)
            worst = fmax(worst, basis_error(b, r->modes + (size_t)i * (size_t)r->n, tails) /
                                    (r->mu[i] * r->mu[i]));
        if (worst < BASIS_ERROR)
            return STRUM_OK;
        if (b->size == b->most)
            return STRUM_ERR_ACCURACY;
    }
    return STRUM_ERR_ACCURACY;
}

/* The count between modes `count` and the next one: where they are equal, before the next that
 * differs. */
static strum_status count_undamped(const reduced *r, spectrum *s, work *w)
{
    int found = s->count;
    while (found < r->n && r->mu[found] > r->mu[found - 1] * (1 - 1e-9))
        found++;
    const double last = 1 / sqrt(r->mu[found - 1]);
    const double next = found < r->n && r->mu[found] > 0
                            ? fmin(1 / sqrt(r->mu[found]), 1.5 * last)
                            : 1.5 * last;
    static const double between[] = {0.5, 0.62, 0.37, 0.71, 0.29};
    strum_status status = STRUM_OK;
    for (size_t i = 0; i < sizeof between / sizeof *between && status == STRUM_OK; i++) {
        bool safe;
        long below = 0;
        status =
            inertia_count(&s->stiffness, last + between[i] * (next - last), w, &below, &safe);
        s->expected = below;
        s->found = found;
        if (safe)
            break;
    }
    return status;
}

static strum_status undamped(int want, arena *memory, spectrum *s)
{
    krylov basis;
    reduced r = {0};
    const int links = s->motion.link_count, first = want + 20 + 6 * links;
    strum_status status =
        krylov_begin(&s->motion, &s->stiffness, 2, 3 * want + 60 + 24 * links, memory, &basis);
    if (status == STRUM_OK)
        status = converge(&basis, want, first, memory, &r);
    if (status != STRUM_OK)
        return status;
    int most = 0;
    while (most < r.n && r.mu[most] > DBL_EPSILON * DBL_EPSILON * r.mu[0])
        most++;
    status = keep_undamped(&s->motion, &r, want < most ? want : most, memory, s);
    return status == STRUM_OK ? count_undamped(&r, s, memory->work) : status;
}

/* ---- in all ---- */

static strum_status attempt(const strum_hanging *cable, const motion_choice *choice,
                            arena *memory, spectrum *s)
{
    *s = (spectrum){0};
    strum_status status = motion_make(cable, choice, memory, &s->motion);
    if (status == STRUM_OK)
        status = stiffness_make(&s->motion, memory, &s->stiffness);
    if (status != STRUM_OK)
        return status;
    return damped_needed(&s->motion) ? spectrum_damped(choice->modes, memory, s)
                                     : undamped(choice->modes, memory, s);
}

strum_status spectrum_make(const strum_hanging *cable, const motion_choice *choice,
                           arena *memory, spectrum *s)
{
    motion_choice refined = *choice;
    for (; refined.more <= MORE_MAX; refined.more += MORE_STEP) {
        const strum_status status = attempt(cable, &refined, memory, s);
        if (status != STRUM_OK || (s->error < MESH_ERROR && s->expected == s->found))
            return status;
    }
    return STRUM_ERR_ACCURACY;
}
