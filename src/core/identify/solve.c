/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/identify/report.h"

#include <stdlib.h>
#include <string.h>

static strum_status range(strum_error *error, int argument, size_t index, const char *what)
{
    return error_at(error, STRUM_ERR_RANGE, argument, index, "%s", what);
}

static bool positive(double x)
{
    return x > 0 && isfinite(x);
}

static strum_status check_data(const strum_identify_params *p, strum_error *error)
{
    if (p->count < 1 || p->count > STRUM_IDENTIFY_FREQUENCIES_MAX ||
        (p->frequencies == NULL && p->damping_ratios == NULL))
        return range(error, STRUM_IDENTIFY_ARG_FREQUENCIES, STRUM_NO_INDEX,
                     "1 to 100 frequencies or damping ratios");
    if (p->modes == NULL && (p->frequencies == NULL || p->damping_ratios != NULL))
        return range(error, STRUM_IDENTIFY_ARG_MODES, STRUM_NO_INDEX,
                     "damping ratios need the numbers of their modes");
    if (p->modes == NULL && (p->first_mode_max < 1 || p->first_mode_max > 100 ||
                             p->missing_max < 0 || p->missing_max > 100))
        return range(error, STRUM_IDENTIFY_ARG_ASSIGNMENT, STRUM_NO_INDEX,
                     "first mode 1 to 100, missing modes 0 to 100");
    for (size_t i = 0; i < p->count; i++) {
        if (p->frequencies != NULL && !(positive(p->frequencies[i]) &&
                                        (i == 0 || p->frequencies[i - 1] < p->frequencies[i])))
            return range(error, STRUM_IDENTIFY_ARG_FREQUENCIES, i,
                         "frequencies are above 0 and ascend");
        if (p->standard_deviations != NULL && !positive(p->standard_deviations[i]))
            return range(error, STRUM_IDENTIFY_ARG_STANDARD_DEVIATIONS, i,
                         "standard deviations are above 0");
        if (p->modes != NULL && !(p->modes[i] >= 1 && p->modes[i] <= STRUM_IDENTIFY_MODE_MAX &&
                                  (i == 0 || p->modes[i - 1] < p->modes[i])))
            return range(error, STRUM_IDENTIFY_ARG_MODES, i,
                         "mode numbers are 1 to 1000 and increase");
        if (p->damping_ratios != NULL &&
            !(p->damping_ratios[i] > 0 && p->damping_ratios[i] < 1))
            return range(error, STRUM_IDENTIFY_ARG_DAMPING_RATIOS, i,
                         "damping ratios are between 0 and 1");
        if (p->damping_standard_deviations != NULL &&
            !positive(p->damping_standard_deviations[i]))
            return range(error, STRUM_IDENTIFY_ARG_DAMPING_RATIOS, i,
                         "standard deviations are above 0");
    }
    return STRUM_OK;
}

/* Standard deviations of all data or of none: a mixture has no common scale. */
static bool weighted(const strum_identify_params *p)
{
    return (p->frequencies == NULL || p->standard_deviations != NULL) &&
           (p->damping_ratios == NULL || p->damping_standard_deviations != NULL);
}

static bool with_bending(const strum_identify_params *p)
{
    const strum_identify_value *ei = &p->quantities[BENDING];
    return ei->unknown || ei->value > 0;
}

static strum_status check_quantity(const strum_identify_params *p, int q, strum_error *error)
{
    const strum_identify_value *v = &p->quantities[q];
    const bool chain = p->components != NULL;
    const bool needed = q == TENSION || ((q == LENGTH || q == MASS) && !chain) ||
                        (q == AXIAL && p->sag) || (q == DAMPING && p->damping_ratios != NULL);
    if (v->standard_deviation < 0 || !isfinite(v->standard_deviation))
        return range(error, STRUM_IDENTIFY_ARG_QUANTITIES, (size_t)q,
                     "a standard deviation is not negative");
    if (v->standard_deviation > 0 && !weighted(p))
        return range(error, STRUM_IDENTIFY_ARG_STANDARD_DEVIATIONS, STRUM_NO_INDEX,
                     "what is known of a quantity counts against the frequencies only if these "
                     "have standard deviations");
    if (v->unknown && chain && q != TENSION)
        return range(error, STRUM_IDENTIFY_ARG_QUANTITIES, (size_t)q,
                     "of a chain only the tension can be unknown");
    const bool read = !v->unknown || v->standard_deviation > 0;
    if (read && needed && !positive(v->value))
        return range(error, STRUM_IDENTIFY_ARG_QUANTITIES, (size_t)q,
                     "a quantity of the cable is missing or not above 0");
    if (q == BENDING && read && !(v->value >= 0 && isfinite(v->value)))
        return range(error, STRUM_IDENTIFY_ARG_QUANTITIES, (size_t)q,
                     "a bending stiffness is not negative");
    if (q == BENDING && v->unknown && v->standard_deviation > 0 && !(v->value > 0))
        return range(error, STRUM_IDENTIFY_ARG_QUANTITIES, (size_t)q,
                     "with a standard deviation EI is above 0");
    if (q == FIXITY && v->standard_deviation > 0 && !(v->value >= 0 && v->value <= 1))
        return range(error, STRUM_IDENTIFY_ARG_QUANTITIES, (size_t)q,
                     "a fixity is between 0 and 1");
    return STRUM_OK;
}

static strum_status check_ends(const strum_identify_params *p, strum_error *error)
{
    bool unknown = false;
    for (size_t i = 0; i < 2; i++) {
        const strum_identify_end *e = &p->ends[i];
        unknown = unknown || e->kind == STRUM_IDENTIFY_UNKNOWN_FIXITY;
        if (e->kind == STRUM_IDENTIFY_FIXED_FIXITY && !(e->value >= 0 && e->value <= 1))
            return range(error, STRUM_IDENTIFY_ARG_ENDS, i, "a fixity is between 0 and 1");
        if (e->kind == STRUM_IDENTIFY_STIFFNESS && !(e->value >= 0 && isfinite(e->value)))
            return range(error, STRUM_IDENTIFY_ARG_ENDS, i,
                         "a rotational stiffness is not negative");
    }
    if (p->quantities[FIXITY].unknown && !with_bending(p))
        return error_at(error, STRUM_ERR_IMPOSSIBLE, STRUM_IDENTIFY_ARG_UNKNOWNS, FIXITY,
                        "a string has no fixity: with bending stiffness 0 the ends' rotation "
                        "moves no frequency");
    if (p->quantities[FIXITY].unknown != unknown)
        return range(
            error, STRUM_IDENTIFY_ARG_ENDS, STRUM_NO_INDEX,
            "the fixity is unknown where, and only where, an end is elastic without a number");
    return STRUM_OK;
}

static strum_status check_models(const strum_identify_params *p, strum_error *error)
{
    if (p->sag && !(p->weight >= 0 && isfinite(p->weight) && fabs(p->inclination) < M_PI / 2))
        return range(error, STRUM_IDENTIFY_ARG_QUANTITIES, AXIAL,
                     "weight not negative, inclination below 90 degrees");
    if (!p->sag && p->quantities[AXIAL].unknown)
        return error_at(error, STRUM_ERR_IMPOSSIBLE, STRUM_IDENTIFY_ARG_UNKNOWNS, AXIAL,
                        "the axial stiffness does not act out of plane: only the sag in plane "
                        "stretches the cable");
    if (p->quantities[DAMPING].unknown && p->damping_ratios == NULL)
        return error_at(error, STRUM_ERR_IMPOSSIBLE, STRUM_IDENTIFY_ARG_UNKNOWNS, DAMPING,
                        "a damper is known by damping ratios only");
    if (p->damping_ratios != NULL) {
        const strum_identify_value *q = p->quantities;
        if (p->components != NULL || p->sag || q[BENDING].unknown || q[BENDING].value > 0 ||
            q[LENGTH].unknown)
            return range(error, STRUM_IDENTIFY_ARG_DAMPING_RATIOS, STRUM_NO_INDEX,
                         "damping ratios go with a string of known length, without bending, "
                         "sag or components");
        if (!(p->damper_position > 0 && p->damper_position < q[LENGTH].value))
            return range(error, STRUM_IDENTIFY_ARG_DAMPER_POSITION, STRUM_NO_INDEX,
                         "the damper lies between the ends");
    }
    if (p->components != NULL && !positive(p->reference_tension))
        return range(error, STRUM_IDENTIFY_ARG_COMPONENTS, STRUM_NO_INDEX,
                     "the reference tension is above 0");
    return STRUM_OK;
}

static strum_status check(const strum_identify_params *p, strum_error *error)
{
    strum_status status = check_data(p, error);
    for (int q = 0; q < QUANTITIES && status == STRUM_OK; q++)
        status = check_quantity(p, q, error);
    if (status == STRUM_OK)
        status = check_models(p, error);
    if (status == STRUM_OK)
        status = check_ends(p, error);
    if (status == STRUM_OK && !(p->confidence >= 0.5 && p->confidence <= 0.9999))
        status = range(error, 0, STRUM_NO_INDEX, "a confidence is between 0.5 and 0.9999");
    if (status != STRUM_OK)
        return status;
    size_t unknowns = 0, rows = (p->frequencies != NULL ? p->count : 0) +
                                (p->damping_ratios != NULL ? p->count : 0);
    for (int q = 0; q < QUANTITIES; q++) {
        unknowns += p->quantities[q].unknown;
        rows += p->quantities[q].unknown && p->quantities[q].standard_deviation > 0;
    }
    if (unknowns < 1 || unknowns > UNKNOWNS_MAX)
        return range(error, STRUM_IDENTIFY_ARG_UNKNOWNS, STRUM_NO_INDEX, "1 to 4 unknowns");
    if (rows < unknowns)
        return error_at(error, STRUM_ERR_IMPOSSIBLE, STRUM_IDENTIFY_ARG_UNKNOWNS,
                        STRUM_NO_INDEX,
                        "%zu unknowns need at least as many frequencies, or standard "
                        "deviations of what is known; "
                        "there are %zu",
                        unknowns, rows);
    return STRUM_OK;
}

static void set_data(problem *p, const strum_identify_params *params)
{
    const size_t n = params->count;
    if (params->frequencies != NULL) {
        memcpy(p->measured, params->frequencies, n * sizeof *p->measured);
        p->count = n;
    }
    p->ratios_at = p->count;
    if (params->damping_ratios != NULL) {
        memcpy(p->measured + p->count, params->damping_ratios, n * sizeof *p->measured);
        p->count += n;
    }
    for (size_t i = 0; i < p->count; i++) {
        const double *sd = i < p->ratios_at ? params->standard_deviations
                                            : params->damping_standard_deviations;
        p->modes[i] = params->modes != NULL ? params->modes[i % n] : (int)i + 1;
        p->deviation[i] = p->weighted ? sd[i % n] : 1;
    }
}

static void set_problem(problem *p, const strum_identify_params *params)
{
    p->weighted = weighted(params);
    set_data(p, params);
    for (int q = 0; q < QUANTITIES; q++) {
        const strum_identify_value *v = &params->quantities[q];
        p->unknown[q] = v->unknown;
        p->value[q] = v->value;
        if (v->unknown && v->standard_deviation > 0) {
            p->prior_value[q] = v->value;
            p->prior[q] = v->standard_deviation;
        }
    }
    p->added_mass = params->added_mass;
    p->sag = params->sag && params->weight > 0;
    p->weight = params->weight * cos(params->inclination);
    memcpy(p->ends, params->ends, sizeof p->ends);
    p->chain = params->components != NULL ? params : NULL;
    if (p->chain != NULL) {
        p->value[LENGTH] = p->value[MASS] = 1; /* not used */
        p->value[BENDING] = 0;
    }
    p->damper_position = params->damper_position;
}

/* A lone damping ratio above the largest that any damper gives. */
static strum_status check_damper(const problem *p, strum_error *error)
{
    const size_t i = p->ratios_at;
    double most, r;
    if (p->count != 1 || i != 0 || !p->unknown[DAMPING])
        return STRUM_OK;
    const double mass = p->value[MASS] + p->added_mass;
    if (!damper_best(p->modes[0], p->damper_position / p->value[LENGTH], &most, &r) ||
        p->measured[0] <= most)
        return STRUM_OK;
    return error_at(
        error, STRUM_ERR_IMPOSSIBLE, STRUM_IDENTIFY_ARG_DAMPING_RATIOS, 0,
        "no damper at this place gives this damping ratio: the largest of mode %d is %.8g, "
        "at %.10g N s/m",
        p->modes[0], most, r * sqrt(p->value[TENSION] * mass));
}

/* All frequencies lie below those of the bending alone: no tension explains them. */
static strum_status check_compression(const strum_identify *f, strum_error *error)
{
    const problem *p = &f->p;
    const fit *best = &f->fits[0];
    if (p->chain != NULL || !p->unknown[TENSION] || p->unknown[BENDING] || best->at.u < 300)
        return STRUM_OK;
    state s = best->at;
    prediction out[DATA_MAX];
    s.q[TENSION] *= 1e-6;
    state_close(p, &s);
    const strum_status status = model_predict(p, &s, out);
    for (size_t i = 0; i < p->count && status == STRUM_OK; i++)
        if (p->skip[i] || p->measured[i] > out[i].value)
            return STRUM_OK;
    return status != STRUM_OK
               ? status
               : error_at(error, STRUM_ERR_IMPOSSIBLE, STRUM_IDENTIFY_ARG_FREQUENCIES, 0,
                          "this bending stiffness alone, without tension, gives higher "
                          "frequencies (%.6g Hz "
                          "for mode %d): the cable is compressed, or the stiffness, mass or "
                          "length is another",
                          out[0].value, p->modes[0]);
}

static strum_status find(strum_identify *f, strum_error *error)
{
    strum_status status = scan_minima(&f->p, f->fits, &f->fit_count, &f->summary.local_minima);
    if (status == STRUM_OK)
        status = check_compression(f, error);
    if (status == STRUM_OK)
        status = report_identifiability(f, error);
    if (status == STRUM_OK)
        status = report_estimates(f);
    return status;
}

/* Figures that are no doubles, of cables that are no cables. */
static strum_status check_finite(const strum_identify *f, const strum_identify_params *params,
                                 strum_error *error)
{
    const state *s = &f->fits[0].at;
    bool good = isfinite(f->summary.chi_squared);
    for (int q = 0; q < QUANTITIES; q++)
        good = good && isfinite(s->q[q]) &&
               (s->q[q] > 0 || !f->p.unknown[q] || q == BENDING || q == FIXITY);
    for (size_t i = 0; i < params->count; i++)
        good = good && isfinite(f->modes[i].computed) && !isinf(f->modes[i].string_rule) &&
               isfinite(f->modes[i].residual);
    for (size_t i = 0; i < f->summary.unknowns; i++)
        for (size_t j = 0; j < f->summary.unknowns; j++)
            good = good && isfinite(f->summary.singular_values[i]) &&
                   isfinite(f->summary.weakest[i]) && isfinite(f->summary.correlation[i][j]);
    return good ? STRUM_OK
                : error_at(error, STRUM_ERR_IMPOSSIBLE, STRUM_IDENTIFY_ARG_UNKNOWNS,
                           STRUM_NO_INDEX,
                           "figures beyond a double: no such cable fits these frequencies");
}

static strum_status identify(strum_identify *f, const strum_identify_params *params,
                             strum_error *error)
{
    strum_status status = check_damper(&f->p, error);
    if (status == STRUM_OK && params->modes == NULL)
        status = assign_modes(f, params, error);
    if (status == STRUM_OK && f->p.chain != NULL)
        status = model_prepare_chain(&f->p, error);
    if (status == STRUM_OK)
        status = find(f, error);
    if (status == STRUM_OK)
        status = report_modes(f, params);
    const size_t outlier = f->summary.outlier;
    if (status == STRUM_OK && params->exclude_outlier && outlier != STRUM_NO_INDEX &&
        problem_rows(&f->p) > f->summary.unknowns) {
        f->p.skip[outlier] = true;
        status = find(f, error);
        if (status == STRUM_OK)
            status = report_modes(f, params);
    }
    if (status == STRUM_OK)
        status = report_alternatives(f);
    if (status == STRUM_OK)
        status = check_finite(f, params, error);
    return status;
}

strum_status strum_identify_solve(const strum_identify_params *params,
                                  const strum_options *options, strum_identify **found,
                                  strum_error *error)
{
    *found = NULL;
    work w = work_begin(options);
    strum_status status = check(params, error);
    if (status != STRUM_OK)
        return status;
    strum_identify *f = calloc(1, sizeof *f);
    if (f == NULL)
        return error_set(error, STRUM_ERR_MEMORY, "%s", strum_status_text(STRUM_ERR_MEMORY));
    if (error != NULL)
        *error = (strum_error){.status = STRUM_OK, .index = STRUM_NO_INDEX};
    f->p.work = &w;
    f->confidence = params->confidence;
    f->assumed_deviation = NAN;
    f->summary.outlier = STRUM_NO_INDEX;
    set_problem(&f->p, params);
    status = identify(f, params, error);
    f->p.work = NULL;
    f->p.chain = NULL; /* the caller's */
    if (status == STRUM_OK) {
        *found = f;
        return STRUM_OK;
    }
    strum_identify_free(f);
    if (error != NULL && error->status == status)
        return status; /* said */
    return status == STRUM_ERR_ACCURACY
               ? error_set(error, status, "no fit was found from any start")
               : work_result(&w, status, error);
}

double strum_identify_work(const strum_identify_params *p)
{
    double unknowns = 0;
    for (int q = 0; q < QUANTITIES; q++)
        unknowns += p->quantities[q].unknown;
    const double n = (double)p->count, mode = p->sag ? 5.0 : 0.5;
    const double scans = p->quantities[FIXITY].unknown ? 5 : 1;
    double us = 30 + n * mode * (60 * scans + 120 * unknowns) + n * n * 6 * mode;
    if (p->components != NULL)
        us += n * (double)p->component_count * 200;
    if (p->damping_ratios != NULL)
        us += 3000 + n * 1500;
    if (p->modes == NULL)
        us += assign_count(p) * n *
                  (p->quantities[BENDING].value == 0 && !p->quantities[BENDING].unknown ? 0.1
                                                                                        : 2.0) +
              n * mode * 600 * scans;
    return us;
}

void strum_identify_free(strum_identify *found)
{
    free(found);
}

/* ---- what was found ---- */

const strum_identify_estimate *strum_identify_estimate_of(const strum_identify *found,
                                                          strum_identify_quantity quantity)
{
    return &found->estimates[quantity];
}

size_t strum_identify_count(const strum_identify *found)
{
    return found->mode_count;
}

strum_status strum_identify_get(const strum_identify *found, size_t i,
                                strum_identify_mode *mode)
{
    if (i >= found->mode_count)
        return STRUM_ERR_RANGE;
    *mode = found->modes[i];
    return STRUM_OK;
}

const strum_identify_summary *strum_identify_summary_of(const strum_identify *found)
{
    return &found->summary;
}

size_t strum_identify_solutions(const strum_identify *found,
                                const strum_identify_solution **solutions)
{
    *solutions = found->solutions;
    return found->solution_count;
}

size_t strum_identify_readings(const strum_identify *found,
                               const strum_identify_reading **readings, bool *ambiguous,
                               bool *by_price, double *assumed_deviation)
{
    *readings = found->readings;
    *ambiguous = found->ambiguous;
    *by_price = found->by_price;
    *assumed_deviation = found->assumed_deviation;
    return found->reading_count;
}
