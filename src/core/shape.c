/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mode shapes from the coefficients of a solved spectrum. */
#include <math.h>

#include "core/spectrum.h"

/* Values along the cable before normalisation; `table` has room for p and q of every k. */
void spectrum_inplane_at(const strum_spectrum *sp, int index, double x, double *table,
                         inplane_state *state)
{
    const root *r = &sp->roots[index];
    const inplane_part *part = sp->parts[r->symmetry];
    const strum_cable *cable = &sp->cable;
    double *p = table, *q = table + sp->size;
    double _Complex slope[2] = {0, 0};
    basis_at(x, sp->size, p, q);
    inplane_frame_at(&sp->coordinate, x, &state->cosh_chi, &state->c, &state->s);
    state->force[0] = r->constant[0];
    state->force[1] = r->constant[1];
    for (int j = 0; j < r->length; j++) {
        state->force[part->component[j]] += r->vector[j] * q[part->index[j]];
        slope[part->component[j]] += r->vector[j] * p[part->index[j]];
    }
    /* F' = [tt' (m_t s^2 + eta_t s) + nn' (..)] X with ' = d/dsigma = d/dx / (cosh chi dchi/dx)
     */
    const double scale = 1 / (coordinate_slope(&sp->coordinate, x) * state->cosh_chi);
    const double _Complex along = (state->c * slope[0] + state->s * slope[1]) * scale /
                                  (r->s * (cable->mass_t * r->s + cable->eta_t));
    const double _Complex across = (-state->s * slope[0] + state->c * slope[1]) * scale /
                                   (r->s * (cable->mass_n * r->s + cable->eta_n));
    state->displacement[0] = along;
    state->displacement[1] = across;
}

static void point_at(const strum_spectrum *sp, int index, double x, double *table,
                     strum_shape_point *point)
{
    point->chi = sp->cable.chi_m + coordinate_offset(&sp->coordinate, x);
    if (sp->plane == STRUM_OUT_OF_PLANE) {
        const root *r = &sp->roots[index];
        basis_at(x, sp->size, table, table + sp->size);
        point->normal = 0;
        for (int k = 0; k < r->length; k++)
            point->normal += r->vector[k] * table[sp->size + k];
        point->tangential = point->tension = 0;
        return;
    }
    inplane_state state;
    spectrum_inplane_at(sp, index, x, table, &state);
    point->tangential = state.displacement[0];
    point->normal = state.displacement[1];
    point->tension = state.c * state.force[0] + state.s * state.force[1];
}

static double _Complex component_of(const strum_shape_point *point, int component)
{
    return component == 0 ? point->tangential : point->normal;
}

/* Largest displacement along the whole cable, found between samples by golden section: where a
 * mode's largest value lies does not depend on how many points were asked for. */
static double _Complex largest(const strum_spectrum *sp, int index, double *table)
{
    const int samples = 4 * sp->size + 1;
    double best = -1, x_best = 0;
    int component = 1;
    for (int i = 0; i < samples; i++) {
        const double x = 2.0 * i / (samples - 1) - 1;
        strum_shape_point point;
        point_at(sp, index, x, table, &point);
        for (int c = 0; c < 2; c++)
            if (cabs(component_of(&point, c)) > best * (1 + 1e-9)) { /* the first of equals */
                best = cabs(component_of(&point, c));
                x_best = x;
                component = c;
            }
    }
    const double golden = 0.6180339887498949, step = 2.0 / (samples - 1);
    double low = fmax(x_best - step, -1), high = fmin(x_best + step, 1);
    for (int i = 0; i < 45; i++) {
        const double left = high - golden * (high - low), right = low + golden * (high - low);
        strum_shape_point at_left, at_right;
        point_at(sp, index, left, table, &at_left);
        point_at(sp, index, right, table, &at_right);
        if (cabs(component_of(&at_left, component)) > cabs(component_of(&at_right, component)))
            high = right;
        else
            low = left;
    }
    strum_shape_point peak;
    point_at(sp, index, (low + high) / 2, table, &peak);
    return component_of(&peak, component);
}

strum_status strum_spectrum_shape(const strum_spectrum *sp, int index, const double *chi,
                                  int points, strum_shape_point *shape)
{
    if (!sp->shapes)
        return STRUM_ERR_METHOD;
    if (index < 0 || index >= sp->count || points < (chi == NULL ? 2 : 1))
        return STRUM_ERR_RANGE;
    for (int i = 0; chi != NULL && i < points; i++)
        if (!(fabs(chi[i] - sp->cable.chi_m) <= sp->cable.mu * (1 + 1e-12)))
            return STRUM_ERR_RANGE;
    arena scratch = {0};
    double *table = arena_doubles(&scratch, 2 * (size_t)sp->size);
    if (table == NULL)
        return STRUM_ERR_MEMORY;
    const double _Complex unit = largest(sp, index, table);
    for (int i = 0; i < points; i++) {
        const double share = i == points - 1 ? 1 : 2.0 * i / (points - 1) - 1;
        const double at = chi != NULL ? chi[i] : sp->cable.chi_m + sp->cable.mu * share;
        const double x =
            chi == NULL && fabs(share) == 1 ? share : coordinate_x(&sp->coordinate, at);
        point_at(sp, index, x, table, &shape[i]);
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
