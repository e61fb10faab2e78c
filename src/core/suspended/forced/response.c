/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A forced response: its life with the system it belongs to, its values along the cable and its largest tension. */
#include <cblas.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "core/suspended/forced/modal.h"
#include "core/numerics/bracket.h"
#include "core/numerics/peak.h"

/* The last of the caller and the responses that lets go frees the system. */
void strum_forced_free(strum_forced *f)
{
    if (f == NULL || atomic_fetch_sub(&f->references, 1) > 1)
        return;
    arena_free(&f->memory);
    free(f);
}

strum_status strum_response_make(const strum_forced *f, strum_response **response,
                                 strum_error *error)
{
    *response = NULL;
    strum_response *r = calloc(1, sizeof *r);
    if (r == NULL)
        return error_set(error, STRUM_ERR_MEMORY, "out of memory");
    const size_t size = (size_t)f->size, samples = (size_t)f->samples;
    const size_t unknowns = f->part_count > 0 ? (size_t)f->parts[0].part.count + 1 : 0;
    const bool damped = f->part_count > 0 && !f->proportional;
    r->forced = (strum_forced *)(uintptr_t)f; /* only its count changes */
    atomic_fetch_add(&r->forced->references, 1);
    r->v[0][0] = arena_doubles(&r->memory, 4 * size);
    r->w = arena_alloc(&r->memory, size, sizeof *r->w);
    r->work = arena_doubles(&r->memory, 6 * size + 2);
    r->table = arena_doubles(&r->memory, 2 * size + 4 * samples);
    r->matrix =
        damped ? arena_alloc(&r->memory, (unknowns + 1) * unknowns, sizeof *r->matrix) : NULL;
    if (r->v[0][0] == NULL || r->w == NULL || r->work == NULL || r->table == NULL ||
        (damped && r->matrix == NULL)) {
        strum_response_free(r);
        return error_set(error, STRUM_ERR_MEMORY, "out of memory");
    }
    for (size_t i = 1; i < 4; i++)
        r->v[i / 2][i % 2] = r->v[0][0] + i * size;
    *response = r;
    return STRUM_OK;
}

void strum_response_free(strum_response *response)
{
    if (response == NULL)
        return;
    arena_free(&response->memory);
    strum_forced_free(response->forced);
    free(response);
}

void response_of_mode(strum_response *r, const forced_part *p, int mode)
{
    const int n = p->part.count;
    const double *phi = p->phi + (size_t)mode * (size_t)n;
    memset(r->v[0][0], 0, 4 * (size_t)r->forced->size * sizeof *r->v[0][0]);
    r->constant[0] = r->constant[1] = r->lift = 0;
    r->scale = 1;
    r->real = true;
    for (int j = 0; j < n; j++) {
        r->v[p->part.component[j]][0][p->part.index[j]] = phi[j];
        for (int k = 0; k < 2; k++)
            r->constant[k] += p->part.rule.from_unknowns[2 * j + k] * phi[j];
    }
}

/* F and dF/dx (over scale) at x; also what depends on x alone. */
static void force_at(const strum_response *r, double x, double *cosh_chi, double t[2],
                     double _Complex force[2], double _Complex slope[2])
{
    const strum_forced *f = r->forced;
    double *p = r->table, *q = p + f->size;
    legendre_at_with(f->factors, x, f->size, p, q);
    in_plane_frame_at(&f->coordinate, x, cosh_chi, &t[0], &t[1]);
    for (int i = 0; i < 2; i++) {
        double value[2] = {0, 0}, derivative[2] = {0, 0};
        for (int half = 0; half < (r->real ? 1 : 2); half++) {
            value[half] = cblas_ddot(f->size, r->v[i][half], 1, q, 1);
            derivative[half] = cblas_ddot(f->size, r->v[i][half], 1, p, 1);
        }
        force[i] = r->constant[i] + r->scale * CMPLX(value[0], value[1]);
        slope[i] = CMPLX(derivative[0], derivative[1]);
    }
}

void response_tension(const strum_response *r, double x, double _Complex *tension,
                      double _Complex *slope)
{
    double cosh_chi, t[2];
    double _Complex force[2], derivative[2];
    force_at(r, x, &cosh_chi, t, force, derivative);
    *tension = t[0] * force[0] + t[1] * force[1];
    /* dt/dchi = n/cosh chi */
    *slope = r->scale * (t[0] * derivative[0] + t[1] * derivative[1]) +
             mapping_slope(&r->forced->coordinate, x) / cosh_chi *
                 (t[0] * force[1] - t[1] * force[0]);
}

/* Rounding of x(chi) at an end. */
#define AT_END 1e-14

void strum_response_at(const strum_response *r, double chi, strum_forced_point *point)
{
    const mapping *along = &r->forced->coordinate;
    const double x = mapping_x(along, chi);
    double cosh_chi, t[2];
    double _Complex force[2], slope[2], w = r->lift * (1 + x) / 2;
    force_at(r, x, &cosh_chi, t, force, slope);
    const double scale = 1 / (mapping_slope(along, x) * cosh_chi);
    point->chi = chi;
    point->tension = t[0] * force[0] + t[1] * force[1];
    point->tangential = r->inverse_t * scale * (t[0] * slope[0] + t[1] * slope[1]);
    point->normal = r->inverse_n * scale * (t[0] * slope[1] - t[1] * slope[0]);
    for (int k = 0; k < r->forced->size; k++)
        w += r->w[k] * r->table[r->forced->size + k];
    point->out_of_plane = w;
    /* the ends, which the force form only meets to rounding */
    if (x < -1 + AT_END)
        point->tangential = point->normal = point->out_of_plane = 0;
    if (x > 1 - AT_END) {
        point->tangential = r->motion.tangential;
        point->normal = r->motion.normal;
        point->out_of_plane = r->motion.out_of_plane;
    }
}

void response_sample(const strum_response *r, double *re, double *im)
{
    const strum_forced *f = r->forced;
    const int samples = f->samples, size = f->size;
    double *part[2] = {r->table + 2 * size + 2 * samples, r->table + 2 * size + 3 * samples};
    memset(re, 0, (size_t)samples * sizeof *re);
    memset(im, 0, (size_t)samples * sizeof *im);
    for (int i = 0; i < 2; i++) {
        const double *t = f->sample_t + (size_t)i * (size_t)samples;
        for (int half = 0; half < (r->real ? 1 : 2); half++)
            cblas_dgemv(CblasColMajor, CblasNoTrans, samples, size, 1, f->sample_q, samples,
                        r->v[i][half], 1, 0, part[half], 1);
        if (r->real) {
            const double c = creal(r->constant[i]), scale = creal(r->scale);
            for (int j = 0; j < samples; j++)
                re[j] += t[j] * (c + scale * part[0][j]);
            continue;
        }
        for (int j = 0; j < samples; j++) {
            const double _Complex force =
                r->constant[i] + r->scale * CMPLX(part[0][j], part[1][j]);
            re[j] += t[j] * creal(force);
            im[j] += t[j] * cimag(force);
        }
    }
}

/* Re(conj(T) dT/dx): half the slope of |T|^2. */
static double climb(const strum_response *r, double x, double _Complex *tension)
{
    double _Complex slope;
    response_tension(r, x, tension, &slope);
    return creal(conj(*tension) * slope);
}

/* The maximum between two samples about one that is larger than both: false position on the
 * slope. */
static double refine(const strum_response *r, double low, double high)
{
    double _Complex ignored;
    bracket_ends b = {low, high, climb(r, low, &ignored), climb(r, high, &ignored), 0};
    if (!(b.f_low > 0)) /* falls from its end, which is a support */
        return low;
    if (!(b.f_high < 0))
        return high;
    double x = low;
    for (int i = 0; i < 40 && b.high - b.low > 1e-9; i++) {
        x = (b.low * b.f_high - b.high * b.f_low) / (b.f_high - b.f_low);
        const double g = climb(r, x, &ignored);
        if (fabs(g) < 1e-13 * fmax(fabs(b.f_low), fabs(b.f_high)))
            break;
        bracket_take(&b, x, g);
    }
    return x;
}

static double refine_peak(void *data, double low, double high, double *x)
{
    double _Complex tension, slope;
    *x = refine(data, low, high);
    response_tension(data, *x, &tension, &slope);
    return cabs(tension);
}

void strum_response_peak(const strum_response *r, strum_peak *peak)
{
    const strum_forced *f = r->forced;
    double *value = r->table + 2 * f->size, *im = value + f->samples, x;
    response_sample(r, value, im);
    for (int i = 0; i < f->samples; i++)
        value[i] = r->real ? fabs(value[i]) : hypot(value[i], im[i]);
    peak->tension = peak_largest(value, f->samples, refine_peak, (void *)r, &x);
    double _Complex tension, slope;
    response_tension(r, x, &tension, &slope);
    peak->phase = carg(tension);
    peak->chi = f->cable.chi_m + mapping_offset(&f->coordinate, x);
}
