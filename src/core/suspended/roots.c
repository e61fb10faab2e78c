/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/suspended/roots.h"

#include <math.h>
#include <string.h>

#include "core/numerics/linalg.h"

void roots_of_natural(double w, double rate, const root *model, root_list *list)
{
    const double half = rate / 2, beyond = half * half - w * w;
    root r = *model;
    r.natural = w;
    if (beyond < 0) {
        r.s = CMPLX(-half, sqrt((w - half) * (w + half)));
        list->items[list->count++] = r;
        return;
    }
    const double fast = half + sqrt(beyond);
    r.s = -fast;
    list->items[list->count++] = r;
    r.s = -w * w / fast;
    list->items[list->count++] = r;
}

bool in_plane_proportional(const strum_cable *cable)
{
    return cable->eta_t * cable->mass_n == cable->eta_n * cable->mass_t;
}

strum_status root_list_grow(root_list *list, int more, arena *a)
{
    root *items = arena_alloc(a, (size_t)(list->count + more), sizeof *items);
    if (items == NULL)
        return STRUM_ERR_MEMORY;
    if (list->count > 0)
        memcpy(items, list->items, (size_t)list->count * sizeof *items);
    list->items = items;
    return STRUM_OK;
}

strum_status in_plane_begin(const root_search *q, strum_symmetry symmetry, arena *functions,
                            arena *a, arena *scratch, legendre *basis, in_plane_frame *frame,
                            in_plane_part *part)
{
    strum_status status = legendre_make(q->size, mapping_singularity(q->x),
                                        symmetry != STRUM_NO_SYMMETRY, functions, basis);
    if (status == STRUM_OK)
        status = in_plane_frame_make(q->x, basis, functions, frame);
    if (status == STRUM_OK)
        status = in_plane_part_make(symmetry, q->form, q->size, a, part);
    return status == STRUM_OK ? in_plane_compliance(q->cable, frame, q->form, part, scratch)
                              : status;
}

/* in_plane_assemble; `functions` may be freed afterwards. */
static strum_status assemble(const root_search *q, strum_symmetry symmetry, arena *functions,
                             arena *a, arena *scratch, in_plane_assembly *out)
{
    legendre basis;
    in_plane_frame frame;
    const strum_cable *cable = q->cable;
    strum_status status =
        in_plane_begin(q, symmetry, functions, a, scratch, &basis, &frame, &out->part);
    if (status != STRUM_OK)
        return status;
    const size_t n = (size_t)out->part.count;
    if (q->form == IN_PLANE_FORCE_FORM && in_plane_proportional(cable)) {
        out->complementary = arena_room(scratch, n * n);
        return out->complementary == NULL
                   ? STRUM_ERR_MEMORY
                   : in_plane_complementary(1 / cable->mass_t, 1 / cable->mass_n, &frame,
                                            &out->part, out->complementary, scratch);
    }
    out->mass = arena_room(scratch, n * n);
    out->damping = arena_room(scratch, n * n);
    if (out->mass == NULL || out->damping == NULL)
        return STRUM_ERR_MEMORY;
    status = in_plane_inertia(cable->mass_t, cable->mass_n, &frame, &out->part, q->form,
                              out->mass, scratch);
    return status == STRUM_OK ? in_plane_inertia(cable->eta_t, cable->eta_n, &frame, &out->part,
                                                 q->form, out->damping, scratch)
                              : status;
}

strum_status in_plane_assemble(const root_search *q, strum_symmetry symmetry, arena *a,
                               arena *scratch, in_plane_assembly *out)
{
    arena functions = {.work = a->work};
    const strum_status status = assemble(q, symmetry, &functions, a, scratch, out);
    arena_free(&functions);
    return status;
}

static void constants_of(const in_plane_assembly *m, root *r)
{
    r->constant[0] = r->constant[1] = 0;
    for (int j = 0; j < r->length; j++)
        for (int k = 0; k < 2; k++)
            r->constant[k] += m->part.rule.from_unknowns[2 * j + k] * r->vector[j];
}

/* Appends symmetric eigenpairs mu = 1/w^2. */
static strum_status append_symmetric(double rate, int n, int want, const double *mu,
                                     const double *vectors, const root *model, arena *a,
                                     root_list *list)
{
    const strum_status status = root_list_grow(list, 2 * want, a);
    if (status != STRUM_OK)
        return status;
    for (int i = 0; i < want && mu[i] > 1e-14 * mu[0]; i++) {
        root r = *model;
        if (vectors != NULL) {
            r.vector = arena_alloc(a, (size_t)n, sizeof *r.vector);
            if (r.vector == NULL)
                return STRUM_ERR_MEMORY;
            r.length = n;
            for (int j = 0; j < n; j++)
                r.vector[j] = vectors[j + (size_t)i * (size_t)n];
        }
        roots_of_natural(1 / sqrt(mu[i]), rate, &r, list);
    }
    return STRUM_OK;
}

/* Complementary form, undamped or proportionally damped: A f = (1/w^2) K f. */
static strum_status complementary_roots(const root_search *q, const in_plane_assembly *m, int n,
                                        bool vectors, arena *a, arena *scratch, root_list *list)
{
    const int full = m->part.count, want = q->want < n ? q->want : n;
    const bool need = vectors || want > LINALG_POLISH_FROM;
    double *mu = arena_doubles(scratch, (size_t)n);
    double *v = need ? arena_doubles(scratch, (size_t)n * (size_t)want) : NULL;
    if (mu == NULL || (need && v == NULL))
        return STRUM_ERR_MEMORY;
    strum_status status = linalg_symmetric(n, m->part.compliance, full, m->complementary, full,
                                           want, mu, v, a->work);
    if (status != STRUM_OK)
        return status;
    const root model = {.symmetry = m->part.symmetry};
    const int before = list->count;
    status = append_symmetric(q->cable->eta_t / q->cable->mass_t, n, want, mu,
                              vectors ? v : NULL, &model, a, list);
    for (int i = before; status == STRUM_OK && vectors && i < list->count; i++)
        constants_of(m, &list->items[i]);
    return status;
}

/* Root z of (g.g) z^2 + (g.Cg) z + g.Mg = 0 nearest to z: the two-sided Rayleigh functional
 * (the problem is complex symmetric, so left and right vectors agree), whose error is the
 * square of the vector's. */
static double _Complex polish_root(int n, const double *c, const double *m,
                                   const double _Complex *g, double _Complex z)
{
    double _Complex q2 = 0, q1 = 0, q0 = 0;
    for (int j = 0; j < n; j++) {
        double _Complex cj = 0, mj = 0;
        for (int i = 0; i < n; i++) {
            cj += c[i + (size_t)j * (size_t)n] * g[i];
            mj += m[i + (size_t)j * (size_t)n] * g[i];
        }
        q2 += g[j] * g[j];
        q1 += g[j] * cj;
        q0 += g[j] * mj;
    }
    const double _Complex derivative = 2 * q2 * z + q1;
    const double _Complex step = (q2 * z * z + q1 * z + q0) / derivative;
    return cabs(step) < 1e-4 * cabs(z) ? z - step : z;
}

/* Mixed form: with A = LL' of the leading block and g = L'f, z = 1/s solves
 * z^2 g + z L'DL g + L'ML g = 0. */
typedef struct reduced {
    int n, rank;
    double *l, *half;
} reduced;

static strum_status reduce(const in_plane_assembly *m, int n, arena *a, reduced *d)
{
    const size_t size = (size_t)n * (size_t)n;
    d->n = n;
    d->l = arena_room(a, size);
    d->half = arena_room(a, size);
    if (d->l == NULL || d->half == NULL)
        return STRUM_ERR_MEMORY;
    return linalg_semidefinite_root(n, m->part.compliance, m->part.count, d->l, &d->rank,
                                    a->work);
}

/* x = -L g, f = (s^2 M + s D) x, and the constants. */
static strum_status give_vector(const in_plane_assembly *m, const reduced *d,
                                const double _Complex *g, arena *a, root *found)
{
    const size_t size = (size_t)d->n, rank = (size_t)d->rank, full = (size_t)m->part.count;
    double _Complex *x = arena_alloc(a, 2 * size, sizeof *x);
    if (x == NULL)
        return STRUM_ERR_MEMORY;
    double _Complex *f = x + size;
    for (size_t i = 0; i < rank; i++)
        for (size_t j = 0; j < size; j++)
            x[j] -= d->l[j + i * size] * g[i];
    for (size_t i = 0; i < size; i++)
        for (size_t j = 0; j < size; j++)
            f[j] += (found->s * found->s * m->mass[j + i * full] +
                     found->s * m->damping[j + i * full]) *
                    x[i];
    found->vector = f;
    found->length = d->n;
    constants_of(m, found);
    return STRUM_OK;
}

/* `polish`: vectors are worth their time only at the full size, whose values are the answer. */
static strum_status quadratic_roots(const in_plane_assembly *m, int n, bool vectors,
                                    bool polish, arena *a, arena *scratch, root_list *list)
{
    reduced d;
    strum_status status = reduce(m, n, scratch, &d);
    if (status != STRUM_OK)
        return status;
    const size_t rank = (size_t)d.rank;
    double *c = arena_room(scratch, rank * rank), *mass = arena_room(scratch, rank * rank);
    double _Complex *z = arena_alloc(scratch, 2 * rank, sizeof *z);
    double _Complex *g = polish ? arena_alloc(scratch, 2 * rank * rank, sizeof *g) : NULL;
    if (c == NULL || mass == NULL || z == NULL || (polish && g == NULL))
        return STRUM_ERR_MEMORY;
    status = linalg_project(n, d.rank, m->damping, m->part.count, d.l, d.half, c, a->work);
    if (status == STRUM_OK)
        status = linalg_project(n, d.rank, m->mass, m->part.count, d.l, d.half, mass, a->work);
    if (status == STRUM_OK)
        status = linalg_quadratic(d.rank, c, mass, z, g, a->work);
    if (status == STRUM_OK)
        status = root_list_grow(list, 2 * d.rank, a);
    double largest = 0;
    for (size_t k = 0; k < 2 * rank; k++)
        largest = fmax(largest, cabs(z[k]));
    for (size_t k = 0; status == STRUM_OK && k < 2 * rank; k++) {
        /* of a conjugate pair the one with Im s > 0; z near 0 is rounding of an infinite s */
        if (cimag(z[k]) > 0 || cabs(z[k]) < 1e-12 * largest)
            continue;
        status = work_poll(a->work);
        if (status != STRUM_OK)
            break;
        root found = {.symmetry = m->part.symmetry};
        const double _Complex *gk = polish ? g + k * rank : NULL;
        found.s = 1 / (polish ? polish_root(d.rank, c, mass, gk, z[k]) : z[k]);
        if (cimag(z[k]) == 0)
            found.s = creal(found.s);
        if (vectors)
            status = give_vector(m, &d, gk, a, &found);
        if (status == STRUM_OK)
            list->items[list->count++] = found;
    }
    return status;
}

/* Mixed form without damping that is not proportional: L'ML g = (1/w^2) g. */
static strum_status mixed_roots(const root_search *q, const in_plane_assembly *m, int n,
                                arena *a, arena *scratch, root_list *list)
{
    reduced d;
    strum_status status = reduce(m, n, scratch, &d);
    if (status != STRUM_OK)
        return status;
    const int r = d.rank, want = q->want < r ? q->want : r;
    double *matrix = arena_room(scratch, (size_t)r * (size_t)r);
    double *mu = arena_doubles(scratch, (size_t)n);
    double *v = arena_doubles(scratch, (size_t)r * (size_t)want);
    if (matrix == NULL || mu == NULL || v == NULL)
        return STRUM_ERR_MEMORY;
    status = linalg_project(n, d.rank, m->mass, m->part.count, d.l, d.half, matrix, a->work);
    if (status == STRUM_OK)
        status = linalg_symmetric(r, matrix, r, NULL, 0, want, mu, v, a->work);
    const root model = {.symmetry = m->part.symmetry};
    return status == STRUM_OK ? append_symmetric(q->cable->eta_t / q->cable->mass_t, r, want,
                                                 mu, NULL, &model, a, list)
                              : status;
}

strum_status in_plane_roots(const root_search *q, const in_plane_assembly *m, int size,
                            bool vectors, arena *a, root_list *list)
{
    arena scratch = {.work = a->work};
    strum_status status;
    int n = 0;
    while (n < m->part.count && m->part.index[n] < size)
        n++;
    if (!in_plane_proportional(q->cable))
        status = quadratic_roots(m, n, vectors, n == m->part.count, a, &scratch, list);
    else if (q->form == IN_PLANE_FORCE_FORM)
        status = complementary_roots(q, m, n, vectors, a, &scratch, list);
    else
        status = mixed_roots(q, m, n, a, &scratch, list);
    arena_free(&scratch);
    return status;
}
