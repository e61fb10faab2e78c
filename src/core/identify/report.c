/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/identify/report.h"

#include <gsl/gsl_cdf.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/numerics/linalg.h"

/* Columns that are parallel to this: no data of these modes could tell them apart. */
#define STRUCTURAL 1e-10
#define ACTS       1e-6
#define ROUNDING   1e-15
/* Intervals wider than this factor (e^2) do not determine a quantity. */
#define WIDE 2.0
/* A frequency disagrees when its residual is beyond this quantile, by Bonferroni's rule. */
#define OUTLIER_LEVEL 0.01
/* A minimum that fits exactly, as a share of the sum of squares. */
#define EXACT 1e-18

const char *const quantity_names[QUANTITIES] = {
    "tension", "bending_stiffness", "fixity", "length", "mass", "axial_stiffness", "damping"};

static double sum_of_squares(const problem *p)
{
    double sum = 0;
    for (size_t i = 0; i < p->count; i++)
        sum += p->skip[i] ? 0 : pow(p->measured[i] / p->deviation[i], 2);
    return sum;
}

/* The unknowns' directions; columns of nothing are left out of `regular`. */
static strum_status decompose(strum_identify *f)
{
    const fit *best = &f->fits[0];
    strum_identify_summary *s = &f->summary;
    double a[ROWS_MAX * UNKNOWNS_MAX], vt[UNKNOWNS_MAX * UNKNOWNS_MAX];
    int which[UNKNOWNS_MAX], n = 0;
    const double scale = sqrt(sum_of_squares(&f->p)) + 1e-300;
    for (size_t j = 0; j < best->unknowns; j++) {
        const double *column = &best->jacobian[j * best->rows];
        double norm = 0;
        for (size_t i = 0; i < best->rows; i++)
            norm += column[i] * column[i];
        f->regular[j] = sqrt(norm) > 1e-10 * scale;
        if (f->regular[j]) {
            memcpy(&a[(size_t)n * best->rows], column, best->rows * sizeof *a);
            which[n++] = (int)j;
        }
    }
    if (n == 0 || best->rows < (size_t)n)
        return STRUM_OK;
    const strum_status status =
        linalg_singular((int)best->rows, n, a, (int)best->rows, s->singular_values, vt);
    for (int i = 0; i < n && status == STRUM_OK; i++) {
        s->weakest[which[i]] = vt[(n - 1) + i * n];
        for (int j = 0; j < n; j++) {
            double sum = 0;
            for (int k = 0; k < n; k++) {
                /* 0 to rounding: no bound, but a number */
                const double sv = fmax(s->singular_values[k], ROUNDING * s->singular_values[0]);
                sum += vt[k + i * n] / sv * (vt[k + j * n] / sv);
            }
            f->covariance[which[i]][which[j]] = sum;
        }
    }
    return status;
}

/* Unknowns that move together without moving any frequency. */
static strum_status refuse_combination(const strum_identify *f, const int *columns, int n,
                                       const double *direction, strum_error *error)
{
    char text[160] = "";
    for (int i = 0; i < n; i++) {
        const size_t used = strlen(text);
        if (fabs(direction[i]) > 1e-6)
            (void)snprintf(text + used, sizeof text - used, "%s%s %+.3g", used > 0 ? ", " : "",
                           quantity_names[f->fits[0].which[columns[i]]], direction[i]);
    }
    return error_at(
        error, STRUM_ERR_IMPOSSIBLE, STRUM_IDENTIFY_ARG_UNKNOWNS, STRUM_NO_INDEX,
        "no frequency changes when these move together (in logarithms): %s; know one "
        "of them, or give it a standard deviation",
        text);
}

/* Columns of the quantities that act on the data, each of length 1. The fixity is left out: data
 * hardly tell it, but never not at all. So is what acts by less than ACTS of the strongest. */
static int unit_columns(const strum_identify *f, double *a, double *norms, int *columns)
{
    const fit *best = &f->fits[0];
    double norm[UNKNOWNS_MAX] = {0}, largest = 0;
    int n = 0;
    for (size_t j = 0; j < best->unknowns; j++) {
        for (size_t i = 0; i < best->rows; i++)
            norm[j] += pow(best->jacobian[i + j * best->rows], 2);
        norm[j] = sqrt(norm[j]);
        largest = fmax(largest, norm[j]);
    }
    for (size_t j = 0; j < best->unknowns; j++) {
        if (!(norm[j] > ACTS * largest) || best->which[j] == FIXITY)
            continue;
        for (size_t i = 0; i < best->rows; i++)
            a[i + (size_t)n * best->rows] = best->jacobian[i + j * best->rows] / norm[j];
        norms[n] = norm[j];
        columns[n++] = (int)j;
    }
    return n;
}

static strum_status test_structure(const strum_identify *f, strum_error *error)
{
    const fit *best = &f->fits[0];
    double a[ROWS_MAX * UNKNOWNS_MAX], values[UNKNOWNS_MAX], vt[UNKNOWNS_MAX * UNKNOWNS_MAX];
    double norms[UNKNOWNS_MAX];
    int columns[UNKNOWNS_MAX];
    for (size_t j = 0; j < best->unknowns; j++)
        if (!f->regular[j] && best->which[j] == AXIAL)
            return error_at(error, STRUM_ERR_IMPOSSIBLE, STRUM_IDENTIFY_ARG_UNKNOWNS,
                            STRUM_NO_INDEX,
                            "the axial stiffness does not act on these modes (antisymmetric "
                            "ones)");
    const int n = unit_columns(f, a, norms, columns);
    if (n < 2 || best->rows < (size_t)n)
        return STRUM_OK;
    const strum_status status =
        linalg_singular((int)best->rows, n, a, (int)best->rows, values, vt);
    if (status != STRUM_OK || values[n - 1] > STRUCTURAL * values[0])
        return status;
    double direction[UNKNOWNS_MAX], largest = 0;
    for (int i = 0; i < n; i++) {
        direction[i] = vt[(n - 1) + i * n] / norms[i];
        largest = fabs(direction[i]) > fabs(largest) ? direction[i] : largest;
    }
    for (int i = 0; i < n; i++)
        direction[i] /= largest;
    return refuse_combination(f, columns, n, direction, error);
}

strum_status report_identifiability(strum_identify *f, strum_error *error)
{
    strum_identify_summary *s = &f->summary;
    const fit *best = &f->fits[0];
    s->unknowns = best->unknowns;
    for (size_t j = 0; j < best->unknowns; j++)
        s->which[j] = (strum_identify_quantity)best->which[j];
    for (size_t j = 0; j < UNKNOWNS_MAX; j++)
        s->singular_values[j] = s->weakest[j] = 0;
    strum_status status = decompose(f);
    if (status == STRUM_OK)
        status = test_structure(f, error);
    for (size_t i = 0; i < best->unknowns; i++)
        for (size_t j = 0; j < best->unknowns; j++) {
            const double size = f->covariance[i][i] * f->covariance[j][j];
            s->correlation[i][j] = i == j ? 1 : size > 0 ? f->covariance[i][j] / sqrt(size) : 0;
        }
    s->chi_squared = best->chi2;
    s->degrees_of_freedom = (int)best->rows - (int)best->unknowns;
    const int dof = s->degrees_of_freedom;
    s->p_value = f->p.weighted && dof > 0 ? gsl_cdf_chisq_Q(best->chi2, dof) : NAN;
    f->variance = f->p.weighted ? 1 : dof > 0 ? best->chi2 / dof : NAN;
    s->residual_deviation = f->p.weighted ? NAN : sqrt(f->variance);
    return status;
}

/* How far chi^2 may rise within the confidence. */
static double allowed_rise(const strum_identify *f)
{
    const double tail = 0.5 * (1 + f->confidence);
    const int dof = f->summary.degrees_of_freedom;
    if (f->p.weighted)
        return pow(gsl_cdf_ugaussian_Pinv(tail), 2);
    return dof > 0 ? pow(gsl_cdf_tdist_Pinv(tail, dof), 2) * f->variance : NAN;
}

static void list_solutions(strum_identify *f, double rise)
{
    const double floor = EXACT * sum_of_squares(&f->p);
    const double most = f->fits[0].chi2 + fmax(isfinite(rise) ? rise : 0, floor);
    f->solution_count = 0;
    for (size_t i = 0; i < f->fit_count; i++) {
        const fit *one = &f->fits[i];
        if (one->chi2 > most)
            break;
        strum_identify_solution *s = &f->solutions[f->solution_count++];
        memcpy(s->values, one->at.q, sizeof s->values);
        s->chi_squared = one->chi2;
        s->lambda_squared = f->p.sag ? state_lambda2(&f->p, &one->at) : NAN;
        if (f->p.ratios_at < f->p.count) {
            double ratio, r;
            const double own =
                one->at.q[DAMPING] / sqrt(one->at.q[TENSION] * state_mass(&f->p, &one->at));
            s->below_optimum =
                damper_best(f->p.modes[f->p.ratios_at],
                            f->p.damper_position / one->at.q[LENGTH], &ratio, &r) &&
                own < r;
        }
    }
}

static bool narrow(const strum_identify_estimate *e, int q, bool interval)
{
    if (!interval)
        return isfinite(e->standard_error) || q == TENSION;
    if (q == FIXITY)
        return isfinite(e->low) && isfinite(e->high) && !(e->low <= 0 && e->high >= 1);
    return isfinite(e->low) && isfinite(e->high) && e->low > 0 && log(e->high / e->low) < WIDE;
}

/* The intervals about all minima that fit, as one. An end that is missing stays so. */
static strum_status interval(strum_identify *f, int q, double rise, double start,
                             strum_identify_estimate *e)
{
    for (size_t i = 0; i < f->solution_count; i++) {
        const double x = f->solutions[i].values[q];
        double low, high;
        if (i > 0 && (x >= e->low || isnan(e->low)) && (x <= e->high || isnan(e->high)))
            continue; /* within already */
        const strum_status status =
            profile_interval(&f->p, &f->fits[i], q, f->fits[0].chi2, rise, start, &low, &high);
        if (status != STRUM_OK)
            return status;
        e->low = i == 0 ? low : isnan(low) || isnan(e->low) ? NAN : fmin(low, e->low);
        e->high = i == 0 ? high : isnan(high) || isnan(e->high) ? NAN : fmax(high, e->high);
    }
    return STRUM_OK;
}

/* Without standard deviations and degrees of freedom the values alone. An unknown fixity joins its
 * minima; others lie apart, and then the data do not determine. */
static strum_status estimate(strum_identify *f, size_t j, double rise)
{
    const fit *best = &f->fits[0];
    const int q = best->which[j];
    strum_identify_estimate *e = &f->estimates[q];
    const double spread = f->regular[j] ? sqrt(f->covariance[j][j] * f->variance) : NAN;
    const double factor = q == FIXITY ? 1 : e->value;
    const bool exact = rise < 1e-22 * sum_of_squares(&f->p);
    strum_status status = STRUM_OK;
    e->standard_error = spread * factor;
    if (exact)
        e->low = e->high = e->value;
    else if (isfinite(rise))
        status = interval(f, q, rise, sqrt(rise / f->variance) * spread, e);
    e->determined =
        narrow(e, q, isfinite(rise)) && (f->solution_count == 1 || f->p.unknown[FIXITY]);
    return status;
}

strum_status report_estimates(strum_identify *f)
{
    const fit *best = &f->fits[0];
    const double rise = allowed_rise(f);
    list_solutions(f, rise);
    strum_status status = STRUM_OK;
    for (int q = 0; q < QUANTITIES; q++)
        f->estimates[q] = (strum_identify_estimate){.unknown = f->p.unknown[q],
                                                    .value = best->at.q[q],
                                                    .standard_error = NAN,
                                                    .low = NAN,
                                                    .high = NAN};
    for (size_t j = 0; j < best->unknowns && status == STRUM_OK; j++)
        status = estimate(f, j, rise);
    strum_identify_summary *s = &f->summary;
    s->xi = best->at.u > 0 && f->p.chain == NULL ? 1 / best->at.u : NAN;
    s->lambda_squared = f->p.sag ? state_lambda2(&f->p, &best->at) : NAN;
    s->sag_to_span =
        f->p.sag ? f->p.weight * best->at.q[LENGTH] / (8 * best->at.q[TENSION]) : NAN;
    return status;
}

/* ---- each datum ---- */

static double leverage(const strum_identify *f, size_t row)
{
    const fit *best = &f->fits[0];
    double h = 0;
    for (size_t i = 0; i < best->unknowns; i++)
        for (size_t j = 0; j < best->unknowns; j++)
            h += best->jacobian[row + i * best->rows] * f->covariance[i][j] *
                 best->jacobian[row + j * best->rows];
    return h;
}

/* Against the given deviation, or against that of the others. */
static double studentized(const strum_identify *f, double residual, double h)
{
    const fit *best = &f->fits[0];
    const int dof = f->summary.degrees_of_freedom;
    const double room = 1 - h;
    if (room < 1e-9)
        return NAN;
    if (f->p.weighted)
        return residual / sqrt(room);
    const double others = (best->chi2 - residual * residual / room) / (dof - 1);
    return dof > 1 && others > 1e-24 * sum_of_squares(&f->p) ? residual / sqrt(others * room)
                                                             : NAN;
}

/* The tension of the fit without datum i; NAN where there is none. */
static strum_status without(problem *less, const fit *best, size_t i, fit *other,
                            double *tension)
{
    strum_status status = STRUM_OK;
    *tension = NAN;
    less->skip[i] = true;
    if (less->unknown[TENSION] && problem_rows(less) >= best->unknowns &&
        problem_data(less) > 0) {
        fit_start(other, best);
        status = fit_chi2(less, other);
        if (status == STRUM_OK)
            *tension = other->at.q[TENSION];
    }
    less->skip[i] = false;
    return status == STRUM_ERR_ACCURACY ? STRUM_OK : status;
}

static void find_outlier(strum_identify *f)
{
    strum_identify_summary *s = &f->summary;
    const double n = (double)problem_data(&f->p);
    const double tail = 1 - 0.5 * OUTLIER_LEVEL / n;
    const int dof = s->degrees_of_freedom;
    const double most = f->p.weighted ? gsl_cdf_ugaussian_Pinv(tail)
                        : dof > 1     ? gsl_cdf_tdist_Pinv(tail, dof - 1)
                                      : HUGE_VAL;
    double largest = most;
    s->outlier = STRUM_NO_INDEX;
    for (size_t i = 0; i < f->mode_count; i++)
        if (!f->modes[i].excluded && fabs(f->modes[i].studentized) > largest) {
            largest = fabs(f->modes[i].studentized);
            s->outlier = i;
        }
    s->outlier_tension =
        s->outlier == STRUM_NO_INDEX ? NAN : f->modes[s->outlier].tension_without;
}

static void report_datum(strum_identify *f, size_t i, size_t row, strum_identify_mode *m)
{
    const fit *best = &f->fits[0];
    const problem *p = &f->p;
    const prediction *o = &best->predictions[i];
    m->excluded = p->skip[i];
    m->mode = p->modes[i];
    m->measured = p->measured[i];
    m->computed = o->value;
    m->residual = m->measured - m->computed;
    m->leverage = p->skip[i] ? NAN : leverage(f, row);
    m->studentized = p->skip[i] ? NAN : studentized(f, best->residuals[row], m->leverage);
    m->share_tension = o->tension;
    m->share_bending = o->bending;
    m->share_ends = o->ends;
    m->share_sag = o->sag;
    m->measured_ratio = m->computed_ratio = m->string_rule = m->tension_without = NAN;
    if (p->chain == NULL && i < p->ratios_at)
        m->string_rule =
            state_mass(p, &best->at) * pow(2 * best->at.q[LENGTH] * m->measured / m->mode, 2);
}

strum_status report_modes(strum_identify *f, const strum_identify_params *params)
{
    fit *best = &f->fits[0], *other = calloc(1, sizeof *other);
    problem less = f->p;
    size_t row = 0;
    /* also of what was left out of the fit */
    memset(less.skip, 0, sizeof less.skip);
    strum_status status =
        other == NULL ? STRUM_ERR_MEMORY : model_predict(&less, &best->at, best->predictions);
    memcpy(less.skip, f->p.skip, sizeof less.skip);
    f->mode_count = params->count;
    for (size_t i = 0; i < f->p.count && status == STRUM_OK; i++) {
        strum_identify_mode *m = &f->modes[i % params->count];
        if (i < params->count) {
            report_datum(f, i, row, m);
            if (!m->excluded)
                status = without(&less, best, i, other, &m->tension_without);
        }
        if (i >= f->p.ratios_at) {
            m->measured_ratio = f->p.measured[i];
            m->computed_ratio = best->predictions[i].value;
        }
        row += !f->p.skip[i];
    }
    free(other);
    if (status == STRUM_OK)
        find_outlier(f);
    return status;
}
