/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "endpoints/cable/fields.h"

/* ---- tables ---- */

static const char *const rotations[] = {"pinned", "clamped", NULL};
const char *const hung_branches[] = {"taut", "slack", NULL};
const char *const hung_statics[] = {"flexible", "stiff", NULL};

#define NUMBER(type, member, unit_, min_, max_, flags_, help_)                                 \
    {                                                                                          \
        FIELD_AT(FIELD_NUMBER, type, member), .unit = (unit_), .min = (min_), .max = (max_),   \
                                              .flags = (flags_), .help = (help_)               \
    }

static const field end_fields[] = {
    {FIELD_AT(FIELD_CHOICE, hung_end, rotation), .choices = rotations, .flags = FIELD_DEFAULT,
     .help = "pinned: free to turn; clamped: held at an angle"},
    NUMBER(hung_end, rotational_stiffness_N_m_per_rad, "N m/rad", 0, 1e15, 0,
           "of a spring that holds the angle, instead of rotation"),
    NUMBER(hung_end, angle_deg, "deg", -360, 360, 0,
           "slope of the clamp; default the cable's own where it hangs without bending "
           "stiffness"),
    {.kind = FIELD_END}};
static const char *const rotation_words[] = {"[rotation]", "rotational_stiffness_N_m_per_rad",
                                             NULL};
static const field_groups end_groups[] = {{"rotation", true, rotation_words}, {0}};
const schema hung_end_schema = {
    .name = "cable_end", .fields = end_fields, .groups = end_groups, .size = sizeof(hung_end)};

static const field hanger_fields[] = {
    NUMBER(hung_hanger, length_m, "m", 0, 1e4, FIELD_REQUIRED | FIELD_OPEN_MIN,
           "from the point above to the cable"),
    NUMBER(hung_hanger, mass_kg, "kg", 0, 1e9, FIELD_DEFAULT, "of the rod"),
    {.kind = FIELD_END}};
const schema hung_hanger_schema = {
    .name = "hanger", .fields = hanger_fields, .size = sizeof(hung_hanger)};

static const field bed_fields[] = {
    NUMBER(hung_bed, depth_below_end_1_m, "m", 0, 1e7, FIELD_DEFAULT,
           "of the bed under end 1; 0: end 1 is on it"),
    NUMBER(hung_bed, slope_deg, "deg", -80, 80, FIELD_DEFAULT, "above 0: rises towards end 2"),
    NUMBER(hung_bed, friction_coefficient, "1", 0, 100, FIELD_DEFAULT,
           "of what lies from end 1 on, against the pull of end 2"),
    {.kind = FIELD_END}};
const schema hung_bed_schema = {.name = "bed", .fields = bed_fields, .size = sizeof(hung_bed)};

const char *const hung_section_groups[] = {"sections", SECTION_GROUPS, NULL};
const char *const hung_given_groups[] = {"horizontal_tension_N",
                                         "tension_end_1_N [branch]",
                                         "tension_end_2_N [branch]",
                                         "tension_parallel_to_chord_N",
                                         "catenary_parameter_m",
                                         "sag_mid_m",
                                         "sag_max_m",
                                         "depth_below_end_1_m",
                                         "angle_end_1_deg",
                                         "angle_end_2_deg",
                                         NULL};
