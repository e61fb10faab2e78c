/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The general cable of a request: its fields. Every endpoint that takes such a cable has
 * HUNG_FIELDS as its first rows. */
#ifndef ENDPOINTS_CABLE_FIELDS_H
#define ENDPOINTS_CABLE_FIELDS_H

#include <strum/cable.h>

#include "endpoints/cable/section.h"

typedef struct hung_end {
    field_set given;
    int rotation; /* index into hung_rotations */
    double rotational_stiffness_N_m_per_rad, angle_deg;
} hung_end;

typedef struct hung_hanger {
    field_set given;
    double length_m, mass_kg;
} hung_hanger;

typedef struct hung_bed {
    field_set given;
    double depth_below_end_1_m, slope_deg, friction_coefficient;
} hung_bed;

/* First member of a request struct, so that the offsets of HUNG_FIELDS hold there too. */
typedef struct hung_input {
    field_set given;
    section_input flat; /* a cable of one section, at the top of the request */
    objects_value sections;
    double fluid_density_kg_per_m3, gravity_m_per_s2;
    double span_m, rise_m;
    int64_t adjust_section;
    double horizontal_tension_N, tension_end_1_N, tension_end_2_N, tension_parallel_to_chord_N;
    double catenary_parameter_m, sag_mid_m, sag_max_m, depth_below_end_1_m;
    double angle_end_1_deg, angle_end_2_deg;
    int branch;
    objects_value attachments; /* of object_item */
    hung_end end_1, end_2;
    int statics;
    int64_t spans;
    hung_hanger hanger;
    hung_bed bed;
    double temperature_change_K, expansion_per_K, taken_in_m;

    /* from here on: computed by hung_prepare, owned by the arena */
    strum_cable_params params;
    section_properties *properties; /* of each section */
    size_t *origin;                 /* attachment of the request that each of params is from */
    const char *given_pointer;      /* of the quantity that is given beside span and lengths */
} hung_input;

enum { HUNG_FLEXIBLE, HUNG_STIFF }; /* hung_input.statics */

extern const variant hung_attachments[];
extern const schema hung_end_schema, hung_hanger_schema, hung_bed_schema;
extern const char *const hung_branches[], *const hung_statics[];
extern const char *const hung_section_groups[], *const hung_given_groups[];

#define HUNG_NUMBER(member, unit_, min_, max_, flags_, fallback_, help_)                       \
    {                                                                                          \
        FIELD_AT(FIELD_NUMBER, hung_input, member), .unit = (unit_), .min = (min_),            \
                                                    .max = (max_), .flags = (flags_),          \
                                                    .fallback = (fallback_), .help = (help_)   \
    }

/* clang-format off */
#define HUNG_FIELDS                                                                            \
    SECTION_ROWS(offsetof(hung_input, flat),                                                   \
        "unstretched length of a cable of one section; beside sections: the stretched length " \
        "of the whole, in place of one section's"),                                            \
    {FIELD_AT(FIELD_OBJECTS, hung_input, sections), .schema = &section_schema, .min_items = 1, \
     .max_items = STRUM_CABLE_SECTIONS_MAX,                                                    \
     .help = "from end 1 to end 2; one section may stand at the top of the request instead"},  \
    HUNG_NUMBER(fluid_density_kg_per_m3, "kg/m^3", 0, 1e5, FIELD_DEFAULT, 0,                   \
                "of the fluid around sections with a diameter and bodies with a volume"),      \
    HUNG_NUMBER(gravity_m_per_s2, "m/s^2", SECTION_LEAST, 1e4, FIELD_DEFAULT, 9.80665,         \
                "acceleration of gravity"),                                                    \
    HUNG_NUMBER(span_m, "m", 0, 1e7, 0, 0,                                                     \
                "horizontal distance of end 2 from end 1; left out where lengths and a "       \
                "tension give it"),                                                            \
    HUNG_NUMBER(rise_m, "m", -1e7, 1e7, FIELD_DEFAULT, 0, "height of end 2 above end 1"),      \
    {FIELD_AT(FIELD_INTEGER, hung_input, adjust_section), .min = 1,                            \
     .max = STRUM_CABLE_SECTIONS_MAX,                                                          \
     .help = "the section, from 1, whose length is found or taken in; default the one "        \
             "without length_m, else the last"},                                               \
    HUNG_NUMBER(horizontal_tension_N, "N", 0, 1e15, FIELD_OPEN_MIN, 0,                         \
                "horizontal part of the tension at end 1"),                                    \
    HUNG_NUMBER(tension_end_1_N, "N", 0, 1e15, FIELD_OPEN_MIN, 0, "tension at end 1"),         \
    HUNG_NUMBER(tension_end_2_N, "N", 0, 1e15, FIELD_OPEN_MIN, 0, "tension at end 2"),         \
    HUNG_NUMBER(tension_parallel_to_chord_N, "N", 0, 1e15, FIELD_OPEN_MIN, 0,                  \
                "tension where the cable is parallel to its chord"),                           \
    HUNG_NUMBER(catenary_parameter_m, "m", 0, 1e12, FIELD_OPEN_MIN, 0,                         \
                "horizontal tension over the weight per length of the section that is found"), \
    HUNG_NUMBER(sag_mid_m, "m", 0, 1e7, FIELD_OPEN_MIN, 0,                                     \
                "vertical distance of the cable below its chord at half the span"),            \
    HUNG_NUMBER(sag_max_m, "m", 0, 1e7, FIELD_OPEN_MIN, 0,                                     \
                "largest vertical distance of the cable below its chord"),                     \
    HUNG_NUMBER(depth_below_end_1_m, "m", 0, 1e7, FIELD_OPEN_MIN, 0,                           \
                "of the lowest point of the cable"),                                           \
    HUNG_NUMBER(angle_end_1_deg, "deg", -90, 90, FIELD_OPEN_MIN | FIELD_OPEN_MAX, 0,           \
                "slope of the cable at end 1"),                                                \
    HUNG_NUMBER(angle_end_2_deg, "deg", -90, 90, FIELD_OPEN_MIN | FIELD_OPEN_MAX, 0,           \
                "slope of the cable at end 2"),                                                \
    {FIELD_AT(FIELD_CHOICE, hung_input, branch), .choices = hung_branches,                     \
     .flags = FIELD_DEFAULT,                                                                   \
     .help = "of the two cables that have this end tension: taut, the shorter, or slack"},     \
    {FIELD_AT(FIELD_VARIANTS, hung_input, attachments), .variants = hung_attachments,          \
     .max_items = STRUM_CABLE_ATTACHMENTS_MAX, .help = "bodies, links and forces along it"},   \
    {FIELD_AT(FIELD_OBJECT, hung_input, end_1), .schema = &hung_end_schema,                    \
     .flags = FIELD_DEFAULT, .help = "how end 1 is held"},                                     \
    {FIELD_AT(FIELD_OBJECT, hung_input, end_2), .schema = &hung_end_schema,                    \
     .flags = FIELD_DEFAULT, .help = "how end 2 is held"},                                     \
    {FIELD_AT(FIELD_CHOICE, hung_input, statics), .choices = hung_statics,                     \
     .flags = FIELD_DEFAULT, .fallback = HUNG_FLEXIBLE,                                        \
     .help = "flexible: the elastic catenary, about which bending stiffness acts; stiff: "     \
             "bending stiffness shapes the cable too"},                                        \
    {FIELD_AT(FIELD_INTEGER, hung_input, spans), .min = 1, .max = STRUM_CABLE_SPANS_MAX,       \
     .flags = FIELD_DEFAULT, .fallback = 1,                                                    \
     .help = "so many equal level spans in a row, each as described, with hangers between"},   \
    {FIELD_AT(FIELD_OBJECT, hung_input, hanger), .schema = &hung_hanger_schema,                \
     .help = "the rigid rod from which the cable hangs between spans (insulator string)"},     \
    {FIELD_AT(FIELD_OBJECT, hung_input, bed), .schema = &hung_bed_schema,                      \
     .help = "a rigid plane on which the cable may lie"},                                      \
    HUNG_NUMBER(temperature_change_K, "K", -1e4, 1e4, FIELD_DEFAULT, 0,                        \
                "warms the cable after its shape was found; masses are kept"),                 \
    HUNG_NUMBER(expansion_per_K, "1/K", -1, 1, FIELD_DEFAULT, 0,                               \
                "length per length and kelvin"),                                               \
    HUNG_NUMBER(taken_in_m, "m", -1e7, 1e7, FIELD_DEFAULT, 0,                                  \
                "unstretched length taken off adjust_section after the shape was found")
/* clang-format on */

/* Rows of a field_groups table. */
#define HUNG_GROUPS                                                                            \
    {"section", false, hung_section_groups},                                                   \
    {                                                                                          \
        "geometry", true, hung_given_groups                                                    \
    }

#endif
