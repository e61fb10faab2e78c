/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Gale's own method for the natural frequencies of a suspended cable (Vibrations of Suspended
 * Cables, 1976, section II.4.2): power series about xi = 0 and xi = 2, matched, and the zeros
 * of the boundary determinant. It holds for inextensible cables without damping whose ends lie
 * within |xi| < 4, and for as many modes as the cancellation inside a power series leaves the
 * digits of; strum_modes_solve has no such limits. It shares nothing with the Galerkin methods.
 */
#ifndef STRUM_SERIES_H
#define STRUM_SERIES_H

#include <strum/modes.h>

STRUM_BEGIN_DECLS

/* How an answer was found. */
typedef struct strum_series_report {
    int terms;          /* most terms a series took */
    double matching_xi; /* |xi| at which the series are matched; 0: one of them reached both
                           ends */
    int mantissa_bits;  /* of the arithmetic that the last digit needed: 64 or 113 */
    int evaluations;    /* of the series: determinants and counts */
    double error;       /* largest estimated relative error of a frequency */
} strum_series_report;

/* STRUM_OK, or why this cable is outside the method. */
strum_status strum_series_applies(const strum_cable *cable, strum_plane plane,
                                  strum_error *fault);

/* The first `count` modes (by the exact count of Wittrick and Williams: none is missed), each
 * right to 1e-12 by its own estimate; STRUM_ERR_ACCURACY with the reason where the series
 * cannot give that. `thorough` false keeps to 64 bit arithmetic, which is some twenty times
 * faster. `modes` has room for `count`. */
strum_status strum_series_solve(const strum_cable *cable, strum_plane plane, int count,
                                bool thorough, strum_mode *modes, strum_series_report *report,
                                strum_error *fault);

/* Estimated time of strum_series_solve in microseconds, without solving anything; 0 where the
 * method does not apply. */
double strum_series_work(const strum_cable *cable, strum_plane plane, int count, bool thorough);

STRUM_END_DECLS
#endif
