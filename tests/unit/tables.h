/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables that hold every kind of row and the shapes of requests that the design names: the
 * alternative geometries of a suspended cable, and a chain of components with variables. */
#ifndef TESTS_TABLES_H
#define TESTS_TABLES_H

#include <math.h>

#include "schema/schema.h"

/* ---- a suspended cable ---- */

typedef struct cable_request {
    field_set given;
    double rise_to_span, sag_parameter, xi_1, xi_2, span_m, rise_m, length_m,
        unstretched_length_m;
    double gravity_m_per_s2, mass_kg_per_m, flexibility, axial_stiffness_N;
    int plane;
    int64_t modes;
    bool verify;
    numbers_value chi;
} cable_request;

static const char *const planes[] = {"in_plane", "out_of_plane", "both", NULL};

static const field cable_fields[] = {
    {FIELD_AT(FIELD_NUMBER, cable_request, rise_to_span), .unit = "1", .min = -100, .max = 100,
     .flags = FIELD_DEFAULT, .help = "rise over span"},
    {FIELD_AT(FIELD_NUMBER, cable_request, sag_parameter), .unit = "1", .min = 0, .max = 1,
     .flags = FIELD_OPEN_MIN | FIELD_OPEN_MAX, .help = "b/sqrt(l^2-h^2)"},
    {FIELD_AT(FIELD_NUMBER, cable_request, xi_1), .help = "xi of end 1"},
    {FIELD_AT(FIELD_NUMBER, cable_request, xi_2), .help = "xi of end 2"},
    {FIELD_AT(FIELD_NUMBER, cable_request, span_m), .unit = "m", .min = 0, .max = INFINITY,
     .flags = FIELD_OPEN_MIN, .help = "horizontal distance of the supports"},
    {FIELD_AT(FIELD_NUMBER, cable_request, rise_m), .unit = "m", .flags = FIELD_DEFAULT,
     .help = "height of end 2 above end 1"},
    {FIELD_AT(FIELD_NUMBER, cable_request, length_m), .unit = "m", .help = "length"},
    {FIELD_AT(FIELD_NUMBER, cable_request, unstretched_length_m), .unit = "m",
     .help = "length"},
    {FIELD_AT(FIELD_NUMBER, cable_request, gravity_m_per_s2), .unit = "m/s2", .min = 0,
     .max = 1000, .flags = FIELD_DEFAULT | FIELD_OPEN_MIN, .fallback = 9.80665,
     .help = "gravity"},
    {FIELD_AT(FIELD_NUMBER, cable_request, mass_kg_per_m), .unit = "kg/m", .help = "mass"},
    {FIELD_AT(FIELD_NUMBER, cable_request, flexibility), .unit = "1", .flags = FIELD_DEFAULT,
     .help = "S0/k"},
    {FIELD_AT(FIELD_NUMBER, cable_request, axial_stiffness_N), .unit = "N",
     .help = "axial stiffness"},
    {FIELD_AT(FIELD_CHOICE, cable_request, plane), .flags = FIELD_DEFAULT, .fallback = 2,
     .choices = planes, .help = "which motion"},
    {FIELD_AT(FIELD_INTEGER, cable_request, modes), .min = 1, .max = 200,
     .flags = FIELD_DEFAULT, .fallback = 6, .help = "how many modes"},
    {FIELD_AT(FIELD_FLAG, cable_request, verify), .flags = FIELD_DEFAULT, .help = "twice"},
    {FIELD_AT(FIELD_NUMBERS, cable_request, chi), .min = -20, .max = 20,
     .flags = FIELD_ASCENDING, .min_items = 1, .max_items = 4, .help = "points"},
    {.kind = FIELD_END},
};

static const field_groups cable_groups[] = {
    {"geometry", false,
     (const char *const[]){"rise_to_span sag_parameter", "xi_1 xi_2", "span_m rise_m length_m",
                           "span_m rise_m unstretched_length_m +axial_stiffness_N "
                           "+mass_kg_per_m",
                           NULL}},
    {"elasticity", true, (const char *const[]){"flexibility", "axial_stiffness_N", NULL}},
    {0},
};

static const schema cable_schema = {
    .name = "cable_request",
    .fields = cable_fields,
    .groups = cable_groups,
    .size = sizeof(cable_request),
};

/* ---- a chain of components ---- */

typedef struct part_cable {
    field_set given;
    variable_value length_m, mass_kg_per_m;
    double tension_N, tension_left_N, tension_right_N;
} part_cable;
static const field part_cable_fields[] = {
    {FIELD_AT(FIELD_NUMBER, part_cable, length_m), .unit = "m", .min = 0, .max = INFINITY,
     .flags = FIELD_REQUIRED | FIELD_VARIABLE | FIELD_OPEN_MIN, .help = "length"},
    {FIELD_AT(FIELD_NUMBER, part_cable, mass_kg_per_m), .unit = "kg/m", .min = 0,
     .max = INFINITY, .flags = FIELD_REQUIRED | FIELD_VARIABLE | FIELD_OPEN_MIN,
     .help = "mass per length"},
    {FIELD_AT(FIELD_NUMBER, part_cable, tension_N), .unit = "N", .help = "its own tension"},
    {FIELD_AT(FIELD_NUMBER, part_cable, tension_left_N), .unit = "N", .help = "at its left"},
    {FIELD_AT(FIELD_NUMBER, part_cable, tension_right_N), .unit = "N", .help = "at its right"},
    {.kind = FIELD_END},
};
static const field_groups part_groups[] = {
    {"tension", true,
     (const char *const[]){"tension_N", "tension_left_N tension_right_N", NULL}},
    {0},
};
static const schema part_cable_schema = {
    .name = "cable",
    .fields = part_cable_fields,
    .groups = part_groups,
    .size = sizeof(part_cable),
};

typedef struct part_link {
    field_set given;
    variable_value left_m, right_m, mass_kg;
} part_link;
static const field part_link_fields[] = {
    {FIELD_AT(FIELD_NUMBER, part_link, left_m), .unit = "m",
     .flags = FIELD_REQUIRED | FIELD_VARIABLE, .help = "left arm"},
    {FIELD_AT(FIELD_NUMBER, part_link, right_m), .unit = "m",
     .flags = FIELD_REQUIRED | FIELD_VARIABLE, .help = "right arm"},
    {FIELD_AT(FIELD_NUMBER, part_link, mass_kg), .unit = "kg", .min = 0, .max = INFINITY,
     .flags = FIELD_REQUIRED | FIELD_VARIABLE, .help = "mass"},
    {.kind = FIELD_END},
};
static const schema part_link_schema = {
    .name = "link", .fields = part_link_fields, .size = sizeof(part_link)};

typedef struct part_joint {
    field_set given;
    variable_value damping_N_s_per_m, stiffness_N_per_m;
} part_joint;
static const field part_joint_fields[] = {
    {FIELD_AT(FIELD_NUMBER, part_joint, damping_N_s_per_m), .unit = "N s/m", .min = 0,
     .max = INFINITY, .flags = FIELD_DEFAULT | FIELD_VARIABLE | FIELD_INFINITE,
     .fallback = INFINITY, .help = "damper"},
    {FIELD_AT(FIELD_NUMBER, part_joint, stiffness_N_per_m), .unit = "N/m",
     .flags = FIELD_DEFAULT | FIELD_VARIABLE, .help = "spring"},
    {.kind = FIELD_END},
};
static const schema part_joint_schema = {
    .name = "joint", .fields = part_joint_fields, .size = sizeof(part_joint)};

typedef struct part_absorber {
    field_set given;
    objects_value links, joints;
} part_absorber;
static const field part_absorber_fields[] = {
    {FIELD_AT(FIELD_OBJECTS, part_absorber, links), .flags = FIELD_REQUIRED,
     .schema = &part_link_schema, .min_items = 2, .max_items = 8, .help = "links"},
    {FIELD_AT(FIELD_OBJECTS, part_absorber, joints), .flags = FIELD_REQUIRED,
     .schema = &part_joint_schema, .min_items = 1, .max_items = 7, .help = "joints"},
    {.kind = FIELD_END},
};
static const schema part_absorber_schema = {
    .name = "inline_absorber", .fields = part_absorber_fields, .size = sizeof(part_absorber)};

typedef struct part_mass {
    field_set given;
    double mass_kg;
} part_mass;
static const field part_mass_fields[] = {
    {FIELD_AT(FIELD_NUMBER, part_mass, mass_kg), .unit = "kg", .min = 0, .max = 1e9,
     .flags = FIELD_REQUIRED, .help = "mass"},
    {.kind = FIELD_END},
};
static const schema part_mass_schema = {
    .name = "point_mass", .fields = part_mass_fields, .size = sizeof(part_mass)};

static const variant parts[] = {
    {"cable", "a uniform cable", &part_cable_schema},
    {"point_mass", "a point mass", &part_mass_schema},
    {"inline_absorber", "hinged links", &part_absorber_schema},
    {0},
};

typedef struct chain_variable {
    field_set given;
    name_value name;
    double min, max;
} chain_variable;
static const field chain_variable_fields[] = {
    {FIELD_AT(FIELD_NAME, chain_variable, name), .flags = FIELD_REQUIRED, .help = "name"},
    {FIELD_AT(FIELD_NUMBER, chain_variable, min), .flags = FIELD_REQUIRED, .help = "least"},
    {FIELD_AT(FIELD_NUMBER, chain_variable, max), .flags = FIELD_REQUIRED, .help = "most"},
    {.kind = FIELD_END},
};
static const schema chain_variable_schema = {
    .name = "variable_range", .fields = chain_variable_fields, .size = sizeof(chain_variable)};

typedef struct chain_limits {
    field_set given;
    double strouhal, diameter_m;
} chain_limits;
static const field chain_limits_fields[] = {
    {FIELD_AT(FIELD_NUMBER, chain_limits, strouhal), .flags = FIELD_DEFAULT, .fallback = 0.2,
     .help = "Strouhal number"},
    {FIELD_AT(FIELD_NUMBER, chain_limits, diameter_m), .unit = "m", .flags = FIELD_REQUIRED,
     .help = "diameter"},
    {.kind = FIELD_END},
};
static const schema chain_limits_schema = {
    .name = "required", .fields = chain_limits_fields, .size = sizeof(chain_limits)};

typedef struct chain_request {
    field_set given;
    double tension_N;
    objects_value components, variables;
    int64_t modes, first_mode;
    numbers_value mode_numbers, band_rad_per_s;
    double max_decay_per_s;
    complexes_value angular_frequencies;
    chain_limits required;
} chain_request;
static const field chain_fields[] = {
    {FIELD_AT(FIELD_NUMBER, chain_request, tension_N), .unit = "N", .min = 0, .max = 1e12,
     .flags = FIELD_REQUIRED | FIELD_OPEN_MIN, .help = "tension"},
    {FIELD_AT(FIELD_VARIANTS, chain_request, components), .flags = FIELD_REQUIRED,
     .variants = parts, .min_items = 1, .help = "from left to right"},
    {FIELD_AT(FIELD_OBJECTS, chain_request, variables), .schema = &chain_variable_schema,
     .max_items = 4, .help = "what may vary"},
    {FIELD_AT(FIELD_INTEGER, chain_request, modes), .min = 1, .max = 1000,
     .flags = FIELD_DEFAULT, .fallback = 10, .help = "how many"},
    {FIELD_AT(FIELD_INTEGER, chain_request, first_mode), .min = 1, .max = 1e6,
     .flags = FIELD_DEFAULT, .fallback = 1, .help = "from which on"},
    {FIELD_AT(FIELD_NUMBERS, chain_request, mode_numbers), .min = 1, .max = 1e6,
     .flags = FIELD_WHOLE | FIELD_ASCENDING, .min_items = 1, .help = "which"},
    {FIELD_AT(FIELD_NUMBERS, chain_request, band_rad_per_s), .unit = "rad/s", .min = 0,
     .max = INFINITY, .flags = FIELD_ASCENDING, .min_items = 2, .max_items = 2,
     .help = "lowest and highest"},
    {FIELD_AT(FIELD_NUMBER, chain_request, max_decay_per_s), .unit = "1/s", .help = "decay"},
    {FIELD_AT(FIELD_COMPLEXES, chain_request, angular_frequencies), .unit = "rad/s",
     .min = -1e9, .max = 1e9, .max_items = 100, .help = "where"},
    {FIELD_AT(FIELD_OBJECT, chain_request, required), .schema = &chain_limits_schema,
     .help = "what must be met"},
    {.kind = FIELD_END},
};
static const field_groups chain_groups[] = {
    {"choice of modes", true,
     (const char *const[]){"modes first_mode", "mode_numbers",
                           "band_rad_per_s [max_decay_per_s]", NULL}},
    {0},
};
static const schema chain_schema = {
    .name = "chain_request",
    .fields = chain_fields,
    .groups = chain_groups,
    .size = sizeof(chain_request),
};

#endif
