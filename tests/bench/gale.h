/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Gale's program of 1976 in C, to be measured against: the algorithm of his appendix B-1
 * (in-plane frequencies), step by step, without the faults of its print. libstrum's own series
 * method (src/core/suspended/series/series.c) is something else: it adapts, counts and estimates.
 */
#ifndef TESTS_BENCH_GALE_H
#define TESTS_BENCH_GALE_H

typedef struct gale_cable {
    double xi_1, xi_2; /* ends */
    double match;      /* his matching point, 0.7 */
    int terms;         /* his N, 80 */
    int determinants;  /* counted: how many were evaluated */
} gale_cable;

/* D(omega)  [2.74]. */
double gale_determinant(gale_cable *cable, double omega);

/* His iteration: Newton's method with the slope over +-0.025 % of omega, stopped when the
 * determinant changes its sign within that interval. */
double gale_frequency(gale_cable *cable, double guess);

/* At equal knowledge and accuracy: no guesses. The determinant is scanned for changes of sign
 * in steps of `step` and each root refined by Newton's method with a slope by difference until
 * it stands to `tolerance`. Returns how many of `count` were found below `highest`. */
int gale_scan(gale_cable *cable, double step, double highest, double tolerance, int count,
              double *omega);

#endif
