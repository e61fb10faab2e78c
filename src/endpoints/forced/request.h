/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is asked of a forced motion. */
#ifndef ENDPOINTS_FORCED_REQUEST_H
#define ENDPOINTS_FORCED_REQUEST_H

#include <strum/forced.h>

#include "endpoints/common/frequency.h"
#include "endpoints/common/suspended_cable.h"

#define FORCED_HARMONICS_MAX 16

typedef struct forced_request {
    cable_input in;
    double tangential_displacement, normal_displacement, out_of_plane_displacement;
    double tangential_displacement_m, normal_displacement_m, out_of_plane_displacement_m;
    objects_value harmonics;
    numbers_value frequency_ratios, profiles_at, profile_chi;
    double frequency_ratio_min, frequency_ratio_max;
    frequencies_input frequencies, asked_profiles; /* other than by ratios */
    frequency_range_input range;
    int64_t points, profile_points;
    bool verify;

    /* computed by prepare */
    numbers_value listed;   /* frequency ratios, however they were given; else `curve_ends` */
    numbers_value profiles; /* frequency ratios */
    double curve_ends[2];
    strum_end_motion motions[FORCED_HARMONICS_MAX];
    int multiples[FORCED_HARMONICS_MAX], motion_count;
    double curve_min, curve_max; /* frequency ratios of the curve */
    double highest;              /* of the curve and the profiles, times the highest multiple */
    bool in_plane, out_of_plane;
} forced_request;

/* True when the motion is a sum of harmonics. */
static inline bool forced_periodic(const forced_request *r)
{
    return r->harmonics.count > 0;
}
/* The forcing frequencies of the curve, in sqrt(g/a). */
int forced_frequency_count(const forced_request *r);
double forced_frequency_at(const forced_request *r, int i);

/* The field that holds the highest frequency. */
const char *forced_highest_field(const forced_request *r);

/* Of the endpoint. */
extern const schema forced_request_schema;
void forced_prepare(void *request, schema_arena *arena, problem *p);
double forced_cost_us(const void *request);
double forced_solve_bytes(const void *request);
double forced_answer_bytes(const void *request, const char **pointer);

#endif
