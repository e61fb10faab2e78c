/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is said about a fit beside the fit: intervals, what the data cannot tell, which datum
 * disagrees, other numbers of modes. */
#ifndef CORE_IDENTIFY_REPORT_H
#define CORE_IDENTIFY_REPORT_H

#include "core/identify/problem.h"

struct strum_identify {
    problem p;
    fit fits[STRUM_IDENTIFY_SOLUTIONS_MAX]; /* the best first */
    size_t fit_count, solution_count;
    double confidence;
    strum_identify_estimate estimates[QUANTITIES];
    strum_identify_summary summary;
    strum_identify_mode modes[STRUM_IDENTIFY_FREQUENCIES_MAX];
    size_t mode_count;
    strum_identify_solution solutions[STRUM_IDENTIFY_SOLUTIONS_MAX];
    strum_identify_reading readings[STRUM_IDENTIFY_READINGS_MAX];
    size_t reading_count;
    bool ambiguous, by_price;
    double assumed_deviation;
    double variance; /* of the residuals, 1 where weighted; NAN */
    double covariance[UNKNOWNS_MAX]
                     [UNKNOWNS_MAX]; /* of unit variance; in the summary's order */
    bool regular[UNKNOWNS_MAX];      /* has an entry there */
};

/* Singular values, covariance, correlation. STRUM_ERR_IMPOSSIBLE where unknowns cannot be told
 * apart. */
strum_status report_identifiability(strum_identify *f, strum_error *error);
/* Solutions that fit as well, and estimates with intervals. */
strum_status report_estimates(strum_identify *f);
/* Each datum: residuals, leverage, the tension without it. */
strum_status report_modes(strum_identify *f, const strum_identify_params *params);
/* The tension with both ends pinned, and clamped; numbers of modes shifted. */
strum_status report_alternatives(strum_identify *f);

/* Tries all numbers of modes, takes the best into f->p.modes. */
strum_status assign_modes(strum_identify *f, const strum_identify_params *params,
                          strum_error *error);
double assign_count(const strum_identify_params *params);

extern const char *const quantity_names[QUANTITIES];

#endif
