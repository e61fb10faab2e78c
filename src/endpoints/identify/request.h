/* SPDX-License-Identifier: GPL-3.0-or-later */
/* /v1/identify/tension, the request: its fields and what follows from them. */
#ifndef ENDPOINTS_IDENTIFY_REQUEST_H
#define ENDPOINTS_IDENTIFY_REQUEST_H

#include <strum/identify.h>

#include "endpoints/common/chain.h"
#include "endpoints/endpoint.h"

typedef struct identify_end {
    field_set given;
    int rotation;
    double rotational_stiffness_N_m_per_rad, fixity, fixity_standard_deviation;
} identify_end;

typedef struct identify_request {
    chain_input in; /* tension, components, their ends */
    numbers_value frequencies_Hz, periods_s;
    double pulse_time_s;
    int64_t pulses;
    numbers_value frequency_standard_deviations_Hz;
    double frequency_standard_deviation_Hz;
    numbers_value mode_numbers;
    int64_t first_mode_at_most, missing_modes_at_most;
    numbers_value damping_ratios, damping_ratio_standard_deviations;
    double damper_position_m;
    double length_m, mass_kg_per_m, added_mass_kg_per_m, bending_stiffness_N_m2;
    double axial_stiffness_N, weight_N_per_m, inclination_deg;
    double tension_relative_standard_deviation, length_relative_standard_deviation;
    double mass_relative_standard_deviation, bending_stiffness_relative_standard_deviation;
    double axial_stiffness_relative_standard_deviation;
    int plane;
    identify_end end_1, end_2, ends;
    choices_value unknowns;
    double confidence;
    bool exclude_outlier, compare, verify;

    strum_identify_params params; /* made by prepare; its lists are the arena's */
    chain_parts parts;
} identify_request;

extern const schema identify_schema;
/* By strum_identify_quantity: the words of `unknowns`, and the fields. */
extern const char *const identify_unknowns[], *const identify_fields[];

bool identify_asks(const identify_request *r, strum_identify_quantity q);
void identify_prepare(void *data, schema_arena *arena, problem *p);
double identify_cost_us(const void *data);

#endif
