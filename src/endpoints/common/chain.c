/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "endpoints/common/chain.h"
#include "endpoints/common/members.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- tables ---- */

#define NUMBER(type, member, unit_, max_, flags_, help_)                                       \
    {                                                                                          \
        FIELD_AT(FIELD_NUMBER, type, member), .unit = (unit_), .min = 0, .max = (max_),        \
                                              .flags = FIELD_VARIABLE | (flags_),              \
                                              .help = (help_)                                  \
    }
/* required and above 0; required; 0 when left out */
#define POSITIVE (FIELD_REQUIRED | FIELD_OPEN_MIN)
#define GIVEN    FIELD_REQUIRED
#define ZERO     FIELD_DEFAULT

#define TENSION                                                                                \
    NUMBER(chain_part, tension_N, "N", 1e12, FIELD_OPEN_MIN,                                   \
           "tension at both ends, instead of the chain's")
#define TENSION_ENDS(required)                                                                 \
    NUMBER(chain_part, tension_left_N, "N", 1e12, FIELD_OPEN_MIN | (required),                 \
           "tension at the left end"),                                                         \
        NUMBER(chain_part, tension_right_N, "N", 1e12, FIELD_OPEN_MIN | (required),            \
               "tension at the right end")
#define TENSIONS TENSION, TENSION_ENDS(0)
#define MASS(flags)                                                                            \
    NUMBER(chain_part, mass_kg, "kg", 1e12, flags, "mass, with the fluid that moves with it")
#define LENGTH NUMBER(chain_part, length_m, "m", 1e7, POSITIVE, "length along the chain")
#define STIFFNESS(flags)                                                                       \
    NUMBER(chain_part, stiffness_N_per_m, "N/m", 1e15, flags, "stiffness of the spring")
#define MASS_PER_LENGTH                                                                        \
    NUMBER(chain_part, mass_kg_per_m, "kg/m", 1e9, POSITIVE,                                   \
           "mass per length, with the fluid that moves with it")
#define END                                                                                    \
    {                                                                                          \
        .kind = FIELD_END                                                                      \
    }
#define REPEAT                                                                                 \
    {                                                                                          \
        FIELD_AT(FIELD_OBJECT, chain_part, repeat), .schema = &chain_repeat_schema,            \
                                                    .help = "this many of it in a row"         \
    }
#define PART_END REPEAT, END

static const char *const solutions[] = {"exact", "wkb", NULL};
static const char *const apexes[] = {"left", "right", NULL};
const char *const chain_ends[] = {"fixed", "free", NULL};

static const char *const tension_words[] = {"tension_N", "tension_left_N tension_right_N",
                                            NULL};
static const field_groups tension_groups[] = {{"tension", true, tension_words}, {0}};

static const field cable_fields[] = {
    LENGTH, MASS_PER_LENGTH,
    NUMBER(chain_part, drag_N_s_per_m2, "N s/m^2", 1e12, ZERO, "viscous drag per length"),
    TENSION, PART_END};
static const field varying_fields[] = {
    LENGTH,
    MASS_PER_LENGTH,
    TENSION_ENDS(FIELD_REQUIRED),
    {FIELD_AT(FIELD_CHOICE, chain_part, solution), .choices = solutions, .flags = FIELD_DEFAULT,
     .help = "exact: Bessel functions; wkb: the approximation of Li's library"},
    PART_END};
static const field point_fields[] = {MASS(GIVEN), PART_END};
static const field lump_fields[] = {
    NUMBER(chain_part, length_m, "m", 1e7, GIVEN, "length between the cables' ends"),
    MASS(GIVEN),
    NUMBER(chain_part, centre_m, "m", 1e7, GIVEN, "centre of mass from the left end"),
    NUMBER(chain_part, radius_of_gyration_m, "m", 1e7, GIVEN, "about the centre of mass"),
    TENSIONS,
    PART_END};
static const field bar_fields[] = {LENGTH, MASS(GIVEN), TENSIONS, PART_END};
static const field sphere_fields[] = {
    NUMBER(chain_part, diameter_m, "m", 1e7, POSITIVE, "diameter"), MASS(GIVEN), TENSIONS,
    PART_END};
static const field cone_fields[] = {
    NUMBER(chain_part, height_m, "m", 1e7, POSITIVE, "height, along the chain"),
    NUMBER(chain_part, base_radius_m, "m", 1e7, POSITIVE, "radius of the base"),
    MASS(GIVEN),
    {FIELD_AT(FIELD_CHOICE, chain_part, apex), .choices = apexes, .flags = FIELD_DEFAULT,
     .help = "the end at which the apex is"},
    TENSIONS,
    PART_END};

static const field link_fields[] = {
    NUMBER(chain_link, left_m, "m", 1e6, GIVEN, "from its left end to its centre of mass"),
    NUMBER(chain_link, right_m, "m", 1e6, GIVEN, "from its centre of mass to its right end"),
    NUMBER(chain_link, mass_kg, "kg", 1e12, GIVEN, "mass"),
    NUMBER(chain_link, inertia_kg_m2, "kg m^2", 1e15, GIVEN, "about its centre of mass"), END};
static const schema link_schema = {"link", link_fields, NULL, sizeof(chain_link)};
static const field joint_fields[] = {
    NUMBER(chain_joint, spring_arm_m, "m", 1e6, GIVEN, "lever arm of the spring (a)"),
    NUMBER(chain_joint, damper_arm_m, "m", 1e6, GIVEN, "lever arm of the damper (b)"),
    NUMBER(chain_joint, stiffness_N_per_m, "N/m", 1e15, GIVEN, "of the spring at its arm"),
    NUMBER(chain_joint, damping_N_s_per_m, "N s/m", 1e15, GIVEN | FIELD_INFINITE,
           "of the damper at its arm; infinite: the joint is locked"),
    NUMBER(chain_joint, force_N, "N", 1e12, FIELD_OPEN_MIN,
           "force that the joint carries along the chain; default the mean of the tensions"),
    END};
static const schema joint_schema = {"joint", joint_fields, NULL, sizeof(chain_joint)};
static const field inline_fields[] = {
    {FIELD_AT(FIELD_OBJECTS, chain_part, links), .schema = &link_schema, .min_items = 2,
     .max_items = STRUM_TAUT_LINKS_MAX, .flags = FIELD_REQUIRED,
     .help = "rigid links, left to right"},
    {FIELD_AT(FIELD_OBJECTS, chain_part, joints), .schema = &joint_schema, .min_items = 1,
     .max_items = STRUM_TAUT_LINKS_MAX - 1, .flags = FIELD_REQUIRED,
     .help = "the hinges between them, one fewer"},
    TENSIONS,
    PART_END};
static const field hanging_fields[] = {
    MASS(GIVEN), STIFFNESS(GIVEN),
    NUMBER(chain_part, damping_N_s_per_m, "N s/m", 1e15, ZERO | FIELD_INFINITE,
           "of the damper beside the spring; infinite: a point mass"),
    PART_END};
static const field spring_fields[] = {STIFFNESS(GIVEN), PART_END};
static const field damper_fields[] = {
    NUMBER(chain_part, damping_N_s_per_m, "N s/m", 1e15, GIVEN,
           "of the damper; where it would be infinite the chain ends"),
    PART_END};
static const field inerter_fields[] = {
    NUMBER(chain_part, inertance_kg, "kg", 1e12, GIVEN, "force per acceleration"), PART_END};
static const field support_fields[] = {
    LENGTH, NUMBER(chain_part, pivot_m, "m", 1e7, POSITIVE, "pivot from the left end"),
    NUMBER(chain_part, inertia_kg_m2, "kg m^2", 1e15, GIVEN, "about the pivot"), TENSION,
    NUMBER(chain_part, tension_left_N, "N", 1e12, 0,
           "tension at the left end; 0: the chain begins with it"),
    NUMBER(chain_part, tension_right_N, "N", 1e12, 0,
           "tension at the right end; 0: the chain ends with it"),
    PART_END};

#define TABLE(name, fields, groups)                                                            \
    static const schema name##_schema = {#name, fields, groups, sizeof(chain_part)}
TABLE(cable, cable_fields, NULL);
TABLE(varying_cable, varying_fields, NULL);
TABLE(point_mass, point_fields, NULL);
TABLE(lump, lump_fields, tension_groups);
TABLE(bar, bar_fields, tension_groups);
TABLE(sphere, sphere_fields, tension_groups);
TABLE(cone, cone_fields, tension_groups);
TABLE(inline_absorber, inline_fields, tension_groups);
TABLE(hanging_absorber, hanging_fields, NULL);
TABLE(spring, spring_fields, NULL);
TABLE(damper, damper_fields, NULL);
TABLE(inerter, inerter_fields, NULL);
TABLE(support, support_fields, tension_groups);

/* All that a group may hold. */
#define SINGLE_VARIANTS                                                                        \
    {"cable", "a piece of cable of uniform tension", &cable_schema},                           \
        {"varying_cable", "a piece of cable whose tension varies linearly",                    \
         &varying_cable_schema},                                                               \
        {"point_mass", "a mass without size", &point_mass_schema},                             \
        {"lump", "a rigid body", &lump_schema},                                                \
        {"bar", "a uniform rigid bar along the chain", &bar_schema},                           \
        {"sphere", "a uniform solid sphere", &sphere_schema},                                  \
        {"cone", "a uniform solid cone", &cone_schema},                                        \
        {"inline_absorber", "rigid links hinged to each other, with springs and dampers",      \
         &inline_absorber_schema},                                                             \
        {"hanging_absorber", "a mass on a spring and a damper, hung to the chain",             \
         &hanging_absorber_schema},                                                            \
        {"spring", "a spring to ground", &spring_schema},                                      \
        {"damper", "a viscous damper to ground", &damper_schema},                              \
        {"inerter", "an inerter to ground", &inerter_schema},                                  \
    {                                                                                          \
        "support", "a rigid lever pinned to ground, through which the chain passes",           \
            &support_schema                                                                    \
    }

static const variant single_variants[] = {SINGLE_VARIANTS, {0}};
static const field group_fields[] = {{FIELD_AT(FIELD_VARIANTS, chain_part, components),
                                      .variants = single_variants, .min_items = 1,
                                      .max_items = STRUM_TAUT_COMPONENTS_MAX,
                                      .flags = FIELD_REQUIRED, .help = "from left to right"},
                                     PART_END};
TABLE(group, group_fields, NULL);
const variant chain_variants[] = {
    SINGLE_VARIANTS,
    {"group", "components in a row that are repeated together", &group_schema},
    {0}};

/* ---- checks across fields ---- */

static bool plain(const variable_value *v)
{
    return v->name.text[0] == '\0';
}

/* `where`: its pointer. */
static void check_part(const object_item *item, const char *where, problem *p)
{
    const chain_part *c = item->object;
    char pointer[128];
    if (item->variant == SUPPORT && plain(&c->pivot_m) && plain(&c->length_m) &&
        !(c->pivot_m.value < c->length_m.value)) {
        (void)snprintf(pointer, sizeof pointer, "%s/pivot_m", where);
        problem_add(p, pointer,
                    "the pivot lies inside the support: must be less than length_m");
    }
    if (item->variant == LUMP && plain(&c->centre_m) && plain(&c->length_m) &&
        !(c->centre_m.value <= c->length_m.value)) {
        (void)snprintf(pointer, sizeof pointer, "%s/centre_m", where);
        problem_add(p, pointer, "the centre of mass lies in the lump: at most length_m");
    }
    if (item->variant == INLINE_ABSORBER && c->joints.count + 1 != c->links.count) {
        (void)snprintf(pointer, sizeof pointer, "%s/joints", where);
        problem_add(p, pointer, "%zu links have %zu joints between them, not %zu",
                    c->links.count, c->links.count - 1, c->joints.count);
    }
}

void chain_prepare(chain_input *in, schema_arena *arena, problem *p)
{
    const object_item *items = in->components.items;
    char pointer[96];
    for (size_t i = 0; i < in->components.count; i++) {
        const objects_value *inner = &((const chain_part *)items[i].object)->components;
        (void)snprintf(pointer, sizeof pointer, "/components/%zu", i);
        check_part(&items[i], pointer, p);
        for (size_t j = 0; j < inner->count; j++) {
            (void)snprintf(pointer, sizeof pointer, "/components/%zu/components/%zu", i, j);
            check_part((const object_item *)inner->items + j, pointer, p);
        }
    }
    chain_expand(in, arena, p);
}

/* ---- making the core's chain ---- */

double chain_number(const variable_value *v, const chain_variables *x)
{
    for (size_t i = 0; !plain(v) && x != NULL && i < x->count; i++)
        if (strcmp(x->names[i].text, v->name.text) == 0)
            return v->value + v->scale * x->values[i];
    return plain(v) ? v->value : NAN;
}

/* Room for all bodies' links and joints; the chain's tension. */
typedef struct workshop {
    const chain_variables *x;
    double tension;
    strum_taut_link *links;
    strum_taut_joint *joints;
} workshop;

static double of(const workshop *w, const variable_value *v)
{
    return chain_number(v, w->x);
}

static void set_tensions(const workshop *w, int kind, const chain_part *c,
                         strum_taut_component *out)
{
    const schema *s = chain_variants[kind].schema;
    out->tension_left = out->tension_right = w->tension;
    if (kind == POINT_MASS || kind == HANGING_ABSORBER || kind == SPRING || kind == DAMPER ||
        kind == INERTER)
        return;
    if (kind != VARYING_CABLE && field_given(s, c, "tension_N")) {
        out->tension_left = out->tension_right = of(w, &c->tension_N);
    } else if (kind != CABLE && field_given(s, c, "tension_left_N")) {
        out->tension_left = of(w, &c->tension_left_N);
        out->tension_right = of(w, &c->tension_right_N);
    }
}

static void make_links(workshop *w, const chain_part *c, strum_taut_component *out)
{
    const chain_link *links = c->links.items;
    const chain_joint *joints = c->joints.items;
    out->body.links = w->links;
    out->body.joints = w->joints;
    out->body.count = c->links.count;
    for (size_t i = 0; i < c->links.count; i++)
        *w->links++ =
            (strum_taut_link){of(w, &links[i].left_m), of(w, &links[i].right_m),
                              of(w, &links[i].mass_kg), of(w, &links[i].inertia_kg_m2)};
    for (size_t i = 0; i + 1 < c->links.count; i++) {
        const chain_joint *j = &joints[i];
        *w->joints++ =
            (strum_taut_joint){of(w, &j->spring_arm_m), of(w, &j->damper_arm_m),
                               of(w, &j->stiffness_N_per_m), of(w, &j->damping_N_s_per_m),
                               field_given(&joint_schema, j, "force_N")
                                   ? of(w, &j->force_N)
                                   : 0.5 * (out->tension_left + out->tension_right)};
    }
}

static void make_lump(workshop *w, int kind, const chain_part *c, strum_taut_component *out)
{
    const double mass = of(w, &c->mass_kg), length = of(w, &c->length_m);
    strum_taut_link link;
    if (kind == BAR) {
        link = strum_taut_bar(length, mass);
    } else if (kind == SPHERE) {
        link = strum_taut_sphere(of(w, &c->diameter_m), mass);
    } else if (kind == CONE) {
        link =
            strum_taut_cone(of(w, &c->height_m), of(w, &c->base_radius_m), mass, c->apex == 0);
    } else {
        const double centre = of(w, &c->centre_m), r = of(w, &c->radius_of_gyration_m);
        link = (strum_taut_link){centre, length - centre, mass, mass * r * r};
    }
    out->body.links = w->links;
    out->body.count = 1;
    *w->links++ = link;
}

static strum_taut_component make_part(workshop *w, const object_item *item)
{
    const chain_part *c = item->object;
    strum_taut_component out = {.kind = STRUM_TAUT_GROUND};
    set_tensions(w, item->variant, c, &out);
    switch (item->variant) {
    case CABLE:
        out.kind = STRUM_TAUT_CABLE;
        out.cable.length = of(w, &c->length_m);
        out.cable.mass_per_length = of(w, &c->mass_kg_per_m);
        out.cable.drag = of(w, &c->drag_N_s_per_m2);
        break;
    case VARYING_CABLE:
        out.kind = STRUM_TAUT_VARYING;
        out.varying.length = of(w, &c->length_m);
        out.varying.mass_per_length = of(w, &c->mass_kg_per_m);
        out.varying.wkb = c->solution == 1;
        break;
    case LUMP:
    case BAR:
    case SPHERE:
    case CONE:
        out.kind = STRUM_TAUT_BODY;
        make_lump(w, item->variant, c, &out);
        break;
    case INLINE_ABSORBER:
        out.kind = STRUM_TAUT_BODY;
        make_links(w, c, &out);
        break;
    case HANGING_ABSORBER:
        out.kind = STRUM_TAUT_HANGING;
        out.hanging.mass = of(w, &c->mass_kg);
        out.hanging.stiffness = of(w, &c->stiffness_N_per_m);
        out.hanging.damping = of(w, &c->damping_N_s_per_m);
        break;
    case SUPPORT:
        out.kind = STRUM_TAUT_SUPPORT;
        out.support.length = of(w, &c->length_m);
        out.support.pivot = of(w, &c->pivot_m);
        out.support.inertia = of(w, &c->inertia_kg_m2);
        break;
    default: /* to ground: what the table does not have is 0 */
        out.ground.stiffness = of(w, &c->stiffness_N_per_m);
        out.ground.damping = of(w, &c->damping_N_s_per_m);
        out.ground.inertance =
            item->variant == POINT_MASS ? of(w, &c->mass_kg) : of(w, &c->inertance_kg);
        break;
    }
    return out;
}

void chain_parts_free(chain_parts *p)
{
    free(p->parts);
    free(p->links);
    free(p->joints);
    *p = (chain_parts){0};
}

strum_status chain_parts_make(const chain_input *in, const chain_variables *x, chain_parts *out)
{
    const size_t count = in->part_count;
    const object_item *items = in->parts;
    size_t links = 0;
    for (size_t i = 0; i < count; i++)
        links += items[i].variant == INLINE_ABSORBER
                     ? ((const chain_part *)items[i].object)->links.count
                     : 1;
    *out =
        (chain_parts){malloc(count * sizeof *out->parts), count,
                      malloc(links * sizeof *out->links), malloc(links * sizeof *out->joints)};
    if (out->parts == NULL || out->links == NULL || out->joints == NULL) {
        chain_parts_free(out);
        return STRUM_ERR_MEMORY;
    }
    workshop w = {x, chain_number(&in->tension_N, x), out->links, out->joints};
    for (size_t i = 0; i < count; i++)
        out->parts[i] = make_part(&w, &items[i]);
    return STRUM_OK;
}

strum_status chain_make(const chain_input *in, const chain_variables *x, strum_taut **chain,
                        strum_error *fault)
{
    *chain = NULL;
    chain_parts p;
    strum_status status = chain_parts_make(in, x, &p);
    if (status != STRUM_OK)
        return status;
    status = strum_taut_make(p.parts, p.count, (strum_taut_end)in->left_end,
                             (strum_taut_end)in->right_end, chain, fault);
    chain_parts_free(&p);
    return status;
}

size_t chain_varying(const chain_input *in)
{
    const object_item *items = in->parts;
    size_t count = 0;
    for (size_t i = 0; i < in->part_count; i++)
        count += items[i].variant == VARYING_CABLE &&
                 ((const chain_part *)items[i].object)->solution == 0;
    return count;
}

double chain_mean_mass(const chain_input *in, const chain_variables *x)
{
    const object_item *items = in->parts;
    double mass = 0, length = 0;
    for (size_t i = 0; i < in->part_count; i++) {
        const chain_part *c = items[i].object;
        if (items[i].variant != CABLE && items[i].variant != VARYING_CABLE)
            continue;
        length += chain_number(&c->length_m, x);
        mass += chain_number(&c->length_m, x) * chain_number(&c->mass_kg_per_m, x);
    }
    return length > 0 ? mass / length : 0;
}

/* A number that is a variable as it stands. */
static const char *name_of(const variable_value *v)
{
    return !plain(v) && v->value == 0 && v->scale == 1 ? v->name.text : NULL;
}

bool chain_look(const chain_input *in, const chain_variables *x, size_t index,
                chain_glance *glance)
{
    const object_item *item = &in->parts[index];
    const chain_part *c = item->object;
    *glance = (chain_glance){.absorber = item->variant == HANGING_ABSORBER,
                             .damper = item->variant == DAMPER};
    if (item->variant == CABLE) {
        const bool own = field_given(chain_variants[CABLE].schema, c, "tension_N");
        glance->length = chain_number(&c->length_m, x);
        glance->mass_per_length = chain_number(&c->mass_kg_per_m, x);
        glance->tension = chain_number(own ? &c->tension_N : &in->tension_N, x);
    } else if (glance->absorber || glance->damper) {
        glance->damping_name = name_of(&c->damping_N_s_per_m);
        if (glance->absorber) {
            glance->mass = chain_number(&c->mass_kg, x);
            glance->stiffness_name = name_of(&c->stiffness_N_per_m);
        }
    } else {
        return false;
    }
    return true;
}

void chain_write_root(json_writer *json, const strum_taut_root *root)
{
    const double w = root->frequency, decay = root->decay;
    if (root->mode > 0)
        json_put_integer(json, "mode", root->mode);
    if (w > 0.0) {
        put_frequency(json, w);
    } else if (decay == 0.0) { /* a rigid motion */
        json_put_number(json, "angular_frequency_rad_per_s", 0.0);
        json_put_number(json, "frequency_Hz", 0.0);
    }
    json_put_number(json, "decay_rate_per_s", decay);
    if (w > 0.0) {
        json_put_number(json, "damping_ratio", decay / hypot(w, decay));
        put_finite(json, "loss_ratio", decay / w);
        put_finite(json, "log_decrement", 2 * M_PI * decay / w);
    }
    if (isfinite(root->exceptional)) {
        json_put_number(json, "relative_damping_to_coalescence", root->exceptional);
        json_put_flag(json, "exceptional_point", root->exceptional < CHAIN_EXCEPTIONAL);
    }
}

void chain_refuse(const chain_input *in, const strum_error *fault, strum_status status,
                  problem *p)
{
    const char *reason = fault->reason[0] != '\0' ? fault->reason : strum_status_text(status);
    const bool later =
        status == STRUM_ERR_MEMORY || status == STRUM_ERR_CANCELLED || status == STRUM_ERR_TIME;
    const int http = later ? 503 : status == STRUM_ERR_INTERNAL ? 500 : 422;
    problem_set(p, http, "%s", reason);
    if (http == 422 && fault->argument == STRUM_TAUT_ARG_COMPONENTS &&
        fault->index < in->part_count) {
        const chain_place *at = &in->places[fault->index];
        char pointer[64];
        const int used = snprintf(pointer, sizeof pointer, "/components/%zu", at->entry);
        if (at->grouped)
            (void)snprintf(pointer + used, sizeof pointer - (size_t)used, "/components/%zu",
                           at->inner);
        problem_add(p, pointer, "%s", reason);
    }
}
