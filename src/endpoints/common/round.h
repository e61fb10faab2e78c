/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A round cable in a fluid: diameter and densities in place of mass, weight and added mass. With
 * A = pi D^2/4, per metre,
 *     mass = material density A,  weight = g (mass - fluid density A),  added mass = Ca fluid density A. */
#ifndef ENDPOINTS_COMMON_ROUND_H
#define ENDPOINTS_COMMON_ROUND_H

#include "schema/schema.h"

typedef struct round_input {
    double diameter_m, material_density, fluid_density, added_mass_coefficient;
} round_input;

#define ROUND_ROW(type, name_, place, unit_, most, flags_, help_)                              \
    {                                                                                          \
        .name = (name_), .kind = FIELD_NUMBER, .offset = offsetof(type, place),                \
        .unit = (unit_), .min = 0, .max = (most), .flags = (flags_), .help = (help_)           \
    }
#define ROUND_FIELDS(type, member)                                                             \
    ROUND_ROW(type, "diameter_m", member.diameter_m, "m", 100, FIELD_OPEN_MIN,                 \
              "outer diameter; weight, added mass and, with material_density_kg_per_m3, mass " \
              "follow from it"),                                                               \
        ROUND_ROW(type, "material_density_kg_per_m3", member.material_density, "kg/m^3", 1e5,  \
                  FIELD_OPEN_MIN, "of the cable, with diameter_m: mass_kg_per_m follows"),     \
        ROUND_ROW(                                                                             \
            type, "fluid_density_kg_per_m3", member.fluid_density, "kg/m^3", 1e5, 0,           \
            "of the fluid around, with diameter_m: its buoyancy is taken off the weight; "     \
            "buoyant and neutral cables are for /v1/cable/modes"),                             \
        ROUND_ROW(type, "added_mass_coefficient", member.added_mass_coefficient, "1", 10, 0,   \
                  "Ca, with diameter_m: added_mass_kg_per_m is Ca times the displaced fluid")

/* What a request gives of these, and where the rest goes. */
typedef struct round_masses {
    double gravity;
    double *mass, *weight, *added;
    bool mass_given, weight_given;
} round_masses;

/* Fills mass, weight and added mass of a request that has a diameter: true. Figures that were given
 * too must be those (to 1e-9), so that the echo can be asked again. Faults go into `p`. */
bool round_complete(const round_input *in, const round_masses *m, problem *p);

#endif
