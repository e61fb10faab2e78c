/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A request for the modes of an inclined cable, read and prepared (request.c), as the answer
 * (answer.c) takes it. */
#ifndef ENDPOINTS_INCLINED_REQUEST_H
#define ENDPOINTS_INCLINED_REQUEST_H

#include <strum/inclined.h>

#include "endpoints/endpoint.h"

#define INCLINED_GRAVITY 9.80665

/* The field `model`. */
enum { FULL, AIRY, ASYMPTOTIC, IRVINE, MODELS };

typedef struct inclined_request {
    field_set given;
    double epsilon, mass_ratio, inclination_deg, lambda_squared;
    double length_m, mass_kg_per_m, added_mass_kg_per_m, weight_N_per_m;
    double tension_N, horizontal_tension_N, axial_stiffness_N;
    bool inextensible, compare, verify;
    int statics, model, airy_expansion;
    int64_t modes, shape_points;

    /* from here on: computed by prepare */
    strum_inclined_cable cable;
    strum_inclined_statics at_rest;
    double tension;   /* T_a in N; 0 for a dimensionless request */
    double rad_per_s; /* of kL = 1; 0 for a dimensionless request */
} inclined_request;

extern const schema inclined_schema;
/* Names of the models, in the order of the enumeration. */
extern const char *const inclined_models[];

void inclined_prepare(void *request, schema_arena *arena, problem *p);
double inclined_cost_us(const void *request);
double inclined_answer_bytes(const void *request, const char **pointer);
/* What the library is asked for one of the models; refers to `r`. */
strum_inclined_params inclined_params(const inclined_request *r, int model);

#endif
