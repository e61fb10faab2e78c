/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The basis begins with what answers the dampers, and so is exact for these at once. Drag and
 * structural loss lead out of it: what is left of each wanted mode is solved for with the real
 * stiffness and joins the basis, until the square of what is left is rounding.
 */
#include "core/cable/spectrum_damped.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "core/cable/inertia.h"
#include "core/cable/mesh_error.h"
#include "core/cable/winding.h"

#define LEFT_OVER 3e-15 /* square, relative */
#define ROUNDS    12

typedef struct {
    spectrum *s;
    int want;
    krylov basis;
    reduced reduced;
    damped damped;
    arena *memory;
    double *vector, *load, *room;
} search;

/* ---- the basis ---- */

/* The unknowns of a root: re and im. */
static void expand(const search *q, const damped_root *root, double *re, double *im)
{
    const reduced *r = &q->reduced;
    const size_t n = q->basis.n;
    memset(re, 0, n * sizeof *re);
    memset(im, 0, n * sizeof *im);
    for (int i = 0; i < r->size; i++) {
        double _Complex a = 0;
        for (int k = 0; k < r->n; k++)
            a += r->modes[(size_t)k * (size_t)r->n + (size_t)i] * root->vector[k];
        motion_add(n, creal(a), q->basis.q + (size_t)i * n, re);
        motion_add(n, cimag(a), q->basis.q + (size_t)i * n, im);
    }
}

/* Loads that the basis may not answer: lambda C x + lambda^2 M x + i K_loss x. */
static void loads(const search *q, double _Complex lambda, const double *re, const double *im,
                  double *load_re, double *load_im)
{
    const motion *m = &q->s->motion;
    const size_t n = q->basis.n;
    double *y = q->load;
    const double *part[] = {re, im};
    memset(load_re, 0, n * sizeof *load_re);
    memset(load_im, 0, n * sizeof *load_im);
    for (int k = 0; k < 2; k++) {
        const double _Complex unit = k == 0 ? 1 : I;
        const double _Complex inertia = unit * lambda * lambda, drag = unit * lambda;
        motion_mass(m, part[k], q->room, y);
        motion_add(n, creal(inertia), y, load_re);
        motion_add(n, cimag(inertia), y, load_im);
        if (m->drag_normal != NULL) {
            motion_drag(m, part[k], q->room, y);
            motion_add(n, creal(drag), y, load_re);
            motion_add(n, cimag(drag), y, load_im);
        }
        if (q->damped.loss != NULL) {
            stiffness_loss(m, part[k], y);
            motion_add(n, creal(I * unit), y, load_re);
            motion_add(n, cimag(I * unit), y, load_im);
        }
    }
}

/* Square of what a root leaves over, relative; where it is too much, that joins the basis. */
static double improve(search *q, const damped_root *root)
{
    const size_t n = q->basis.n;
    double *re = q->vector, *im = re + n, *load_re = im + n, *load_im = load_re + n;
    expand(q, root, re, im);
    loads(q, root->lambda, re, im, load_re, load_im);
    double left = 0;
    const double *part[] = {load_re, load_im};
    for (int k = 0; k < 2; k++)
        left += krylov_left(&q->basis, part[k]);
    for (int k = 0; k < 2 && left > LEFT_OVER; k++)
        krylov_add(&q->basis, part[k]);
    return left;
}

static int wanted(const search *q)
{
    return q->want < q->damped.count ? q->want : q->damped.count;
}

/* Overdamped roots up to the size of the last wanted one. */
static int wanted_real(const search *q)
{
    const int last = wanted(q);
    int count = 0;
    const double size = last > 0 ? cabs(q->damped.roots[last - 1].lambda) : HUGE_VAL;
    while (count < q->damped.real_count && cabs(q->damped.real[count].lambda) < size)
        count++;
    return last > 0 ? count : 0;
}

static strum_status solve_reduced(search *q)
{
    strum_status status = reduced_make(&q->basis, q->memory, &q->reduced);
    if (status == STRUM_OK)
        status = reduced_undamped(&q->reduced, q->memory);
    if (status == STRUM_OK)
        status = damped_make(&q->reduced, q->want, q->memory, &q->damped);
    return status;
}

static strum_status converge(search *q, int first)
{
    strum_status status = krylov_extend(&q->basis, first, q->memory->work);
    for (int round = 0; round < ROUNDS && status == STRUM_OK; round++) {
        status = solve_reduced(q);
        if (status != STRUM_OK || q->basis.exhausted)
            return status;
        double worst = 0;
        const int count = wanted(q), real = wanted_real(q);
        for (int i = 0; i < count + real && status == STRUM_OK; i++) {
            status = work_spend(q->memory->work, 0.1 * (double)q->basis.n);
            worst = fmax(worst, improve(q, i < count ? q->damped.roots + i
                                                     : q->damped.real + i - count));
        }
        if (worst <= LEFT_OVER && count == q->want)
            return status;
        if (worst <= LEFT_OVER && status == STRUM_OK) {
            const int before = q->basis.size;
            status = krylov_extend(&q->basis, before + 16, q->memory->work);
            if (q->basis.size == before)
                return status;
        }
        if (q->basis.size == q->basis.most)
            break;
    }
    return status == STRUM_OK ? STRUM_ERR_ACCURACY : status;
}

/* ---- the count ---- */

static winding_box box_of(const search *q, double share)
{
    const damped *d = &q->damped;
    const int count = wanted(q);
    const double last = cimag(d->roots[count - 1].lambda);
    int next = count;
    while (next < d->count && cimag(d->roots[next].lambda) < last * (1 + 1e-7))
        next++;
    const double beyond =
        next < d->count ? fmin(cimag(d->roots[next].lambda), 1.3 * last) : 1.3 * last;
    double decay = 0;
    for (int i = 0; i < next; i++)
        decay = fmax(decay, -creal(d->roots[i].lambda));
    const double high = last + share * (beyond - last);
    return (winding_box){-2 * decay - high, 0.3 * high, 0.5 * cimag(d->roots[0].lambda), high};
}

static long inside(const damped *d, const winding_box *box)
{
    long count = 0;
    for (int i = 0; i < d->count; i++) {
        const double _Complex lambda = d->roots[i].lambda;
        count += cimag(lambda) > box->low && cimag(lambda) < box->high &&
                 creal(lambda) > box->left && creal(lambda) < box->right;
    }
    return count;
}

/* Undamped modes that the reduced cable has, less those that there are. */
static strum_status undamped_missing(const search *q, double high, long *missing, bool *safe)
{
    long below = 0;
    const strum_status status =
        inertia_count(&q->s->stiffness, high, q->memory->work, &below, safe);
    for (int k = 0; k < q->reduced.n; k++)
        below -= q->reduced.mu[k] * high * high > 1;
    *missing = below;
    return status;
}

static strum_status count(search *q)
{
    static const double shares[] = {0.5, 0.63, 0.36, 0.72, 0.27};
    strum_status status = STRUM_OK;
    for (size_t i = 0; i < sizeof shares / sizeof *shares && status == STRUM_OK; i++) {
        const winding_box box = box_of(q, shares[i]);
        long found = inside(&q->damped, &box), expected = 0, missing = 0;
        bool sure = false, safe = false;
        status = winding_count(&q->damped, &box, q->memory->work, &expected, &sure);
        if (status == STRUM_OK)
            status = undamped_missing(q, box.high, &missing, &safe);
        q->s->expected = expected + missing;
        q->s->found = found;
        if (sure && safe)
            break;
    }
    return status;
}

/* ---- what is kept ---- */

static strum_status keep(search *q)
{
    spectrum *s = q->s;
    const size_t n = q->basis.n;
    const int roots = wanted(q), real = wanted_real(q);
    double *vectors = arena_room(q->memory, 2 * (size_t)roots * n + 1);
    s->modes = arena_alloc(q->memory, (size_t)roots + 1, sizeof *s->modes);
    s->decays = arena_doubles(q->memory, (size_t)real + 1);
    if (vectors == NULL || s->modes == NULL || s->decays == NULL)
        return STRUM_ERR_MEMORY;
    for (int i = 0; i < roots; i++) {
        double *re = vectors + 2 * (size_t)i * n, *im = re + n;
        expand(q, q->damped.roots + i, re, im);
        const double error = mesh_error(&s->motion, re) + mesh_error(&s->motion, im);
        s->modes[i] = (spectrum_mode){q->damped.roots[i].lambda, re, im, error};
        s->error = fmax(s->error, error);
    }
    /* an absorber on a damper alone has no root at all where the library's spring gives one */
    for (int i = 0; i < real; i++)
        if (cabs(q->damped.real[i].lambda) > 1e-9 * sqrt(1 / q->reduced.mu[0]))
            s->decays[s->overdamped++] = -creal(q->damped.real[i].lambda);
    s->count = roots;
    s->damped = true;
    return STRUM_OK;
}

strum_status spectrum_damped(int want, arena *memory, spectrum *s)
{
    const motion *m = &s->motion;
    const int links = m->link_count;
    const int first = want + 14 + 8 * links;
    search q = {.s = s, .want = want, .memory = memory};
    strum_status status =
        krylov_begin(m, &s->stiffness, 1, 6 * want + 120 + 30 * links, memory, &q.basis);
    if (status != STRUM_OK)
        return status;
    q.vector = arena_room(memory, 5 * q.basis.n + motion_room(m));
    if (q.vector == NULL)
        return STRUM_ERR_MEMORY;
    q.load = q.vector + 4 * q.basis.n;
    q.room = q.load + q.basis.n;
    status = converge(&q, first);
    if (status == STRUM_OK)
        status = keep(&q);
    return status == STRUM_OK && s->count > 0 ? count(&q) : status;
}
