/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inclined cables at rest: ranges, statics, crossovers, and the coordinates of a point. */
#include "core/inclined/statics.h"

#include <math.h>

#include "core/numerics/status.h"

static strum_status check(const strum_inclined_cable *c, strum_error *error)
{
    if (!(c->epsilon >= STRUM_EPSILON_MIN && c->epsilon <= STRUM_EPSILON_MAX))
        return error_at(error, STRUM_ERR_RANGE, STRUM_INCLINED_ARG_EPSILON, STRUM_NO_INDEX,
                        "epsilon must lie between %g and %g", STRUM_EPSILON_MIN,
                        STRUM_EPSILON_MAX);
    if (!(c->inclination >= 0 &&
          c->inclination <= STRUM_INCLINATION_MAX_DEG * M_PI / 180 * (1 + 1e-12)))
        return error_at(error, STRUM_ERR_RANGE, STRUM_INCLINED_ARG_INCLINATION, STRUM_NO_INDEX,
                        "the inclination must lie between 0 and %g degrees",
                        STRUM_INCLINATION_MAX_DEG);
    if (!(c->lambda_squared >= STRUM_LAMBDA_SQUARED_MIN &&
          (c->lambda_squared <= STRUM_LAMBDA_SQUARED_MAX || isinf(c->lambda_squared))))
        return error_at(error, STRUM_ERR_RANGE, STRUM_INCLINED_ARG_LAMBDA_SQUARED,
                        STRUM_NO_INDEX,
                        "lambda squared must lie between %g and %g, or be infinite",
                        STRUM_LAMBDA_SQUARED_MIN, STRUM_LAMBDA_SQUARED_MAX);
    if (!(c->mass_ratio >= STRUM_MASS_RATIO_MIN && c->mass_ratio <= 1))
        return error_at(error, STRUM_ERR_RANGE, STRUM_INCLINED_ARG_MASS_RATIO, STRUM_NO_INDEX,
                        "the mass ratio must lie between %g and 1", STRUM_MASS_RATIO_MIN);
    return STRUM_OK;
}

double inclined_phase(const strum_inclined_cable *cable, const strum_catenary *p,
                      const legendre *rule, double offset)
{
    /* T0 = cos(phi_a) cosh(chi), ds = cosh(chi) dchi a/L */
    const double half = (offset + p->mu) / 2;
    double sum = 0;
    for (int i = 0; i < rule->points; i++)
        sum += rule->w[i] * sqrt(cosh(p->chi_m - p->mu + half * (rule->x[i] + 1)));
    return half * sum * sqrt(cos(cable->inclination)) / cable->epsilon;
}

strum_status strum_inclined_statics_find(const strum_inclined_cable *cable,
                                         strum_inclined_statics *s, strum_error *error)
{
    strum_status status = check(cable, error);
    if (status != STRUM_OK)
        return status;
    const double cosine = cos(cable->inclination);
    s->stiffness = cable->lambda_squared / pow(cable->epsilon * cosine, 2);
    const double strain = cable->elastic_statics ? cable->epsilon / s->stiffness : 0;
    status = strum_catenary_from_chord(cable->epsilon, cable->inclination, strain, &s->profile,
                                       error);
    if (status != STRUM_OK) {
        if (error !=
            NULL) /* it is the weight over the tension that makes a profile too steep */
            error->argument = STRUM_INCLINED_ARG_EPSILON;
        return status;
    }
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
                              : error_set(error, status, "%s", strum_status_text(status));
}

strum_status strum_inclined_crossover(const strum_inclined_cable *cable, strum_crossover *c)
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

strum_cable inclined_mechanics(const strum_inclined_cable *cable,
                               const strum_inclined_statics *s)
{
    const double kappa = cos(cable->inclination) / s->stiffness; /* H/EA */
    return (strum_cable){.chi_m = s->profile.chi_m,
                         .mu = s->profile.mu,
                         .kappa_t = kappa,
                         .kappa_n = cable->elastic_statics ? kappa : 0,
                         .mass_t = cable->mass_ratio,
                         .mass_n = 1};
}

double inclined_s_of_x(const strum_inclined *m, double x)
{
    const strum_catenary *p = &m->statics.profile;
    const double offset = mapping_offset(&m->along, x);
    return 2 * cosh(p->chi_m + (offset - p->mu) / 2) * sinh((offset + p->mu) / 2) / m->length;
}

double inclined_x_of_s(const strum_inclined *m, double s)
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

double inclined_spacing(const strum_inclined *m)
{
    const bool along = m->model->has_longitudinal;
    return 1 / (1 + (along ? sqrt(m->cable.mass_ratio / m->statics.stiffness) : 0));
}
