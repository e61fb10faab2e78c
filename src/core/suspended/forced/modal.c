/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Forced motion in the complementary form. With a = m s^2 + eta s, the weak equation is
 *     INT G' . (tt'/a_t + nn'/a_n) F' dsigma + INT G . C F dsigma = G(end 2) . d   for all G.
 * In the unknowns of in_plane.h it is
 *     (A + K(s)) f = r,
 *     r = b + constants' d,
 *     c = from_unknowns f + from_motion d.
 * Without damping, and with damping proportional to mass,
 *     K(s) = -K/Omega,
 *     Omega = -(s^2 + rate s),
 * so that the free modes A phi = mu K phi, phi'K phi = 1, give
 *     f = Omega h,
 *     h = sum phi (phi.r)/(Omega mu - 1),
 *     X = -(tt'/m_t + nn'/m_n) dh/dsigma,
 * which is the exact static answer at Omega = 0. Other damping solves the complex system at
 * each frequency.
 */
#include "core/suspended/forced/modal.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/numerics/linalg.h"
#include "core/suspended/roots.h"
#include "core/suspended/modes.h"

/* Largest coefficient among the last ones, relative to the largest: the error of a response. */
#define TAIL_MAX 1e-12

/* Damping and inertia make less than rounding of the static answer here, and their products
 * would underflow. */
#define STATIC_BELOW 1e-100

/* r_k = q_k(1) d + constants' d for unit d; only q_0 does not vanish at the ends. */
static double load(const forced_part *p, int j, int direction)
{
    const double end =
        p->part.index[j] == 0 && p->part.component[j] == direction ? sqrt(0.5) : 0;
    return end + p->part.rule.from_unknowns[2 * j + direction];
}

static strum_status make_shares(forced_part *p, arena *a)
{
    const size_t n = (size_t)p->part.count;
    double *memory = arena_doubles(a, 5 * n), *r = memory + 4 * n;
    if (memory == NULL)
        return STRUM_ERR_MEMORY;
    p->modes = 0;
    while (p->modes < p->part.count && p->mu[p->modes] > 1e-15 * p->mu[0])
        p->modes++;
    for (int d = 0; d < 2; d++) {
        p->share[d] = memory + (size_t)d * n;
        p->rest[d] = memory + (size_t)(2 + d) * n;
        for (int j = 0; j < p->part.count; j++)
            r[j] = load(p, j, d);
        for (size_t j = 0; j < n; j++) {
            const double *phi = p->phi + j * n;
            p->share[d][j] = cblas_ddot((int)n, phi, 1, r, 1);
            if ((int)j >= p->modes)
                cblas_daxpy((int)n, p->share[d][j], phi, 1, p->rest[d], 1);
        }
    }
    return STRUM_OK;
}

static strum_status make_part(const strum_forced *f, strum_symmetry symmetry, arena *a,
                              arena *scratch, forced_part *part)
{
    legendre basis;
    in_plane_frame frame;
    const root_search q = {
        .cable = &f->cable, .x = &f->coordinate, .form = IN_PLANE_FORCE_FORM, .size = f->size};
    strum_status status =
        in_plane_begin(&q, symmetry, scratch, a, a, &basis, &frame, &part->part);
    if (status != STRUM_OK)
        return status;
    const size_t n = (size_t)part->part.count;
    part->along = arena_room(a, n * n);
    part->across = arena_room(a, n * n);
    part->phi = arena_room(a, n * n);
    part->mu = arena_doubles(a, n);
    double *k = arena_room(scratch, n * n);
    if (part->along == NULL || part->across == NULL || part->phi == NULL || part->mu == NULL ||
        k == NULL)
        return STRUM_ERR_MEMORY;
    status = in_plane_complementary(1, 0, &frame, &part->part, part->along, scratch);
    if (status == STRUM_OK)
        status = in_plane_complementary(0, 1, &frame, &part->part, part->across, scratch);
    if (status != STRUM_OK)
        return status;
    for (size_t i = 0; i < n * n; i++)
        k[i] = part->along[i] / f->cable.mass_t + part->across[i] / f->cable.mass_n;
    status = linalg_symmetric((int)n, part->part.compliance, (int)n, k, (int)n, (int)n,
                              part->mu, part->phi, scratch->work);
    return status == STRUM_OK ? make_shares(part, a) : status;
}

static strum_status make_samples(strum_forced *f)
{
    f->samples = 3 * f->size / 2 + 1;
    const size_t samples = (size_t)f->samples, size = (size_t)f->size;
    f->sample_q = arena_room(&f->memory, samples * size);
    f->sample_t = arena_room(&f->memory, 2 * samples);
    double *one = arena_room(&f->memory, 2 * size);
    f->factors = arena_doubles(&f->memory, 4 * size);
    if (f->factors == NULL || f->sample_q == NULL || f->sample_t == NULL || one == NULL)
        return STRUM_ERR_MEMORY;
    legendre_factors(f->size, f->factors);
    for (size_t i = 0; i < samples; i++) {
        const double x = i == samples - 1 ? 1 : 2.0 * (double)i / (double)(samples - 1) - 1;
        double cosh_chi;
        in_plane_frame_at(&f->coordinate, x, &cosh_chi, &f->sample_t[i],
                          &f->sample_t[i + samples]);
        legendre_at(x, f->size, one, one + size);
        for (size_t k = 0; k < size; k++)
            f->sample_q[i + k * samples] = one[size + k];
    }
    return STRUM_OK;
}

/* Estimated microseconds of the eigenproblem of n unknowns. */
static double part_us(double n)
{
    return 20 + 2.5e-3 * n * n * n;
}

static strum_status make_at_size(strum_forced *f, int size, work *w)
{
    const bool level = f->cable.chi_m == 0;
    strum_status status = STRUM_OK;
    f->size = size;
    f->part_count = f->in_plane ? (level ? 2 : 1) : 0;
    for (int i = 0; i < f->part_count && status == STRUM_OK; i++) {
        status = work_spend(w, part_us(level ? size : 2.0 * size));
        if (status != STRUM_OK)
            return status;
        arena scratch = {.work = w};
        status = make_part(f,
                           !level   ? STRUM_NO_SYMMETRY
                           : i == 0 ? STRUM_SYMMETRIC
                                    : STRUM_ANTISYMMETRIC,
                           &f->memory, &scratch, &f->parts[i]);
        arena_free(&scratch);
    }
    if (status == STRUM_OK && f->out_of_plane) {
        status = work_spend(w, part_us(size));
        if (status == STRUM_OK)
            status = forced_out_of_plane_make(f);
    }
    return status == STRUM_OK ? make_samples(f) : status;
}

static double tail_of(const double *v, int size)
{
    double largest = 0, last = 0;
    for (int k = 0; k < size; k++) {
        largest = fmax(largest, fabs(v[k]));
        if (k >= size - 4)
            last = fmax(last, fabs(v[k]));
    }
    return largest > 0 ? last / largest : 0;
}

/* The error of this size: the tails of the responses at the highest frequency, just off any
 * resonance. */
static strum_status tail(const strum_forced *f, double *error)
{
    strum_response *r;
    strum_status status = strum_response_make(f, &r, NULL);
    *error = 0;
    for (int direction = 0; direction < 2 && status == STRUM_OK; direction++) {
        const strum_end_motion motion = {direction == 0, direction == 1, f->out_of_plane};
        double frequency = f->frequency_max;
        do {
            status = work_poll(f->memory.work);
            if (status == STRUM_OK)
                status = strum_response_solve(r, frequency, &motion, NULL);
        } while (status == STRUM_ERR_METHOD && (frequency *= 1 - 1e-3) > 0);
        for (int i = 0; i < 2 && f->in_plane; i++)
            for (int half = 0; half < 2; half++)
                *error = fmax(*error, tail_of(r->v[i][half], f->size));
        if (f->out_of_plane)
            *error = fmax(*error, tail_of((const double *)r->w, 2 * f->size));
    }
    strum_response_free(r);
    return status;
}

/* Grows the size in one coordinate until the tail is short enough. */
static strum_status grow(strum_forced *f, mapping along, int modes, work *w,
                         strum_error *error_out)
{
    const strum_plane plane = f->in_plane ? STRUM_IN_PLANE : STRUM_OUT_OF_PLANE;
    double cosh_chi, c, s, error = INFINITY, before = INFINITY;
    f->coordinate = along;
    in_plane_frame_at(&f->coordinate, 1, &cosh_chi, &c, &s);
    f->end[0][0] = f->end[1][1] = c;
    f->end[0][1] = s;
    f->end[1][0] = -s;
    double size = 1.4 * spectrum_first_size(&f->cable, &f->coordinate, plane, modes) + 4;
    for (; size < SPECTRUM_SIZE_MAX_QUADRATIC; size = 1.3 * size + 6) {
        strum_status status = make_at_size(f, (int)size, w);
        if (status == STRUM_OK)
            status = tail(f, &error);
        if (status == STRUM_OK && error < TAIL_MAX)
            return work_result(w, forced_naturals_make(f), error_out);
        if (status != STRUM_OK)
            return work_result(w, status, error_out);
        arena_free(&f->memory);
        /* rounding, not size, stands in the way once a larger size helps no more */
        if (error < 1e-8 && error > before / 2)
            break;
        before = error;
    }
    if (isinf(error))
        return error_at(error_out, STRUM_ERR_ACCURACY, STRUM_FORCED_ARG_FREQUENCY,
                        STRUM_NO_INDEX,
                        "the response needs about %.0f unknowns a component; %d can be solved",
                        size, SPECTRUM_SIZE_MAX_QUADRATIC);
    return error_at(error_out, STRUM_ERR_ACCURACY, STRUM_FORCED_ARG_FREQUENCY, STRUM_NO_INDEX,
                    "the last terms of the response are still %.1e of the first (%.0e is "
                    "promised) at up to %d unknowns a component",
                    error, TAIL_MAX, SPECTRUM_SIZE_MAX_QUADRATIC);
}

static strum_status make(strum_forced *f, work *w, strum_error *fault)
{
    double count = 2;
    for (int plane = 0; plane < 2; plane++)
        if (plane == STRUM_IN_PLANE ? f->in_plane : f->out_of_plane)
            count = fmax(count, 2 + spectrum_phase_count(&f->cable, (strum_plane)plane,
                                                         f->frequency_max));
    if (!(count < STRUM_MODES_MAX))
        return error_at(fault, STRUM_ERR_RANGE, STRUM_FORCED_ARG_FREQUENCY, STRUM_NO_INDEX,
                        "about %.6g modes lie below the highest frequency; %d can be answered",
                        ceil(count), STRUM_MODES_MAX);
    const strum_plane plane = f->in_plane ? STRUM_IN_PLANE : STRUM_OUT_OF_PLANE;
    const int modes = (int)ceil(count);
    const strum_status status = grow(f, mapping_linear(&f->cable), modes, w, fault);
    if (status != STRUM_ERR_ACCURACY)
        return status;
    int size;
    const mapping other = spectrum_mapping(&f->cable, plane, modes, &size);
    return other.stretch != 0 ? grow(f, other, modes, w, fault) : status;
}

strum_status strum_forced_solve(const strum_forced_params *params, const strum_options *options,
                                strum_forced **forced, strum_error *error)
{
    *forced = NULL;
    strum_status status = spectrum_check_cable(&params->cable, error);
    if (status != STRUM_OK) {
        if (error != NULL)
            error->argument = STRUM_FORCED_ARG_CABLE;
        return status;
    }
    if (!(isfinite(params->frequency_max) && params->frequency_max >= 0))
        return error_at(error, STRUM_ERR_RANGE, STRUM_FORCED_ARG_FREQUENCY, STRUM_NO_INDEX,
                        "the frequency must not be negative");
    strum_forced *f = calloc(1, sizeof *f);
    if (f == NULL)
        return error_set(error, STRUM_ERR_MEMORY, "out of memory");
    work w = work_begin(options);
    f->references = 1;
    f->memory.work = &w;
    f->cable = params->cable;
    f->frequency_max = params->frequency_max;
    f->in_plane = params->in_plane;
    f->out_of_plane = params->out_of_plane;
    f->proportional = in_plane_proportional(&params->cable);
    status = make(f, &w, error);
    if (status != STRUM_OK) {
        strum_forced_free(f);
        return status;
    }
    f->memory.work = NULL; /* it ends here */
    *forced = f;
    return status;
}

/* Puts one real part of a part's unknowns where the response keeps them, and their constants
 * with them. */
static void scatter(const forced_part *p, const double *v, int half, strum_response *response)
{
    double c[2] = {0, 0};
    for (int j = 0; j < p->part.count; j++) {
        response->v[p->part.component[j]][half][p->part.index[j]] = v[j];
        c[0] += p->part.rule.from_unknowns[2 * j] * v[j];
        c[1] += p->part.rule.from_unknowns[2 * j + 1] * v[j];
    }
    for (int k = 0; k < 2; k++)
        response->constant[k] += response->scale * (half == 0 ? c[k] : CMPLX(0, c[k]));
}

/* h = sum phi (phi.r)/(Omega mu - 1) of one part into the response. */
static strum_status solve_modal(const forced_part *p, const double _Complex d[2],
                                double _Complex omega2, strum_response *response, int *resonant)
{
    const int n = p->part.count, m = p->modes;
    double *factor[2] = {response->work, response->work + n}, *h = response->work + 2 * n;
    const double moved = cabs(d[0]) + cabs(d[1]);
    for (int j = 0; j < m; j++) {
        const double _Complex share = d[0] * p->share[0][j] + d[1] * p->share[1][j];
        const double _Complex distance = omega2 * p->mu[j] - 1;
        double _Complex f = 0;
        if (cabs(distance) >= 2 * RESONANCE_WIDTH)
            f = response->real ? creal(share) / creal(distance) : share / distance;
        else if (cabs(share) > 1e-9 * moved * (fabs(p->share[0][j]) + fabs(p->share[1][j]))) {
            *resonant = j;
            return STRUM_ERR_METHOD;
        } /* else a mode that this motion does not excite */
        factor[0][j] = creal(f);
        factor[1][j] = cimag(f);
    }
    for (int half = 0; half < (response->real ? 1 : 2); half++) {
        cblas_dgemv(CblasColMajor, CblasNoTrans, n, m, 1, p->phi, n, factor[half], 1, 0, h, 1);
        for (int k = 0; k < 2; k++)
            cblas_daxpy(n, half == 0 ? -creal(d[k]) : -cimag(d[k]), p->rest[k], 1, h, 1);
        scatter(p, h, half, response);
    }
    return STRUM_OK;
}

/* (A + along/a_t + across/a_n) f = r of one part. */
static strum_status solve_damped(const forced_part *p, const double _Complex d[2],
                                 strum_response *response)
{
    const int n = p->part.count;
    double _Complex *z = response->matrix, *r = z + (size_t)n * (size_t)n;
    for (int j = 0; j < n; j++)
        r[j] = load(p, j, 0) * d[0] + load(p, j, 1) * d[1];
    for (size_t i = 0; i < (size_t)n * (size_t)n; i++)
        z[i] = p->part.compliance[i] + p->along[i] * response->inverse_t +
               p->across[i] * response->inverse_n;
    const strum_status status = linalg_complex_solve(n, z, r, NULL);
    for (int half = 0; half < 2 && status == STRUM_OK; half++) {
        for (int j = 0; j < n; j++)
            response->work[j] = half == 0 ? creal(r[j]) : cimag(r[j]);
        scatter(p, response->work, half, response);
    }
    return status;
}

static void note_resonance(const forced_part *p, int j, strum_resonance *at)
{
    if (at != NULL)
        *at = (strum_resonance){.plane = STRUM_IN_PLANE,
                                .symmetry = p->part.symmetry,
                                .frequency = 1 / sqrt(p->mu[j])};
}

strum_status strum_response_solve(strum_response *response, double frequency,
                                  const strum_end_motion *motion, strum_resonance *at)
{
    const strum_forced *f = response->forced;
    if (!(frequency >= 0 && frequency <= f->frequency_max * (1 + 1e-12)))
        return STRUM_ERR_RANGE;
    const strum_cable *cable = &f->cable;
    const double _Complex s = CMPLX(0, frequency);
    double _Complex d[2];
    for (int k = 0; k < 2; k++)
        d[k] = motion->tangential * f->end[0][k] + motion->normal * f->end[1][k];
    /* nothing moves at frequency 0, so the static answer knows no damping */
    const bool modal = f->proportional || frequency < STATIC_BELOW;
    const double _Complex omega2 = modal ? -(s * s + s * cable->eta_t / cable->mass_t) : 1;
    response->frequency = frequency;
    response->motion = *motion;
    response->scale = omega2;
    response->inverse_t =
        modal ? -1 / cable->mass_t : 1 / (s * (cable->mass_t * s + cable->eta_t));
    response->inverse_n =
        modal ? -1 / cable->mass_n : 1 / (s * (cable->mass_n * s + cable->eta_n));
    response->constant[0] = response->constant[1] = response->lift = 0;
    response->real = cimag(omega2) == 0 && modal && cimag(d[0]) == 0 && cimag(d[1]) == 0;
    for (int i = 0; i < f->part_count; i++) {
        const forced_part *p = &f->parts[i];
        int resonant = 0;
        const strum_status status = modal ? solve_modal(p, d, omega2, response, &resonant)
                                          : solve_damped(p, d, response);
        if (status == STRUM_ERR_METHOD)
            note_resonance(p, resonant, at);
        if (status != STRUM_OK)
            return status;
        for (int k = 0; k < 2; k++)
            response->constant[k] +=
                p->part.rule.from_motion[k][0] * d[0] + p->part.rule.from_motion[k][1] * d[1];
    }
    return f->out_of_plane
               ? forced_out_of_plane_solve(f, frequency, motion->out_of_plane, response, at)
               : STRUM_OK;
}
