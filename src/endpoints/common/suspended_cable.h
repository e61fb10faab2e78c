/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the suspended cable's endpoints share: its fields, its geometry, and the units of the
 * answer. */
#ifndef ENDPOINTS_COMMON_SUSPENDED_CABLE_H
#define ENDPOINTS_COMMON_SUSPENDED_CABLE_H

#include <strum/catenary.h>

#include "endpoints/common/members.h"
#include "endpoints/common/round.h"
#include "endpoints/endpoint.h"

/* First member of a request struct, so that CABLE_FIELDS' offsets hold there too. */
typedef struct cable_input {
    field_set given;
    double rise_to_span, sag_parameter, xi_1, xi_2, chi_1, chi_2;
    double span_m, rise_m, length_m, unstretched_length_m;
    double gravity_m_per_s2, mass_kg_per_m, weight_N_per_m, added_mass_kg_per_m;
    double flexibility, axial_stiffness_N, eta_tangential, eta_normal;
    double horizontal_tension_N, tension_end_1_N, tension_end_2_N, tension_parallel_to_chord_N;
    double catenary_parameter_m, sag_mid_m, sag_max_m, depth_below_end_1_m;
    double angle_end_1_deg, angle_end_2_deg;
    int branch;
    round_input round;

    /* from here on: computed by cable_prepare */
    strum_catenary catenary;
    strum_cable cable;
    bool elastic_profile;  /* about the exact elastic catenary, masses per unstretched metre */
    double rest_length_m;  /* unstretched, where it was found from a figure; else 0 */
    int solutions;         /* shapes with that figure; 0: no figure was given */
    double other_length_m; /* unstretched length of the other one */
    double a_m;            /* metres of the catenary parameter; 0 for a dimensionless request */
    double tension_N;      /* horizontal tension; 0 when not known */
    double ratio;          /* frequency_ratio (in sqrt(g/a)) of the core's unit frequency */
    double rad_per_s;      /* rad/s of frequency_ratio 1; 0 when not known */
} cable_input;

/* Least length, mass, weight, gravity and stiffness in their SI units: far below any cable's,
 * and quotients of two of them stay finite. */
#define CABLE_LEAST 1e-9

enum { CABLE_TAUT, CABLE_SLACK };
extern const char *const cable_branches[];

#define CABLE_NUMBER(member, unit_, min_, max_, flags_, fallback_, help_)                      \
    {                                                                                          \
        FIELD_AT(FIELD_NUMBER, cable_input, member), .unit = (unit_), .min = (min_),           \
                                                     .max = (max_), .flags = (flags_),         \
                                                     .fallback = (fallback_), .help = (help_)  \
    }

#define CABLE_FIELDS                                                                           \
    CABLE_NUMBER(rise_to_span, "1", -1e4, 1e4, FIELD_DEFAULT, 0,                               \
                 "h/b: height of end 2 above end 1 over the span"),                            \
        CABLE_NUMBER(sag_parameter, "1", 0, 1, FIELD_OPEN_MIN | FIELD_OPEN_MAX, 0,             \
                     "b/sqrt(l^2 - h^2): near 1 for a taut cable, near 0 for a deep one"),     \
        CABLE_NUMBER(xi_1, "1", -1.3e5, 1.3e5, 0, 0,                                           \
                     "xi of end 1: sgn(slope) (1/cos(slope angle) - 1)"),                      \
        CABLE_NUMBER(xi_2, "1", -1.3e5, 1.3e5, 0, 0, "xi of end 2, above xi_1"),               \
        CABLE_NUMBER(chi_1, "1", -STRUM_CHI_MAX, STRUM_CHI_MAX, 0, 0,                          \
                     "x/a of end 1: asinh of the slope there"),                                \
        CABLE_NUMBER(chi_2, "1", -STRUM_CHI_MAX, STRUM_CHI_MAX, 0, 0,                          \
                     "x/a of end 2, above chi_1"),                                             \
        CABLE_NUMBER(span_m, "m", CABLE_LEAST, 1e6, 0, 0,                                      \
                     "horizontal distance of the supports"),                                   \
        CABLE_NUMBER(rise_m, "m", -1e6, 1e6, FIELD_DEFAULT, 0, "height of end 2 above end 1"), \
        CABLE_NUMBER(length_m, "m", CABLE_LEAST, 1e7, 0, 0,                                    \
                     "length of the hanging cable, longer than the chord"),                    \
        CABLE_NUMBER(unstretched_length_m, "m", CABLE_LEAST, 1e7, 0, 0,                        \
                     "length without load: modes about the exact elastic catenary"),           \
        CABLE_NUMBER(horizontal_tension_N, "N", 0, 1e12, FIELD_OPEN_MIN, 0,                    \
                     "horizontal component of the tension"),                                   \
        CABLE_NUMBER(tension_end_1_N, "N", 0, 1e12, FIELD_OPEN_MIN, 0, "tension at end 1"),    \
        CABLE_NUMBER(tension_end_2_N, "N", 0, 1e12, FIELD_OPEN_MIN, 0, "tension at end 2"),    \
        CABLE_NUMBER(tension_parallel_to_chord_N, "N", 0, 1e12, FIELD_OPEN_MIN, 0,             \
                     "tension where the cable is parallel to its chord"),                      \
        CABLE_NUMBER(catenary_parameter_m, "m", 0, 1e12, FIELD_OPEN_MIN, 0,                    \
                     "a = H/w: horizontal tension over weight per length"),                    \
        CABLE_NUMBER(sag_mid_m, "m", 0, 1e7, FIELD_OPEN_MIN, 0,                                \
                     "height of the chord above the cable at half the span"),                  \
        CABLE_NUMBER(sag_max_m, "m", 0, 1e7, FIELD_OPEN_MIN, 0,                                \
                     "largest height of the chord above the cable"),                           \
        CABLE_NUMBER(depth_below_end_1_m, "m", 0, 1e7, FIELD_OPEN_MIN, 0,                      \
                     "height of end 1 above the lowest point of the cable"),                   \
        CABLE_NUMBER(angle_end_1_deg, "deg", -90, 90, FIELD_OPEN_MIN | FIELD_OPEN_MAX, 0,      \
                     "slope of the cable at end 1, negative where it leaves downwards"),       \
        CABLE_NUMBER(angle_end_2_deg, "deg", -90, 90, FIELD_OPEN_MIN | FIELD_OPEN_MAX, 0,      \
                     "slope of the cable at end 2"),                                           \
        {FIELD_AT(FIELD_CHOICE, cable_input, branch), .choices = cable_branches,               \
         .flags = FIELD_DEFAULT, .fallback = CABLE_TAUT,                                       \
         .help = "of the two cables with one tension at an end, the shorter or the longer"},   \
        CABLE_NUMBER(gravity_m_per_s2, "m/s^2", CABLE_LEAST, 1e4, FIELD_DEFAULT, 9.80665,      \
                     "acceleration of gravity"),                                               \
        CABLE_NUMBER(mass_kg_per_m, "kg/m", CABLE_LEAST, 1e6, 0, 0,                            \
                     "mass per length (per unstretched length where that is given)"),          \
        CABLE_NUMBER(weight_N_per_m, "N/m", CABLE_LEAST *CABLE_LEAST, 1e10, 0,                 \
                     0, /* of every mass times gravity */                                      \
                     "weight per length; default mass times gravity, less in water"),          \
        CABLE_NUMBER(added_mass_kg_per_m, "kg/m", 0, 1e6, FIELD_DEFAULT, 0,                    \
                     "mass of fluid that moves with the cable, normal to it"),                 \
        ROUND_FIELDS(cable_input, round),                                                      \
        CABLE_NUMBER(                                                                          \
            flexibility, "1", 0, 1e4, FIELD_DEFAULT, 0,                                        \
            "kappa = S0/k: horizontal tension over axial stiffness; 0: inextensible"),         \
        CABLE_NUMBER(axial_stiffness_N, "N", CABLE_LEAST, 1e15, 0, 0, "EA of the cable"),      \
        CABLE_NUMBER(eta_tangential, "1", 0, 1e6, FIELD_DEFAULT, 0,                            \
                     "eta_1: tangential viscous damping per length over m sqrt(g/a)"),         \
        CABLE_NUMBER(                                                                          \
            eta_normal, "1", 0, 1e6, FIELD_DEFAULT, 0,                                         \
            "eta_2: normal and out-of-plane viscous damping per length over m sqrt(g/a)")

extern const char *const cable_geometry_groups[], *const cable_elasticity_groups[];
/* Rows of a field_groups table. */
#define CABLE_GEOMETRY_GROUPS .title = "geometry", .groups = cable_geometry_groups
#define CABLE_ELASTICITY_GROUPS                                                                \
    .title = "elasticity", .optional = true, .groups = cable_elasticity_groups

/* Fills what is computed; faults: 400 across fields, 422 where no such cable exists. */
void cable_prepare(const schema *s, cable_input *in, problem *p);
/* Of a geometry by a figure (suspended_figure.c): its pointer, or NULL where the geometry is given
 * otherwise; and the profile, with `solutions` and what follows it. */
const char *cable_figure_pointer(const schema *s, const cable_input *in);
strum_status cable_find_by_figure(const schema *s, cable_input *in, strum_catenary *c,
                                  strum_error *error);
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
