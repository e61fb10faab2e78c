/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "endpoints/cable/attachments.h"

#include <math.h>
#include <stdio.h>

typedef struct repetition {
    field_set given;
    int64_t count;
    double spacing_m;
} repetition;

/* Any attachment: its variant's table says which members mean something. */
typedef struct part {
    field_set given;
    double position_m;
    repetition repeat;
    int direction;
    double direction_deg;
    double mass_kg, volume_m3, weight_N, added_mass_kg, rotary_inertia_kg_m2;
    double stiffness_N_per_m, damping_N_s_per_m, inertance_kg;
    double force_x_N, force_z_N, jump_N;
} part;

/* ---- tables ---- */

#define NUMBER(member, unit_, min_, max_, flags_, help_)                                       \
    {                                                                                          \
        FIELD_AT(FIELD_NUMBER, part, member), .unit = (unit_), .min = (min_), .max = (max_),   \
                                              .flags = (flags_), .help = (help_)               \
    }
#define END                                                                                    \
    {                                                                                          \
        .kind = FIELD_END                                                                      \
    }

static const field repetition_fields[] = {
    {FIELD_AT(FIELD_INTEGER, repetition, count), .min = 1, .max = STRUM_CABLE_ATTACHMENTS_MAX,
     .flags = FIELD_REQUIRED, .help = "how many, the first included"},
    {FIELD_AT(FIELD_NUMBER, repetition, spacing_m), .unit = "m", .min = 0, .max = 1e7,
     .flags = FIELD_REQUIRED | FIELD_OPEN_MIN, .help = "from one to the next, unstretched"},
    END};
static const schema repetition_schema = {
    .name = "repetition", .fields = repetition_fields, .size = sizeof(repetition)};

/* In the order of strum_cable_direction. */
static const char *const directions[] = {"normal",   "tangential",   "vertical", "horizontal",
                                         "in_plane", "out_of_plane", "all",      NULL};

#define PLACE                                                                                  \
    NUMBER(position_m, "m", 0, 1e7, FIELD_REQUIRED | FIELD_OPEN_MIN,                           \
           "unstretched length from end 1"),                                                   \
    {                                                                                          \
        FIELD_AT(FIELD_OBJECT, part, repeat),                                                  \
            .schema = &repetition_schema,                                                      \
            .help = "the same again, equally spaced towards end 2"                             \
    }
#define DIRECTIONS                                                                             \
    {FIELD_AT(FIELD_CHOICE, part, direction), .choices = directions, .flags = FIELD_DEFAULT,   \
     .help = "line of action; normal: in the plane, across the cable; in_plane and all: any "  \
             "motion in the plane, any motion"},                                               \
        NUMBER(direction_deg, "deg", -360, 360, 0,                                             \
               "line of action in the plane, from the horizontal, instead of direction")
#define MASS                                                                                   \
    NUMBER(mass_kg, "kg", 0, 1e12, FIELD_REQUIRED, "mass, without the fluid that moves with it")
#define WEIGHT                                                                                 \
    NUMBER(weight_N, "N", -1e15, 1e15, 0,                                                      \
           "weight in the fluid, negative of a float; default mass times gravity")
#define DAMPING(flags, help) NUMBER(damping_N_s_per_m, "N s/m", 0, 1e15, flags, help)
#define STIFFNESS(help)      NUMBER(stiffness_N_per_m, "N/m", 0, 1e15, FIELD_REQUIRED, help)

static const char *const direction_words[] = {"[direction]", "direction_deg", NULL};
static const field_groups link_groups[] = {{"direction", true, direction_words}, {0}};
static const char *const weight_words[] = {"volume_m3", "weight_N", NULL};
static const field_groups body_groups[] = {{"weight", true, weight_words}, {0}};

static const field body_fields[] = {
    PLACE,
    MASS,
    NUMBER(volume_m3, "m^3", 0, 1e9, 0,
           "weight by the fluid that it displaces, instead of weight_N"),
    WEIGHT,
    NUMBER(added_mass_kg, "kg", 0, 1e12, FIELD_DEFAULT, "mass of fluid that moves with it"),
    NUMBER(rotary_inertia_kg_m2, "kg m^2", 0, 1e15, FIELD_DEFAULT,
           "about an axis across the cable; felt where the cable has bending stiffness"),
    END};
static const field spring_fields[] = {PLACE, DIRECTIONS, STIFFNESS("to ground"), END};
static const field damper_fields[] = {PLACE, DIRECTIONS, DAMPING(FIELD_REQUIRED, "to ground"),
                                      END};
static const field inerter_fields[] = {
    PLACE, DIRECTIONS,
    NUMBER(inertance_kg, "kg", 0, 1e12, FIELD_REQUIRED, "force to ground per acceleration"),
    END};
static const field absorber_fields[] = {
    PLACE,
    DIRECTIONS,
    MASS,
    WEIGHT,
    STIFFNESS("of its spring"),
    DAMPING(FIELD_DEFAULT, "of the damper beside the spring"),
    END};
static const field force_fields[] = {
    PLACE, NUMBER(force_x_N, "N", -1e15, 1e15, FIELD_DEFAULT, "towards end 2's side"),
    NUMBER(force_z_N, "N", -1e15, 1e15, FIELD_DEFAULT, "upwards"), END};
static const field jump_fields[] = {
    PLACE,
    NUMBER(jump_N, "N", -1e15, 1e15, FIELD_REQUIRED,
           "dead force along the cable: the tension towards end 2 is larger by it"),
    END};

#define TABLE(name, fields, groups)                                                            \
    static const schema name##_schema = {#name, fields, groups, sizeof(part)}
TABLE(cable_point_mass, body_fields, body_groups);
TABLE(cable_spring, spring_fields, link_groups);
TABLE(cable_damper, damper_fields, link_groups);
TABLE(cable_inerter, inerter_fields, link_groups);
TABLE(cable_hanging_absorber, absorber_fields, link_groups);
TABLE(force, force_fields, NULL);
TABLE(tension_jump, jump_fields, NULL);

/* In the order of strum_cable_attachment_kind. */
const variant hung_attachments[] = {
    {"point_mass", "a body: a mass, a clump weight, a float", &cable_point_mass_schema},
    {"spring", "a spring to ground, unstressed in the static shape", &cable_spring_schema},
    {"damper", "a viscous damper to ground", &cable_damper_schema},
    {"inerter", "an inerter to ground", &cable_inerter_schema},
    {"hanging_absorber", "a mass on a spring and a damper, hung to the cable",
     &cable_hanging_absorber_schema},
    {"force", "a dead force from outside", &force_schema},
    {"tension_jump", "a dead force along the cable", &tension_jump_schema},
    {0}};

/* ---- from the request to the core ---- */

static bool has(const object_item *item, const void *member)
{
    const part *a = item->object;
    return field_given_at(hung_attachments[item->variant].schema, a,
                          (size_t)((const char *)member - (const char *)a));
}

static size_t repetitions(const object_item *item)
{
    const part *a = item->object;
    return has(item, &a->repeat) ? (size_t)a->repeat.count : 1;
}

static size_t attachment_count(const hung_input *in)
{
    const object_item *items = in->attachments.items;
    size_t count = 0;
    for (size_t i = 0; i < in->attachments.count; i++)
        count += repetitions(&items[i]);
    return count;
}

/* Weight of what has a mass; it is filled in where nothing else says it. */
static double weight_of(const object_item *item, const hung_input *in)
{
    part *a = item->object;
    if (has(item, &a->volume_m3))
        return in->gravity_m_per_s2 * (a->mass_kg - in->fluid_density_kg_per_m3 * a->volume_m3);
    if (!has(item, &a->weight_N)) {
        a->weight_N = a->mass_kg * in->gravity_m_per_s2;
        FIELD_GIVE(hung_attachments[item->variant].schema, a, weight_N);
    }
    return a->weight_N;
}

static strum_cable_attachment make(const object_item *item, const hung_input *in)
{
    const part *a = item->object;
    const strum_cable_attachment_kind kind = (strum_cable_attachment_kind)item->variant;
    const bool heavy = kind == STRUM_CABLE_POINT_MASS || kind == STRUM_CABLE_ABSORBER;
    return (strum_cable_attachment){.kind = kind,
                                    .position = a->position_m,
                                    .direction = has(item, &a->direction_deg)
                                                     ? STRUM_CABLE_ANGLE
                                                     : (strum_cable_direction)a->direction,
                                    .angle = a->direction_deg * M_PI / 180,
                                    .mass = a->mass_kg,
                                    .weight = heavy ? weight_of(item, in) : 0,
                                    .added_mass = a->added_mass_kg,
                                    .rotary_inertia = a->rotary_inertia_kg_m2,
                                    .stiffness = a->stiffness_N_per_m,
                                    .damping = a->damping_N_s_per_m,
                                    .inertance = a->inertance_kg,
                                    .force_x = a->force_x_N,
                                    .force_z = a->force_z_N,
                                    .jump = a->jump_N};
}

/* The last of a row of them must lie before the end; NAN: its place is not known. */
static void check_place(const object_item *item, size_t i, double length, problem *p)
{
    const part *a = item->object;
    const double extent =
        has(item, &a->repeat) ? (double)(a->repeat.count - 1) * a->repeat.spacing_m : 0;
    char pointer[64];
    if (!(a->position_m + extent >= length))
        return;
    (void)snprintf(pointer, sizeof pointer, "/attachments/%zu/%s", i,
                   a->position_m >= length ? "position_m" : "repeat");
    problem_add(p, pointer, "must lie before the end of the cable, at %.15g m", length);
}

static double total_length(const hung_input *in)
{
    const strum_cable_params *params = &in->params;
    const bool one_unknown = params->given != STRUM_CABLE_LENGTHS && !params->span_unknown;
    double length = 0;
    for (size_t i = 0; i < params->section_count; i++)
        length += params->sections[i].length > 0 ? params->sections[i].length : NAN;
    return one_unknown ? NAN : length;
}

void attachments_prepare(hung_input *in, schema_arena *arena, problem *p)
{
    const object_item *items = in->attachments.items;
    const size_t count = attachment_count(in);
    const double length = total_length(in);
    if (count > STRUM_CABLE_ATTACHMENTS_MAX) {
        problem_add(p, "/attachments", "%zu attachments with their repetitions; at most %d",
                    count, STRUM_CABLE_ATTACHMENTS_MAX);
        return;
    }
    strum_cable_attachment *made = schema_alloc(arena, count * sizeof *made);
    in->origin = schema_alloc(arena, count * sizeof *in->origin);
    if (made == NULL || in->origin == NULL) {
        problem_out_of_memory(p);
        return;
    }
    in->params.attachments = made;
    in->params.attachment_count = count;
    for (size_t i = 0, next = 0; i < in->attachments.count; i++) {
        const part *a = items[i].object;
        check_place(&items[i], i, length, p);
        const strum_cable_attachment one = make(&items[i], in);
        for (size_t k = 0; k < repetitions(&items[i]); k++, next++) {
            made[next] = one;
            made[next].position = a->position_m + (double)k * a->repeat.spacing_m;
            in->origin[next] = i;
        }
    }
}
