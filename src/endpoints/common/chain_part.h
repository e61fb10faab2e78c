/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A component of a chain as it is read: what chain.c and chain_repeat.c share. */
#ifndef ENDPOINTS_COMMON_CHAIN_PART_H
#define ENDPOINTS_COMMON_CHAIN_PART_H

#include <strum/taut.h>

#include "schema/schema.h"

typedef struct chain_repeat {
    field_set given;
    int64_t count;
    variable_value spacing_m;
} chain_repeat;

extern const schema chain_repeat_schema;

typedef struct chain_link {
    field_set given;
    variable_value left_m, right_m, mass_kg, inertia_kg_m2;
} chain_link;

typedef struct chain_joint {
    field_set given;
    variable_value spring_arm_m, damper_arm_m, stiffness_N_per_m, damping_N_s_per_m, force_N;
} chain_joint;

/* Any component: its variant's table says which members mean something. */
typedef struct chain_part {
    field_set given;
    variable_value tension_N, tension_left_N, tension_right_N;
    variable_value length_m, diameter_m, height_m, base_radius_m, centre_m, pivot_m;
    variable_value mass_kg_per_m, drag_N_s_per_m2, mass_kg, radius_of_gyration_m, inertia_kg_m2;
    variable_value stiffness_N_per_m, damping_N_s_per_m, inertance_kg;
    int solution, apex;
    objects_value links, joints, components;
    chain_repeat repeat;
} chain_part;

/* Where a component was sent: entry of the list, and of the group that it is. */
typedef struct chain_place {
    size_t entry, inner;
    bool grouped;
} chain_place;

/* First member of a request struct, so that the offsets of CHAIN_FIELDS hold there too. */
typedef struct chain_input {
    field_set given;
    variable_value tension_N;
    objects_value components; /* of object_item */
    int left_end, right_end;

    /* computed by chain_prepare: the components one by one, groups and repeats written out */
    object_item *parts;
    chain_place *places;
    size_t part_count;
} chain_input;

/* Rows of chain_variants. */
enum {
    CABLE,
    VARYING_CABLE,
    POINT_MASS,
    LUMP,
    BAR,
    SPHERE,
    CONE,
    INLINE_ABSORBER,
    HANGING_ABSORBER,
    SPRING,
    DAMPER,
    INERTER,
    SUPPORT,
    GROUP
};

/* Lists the components of a chain one by one, however they were sent: `parts` and `places` of
 * `in`, in the arena. Faults go into `p`. */
void chain_expand(chain_input *in, schema_arena *arena, problem *p);

#endif
