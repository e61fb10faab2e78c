/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The answer's frequencies by another way: of a uniform cable by Galerkin's method with finite
 * elements of high degree, graded into the layers at the ends; of chains and dampers by taut.h. */
#include "core/identify/report.h"

#include <stdlib.h>
#include <string.h>

#include "core/numerics/arena.h"
#include "core/numerics/gauss.h"
#include "core/numerics/linalg.h"

#define MODE_MAX 60
/* Functions of an element: four cubics of Hermite and bubbles, twice integrated P_2 .. */
#define BUBBLES  12
#define LOCAL    (4 + BUBBLES)
#define POINTS   24
#define ELEMENTS 80
/* Longest element in wave lengths/(2 pi); the layer's first in its own depth. */
#define PHASE 4.0
#define DEPTH 3.0

typedef struct mesh {
    double ends[ELEMENTS + 1];
    int count;
} mesh;

/* From both ends inward, each element at most thrice as long as the one before. */
static void make_mesh(mesh *m, double u, int mode)
{
    const double longest = PHASE / ((mode + 1) * M_PI);
    double half[ELEMENTS], x = 0, h = u > 0 ? fmin(DEPTH * u, longest) : longest;
    int n = 0;
    while (x < 0.5 && n < ELEMENTS / 2) {
        half[n++] = x;
        x += h;
        h = fmin(3 * h, longest);
    }
    /* stretched to meet in the middle */
    const double stretch = 0.5 / x;
    m->count = 2 * n;
    for (int i = 0; i < n; i++) {
        m->ends[i] = half[i] * stretch;
        m->ends[2 * n - i] = 1 - half[i] * stretch;
    }
    m->ends[n] = 0.5;
}

/* Values, first and second derivatives of the local functions at x in [-1, 1], element length h. */
static void local_functions(double x, double h, double f[3][LOCAL])
{
    double p[BUBBLES + 8];
    p[0] = 1;
    p[1] = x;
    for (int k = 1; k < BUBBLES + 7; k++)
        p[k + 1] = ((2 * k + 1) * x * p[k] - k * p[k - 1]) / (k + 1);
    const double a = 1 - x, b = 1 + x;
    const double cubic[3][4] = {
        {a * a * (2 + x) / 4, h / 8 * a * a * b, b * b * (2 - x) / 4, -h / 8 * b * b * a},
        {-3 * a * b / 4, h / 8 * (a * a - 2 * a * b), 3 * a * b / 4,
         h / 8 * (b * b - 2 * a * b)},
        {1.5 * x, h / 8 * (-4 * a + 2 * b), -1.5 * x, h / 8 * (4 * b - 2 * a)}};
    for (int d = 0; d < 3; d++)
        for (int i = 0; i < 4; i++)
            f[d][i] = cubic[d][i] * (d == 0 ? 1 : d == 1 ? 2 / h : 4 / (h * h));
    for (int i = 0; i < BUBBLES; i++) {
        const int k = i + 2;
        const double norm = sqrt(k + 0.5);
        f[0][4 + i] = norm *
                      ((p[k + 2] - p[k]) / (2 * k + 3) - (p[k] - p[k - 2]) / (2 * k - 1)) /
                      (2 * k + 1);
        f[1][4 + i] = norm * (p[k + 1] - p[k - 1]) / (2 * k + 1) * 2 / h;
        f[2][4 + i] = norm * p[k] * 4 / (h * h);
    }
}

typedef struct equations {
    int n;
    double *k, *m, *load;
} equations;

/* Global number of a local function of element e; -1: held (the ends' displacements). Numbers: 2
 * for each node (displacement, slope), then bubbles. */
static int global(const mesh *t, int e, int i)
{
    const int inner = 2 * (t->count - 1) + 2; /* and the two end slopes */
    if (i >= 4)
        return inner + e * BUBBLES + i - 4;
    const int node = e + i / 2, slope = i % 2;
    if (node == 0)
        return slope ? 0 : -1;
    if (node == t->count)
        return slope ? 1 : -1;
    return 2 * node + slope;
}

static void assemble(const mesh *t, double u, equations *s)
{
    double x[POINTS], w[POINTS], f[3][LOCAL];
    gauss_legendre(POINTS, x, w);
    for (int e = 0; e < t->count; e++) {
        const double h = t->ends[e + 1] - t->ends[e];
        for (int g = 0; g < POINTS; g++) {
            const double weight = 0.5 * h * w[g];
            local_functions(x[g], h, f);
            for (int i = 0; i < LOCAL; i++) {
                const int row = global(t, e, i);
                if (row < 0)
                    continue;
                s->load[row] += weight * f[0][i];
                for (int j = 0; j < LOCAL; j++) {
                    const int column = global(t, e, j);
                    if (column < 0)
                        continue;
                    const size_t at = (size_t)row + (size_t)column * (size_t)s->n;
                    s->m[at] += weight * f[0][i] * f[0][j];
                    s->k[at] += weight * (f[1][i] * f[1][j] + u * u * f[2][i] * f[2][j]);
                }
            }
        }
    }
}

/* k L/T of the end's spring, in lengths of the span; huge where it is clamped. */
static double spring(const problem *p, const state *s, int end)
{
    const strum_identify_end *e = &p->ends[end];
    const double rho = e->kind == STRUM_IDENTIFY_PINNED           ? 0
                       : e->kind == STRUM_IDENTIFY_FIXED_FIXITY   ? e->value
                       : e->kind == STRUM_IDENTIFY_UNKNOWN_FIXITY ? s->q[FIXITY]
                                                                  : 1;
    if (e->kind == STRUM_IDENTIFY_STIFFNESS)
        return e->value / (s->q[TENSION] * s->q[LENGTH]);
    return rho < 1 ? rho / (1 - rho) * s->u * (1 + 3 * s->u) : HUGE_VAL;
}

static void add_ends(const problem *p, const state *at, equations *s)
{
    const double lambda2 = state_lambda2(p, at);
    for (int end = 0; end < 2 && at->u > 0; end++) {
        const double k = spring(p, at, end);
        const size_t n = (size_t)s->n, own = (size_t)end;
        if (isfinite(k)) {
            s->k[own + own * n] += k;
            continue;
        }
        for (size_t i = 0; i < n; i++) /* the slope is held */
            s->k[i + own * n] = s->k[own + i * n] = s->m[i + own * n] = s->m[own + i * n] = 0;
        s->k[own + own * n] = 1;
        s->load[own] = 0;
    }
    for (int j = 0; j < s->n; j++)
        for (int i = 0; i < s->n; i++)
            s->k[(size_t)i + (size_t)j * (size_t)s->n] += lambda2 * s->load[i] * s->load[j];
}

static void compare(const strum_identify *f, const double *mu, int count, strum_verification *v)
{
    const problem *p = &f->p;
    const state *s = &f->fits[0].at;
    const double scale = sqrt(s->q[TENSION] / state_mass(p, s)) / (2 * M_PI * s->q[LENGTH]);
    const double last = f->modes[f->mode_count - 1].computed;
    double worst = 0;
    v->modes_expected = 0;
    for (int i = 0; i < count; i++)
        v->modes_expected += scale / sqrt(mu[i]) < last * (1 + 1e-9);
    for (size_t i = 0; i < f->mode_count; i++)
        worst = fmax(worst,
                     fabs(scale / sqrt(mu[f->modes[i].mode - 1]) / f->modes[i].computed - 1));
    v->modes_found = f->modes[f->mode_count - 1].mode;
    v->max_relative_difference = v->max_residual = worst;
    v->method = "Galerkin's method with finite elements of high degree";
}

static strum_status verify_beam(const strum_identify *f, work *w, strum_verification *v)
{
    const problem *p = &f->p;
    const state *s = &f->fits[0].at;
    const int last = p->modes[p->count - 1];
    mesh t;
    make_mesh(&t, s->u, last);
    arena scratch = {.work = w};
    equations sys = {.n = 2 * (t.count - 1) + 2 + t.count * BUBBLES};
    const size_t n = (size_t)sys.n;
    sys.k = arena_doubles(&scratch, n * n);
    sys.m = arena_doubles(&scratch, n * n);
    sys.load = arena_doubles(&scratch, n);
    double *mu = arena_doubles(&scratch, n);
    strum_status status = mu == NULL || sys.load == NULL || sys.m == NULL || sys.k == NULL
                              ? STRUM_ERR_MEMORY
                              : STRUM_OK;
    const int want = last + 1;
    if (status == STRUM_OK) {
        assemble(&t, s->u, &sys);
        add_ends(p, s, &sys);
        double *vectors = arena_doubles(&scratch, n * (size_t)want);
        status = vectors == NULL ? STRUM_ERR_MEMORY
                                 : linalg_symmetric(sys.n, sys.m, sys.n, sys.k, sys.n, want, mu,
                                                    vectors, w);
    }
    if (status == STRUM_OK)
        compare(f, mu, want, v);
    arena_free(&scratch);
    return status;
}

/* A chain by its own second method; a damper's string by transfer matrices. */
static strum_status verify_taut(const strum_identify *f, const strum_identify_params *params,
                                const strum_options *options, strum_verification *v,
                                strum_error *error)
{
    const state *s = &f->fits[0].at;
    const size_t n = params->count;
    strum_taut_component own[3] = {
        {.kind = STRUM_TAUT_CABLE}, {.kind = STRUM_TAUT_GROUND}, {.kind = STRUM_TAUT_CABLE}};
    for (int i = 0; i < 3; i += 2) {
        own[i].tension_left = own[i].tension_right = s->q[TENSION];
        own[i].cable.mass_per_length = state_mass(&f->p, s);
        own[i].cable.length =
            i == 0 ? params->damper_position : s->q[LENGTH] - params->damper_position;
    }
    own[1].ground.damping = s->q[DAMPING];
    long numbers[STRUM_IDENTIFY_FREQUENCIES_MAX];
    for (size_t i = 0; i < n; i++)
        numbers[i] = f->modes[i].mode;
    strum_taut *chain = NULL;
    strum_taut_roots *roots = NULL;
    strum_status status =
        params->components != NULL
            ? model_chain(params, s->q[TENSION] / params->reference_tension, &chain, error)
            : strum_taut_make(own, 3, STRUM_TAUT_FIXED, STRUM_TAUT_FIXED, &chain, error);
    if (status == STRUM_OK)
        status = strum_taut_solve(chain, &(strum_taut_query){.numbers = numbers, .count = n},
                                  options, &roots, error);
    if (status == STRUM_OK)
        status = strum_taut_verify(chain, roots, options, v, error);
    for (size_t i = 0; status == STRUM_OK && i < n && i < roots->count && f->p.chain == NULL &&
                       params->damping_ratios != NULL;
         i++) {
        const strum_taut_root *r = &roots->roots[i];
        const double ratio = r->decay / hypot(r->decay, r->frequency);
        v->max_relative_difference =
            fmax(v->max_relative_difference, fabs(ratio / f->modes[i].computed_ratio - 1));
    }
    strum_taut_roots_free(roots);
    strum_taut_free(chain);
    return status;
}

strum_status strum_identify_verify(const strum_identify *found,
                                   const strum_identify_params *params,
                                   const strum_options *options,
                                   strum_verification *verification, strum_error *error)
{
    *verification = (strum_verification){0};
    if (params->components != NULL || params->damping_ratios != NULL)
        return verify_taut(found, params, options, verification, error);
    if (found->p.modes[found->p.count - 1] > MODE_MAX)
        return error_set(error, STRUM_ERR_METHOD, "the second method goes up to mode %d",
                         MODE_MAX);
    if (found->fits[0].at.u > 0 && found->fits[0].at.u < 1e-5)
        return error_set(error, STRUM_ERR_METHOD, "the second method goes up to xi = 1e5");
    work w = work_begin(options);
    const strum_status status = verify_beam(found, &w, verification);
    return work_result(&w, status, error);
}
