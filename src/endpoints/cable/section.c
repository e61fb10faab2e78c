/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "endpoints/cable/section.h"

#include <math.h>
#include <stdio.h>

/* ---- tables ---- */

#define LAYER(member, unit_, max_, help_)                                                      \
    {                                                                                          \
        FIELD_AT(FIELD_NUMBER, section_layer, member),                                         \
            .unit = (unit_), .min = 0, .max = (max_),                                          \
            .flags = FIELD_REQUIRED | FIELD_OPEN_MIN, .help = (help_)                          \
    }
static const field layer_fields[] = {LAYER(thickness_m, "m", 100, "radial thickness"),
                                     LAYER(density_kg_per_m3, "kg/m^3", 1e5, "of the layer"),
                                     {.kind = FIELD_END}};
const schema section_layer_schema = {
    .name = "layer", .fields = layer_fields, .size = sizeof(section_layer)};

static const char *const links[] = {"studless", "studlink", NULL};
static const field chain_fields[] = {
    {FIELD_AT(FIELD_NUMBER, section_chain, nominal_diameter_m), .unit = "m", .min = 0, .max = 1,
     .flags = FIELD_REQUIRED | FIELD_OPEN_MIN, .help = "of the bar that the links are made of"},
    {FIELD_AT(FIELD_CHOICE, section_chain, link), .choices = links, .flags = FIELD_DEFAULT,
     .help = "form of the links"},
    {.kind = FIELD_END}};
const schema section_chain_schema = {
    .name = "mooring_chain", .fields = chain_fields, .size = sizeof(section_chain)};

static const field fields[] = {
    SECTION_ROWS(0, "unstretched length; left out where it is to be found"),
    {.kind = FIELD_END}};
static const char *const mass_groups[] = {SECTION_GROUPS, NULL};
static const field_groups groups[] = {{"mass", false, mass_groups}, {0}};
const schema section_schema = {
    .name = "section", .fields = fields, .groups = groups, .size = sizeof(section_input)};

/* ---- reading ---- */

static size_t row_offset(const section_reading *r, const void *member)
{
    return (size_t)((const char *)member - (const char *)r->rows);
}

static bool given(const section_reading *r, const void *member)
{
    return field_given_at(r->s, r->rows, row_offset(r, member));
}

static void fill(const section_reading *r, double *member, double value)
{
    if (given(r, member))
        return;
    *member = value;
    field_give_at(r->s, r->rows, row_offset(r, member));
}

static void fault(const section_reading *r, const char *member, const char *says, problem *p)
{
    char pointer[96];
    (void)snprintf(pointer, sizeof pointer, "%s/%s", r->pointer, member);
    problem_add(p, pointer, "%s", says);
}

/* What asks for a diameter, or for one that is not a chain's. */
static void check(const section_reading *r, bool diameter, bool chain, problem *p)
{
    const section_input *in = r->in;
    if (given(r, &in->youngs_modulus_Pa) && !diameter)
        fault(r, "youngs_modulus_Pa",
              chain ? "a chain has stiffnesses of its own: give axial_stiffness_N where they "
                      "are others"
                    : "needs diameter_m",
              p);
    if (diameter || chain)
        return;
    if (in->layers.count > 0)
        fault(r, "layers", "needs diameter_m or chain", p);
    if (given(r, &in->added_mass_coefficient))
        fault(r, "added_mass_coefficient",
              "needs diameter_m or chain; or give added_mass_kg_per_m", p);
    if (given(r, &in->added_mass_coefficient_axial))
        fault(r, "added_mass_coefficient_axial",
              "needs diameter_m or chain; or give added_mass_tangential_kg_per_m", p);
}

/* ---- properties ---- */

/* Mass in kg/m and stiffness in N over the square of the nominal diameter, and the diameter over
 * the nominal one  [OrcaFlex documentation, Chain]. */
typedef struct chain_rule {
    double mass, stiffness, diameter;
    const char *words;
} chain_rule;
static const chain_rule chain_rules[] = {
    {19.9e3, 0.854e11, 1.80,
     "studless chain (OrcaFlex): mass 19.9 t/m d^2, EA 0.854e8 kN d^2, diameter 1.80 d"},
    {21.9e3, 1.01e11, 1.89,
     "studlink chain (OrcaFlex): mass 21.9 t/m d^2, EA 1.01e8 kN d^2, diameter 1.89 d"},
};

/* Of the section without layers: what its figures are where they are not given. */
typedef struct core {
    double diameter, mass, axial, bending;
} core;

static core core_of(const section_reading *r, bool diameter, bool chain,
                    section_properties *properties)
{
    const section_input *in = r->in;
    core c = {0, in->mass_kg_per_m, INFINITY, 0};
    if (chain) {
        const chain_rule *rule = chain_rules + in->chain.link;
        const double square = in->chain.nominal_diameter_m * in->chain.nominal_diameter_m;
        properties->rule = rule->words;
        c.diameter = rule->diameter * in->chain.nominal_diameter_m;
        c.mass = rule->mass * square;
        c.axial = rule->stiffness * square;
    } else if (diameter) {
        const double area = M_PI * in->diameter_m * in->diameter_m / 4;
        c.diameter = in->diameter_m;
        if (given(r, &in->material_density_kg_per_m3))
            c.mass = in->material_density_kg_per_m3 * area;
        if (given(r, &in->youngs_modulus_Pa)) {
            c.axial = in->youngs_modulus_Pa * area;
            c.bending = c.axial * in->diameter_m * in->diameter_m / 16;
        }
    }
    return c;
}

/* A layer of thickness t around a diameter d: area pi t (d + t). */
static void add_layers(const section_input *in, core *c)
{
    const section_layer *layer = in->layers.items;
    for (size_t i = 0; i < in->layers.count; i++, layer++) {
        c->mass += layer->density_kg_per_m3 * M_PI * layer->thickness_m *
                   (c->diameter + layer->thickness_m);
        c->diameter += 2 * layer->thickness_m;
    }
}

static void fill_defaults(const section_reading *r, bool derived, bool chain, const core *c,
                          double gravity)
{
    section_input *in = r->in;
    if (derived) {
        fill(r, &in->added_mass_coefficient, 1);
        fill(r, &in->added_mass_coefficient_axial, chain ? 0.5 : 0);
    } else {
        fill(r, &in->weight_N_per_m, c->mass * gravity);
        fill(r, &in->added_mass_kg_per_m, 0);
        fill(r, &in->added_mass_tangential_kg_per_m, 0);
    }
    if (isinf(c->axial))
        fill(r, &in->axial_stiffness_N, INFINITY);
    if (c->bending == 0)
        fill(r, &in->bending_stiffness_N_m2, 0);
    fill(r, &in->axial_loss_factor, 0);
    fill(r, &in->bending_loss_factor, 0);
    fill(r, &in->drag_normal_N_s_per_m2, 0);
    fill(r, &in->drag_tangential_N_s_per_m2, 0);
}

static double either(const section_reading *r, const double *member, double derived)
{
    return given(r, member) ? *member : derived;
}

void section_resolve(const section_reading *r, const section_place *place,
                     strum_cable_section *out, section_properties *properties, problem *p)
{
    section_input *in = r->in;
    const bool chain = given(r, &in->chain), diameter = given(r, &in->diameter_m);
    *properties = (section_properties){0, NULL};
    *out = (strum_cable_section)STRUM_CABLE_SECTION_INIT;
    check(r, diameter, chain, p);
    core c = core_of(r, diameter, chain, properties);
    add_layers(in, &c);
    fill_defaults(r, diameter || chain, chain, &c, place->gravity);
    const double fluid = place->fluid_density * M_PI * c.diameter * c.diameter / 4;
    properties->outer_diameter = c.diameter;
    out->length = in->length_m;
    out->mass = c.mass;
    out->weight = either(r, &in->weight_N_per_m, place->gravity * (c.mass - fluid));
    out->added_mass = either(r, &in->added_mass_kg_per_m, in->added_mass_coefficient * fluid);
    out->added_mass_tangential = either(r, &in->added_mass_tangential_kg_per_m,
                                        in->added_mass_coefficient_axial * fluid);
    out->axial_stiffness = either(r, &in->axial_stiffness_N, c.axial);
    out->bending_stiffness = either(r, &in->bending_stiffness_N_m2, c.bending);
    out->axial_loss = in->axial_loss_factor;
    out->bending_loss = in->bending_loss_factor;
    out->drag_normal = in->drag_normal_N_s_per_m2;
    out->drag_tangential = in->drag_tangential_N_s_per_m2;
    out->bed_friction = either(r, &in->bed_friction, NAN);
}
