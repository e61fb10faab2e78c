/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What stands beside the frequencies of a suspended cable: a second method's opinion, and the
 * handbook's. */
#ifndef ENDPOINTS_CATENARY_COMPARISON_H
#define ENDPOINTS_CATENARY_COMPARISON_H

#include <strum/series.h>

#include "endpoints/common/suspended_cable.h"

/* The answer for one plane. */
typedef struct plane_modes {
    int count; /* 0: this plane was not asked for */
    strum_mode modes[STRUM_MODES_MAX];
    strum_modes *spectrum; /* Galerkin method; NULL: by the series */
    strum_series_report series;
} plane_modes;

/* Cost of the series as a further method under `verify`, in microseconds; 0 where it does not
 * apply. */
double verification_series_work(const cable_input *in, strum_plane plane, int count);
/* "verification"; false with `p` set when the second method fails. */
bool write_verification(json_writer *json, const cable_input *in, const plane_modes found[2],
                        const answer *a);
/* "comparison". */
void write_comparison(json_writer *json, const cable_input *in, const plane_modes found[2]);

#endif
