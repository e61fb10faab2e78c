/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the suspended cable's endpoints share: its fields, its geometry, and the units of the
 * answer. */
#ifndef ENDPOINTS_COMMON_SUSPENDED_CABLE_H
#define ENDPOINTS_COMMON_SUSPENDED_CABLE_H

#include <strum/catenary.h>

#include "endpoints/common/members.h"
#include "endpoints/endpoint.h"

/* First member of a request struct, so that CABLE_FIELDS' offsets hold there too. */
typedef struct cable_input {
    field_set given;
    double rise_to_span, sag_parameter, xi_1, xi_2, chi_1, chi_2;
    double span_m, rise_m, length_m, unstretched_length_m;
    double gravity_m_per_s2, mass_kg_per_m, weight_N_per_m, added_mass_kg_per_m;
    double flexibility, axial_stiffness_N, eta_tangential, eta_normal;

    /* from here on: computed by cable_prepare */
    strum_catenary catenary;
    strum_cable cable;
    double a_m;       /* metres of the catenary parameter; 0 for a dimensionless request */
    double tension_N; /* horizontal tension; 0 when not known */
    double ratio;     /* frequency_ratio (in sqrt(g/a)) of the core's unit frequency */
    double rad_per_s; /* rad/s of frequency_ratio 1; 0 when not known */
} cable_input;

/* Least length, mass, weight, gravity and stiffness in their SI units: far below any cable's,
 * and quotients of two of them stay finite. */
#define CABLE_LEAST 1e-9

#define CABLE_FIELDS                                                                           \
    {FIELD_AT(FIELD_NUMBER, cable_input, rise_to_span),                                        \
     .unit = "1",                                                                              \
     .min = -1e4,                                                                              \
     .max = 1e4,                                                                               \
     .flags = FIELD_DEFAULT,                                                                   \
     .help = "h/b: height of end 2 above end 1 over the span"},                                \
        {FIELD_AT(FIELD_NUMBER, cable_input, sag_parameter),                                   \
         .unit = "1",                                                                          \
         .min = 0,                                                                             \
         .max = 1,                                                                             \
         .flags = FIELD_OPEN_MIN | FIELD_OPEN_MAX,                                             \
         .help = "b/sqrt(l^2 - h^2): near 1 for a taut cable, near 0 for a deep one"},         \
        {FIELD_AT(FIELD_NUMBER, cable_input, xi_1), .unit = "1", .min = -1.3e5, .max = 1.3e5,  \
         .help = "xi of end 1: sgn(slope) (1/cos(slope angle) - 1)"},                          \
        {FIELD_AT(FIELD_NUMBER, cable_input, xi_2), .unit = "1", .min = -1.3e5, .max = 1.3e5,  \
         .help = "xi of end 2, above xi_1"},                                                   \
        {FIELD_AT(FIELD_NUMBER, cable_input, chi_1), .unit = "1", .min = -STRUM_CHI_MAX,       \
         .max = STRUM_CHI_MAX, .help = "x/a of end 1: asinh of the slope there"},              \
        {FIELD_AT(FIELD_NUMBER, cable_input, chi_2), .unit = "1", .min = -STRUM_CHI_MAX,       \
         .max = STRUM_CHI_MAX, .help = "x/a of end 2, above chi_1"},                           \
        {FIELD_AT(FIELD_NUMBER, cable_input, span_m), .unit = "m", .min = CABLE_LEAST,         \
         .max = 1e6, .help = "horizontal distance of the supports"},                           \
        {FIELD_AT(FIELD_NUMBER, cable_input, rise_m),                                          \
         .unit = "m",                                                                          \
         .min = -1e6,                                                                          \
         .max = 1e6,                                                                           \
         .flags = FIELD_DEFAULT,                                                               \
         .help = "height of end 2 above end 1"},                                               \
        {FIELD_AT(FIELD_NUMBER, cable_input, length_m), .unit = "m", .min = CABLE_LEAST,       \
         .max = 1e7, .help = "length of the hanging cable, longer than the chord"},            \
        {FIELD_AT(FIELD_NUMBER, cable_input, unstretched_length_m), .unit = "m",               \
         .min = CABLE_LEAST, .max = 1e7,                                                       \
         .help = "length without load: modes about the exact elastic catenary"},               \
        {FIELD_AT(FIELD_NUMBER, cable_input, gravity_m_per_s2),                                \
         .unit = "m/s^2",                                                                      \
         .min = CABLE_LEAST,                                                                   \
         .max = 1e4,                                                                           \
         .flags = FIELD_DEFAULT,                                                               \
         .fallback = 9.80665,                                                                  \
         .help = "acceleration of gravity"},                                                   \
        {FIELD_AT(FIELD_NUMBER, cable_input, mass_kg_per_m), .unit = "kg/m",                   \
         .min = CABLE_LEAST, .max = 1e6,                                                       \
         .help = "mass per length (per unstretched length where that is given)"},              \
        {FIELD_AT(FIELD_NUMBER, cable_input, weight_N_per_m), .unit = "N/m",                   \
         .min = CABLE_LEAST, .max = 1e8,                                                       \
         .help = "weight per length; default mass times gravity, less in water"},              \
        {FIELD_AT(FIELD_NUMBER, cable_input, added_mass_kg_per_m),                             \
         .unit = "kg/m",                                                                       \
         .min = 0,                                                                             \
         .max = 1e6,                                                                           \
         .flags = FIELD_DEFAULT,                                                               \
         .help = "mass of fluid that moves with the cable, normal to it"},                     \
        {FIELD_AT(FIELD_NUMBER, cable_input, flexibility),                                     \
         .unit = "1",                                                                          \
         .min = 0,                                                                             \
         .max = 1e4,                                                                           \
         .flags = FIELD_DEFAULT,                                                               \
         .help = "kappa = S0/k: horizontal tension over axial stiffness; 0: inextensible"},    \
        {FIELD_AT(FIELD_NUMBER, cable_input, axial_stiffness_N), .unit = "N",                  \
         .min = CABLE_LEAST, .max = 1e15, .help = "EA of the cable"},                          \
        {FIELD_AT(FIELD_NUMBER, cable_input, eta_tangential),                                  \
         .unit = "1",                                                                          \
         .min = 0,                                                                             \
         .max = 1e6,                                                                           \
         .flags = FIELD_DEFAULT,                                                               \
         .help = "eta_1: tangential viscous damping per length over m sqrt(g/a)"},             \
    {                                                                                          \
        FIELD_AT(FIELD_NUMBER, cable_input, eta_normal),                                       \
            .unit = "1", .min = 0, .max = 1e6, .flags = FIELD_DEFAULT,                         \
            .help = "eta_2: normal and out-of-plane "                                          \
                    "viscous damping per length over m "                                       \
                    "sqrt(g/a)"                                                                \
    }

extern const char *const cable_geometry_groups[], *const cable_elasticity_groups[];
/* Rows of a field_groups table. */
#define CABLE_GEOMETRY_GROUPS .title = "geometry", .groups = cable_geometry_groups
#define CABLE_ELASTICITY_GROUPS                                                                \
    .title = "elasticity", .optional = true, .groups = cable_elasticity_groups

/* Fills what is computed; faults: 400 across fields, 422 where no such cable exists. */
void cable_prepare(const schema *s, cable_input *in, problem *p);
/* The member "geometry". */
void cable_write_geometry(json_writer *json, const cable_input *in);
/* frequency_ratio, decays and their companions of a characteristic root s of the core. */
void cable_write_rates(json_writer *json, const cable_input *in, double _Complex s);
/* Warnings that every answer about a cable may carry. */
void cable_warn(const cable_input *in, answer *a);
/* Of a weight that does not fit its mass; SI units, per length. */
void cable_warn_weight(double weight, double mass, double added_mass, double gravity,
                       answer *a);
bool cable_damped(const cable_input *in);
/* Turns a fault of the core into a problem. */
void cable_refuse(const strum_error *fault, strum_status status, problem *p);

#endif
