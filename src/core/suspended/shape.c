/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mode shapes from the coefficients of a solved spectrum. */
#include <math.h>

#include "core/numerics/peak.h"
#include "core/suspended/modes.h"

/* Values along the cable before normalisation; `table` holds p and q of every k at x. */
void spectrum_in_plane_at(const strum_modes *sp, int index, double x, const double *table,
                          in_plane_state *state)
{
    const root *r = &sp->roots[index];
    const in_plane_part *part = sp->parts[r->symmetry];
    const strum_cable *cable = &sp->cable;
    const double *p = table, *q = table + sp->size;
    double _Complex slope[2] = {0, 0};
    in_plane_frame_at(&sp->coordinate, x, &state->cosh_chi, &state->c, &state->s);
    state->force[0] = r->constant[0];
    state->force[1] = r->constant[1];
    for (int j = 0; j < r->length; j++) {
        state->force[part->component[j]] += r->vector[j] * q[part->index[j]];
        slope[part->component[j]] += r->vector[j] * p[part->index[j]];
    }
    /* F' = [tt' (m_t s^2 + eta_t s) + nn' (..)] X with ' = d/dsigma = d/dx / (cosh chi dchi/dx)
     */
    const double scale = 1 / (mapping_slope(&sp->coordinate, x) * state->cosh_chi);
    const double _Complex along = (state->c * slope[0] + state->s * slope[1]) * scale /
                                  (r->s * (cable->mass_t * r->s + cable->eta_t));
    const double _Complex across = (-state->s * slope[0] + state->c * slope[1]) * scale /
                                   (r->s * (cable->mass_n * r->s + cable->eta_n));
    state->displacement[0] = along;
    state->displacement[1] = across;
}

static void point_at(const strum_modes *sp, int index, double x, const double *table,
                     strum_shape_point *point)
{
    point->chi = sp->cable.chi_m + mapping_offset(&sp->coordinate, x);
    if (sp->plane == STRUM_OUT_OF_PLANE) {
        const root *r = &sp->roots[index];
        point->normal = 0;
        for (int k = 0; k < r->length; k++)
            point->normal += r->vector[k] * table[sp->size + k];
        point->tangential = point->tension = 0;
        return;
    }
    in_plane_state state;
    spectrum_in_plane_at(sp, index, x, table, &state);
    point->tangential = state.displacement[0];
    point->normal = state.displacement[1];
    point->tension = state.c * state.force[0] + state.s * state.force[1];
}

/* One displacement component of one mode, for the search of its largest value. */
typedef struct component {
    const strum_modes *sp;
    int index, number; /* of the mode; 0 tangential, 1 normal */
    double *table;
    double _Complex value; /* at the last x asked for */
} component;

static double component_at(void *data, double x)
{
    component *c = data;
    strum_shape_point point;
    legendre_at_with(c->sp->factors, x, c->sp->size, c->table, c->table + c->sp->size);
    point_at(c->sp, c->index, x, c->table, &point);
    c->value = c->number == 0 ? point.tangential : point.normal;
    return cabs(c->value);
}

static double refine(void *data, double low, double high, double *x)
{
    return peak_golden(component_at, data, low, high, x);
}

/* Where a mode's largest value lies does not depend on how many points are asked for. All modes
 * at once: the functions at a sample cost as much as a mode's sum of them. */
strum_status spectrum_normalise(strum_modes *sp)
{
    work *w = sp->memory.work;
    arena scratch = {.work = w};
    strum_status status = STRUM_OK;
    const size_t samples = 2 * (size_t)sp->size + 1, count = (size_t)sp->count;
    double *table = arena_doubles(&scratch, 2 * (size_t)sp->size);
    double *values = arena_doubles(&scratch, 2 * samples * count);
    sp->units = arena_alloc(&sp->memory, count, sizeof *sp->units);
    if (table == NULL || values == NULL || sp->units == NULL) {
        arena_free(&scratch);
        return STRUM_ERR_MEMORY;
    }
    for (size_t i = 0; i < samples && status == STRUM_OK; i++) {
        const double x = 2.0 * (double)i / (double)(samples - 1) - 1;
        status = work_poll(w);
        legendre_at_with(sp->factors, x, sp->size, table, table + sp->size);
        for (size_t k = 0; k < count; k++) {
            strum_shape_point point;
            point_at(sp, (int)k, x, table, &point);
            values[i + 2 * k * samples] = cabs(point.tangential);
            values[i + (2 * k + 1) * samples] = cabs(point.normal);
        }
    }
    for (size_t k = 0; k < count && status == STRUM_OK; k++) {
        double largest = 0;
        status = work_poll(w);
        for (int number = 1; number >= 0; number--) {
            component c = {.sp = sp, .index = (int)k, .number = number, .table = table};
            double x;
            const double value = peak_largest(values + (2 * k + (size_t)number) * samples,
                                              (int)samples, refine, &c, &x);
            if (value <= largest)
                continue;
            largest = component_at(&c, x);
            sp->units[k] = c.value;
        }
    }
    arena_free(&scratch);
    return status;
}

strum_status strum_modes_shape(const strum_modes *sp, size_t index, const double *chi,
                               size_t points, strum_shape_point *shape)
{
    if (!sp->shapes)
        return STRUM_ERR_METHOD;
    if (index >= (size_t)sp->count || points < (chi == NULL ? 2 : 1))
        return STRUM_ERR_RANGE;
    for (size_t i = 0; chi != NULL && i < points; i++)
        if (!(fabs(chi[i] - sp->cable.chi_m) <= sp->cable.mu * (1 + 1e-12)))
            return STRUM_ERR_RANGE;
    arena scratch = {0};
    double *table = arena_doubles(&scratch, 2 * (size_t)sp->size);
    if (table == NULL)
        return STRUM_ERR_MEMORY;
    const double _Complex unit = sp->units[index];
    for (size_t i = 0; i < points; i++) {
        const double share = i == points - 1 ? 1 : 2.0 * (double)i / (double)(points - 1) - 1;
        const double at = chi != NULL ? chi[i] : sp->cable.chi_m + sp->cable.mu * share;
        const double x =
            chi == NULL && fabs(share) == 1 ? share : mapping_x(&sp->coordinate, at);
        legendre_at_with(sp->factors, x, sp->size, table, table + sp->size);
        point_at(sp, (int)index, x, table, &shape[i]);
        shape[i].chi = at;
        shape[i].tangential /= unit;
        shape[i].normal /= unit;
        shape[i].tension /= unit;
        if (fabs(x) == 1) /* the supports, which the force form only meets to rounding */
            shape[i].tangential = shape[i].normal = 0;
    }
    arena_free(&scratch);
    return STRUM_OK;
}
