/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A request for an absorber, read and prepared. */
#ifndef ENDPOINTS_ABSORBER_REQUEST_H
#define ENDPOINTS_ABSORBER_REQUEST_H

#include <strum/absorber.h>

#include "endpoints/common/chain.h"
#include "endpoints/common/frequency.h"

typedef struct absorber_variable {
    field_set given;
    name_value name;
    double min, max;
} absorber_variable;

typedef struct absorber_required {
    field_set given;
    double strouhal, reduced_damping, diameter_m, fluid_kg_per_m3;
} absorber_required;

typedef struct absorber_sweep {
    field_set given;
    name_value variable;
    int64_t points;
} absorber_sweep;

typedef struct absorber_request {
    chain_input in;
    objects_value variables; /* of absorber_variable */
    numbers_value modes, current_m_per_s;
    band_input asked_band;
    bool assess;
    int objective;
    absorber_required required;
    absorber_sweep sweep;
    int64_t max_evaluations;
    double time_limit_s;

    /* computed by prepare */
    long *mode_numbers;
    double band[2];
    name_value names[STRUM_ABSORBER_VARIABLES_MAX];
    double low[STRUM_ABSORBER_VARIABLES_MAX], high[STRUM_ABSORBER_VARIABLES_MAX];
} absorber_request;

extern const schema absorber_schema;

void absorber_prepare(void *request, schema_arena *arena, problem *p);
double absorber_cost_us(const void *request);
double absorber_solve_bytes(const void *request);
/* Index of a declared variable (the first of that name), or -1. */
int absorber_variable_index(const absorber_request *r, const char *name);

#endif
