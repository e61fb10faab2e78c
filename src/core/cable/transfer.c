/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/transfer.h"

#include <math.h>
#include <string.h>

#include "core/numerics/gauss.h"
#include "core/numerics/legendre.h"

#define N TRANSFER_POINTS
#define D TRANSFER_STATES

/* From -1 to point q of what is 1 at point k alone. */
static void integrals(motion_rule *r)
{
    double p[N][N + 1], q[N + 1];
    for (int k = 0; k < N; k++)
        legendre_at(r->x[k], N, p[k], q);
    for (int i = 0; i < N; i++) {
        double unused[N + 1];
        legendre_at(r->x[i], N, unused, q);
        q[0] = (r->x[i] + 1) * sqrt(0.5);
        for (int k = 0; k < N; k++) {
            double sum = 0;
            for (int j = 0; j < N; j++)
                sum += p[k][j] * q[j];
            r->integral[k * N + i] = r->w[k] * sum;
        }
    }
}

strum_status transfer_begin(const motion *m, arena *memory, transfer *t)
{
    const cable_station *from = m->cable->stations + m->first_piece;
    const cable_station *to = m->cable->stations + m->last_piece;
    const size_t size = (size_t)(N * D) * (size_t)(N * D + D);
    *t = (transfer){.motion = m,
                    .length = to->position - from->position,
                    .force = m->cable->statics.tension_max};
    t->arm = t->length;
    double *table = arena_room(memory, 2 * N + N * N);
    t->re = arena_room(memory, 2 * size);
    t->a = arena_alloc(memory, N * D * D, sizeof *t->a);
    if (table == NULL || t->re == NULL || t->a == NULL)
        return STRUM_ERR_MEMORY;
    t->im = t->re + size;
    t->rule = (motion_rule){.points = N, .x = table, .w = table + N, .integral = table + 2 * N};
    gauss_legendre(N, t->rule.x, t->rule.w);
    integrals(&t->rule);
    return STRUM_OK;
}

/* ---- A ---- */

typedef struct {
    motion_state at;
    const strum_cable_section *section;
    double stretch;
    double _Complex across, along;  /* lambda^2 m + lambda c */
    double _Complex axial, bending; /* 1/EA, 1/EI; 0 where there is none */
} local;

static local local_at(const transfer *t, const transfer_element *e, double s,
                      double _Complex lambda)
{
    const cable_piece *piece = t->motion->cable->pieces + e->piece;
    const strum_cable_section *c = piece->section;
    local l = {.at = motion_state_at(t->motion->cable, e->piece, s - piece->start),
               .section = c};
    l.stretch = 1 + l.at.tension / c->axial_stiffness;
    l.across = lambda * lambda * (c->mass + c->added_mass) + lambda * c->drag_normal;
    l.along =
        lambda * lambda * (c->mass + c->added_mass_tangential) + lambda * c->drag_tangential;
    l.axial =
        isinf(c->axial_stiffness) ? 0 : 1 / (c->axial_stiffness * CMPLX(1, c->axial_loss));
    if (c->bending_stiffness > 0)
        l.bending = 1 / (c->bending_stiffness * CMPLX(1, c->bending_loss));
    return l;
}

/* Column `from` of A has the rates of all states for a unit of one: a[to * states + from]. */
static void in_plane(const transfer *t, const transfer_element *e, const local *l,
                     double _Complex *a)
{
    const int n = e->states;
    const double tx = l->at.tangent_x, tz = l->at.tangent_z, nx = -tz, nz = tx;
    const double u = t->length, f = t->force, fm = f * t->arm, g = l->stretch,
                 shear = l->at.shear;
    const bool lies = t->motion->cable->pieces[e->piece].lies;
    for (int from = 0; from < n; from++) {
        const double ux = from == 0 ? u : 0, uz = from == 1 ? u : 0;
        const double fx = from == 2 ? f : 0, fz = from == 3 ? f : 0;
        const double moment = from == 5 ? fm : 0;
        const double turned = n == 6 ? from == 4
                              : lies ? 0
                                     : (fx * nx + fz * nz) / l->at.tension;
        const double _Complex strain = l->axial * (fx * tx + fz * tz + shear * turned);
        const double _Complex across = l->across * (nx * ux + nz * uz);
        const double _Complex along = l->along * (tx * ux + tz * uz);
        a[from] = (strain * tx + g * turned * nx) / u;
        a[n + from] = (strain * tz + g * turned * nz) / u;
        a[2 * n + from] = (across * nx + along * tx) / f;
        a[3 * n + from] = (across * nz + along * tz) / f;
        if (n == 4)
            continue;
        a[4 * n + from] = moment * l->bending;
        a[5 * n + from] =
            (g * (l->at.tension * turned - fx * nx - fz * nz) - shear * strain) / fm;
    }
}

static void out_of_plane(const transfer *t, const transfer_element *e, const local *l,
                         double _Complex *a)
{
    const int n = e->states;
    const double u = t->length, f = t->force, fm = f * t->arm, g = l->stretch;
    const double turn = l->section->bending_stiffness * l->at.turn * l->at.turn;
    for (int from = 0; from < n; from++) {
        const double moved = from == 0 ? u : 0, force = from == 1 ? f : 0;
        const double moment = from == 3 ? fm : 0;
        const double turned = n == 4 ? from == 2 : force / l->at.tension;
        a[from] = g * turned / u;
        a[n + from] = l->across * moved / f;
        if (n == 2)
            continue;
        a[2 * n + from] = moment * l->bending;
        a[3 * n + from] = (g * (l->at.tension * turned - force) - turn * turned) / fm;
    }
}

/* ---- collocation ---- */

static void swap_rows(int n, int columns, int i, int j, double *x)
{
    for (int k = 0; k < columns; k++) {
        const double kept = x[(size_t)k * (size_t)n + (size_t)i];
        x[(size_t)k * (size_t)n + (size_t)i] = x[(size_t)k * (size_t)n + (size_t)j];
        x[(size_t)k * (size_t)n + (size_t)j] = kept;
    }
}

/* Takes (pr + i pi) times column a from column b, from row `from` on. */
static void take(int from, int n, double pr, double pi, const double *ar, const double *ai,
                 double *restrict br, double *restrict bi)
{
    for (int i = from; i < n; i++) {
        br[i] -= pr * ar[i] - pi * ai[i];
        bi[i] -= pr * ai[i] + pi * ar[i];
    }
}

static void divide(double pr, double pi, double *xr, double *xi)
{
    const double size = pr * pr + pi * pi, re = (*xr * pr + *xi * pi) / size;
    *xi = (*xi * pr - *xr * pi) / size;
    *xr = re;
}

void transfer_solve(int n, int count, double *re, double *im)
{
    for (int j = 0; j < n; j++) {
        double *cr = re + (size_t)j * (size_t)n, *ci = im + (size_t)j * (size_t)n;
        int best = j;
        for (int i = j + 1; i < n; i++)
            if (fabs(cr[i]) + fabs(ci[i]) > fabs(cr[best]) + fabs(ci[best]))
                best = i;
        if (best != j) {
            swap_rows(n, n + count, j, best, re);
            swap_rows(n, n + count, j, best, im);
        }
        for (int i = j + 1; i < n; i++)
            divide(cr[j], ci[j], cr + i, ci + i);
        for (int k = j + 1; k < n + count; k++) {
            double *br = re + (size_t)k * (size_t)n, *bi = im + (size_t)k * (size_t)n;
            if (br[j] != 0 || bi[j] != 0)
                take(j + 1, n, br[j], bi[j], cr, ci, br, bi);
        }
    }
    for (int k = n; k < n + count; k++) {
        double *br = re + (size_t)k * (size_t)n, *bi = im + (size_t)k * (size_t)n;
        for (int j = n - 1; j >= 0; j--) {
            const double *cr = re + (size_t)j * (size_t)n, *ci = im + (size_t)j * (size_t)n;
            divide(cr[j], ci[j], br + j, bi + j);
            take(0, j, br[j], bi[j], cr, ci, br, bi);
        }
    }
}

/* Y_q - half SUM_k integral_qk A_k Y_k = y at the beginning. */
static void collocate(const transfer *t, const transfer_element *e)
{
    const int d = e->states, n = N * d;
    for (int k = 0; k < N; k++)
        for (int from = 0; from < d; from++) {
            double *cr = t->re + (size_t)(k * d + from) * (size_t)n;
            double *ci = t->im + (size_t)(k * d + from) * (size_t)n;
            for (int q = 0; q < N; q++) {
                const double weight = e->half * t->rule.integral[k * N + q];
                for (int to = 0; to < d; to++) {
                    const double _Complex a = t->a[(k * d + to) * d + from];
                    cr[q * d + to] = (q == k && to == from ? 1 : 0) - weight * creal(a);
                    ci[q * d + to] = -weight * cimag(a);
                }
            }
        }
    for (int j = 0; j < d; j++) {
        double *br = t->re + (size_t)(n + j) * (size_t)n;
        memset(br, 0, (size_t)n * sizeof *br);
        memset(t->im + (size_t)(n + j) * (size_t)n, 0, (size_t)n * sizeof *br);
        for (int q = 0; q < N; q++)
            br[q * d + j] = 1;
    }
}

void transfer_of(const transfer *t, const transfer_element *e, double _Complex lambda,
                 double _Complex *y)
{
    const int d = e->states, n = N * d;
    for (int q = 0; q < N; q++) {
        const local l = local_at(t, e, e->from + e->half * (1 + t->rule.x[q]), lambda);
        if (t->motion->components == 2)
            in_plane(t, e, &l, t->a + q * d * d);
        else
            out_of_plane(t, e, &l, t->a + q * d * d);
    }
    collocate(t, e);
    transfer_solve(n, d, t->re, t->im);
    for (int j = 0; j < d; j++)
        for (int to = 0; to < d; to++) {
            double _Complex sum = to == j;
            for (int q = 0; q < N; q++)
                for (int from = 0; from < d; from++) {
                    const size_t at = (size_t)(n + j) * (size_t)n + (size_t)(q * d + from);
                    sum += e->half * t->rule.w[q] * t->a[(q * d + to) * d + from] *
                           CMPLX(t->re[at], t->im[at]);
                }
            y[j * d + to] = sum;
        }
}
