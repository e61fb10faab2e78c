/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A request for the modes of an inclined cable, read and prepared (request.c), as the answer
 * (answer.c) takes it. */
#ifndef ENDPOINTS_INCLINED_REQUEST_H
#define ENDPOINTS_INCLINED_REQUEST_H

#include <strum/inclined.h>

#include "endpoints/common/round.h"
#include "endpoints/endpoint.h"

#define INCLINED_GRAVITY 9.80665

/* The field `plane`; without it the modes in the plane. */
enum { INCLINED_IN_PLANE, INCLINED_OUT_OF_PLANE, INCLINED_BOTH };

/* The field `model`. */
enum { FULL, AIRY, ASYMPTOTIC, IRVINE, MODELS };

typedef struct inclined_request {
    field_set given;
    double epsilon, mass_ratio, inclination_deg, lambda_squared;
    double length_m, mass_kg_per_m, added_mass_kg_per_m, weight_N_per_m;
    double tension_N, horizontal_tension_N, axial_stiffness_N;
    round_input round;
    double span_m, rise_m, stretched_length_m, tension_end_1_N, tension_end_2_N;
    double tension_parallel_to_chord_N, catenary_parameter_m;
    double sag_mid_m, sag_max_m, depth_below_end_1_m;
    bool inextensible, compare, verify;
    int branch, plane, statics, model, airy_expansion;
    int64_t modes, shape_points;

    /* from here on: computed by prepare */
    strum_inclined_cable cable;
    strum_inclined_statics at_rest;
    double tension;        /* T_a in N; 0 for a dimensionless request */
    double rad_per_s;      /* of kL = 1; 0 for a dimensionless request */
    int solutions;         /* of a cable by its span and a figure; else 0 */
    double other_length_m; /* unstretched length of the other one */
} inclined_request;

extern const schema inclined_schema;
/* Names of the models, in the order of the enumeration. */
extern const char *const inclined_models[];

void inclined_prepare(void *request, schema_arena *arena, problem *p);
double inclined_cost_us(const void *request);
double inclined_answer_bytes(const void *request, const char **pointer);
/* With span_m: inclination, unstretched length and tension from supports and figure. */
void inclined_span(inclined_request *r, problem *p);
/* Pointer to the field that tells how the cable hangs. */
const char *inclined_figure_pointer(const inclined_request *r);
/* Estimated microseconds of the modes out of the plane. */
double inclined_out_of_plane_us(const inclined_request *r);
/* What the library is asked for one of the models; refers to `r`. */
strum_inclined_params inclined_params(const inclined_request *r, int model);

#endif
