/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Gale's own method for the natural frequencies of a suspended cable (Vibrations of Suspended
 * Cables, 1976, section II.4.2): power series about xi = 0 and xi = 2, matched, and the zeros
 * of the boundary determinant. It holds for inextensible cables without damping whose ends lie
 * within |xi| < 4, and for as many modes as the cancellation inside a power series leaves the
 * digits of; strum_modes_solve has no such limits. It shares nothing with the Galerkin methods.
 *
 * Units are those of catenary.h: a frequency in rad/s is mode.frequency sqrt(g/a).
 *
 *     strum_series_params params = STRUM_SERIES_PARAMS_INIT;
 *     strum_mode modes[6];
 *     strum_series_report report;
 *     strum_error error;
 *     params.cable.chi_m = catenary.chi_m;
 *     params.cable.mu = catenary.mu;
 *     params.count = 6;
 *     if (strum_series_solve(&params, NULL, modes, &report, &error) == STRUM_OK)
 *         printf("%g by %d terms\n", modes[0].frequency, report.terms);
 *
 * Ownership: everything is the caller's; nothing is to be freed. All functions are re-entrant.
 */
#ifndef STRUM_SERIES_H
#define STRUM_SERIES_H

#include <strum/modes.h>

STRUM_BEGIN_DECLS

/* strum_error.argument of the functions here: the parameter at fault. */
typedef enum strum_series_argument {
    STRUM_SERIES_ARG_CABLE = 1, /* outside the method, or more terms than can be had */
    STRUM_SERIES_ARG_COUNT
} strum_series_argument;

typedef struct strum_series_params {
    strum_cable cable;
    strum_plane plane;
    int count;     /* modes from the lowest frequency: 1..STRUM_MODES_MAX */
    bool thorough; /* false keeps to 64 bit arithmetic, which is some twenty times faster */
} strum_series_params;

#define STRUM_SERIES_PARAMS_INIT                                                               \
    {                                                                                          \
        {0, 0, 0, 0, 1, 1, 0, 0}, STRUM_IN_PLANE, 6, true                                      \
    }

/* How an answer was found. */
typedef struct strum_series_report {
    int terms;          /* most terms a series took */
    double matching_xi; /* |xi| at which the series are matched; 0: one of them reached both
                           ends */
    int mantissa_bits;  /* of the arithmetic that the last digit needed: 64 or 113 */
    int evaluations;    /* of the series: determinants and counts */
    double error;       /* largest estimated relative error of a frequency */
} strum_series_report;

/* The first params->count modes (by the exact count of Wittrick and Williams: none is missed),
 * each right to 1e-12 by its own estimate; `modes` has room for them. STRUM_ERR_METHOD as of
 * strum_series_applies, STRUM_ERR_RANGE (the count), STRUM_ERR_ACCURACY where the series cannot
 * give those digits, STRUM_ERR_MEMORY; and what `options` (may be NULL) ends. After an error
 * `modes` holds nothing. */
strum_status strum_series_solve(const strum_series_params *params, const strum_options *options,
                                strum_mode *modes, strum_series_report *report,
                                strum_error *error);

/* STRUM_OK, or STRUM_ERR_METHOD with the reason why this cable is outside the method. */
strum_status strum_series_applies(const strum_cable *cable, strum_plane plane,
                                  strum_error *error);

/* Estimated time of strum_series_solve in microseconds, without solving anything; 0 where the
 * method does not apply. */
double strum_series_work(const strum_series_params *params);

STRUM_END_DECLS
#endif
