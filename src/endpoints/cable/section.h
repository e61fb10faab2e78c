/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A section of a general cable: by its mass, by a diameter and what it is made of, or as a
 * chain. */
#ifndef ENDPOINTS_CABLE_SECTION_H
#define ENDPOINTS_CABLE_SECTION_H

#include <strum/cable.h>

#include "endpoints/endpoint.h"

typedef struct section_layer {
    field_set given;
    double thickness_m, density_kg_per_m3;
} section_layer;

typedef struct section_chain {
    field_set given;
    double nominal_diameter_m;
    int link;
} section_chain;

typedef struct section_input {
    field_set given; /* not of a section at the top of a request: see hung_prepare */
    double length_m, mass_kg_per_m, weight_N_per_m, added_mass_kg_per_m;
    double added_mass_tangential_kg_per_m, axial_stiffness_N, bending_stiffness_N_m2;
    double axial_loss_factor, bending_loss_factor, drag_normal_N_s_per_m2;
    double drag_tangential_N_s_per_m2, bed_friction;
    double diameter_m, material_density_kg_per_m3, youngs_modulus_Pa;
    double added_mass_coefficient, added_mass_coefficient_axial;
    objects_value layers; /* of section_layer */
    section_chain chain;
} section_input;

/* What follows from a diameter or a chain. */
typedef struct section_properties {
    double outer_diameter; /* m; 0: not known */
    const char *rule;      /* the source of a chain's figures; NULL */
} section_properties;

extern const schema section_schema, section_layer_schema, section_chain_schema;

/* Least gravity, mass and length in SI units: quotients of two of them stay finite. */
#define SECTION_LEAST 1e-9

#define SECTION_NUMBER(base, member, unit_, min_, max_, flags_, help_)                         \
    {                                                                                          \
        .name = #member, .kind = FIELD_NUMBER,                                                 \
        .offset = (base) + offsetof(section_input, member), .unit = (unit_), .min = (min_),    \
        .max = (max_), .flags = (flags_), .help = (help_)                                      \
    }

/* clang-format off */
#define SECTION_ROWS(base, length_help)                                                        \
    SECTION_NUMBER(base, length_m, "m", 0, 1e7, FIELD_OPEN_MIN, length_help),                  \
    SECTION_NUMBER(base, mass_kg_per_m, "kg/m", 0, 1e6, 0,                                     \
        "mass per unstretched length, without layers and fluid"),                              \
    SECTION_NUMBER(base, weight_N_per_m, "N/m", -1e10, 1e10, 0,                                \
        "weight per unstretched length, in the fluid: negative where it floats; default mass " \
        "times gravity, less what a diameter displaces"),                                      \
    SECTION_NUMBER(base, added_mass_kg_per_m, "kg/m", 0, 1e6, 0,                               \
        "mass of fluid that moves with the cable, normal to it; default 0, or by "             \
        "added_mass_coefficient"),                                                             \
    SECTION_NUMBER(base, added_mass_tangential_kg_per_m, "kg/m", 0, 1e6, 0,                    \
        "mass of fluid that moves with the cable along it; default 0, or by "                  \
        "added_mass_coefficient_axial"),                                                       \
    SECTION_NUMBER(base, axial_stiffness_N, "N", 0, 1e15, FIELD_OPEN_MIN | FIELD_INFINITE,     \
        "EA; default infinite, or by youngs_modulus_Pa or chain"),                             \
    SECTION_NUMBER(base, bending_stiffness_N_m2, "N m^2", 0, 1e15, 0,                          \
        "EI; default 0, or by youngs_modulus_Pa as of a solid rod"),                           \
    SECTION_NUMBER(base, axial_loss_factor, "1", 0, 10, 0, "EA (1 + i loss); default 0"),      \
    SECTION_NUMBER(base, bending_loss_factor, "1", 0, 10, 0, "EI (1 + i loss); default 0"),    \
    SECTION_NUMBER(base, drag_normal_N_s_per_m2, "N s/m^2", 0, 1e9, 0,                         \
        "viscous drag per length of motion across the cable; default 0"),                      \
    SECTION_NUMBER(base, drag_tangential_N_s_per_m2, "N s/m^2", 0, 1e9, 0,                     \
        "viscous drag per length of motion along the cable; default 0"),                       \
    SECTION_NUMBER(base, bed_friction, "1", 0, 100, 0,                                         \
        "friction coefficient on the bed, in place of the bed's"),                             \
    SECTION_NUMBER(base, diameter_m, "m", 0, 100, FIELD_OPEN_MIN,                              \
        "outer diameter without layers (volume-equivalent where it is not round)"),            \
    SECTION_NUMBER(base, material_density_kg_per_m3, "kg/m^3", 0, 1e5, 0,                      \
        "mass by the diameter, in place of mass_kg_per_m"),                                    \
    SECTION_NUMBER(base, youngs_modulus_Pa, "Pa", 0, 1e13, FIELD_OPEN_MIN,                     \
        "EA and EI of a solid rod of the diameter"),                                           \
    SECTION_NUMBER(base, added_mass_coefficient, "1", 0, 100, 0,                               \
        "added mass over displaced fluid, across the cable; default 1"),                       \
    SECTION_NUMBER(base, added_mass_coefficient_axial, "1", 0, 100, 0,                         \
        "added mass over displaced fluid, along the cable; default 0, of a chain 0.5"),        \
    {.name = "layers", .kind = FIELD_OBJECTS,                                                  \
     .offset = (base) + offsetof(section_input, layers), .schema = &section_layer_schema,      \
     .min_items = 1, .max_items = 20,                                                          \
     .help = "ice, coating, growth around the diameter or chain, from the inside"},            \
    {.name = "chain", .kind = FIELD_OBJECT,                                                    \
     .offset = (base) + offsetof(section_input, chain), .schema = &section_chain_schema,       \
     .help = "mass, diameter and stiffness of a mooring chain"}
/* clang-format on */

/* Three ways to say a section's mass, as groups of a table. */
#define SECTION_GROUPS                                                                         \
    "mass_kg_per_m [diameter_m]", "diameter_m material_density_kg_per_m3", "chain"

/* What surrounds the cable. */
typedef struct section_place {
    double gravity, fluid_density;
} section_place;

/* Is member `name` given? `s` and `rows` are the table and the given rows that hold it: the
 * section's own, or the request's where the section stands at its top. */
typedef struct section_reading {
    const schema *s;
    void *rows;
    section_input *in;
    char pointer[32]; /* of the section: "" at the top */
} section_reading;

/* Fills the defaults that depend on other fields, adds faults across fields, and makes the
 * core's section, with length 0 where none is given. */
void section_resolve(const section_reading *r, const section_place *place,
                     strum_cable_section *out, section_properties *properties, problem *p);

#endif
