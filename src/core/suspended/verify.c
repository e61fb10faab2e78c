/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A second opinion on a spectrum. */
#include <math.h>

#include "core/numerics/work.h"
#include "core/suspended/displacement.h"
#include "core/suspended/modes.h"

/* The largest value of what the Galerkin method leaves free and the exact solution has not: in
 * plane the displacement at a support, out of plane the acceleration there (there W_chi = e V
 * with e = 1 + kappa_n cosh, so that e V_chi = W_chichi - W_chi e_chi/e); relative to the
 * largest along the cable. */
static strum_status closure(const strum_modes *sp, int index, double *table, double *residual)
{
    double end = 0, inside = 0;
    const root *r = &sp->roots[index];
    for (int i = 0; i <= 64; i++) {
        const double x = i / 32.0 - 1;
        double value;
        legendre_at_with(sp->factors, x, sp->size, table, table + sp->size);
        if (sp->plane == STRUM_IN_PLANE) {
            in_plane_state state;
            spectrum_in_plane_at(sp, index, x, table, &state);
            value = hypot(cabs(state.displacement[0]), cabs(state.displacement[1]));
        } else {
            const double kappa = sp->cable.kappa_n, slope = mapping_slope(&sp->coordinate, x);
            const double chi = sp->cable.chi_m + mapping_offset(&sp->coordinate, x);
            const double e = 1 + kappa * cosh(chi);
            double _Complex w = 0, w1 = 0, w2 = 0;
            for (int k = 1; k < r->length; k++) {
                /* q_k'' = p_k' at the ends */
                w1 += r->vector[k] * table[k];
                w2 += r->vector[k] * sqrt(k + 0.5) * (k % 2 == 0 && x < 0 ? -1 : 1) * k *
                      (k + 1) / 2;
                w += r->vector[k] * table[sp->size + k];
            }
            const double rate = r->natural * r->natural * sp->cable.mass_n;
            w2 -= w1 * (slope * kappa * sinh(chi) / e + mapping_bend(&sp->coordinate, x));
            value = i % 64 == 0 ? cabs(w2) / pow(slope, 2) : cabs(w) * rate * e * cosh(chi);
        }
        if (i % 64 == 0)
            end = fmax(end, value);
        else
            inside = fmax(inside, value);
    }
    *residual = end / inside;
    return STRUM_OK;
}

static strum_status second_roots(const strum_modes *sp, int size, int want, arena *a,
                                 root_list *list, const char **method)
{
    const strum_cable *c = &sp->cable;
    root_search q = {.cable = c,
                     .x = &sp->coordinate,
                     .plane = sp->plane,
                     .form = IN_PLANE_CLAMPED_FORM,
                     .size = size,
                     .want = want};
    const bool undamped = c->eta_t == 0 && c->eta_n == 0;
    const bool stiff = c->kappa_t == 0 && c->kappa_n == 0;
    if (sp->plane == STRUM_OUT_OF_PLANE) {
        *method = "transverse-force Galerkin (dual form, natural ends)";
    } else if (undamped && stiff && sp->coordinate.stretch == 0 &&
               fabs(c->chi_m) + c->mu <= DISPLACEMENT_CHI_MAX) {
        *method = "displacement Galerkin (Gale 2.35, clamped u)";
        return displacement_roots(&q, false, a, list, NULL);
    } else {
        *method = "clamped-displacement Galerkin (Hellinger-Reissner form)";
    }
    q.size = size + 4;
    return spectrum_roots(&q, a, list, NULL, NULL);
}

static double nearest(const root_list *list, double _Complex s)
{
    double best = INFINITY;
    for (int i = 0; i < list->count; i++)
        best = fmin(best, cabs(list->items[i].s - s) / cabs(s));
    return best;
}

/* Agreement and count at one size of the second method. */
static strum_status hold_against(const strum_modes *sp, int size, work *spent,
                                 strum_verification *v)
{
    arena a = {.work = spent};
    root_list list = {0};
    const int want = sp->count + sp->overdamped + 8;
    const strum_status status = second_roots(sp, size, want, &a, &list, &v->method);
    const double last = sp->modes[sp->count - 1].frequency * (1 + 1e-9);
    v->modes_expected = 0;
    v->max_relative_difference = 0;
    for (int i = 0; status == STRUM_OK && i < list.count; i++)
        v->modes_expected += cimag(list.items[i].s) > 0 && cimag(list.items[i].s) <= last;
    for (int i = 0; status == STRUM_OK && i < sp->count; i++)
        v->max_relative_difference =
            fmax(v->max_relative_difference, nearest(&list, sp->roots[i].s));
    arena_free(&a);
    return status;
}

strum_status strum_modes_verify(const strum_modes *sp, const strum_options *options,
                                strum_verification *v, strum_error *fault)
{
    if (!sp->shapes)
        return error_set(fault, STRUM_ERR_METHOD, "a spectrum is verified with its shapes");
    *v = (strum_verification){.modes_found = sp->count};
    work spent = work_begin(options);
    arena a = {.work = &spent};
    double *table = arena_doubles(&a, 2 * (size_t)sp->size);
    strum_status status = table == NULL ? STRUM_ERR_MEMORY : STRUM_OK;
    for (int i = 0; status == STRUM_OK && i < sp->count; i++) {
        double residual;
        status = work_poll(&spent);
        if (status == STRUM_OK)
            status = closure(sp, i, table, &residual);
        if (status == STRUM_OK)
            v->max_residual = fmax(v->max_residual, residual);
    }
    /* the second method may need more functions than the first; it shows by disagreeing */
    int size = sp->size;
    double before = INFINITY;
    while (status == STRUM_OK) {
        status = hold_against(sp, size, &spent, v);
        if (v->max_relative_difference < 1e-12 || v->max_relative_difference > before / 3 ||
            size > SPECTRUM_SIZE_MAX)
            break;
        before = v->max_relative_difference;
        size = (int)(1.4 * size);
    }
    arena_free(&a);
    return work_result(&spent, status, fault);
}
