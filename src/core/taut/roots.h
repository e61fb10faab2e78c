/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The lists of roots that a solve gives out. */
#ifndef CORE_TAUT_ROOTS_H
#define CORE_TAUT_ROOTS_H

#include <strum/taut.h>

/* Appends one. */
strum_status taut_roots_add(strum_taut_roots *roots, strum_taut_root root, bool overdamped,
                            strum_error *fault);
/* Appends a mode without a root. */
strum_status taut_roots_miss(strum_taut_roots *roots, strum_taut_missing missing,
                             strum_error *fault);
/* Frequencies within this share of each other count as one. */
#define TAUT_TIE 1e-12
/* By frequency, then decay: the overdamped, and the others where `oscillating` says so. */
void taut_roots_sort(strum_taut_roots *roots, bool oscillating);

#endif
