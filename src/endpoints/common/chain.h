/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the endpoints of taut chains share: the tables of all components, and the chain of the
 * core that a request describes. Every number of a component may be a variable where the
 * endpoint allows it. */
#ifndef ENDPOINTS_COMMON_CHAIN_H
#define ENDPOINTS_COMMON_CHAIN_H

#include "endpoints/common/chain_part.h"
#include "endpoints/endpoint.h"

extern const variant chain_variants[];
extern const char *const chain_ends[];

#define CHAIN_FIELDS                                                                           \
    {FIELD_AT(FIELD_NUMBER, chain_input, tension_N),                                           \
     .unit = "N",                                                                              \
     .min = 0,                                                                                 \
     .max = 1e12,                                                                              \
     .flags = FIELD_OPEN_MIN | FIELD_REQUIRED | FIELD_VARIABLE,                                \
     .help = "tension of every component that states none of its own"},                        \
    {                                                                                          \
        FIELD_AT(FIELD_VARIANTS, chain_input, components),                                     \
            .variants = chain_variants, .min_items = 1,                                        \
            .max_items = STRUM_TAUT_COMPONENTS_MAX, .flags = FIELD_REQUIRED,                   \
            .help = "from left to right"                                                       \
    }
#define CHAIN_END_FIELDS                                                                       \
    {FIELD_AT(FIELD_CHOICE, chain_input, left_end), .choices = chain_ends,                     \
     .flags = FIELD_DEFAULT, .fallback = STRUM_TAUT_FIXED,                                     \
     .help = "fixed: held; free: moves without force"},                                        \
    {                                                                                          \
        FIELD_AT(FIELD_CHOICE, chain_input, right_end),                                        \
            .choices = chain_ends, .flags = FIELD_DEFAULT, .fallback = STRUM_TAUT_FIXED,       \
            .help = "as left_end"                                                              \
    }

/* Values for the names that a request's numbers may stand for. */
typedef struct chain_variables {
    const name_value *names;
    const double *values;
    size_t count;
} chain_variables;

/* `v` with its variable, if it names one, taken from `x` (may be NULL where none is named). */
double chain_number(const variable_value *v, const chain_variables *x);

/* Checks across the fields of each component, and writes out what is repeated; faults go into
 * `p`. */
void chain_prepare(chain_input *in, schema_arena *arena, problem *p);
/* The chain; the caller ends it by strum_taut_free. */
strum_status chain_make(const chain_input *in, const chain_variables *x, strum_taut **chain,
                        strum_error *fault);
/* The components alone, with all that they point to; ended by chain_parts_free. */
typedef struct chain_parts {
    strum_taut_component *parts;
    size_t count;
    strum_taut_link *links;
    strum_taut_joint *joints;
} chain_parts;
strum_status chain_parts_make(const chain_input *in, const chain_variables *x,
                              chain_parts *out);
void chain_parts_free(chain_parts *p);
/* How many cables of varying tension are solved exactly. */
size_t chain_varying(const chain_input *in);
/* Mean mass per length of the cables of a chain, kg/m; 0 without any. */
double chain_mean_mass(const chain_input *in, const chain_variables *x);

/* A component as a textbook sees it: a piece of cable (length > 0), an absorber hung to it, or
 * a damper to ground, with the names of the variables that its stiffness and damping are (NULL
 * for plain numbers and for what is more than the variable itself). */
typedef struct chain_glance {
    double length, mass_per_length, tension;
    bool absorber, damper;
    double mass;
    const char *stiffness_name, *damping_name;
} chain_glance;
/* False for any other component. */
bool chain_look(const chain_input *in, const chain_variables *x, size_t index,
                chain_glance *glance);

/* Below this relative change of the damping two roots are at an exceptional point. */
#define CHAIN_EXCEPTIONAL 1e-4

/* Members of an open object: mode, angular_frequency_rad_per_s and its companions, decay and
 * dampings. */
void chain_write_root(json_writer *json, const strum_taut_root *root);
/* Turns a fault of the core into a problem, laid at the entry that made the component it names. */
void chain_refuse(const chain_input *in, const strum_error *fault, strum_status status,
                  problem *p);

#endif
