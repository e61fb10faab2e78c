/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inclined cables: statics, crossovers, and the models behind one face. */
#include "core/inclined/inclined.h"

#include <math.h>
#include <stdlib.h>

/* Below it the characteristic functions round away too much of the spurious root to tell it. */
#define SPURIOUS_MIN 1e-3

static strum_status check(const strum_inclined *c, strum_error *fault)
{
    if (!(c->epsilon >= STRUM_EPSILON_MIN && c->epsilon <= STRUM_EPSILON_MAX))
        return error_set(fault, STRUM_ERR_RANGE, "epsilon must lie between %g and %g",
                         STRUM_EPSILON_MIN, STRUM_EPSILON_MAX);
    if (!(c->inclination >= 0 &&
          c->inclination <= STRUM_INCLINATION_MAX_DEG * M_PI / 180 * (1 + 1e-12)))
        return error_set(fault, STRUM_ERR_RANGE,
                         "the inclination must lie between 0 and %g degrees",
                         STRUM_INCLINATION_MAX_DEG);
    if (!(c->lambda_squared >= STRUM_LAMBDA_SQUARED_MIN &&
          (c->lambda_squared <= STRUM_LAMBDA_SQUARED_MAX || isinf(c->lambda_squared))))
        return error_set(fault, STRUM_ERR_RANGE,
                         "lambda squared must lie between %g and %g, or be infinite",
                         STRUM_LAMBDA_SQUARED_MIN, STRUM_LAMBDA_SQUARED_MAX);
    if (!(c->mass_ratio >= STRUM_MASS_RATIO_MIN && c->mass_ratio <= 1))
        return error_set(fault, STRUM_ERR_RANGE, "the mass ratio must lie between %g and 1",
                         STRUM_MASS_RATIO_MIN);
    return STRUM_OK;
}

double inclined_phase(const strum_inclined *cable, const strum_catenary *p,
                      const legendre *rule, double offset)
{
    /* T0 = cos(phi_a) cosh(chi), ds = cosh(chi) dchi a/L */
    const double half = (offset + p->mu) / 2;
    double sum = 0;
    for (int i = 0; i < rule->points; i++)
        sum += rule->w[i] * sqrt(cosh(p->chi_m - p->mu + half * (rule->x[i] + 1)));
    return half * sum * sqrt(cos(cable->inclination)) / cable->epsilon;
}

strum_status strum_inclined_statics_find(const strum_inclined *cable, strum_inclined_statics *s,
                                         strum_error *fault)
{
    strum_status status = check(cable, fault);
    if (status != STRUM_OK)
        return status;
    const double cosine = cos(cable->inclination);
    s->stiffness = cable->lambda_squared / pow(cable->epsilon * cosine, 2);
    const double strain = cable->elastic_statics ? cable->epsilon / s->stiffness : 0;
    status = strum_catenary_from_chord(cable->epsilon, cable->inclination, strain, &s->profile,
                                       fault);
    if (status != STRUM_OK)
        return status;
    const strum_catenary *p = &s->profile;
    const double length = cable->epsilon / cosine;
    const double chi_1 = p->chi_m - p->mu, chi_2 = p->chi_m + p->mu;
    s->s_a = strum_catenary_parallel(p) / length;
    s->tension_bottom = cosine * cosh(chi_1);
    s->tension_top = cosine * cosh(chi_2);
    s->curvature_bottom = length / pow(cosh(chi_1), 2);
    s->curvature_top = length / pow(cosh(chi_2), 2);
    s->angle_bottom = atan(sinh(chi_1));
    s->angle_top = atan(sinh(chi_2));
    s->chord = hypot(p->span, p->rise) / length;
    s->sag = strum_catenary_sag(p) / length;
    arena scratch = {0};
    legendre rule;
    status = legendre_make(1, M_PI_2 / p->mu, false, &scratch, &rule);
    if (status == STRUM_OK)
        s->phase = inclined_phase(cable, p, &rule, p->mu);
    arena_free(&scratch);
    return status == STRUM_OK ? status
                              : error_set(fault, status, "%s", strum_status_text(status));
}

strum_status strum_inclined_crossover(const strum_inclined *cable, strum_crossover *c)
{
    if (isinf(cable->lambda_squared))
        return STRUM_ERR_METHOD;
    const double width = 2 * cable->epsilon * sin(cable->inclination);
    const double nearest = round(sqrt(cable->lambda_squared) / (2 * M_PI));
    c->number = nearest < 1 ? 1 : (int)nearest;
    c->lambda_squared = pow(2 * M_PI * c->number, 2);
    /* |kL^2/lambda^2 - 1| < 2 epsilon sin(phi_a) at kL = 2 n pi */
    c->low = c->lambda_squared / (1 + width);
    c->high = width < 1 ? c->lambda_squared / (1 - width) : INFINITY;
    c->inside = cable->lambda_squared > c->low && cable->lambda_squared < c->high;
    c->gap = 7 / (2 * sqrt(3)) * cable->epsilon * sin(cable->inclination);
    return STRUM_OK;
}

strum_cable inclined_mechanics(const strum_inclined *cable, const strum_inclined_statics *s)
{
    const double kappa = cos(cable->inclination) / s->stiffness; /* H/EA */
    return (strum_cable){.chi_m = s->profile.chi_m,
                         .mu = s->profile.mu,
                         .kappa_t = kappa,
                         .kappa_n = cable->elastic_statics ? kappa : 0,
                         .mass_t = cable->mass_ratio,
                         .mass_n = 1};
}

double inclined_s_of_x(const strum_inclined_modes *m, double x)
{
    const strum_catenary *p = &m->statics.profile;
    const double offset = mapping_offset(&m->along, x);
    return 2 * cosh(p->chi_m + (offset - p->mu) / 2) * sinh((offset + p->mu) / 2) / m->length;
}

double inclined_x_of_s(const strum_inclined_modes *m, double s)
{
    /* chi - chi_m from sinh chi - sinh chi_m; of the two forms of the difference of two asinh
     * each cancels where the other does not */
    const strum_catenary *p = &m->statics.profile;
    const double from = sinh(p->chi_m), half = sinh(p->mu / 2);
    const double rise = from * 2 * half * half + m->length * (s - 0.5), to = from + rise;
    const double root_from = hypot(1, from), root_to = hypot(1, to);
    const double sinh_difference = from * to > 0
                                       ? rise * (to + from) / (to * root_from + from * root_to)
                                       : to * root_from - from * root_to;
    const double offset = asinh(sinh_difference);
    return m->along.stretch == 0 ? fmin(fmax(offset / p->mu, -1), 1)
                                 : mapping_x(&m->along, p->chi_m + offset);
}

double inclined_spacing(const strum_inclined_modes *m)
{
    const bool airy = m->model <= STRUM_INCLINED_AIRY_TANGENT; /* the others lack those waves */
    return 1 / (1 + (airy ? sqrt(m->cable.mass_ratio / m->statics.stiffness) : 0));
}

strum_status inclined_roots(const strum_inclined_modes *m, int count, inclined_wave *waves,
                            double *spurious)
{
    return m->model <= STRUM_INCLINED_AIRY_TANGENT
               ? inclined_airy_roots(m, count, waves, spurious)
               : inclined_closed_roots(m, count, waves, spurious);
}

/* Frequencies and force coefficients of the core's spectrum. */
static strum_status keep_spectrum(strum_inclined_modes *m, const strum_modes *sp)
{
    const size_t size = (size_t)strum_modes_size(sp);
    const double unit = m->cable.epsilon / sqrt(cos(m->cable.inclination));
    m->size = (int)size;
    m->along = sp->coordinate;
    m->forces = arena_doubles(&m->memory, 2 * size * (size_t)m->count);
    m->constants = arena_doubles(&m->memory, 2 * (size_t)m->count);
    m->stretch = arena_doubles(&m->memory, size * (size_t)m->count);
    if (m->forces == NULL || m->constants == NULL || m->stretch == NULL)
        return STRUM_ERR_MEMORY;
    for (int i = 0; i < m->count; i++) {
        const root *r = &sp->roots[i];
        const in_plane_part *part = sp->parts[r->symmetry];
        m->modes[i] =
            (strum_inclined_mode){.kl = sp->modes[i].frequency * unit, .symmetry = r->symmetry};
        for (int j = 0; j < r->length; j++)
            m->forces[(size_t)(2 * i + part->component[j]) * size + (size_t)part->index[j]] =
                creal(r->vector[j]);
        for (int k = 0; k < 2; k++)
            m->constants[2 * i + k] = creal(r->constant[k]);
    }
    return STRUM_OK;
}

static strum_status solve_full(strum_inclined_modes *m, strum_error *fault)
{
    const strum_cable cable = inclined_mechanics(&m->cable, &m->statics);
    strum_modes *spectrum;
    strum_status status = strum_modes_solve(
        &(strum_modes_params){cable, STRUM_IN_PLANE, m->count, true}, NULL, &spectrum, fault);
    if (status != STRUM_OK)
        return status;
    status = keep_spectrum(m, spectrum);
    strum_modes_free(spectrum);
    if (status == STRUM_OK)
        status = inclined_stretch(m);
    return status == STRUM_OK ? status : error_set(fault, status, "out of memory");
}

static strum_status solve_approximately(strum_inclined_modes *m, strum_error *fault)
{
    if (m->model != STRUM_INCLINED_IRVINE && m->cable.epsilon > STRUM_EXPANSION_EPSILON_MAX)
        return error_set(fault, STRUM_ERR_METHOD,
                         "epsilon is %.3g, and the report's expansions are in powers of it: "
                         "above %g only the full model answers",
                         m->cable.epsilon, STRUM_EXPANSION_EPSILON_MAX);
    const strum_cable cable = inclined_mechanics(&m->cable, &m->statics);
    m->along = mapping_linear(&cable);
    m->size =
        (int)(1.35 * spectrum_first_size(&cable, &m->along, STRUM_IN_PLANE, m->count)) + 8;
    m->waves = arena_alloc(&m->memory, (size_t)m->count, sizeof *m->waves);
    strum_status status = m->waves == NULL ? STRUM_ERR_MEMORY
                                           : legendre_make(1, M_PI_2 / m->statics.profile.mu,
                                                           false, &m->memory, &m->rule);
    if (status != STRUM_OK)
        return error_set(fault, status, "%s", strum_status_text(status));
    status = inclined_roots(m, m->count, m->waves, &m->spurious);
    if (status != STRUM_OK)
        return error_set(fault, status,
                         "the characteristic equation of this model has not the "
                         "roots it should have for this cable");
    for (int i = 0; i < m->count; i++)
        m->modes[i] = (strum_inclined_mode){
            .kl = m->waves[i].kl,
            .symmetry = m->cable.inclination == 0 ? m->waves[i].symmetry : STRUM_NO_SYMMETRY};
    return STRUM_OK;
}

strum_status strum_inclined_solve(const strum_inclined *cable, strum_inclined_model model,
                                  int count, strum_inclined_modes **modes, strum_error *fault)
{
    *modes = NULL;
    if (count < 1 || count > STRUM_MODES_MAX)
        return error_set(fault, STRUM_ERR_RANGE, "1 to %d modes can be asked for",
                         STRUM_MODES_MAX);
    strum_inclined_modes *m = calloc(1, sizeof *m);
    if (m == NULL)
        return error_set(fault, STRUM_ERR_MEMORY, "out of memory");
    m->cable = *cable;
    m->model = model;
    m->count = count;
    m->length = cable->epsilon / cos(cable->inclination);
    m->modes = arena_alloc(&m->memory, (size_t)count, sizeof *m->modes);
    m->unit = arena_doubles(&m->memory, (size_t)count);
    strum_status status = m->modes == NULL || m->unit == NULL
                              ? error_set(fault, STRUM_ERR_MEMORY, "out of memory")
                              : strum_inclined_statics_find(cable, &m->statics, fault);
    if (status == STRUM_OK)
        status =
            model == STRUM_INCLINED_FULL ? solve_full(m, fault) : solve_approximately(m, fault);
    if (status == STRUM_OK) {
        status = inclined_measure(m);
        if (status != STRUM_OK)
            error_set(fault, status, "%s", strum_status_text(status));
    }
    if (status != STRUM_OK)
        strum_inclined_free(&m);
    *modes = m;
    return status;
}

void strum_inclined_free(strum_inclined_modes **modes)
{
    if (*modes != NULL) {
        arena_free(&(*modes)->memory);
        free(*modes);
        *modes = NULL;
    }
}

double strum_inclined_work(const strum_inclined *cable, strum_inclined_model model, int count)
{
    strum_inclined_statics s;
    if (strum_inclined_statics_find(cable, &s, NULL) != STRUM_OK)
        return 0;
    const strum_cable mechanics = inclined_mechanics(cable, &s);
    const mapping x = mapping_linear(&mechanics);
    const double size = 1.35 * spectrum_first_size(&mechanics, &x, STRUM_IN_PLANE, count);
    /* measured: the roots, and the shapes sampled for their maxima and energies */
    if (model == STRUM_INCLINED_FULL)
        return strum_modes_work(&(strum_modes_params){mechanics, STRUM_IN_PLANE, count, true}) +
               count * (60 + 0.004 * size * size);
    const bool airy = model <= STRUM_INCLINED_AIRY_TANGENT;
    return count * (airy ? 80 + 0.01 * size * size : 25 + 0.001 * size * size);
}

int strum_inclined_count(const strum_inclined_modes *m)
{
    return m->count;
}

const strum_inclined_mode *strum_inclined_mode_at(const strum_inclined_modes *m, int index)
{
    return &m->modes[index];
}

double strum_inclined_spurious(const strum_inclined_modes *m)
{
    return m->spurious > SPURIOUS_MIN ? m->spurious : 0;
}
