/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "endpoints/cable/prepare.h"

#include <math.h>
#include <stdio.h>

#include "endpoints/cable/attachments.h"

/* ---- sections ---- */

/* Rows of a section at the top that mean nothing beside `sections`: all but length_m, mass,
 * diameter and chain, whose alternatives the table has. */
static void refuse_flat_beside_sections(const schema *s, const hung_input *in, problem *p)
{
    for (const field *f = section_schema.fields; f->kind != FIELD_END; f++) {
        char pointer[64];
        const size_t offset = offsetof(hung_input, flat) + f->offset;
        if (f->offset == offsetof(section_input, length_m) || !field_given_at(s, in, offset))
            continue;
        (void)snprintf(pointer, sizeof pointer, "/%s", f->name);
        problem_add(p, pointer, "belongs into an item of sections");
    }
}

static void resolve_sections(const schema *s, hung_input *in, schema_arena *arena, problem *p)
{
    const bool listed = in->sections.count > 0;
    const size_t count = listed ? in->sections.count : 1;
    const section_place place = {in->gravity_m_per_s2, in->fluid_density_kg_per_m3};
    strum_cable_section *made = schema_alloc(arena, count * sizeof *made);
    in->properties = schema_alloc(arena, count * sizeof *in->properties);
    if (made == NULL || in->properties == NULL) {
        problem_out_of_memory(p);
        return;
    }
    in->params.sections = made;
    in->params.section_count = count;
    if (listed)
        refuse_flat_beside_sections(s, in, p);
    for (size_t i = 0; i < count; i++) {
        section_input *section = listed ? (section_input *)in->sections.items + i : &in->flat;
        section_reading r = {s, in, section, ""};
        if (listed) {
            r.s = &section_schema;
            r.rows = section;
            (void)snprintf(r.pointer, sizeof r.pointer, "/sections/%zu", i);
        }
        section_resolve(&r, &place, &made[i], &in->properties[i], p);
    }
}

/* ---- which quantity is given, and which length is found ---- */

typedef struct quantity {
    const char *pointer;
    size_t offset;
    strum_cable_given given;
    double unit;  /* of the core in this unit */
    bool tension; /* gives the span where that is unknown */
} quantity;

#define QUANTITY(member, given, unit, tension)                                                 \
    {                                                                                          \
        "/" #member, offsetof(hung_input, member), given, unit, tension                        \
    }
static const quantity quantities[] = {
    QUANTITY(horizontal_tension_N, STRUM_CABLE_HORIZONTAL_TENSION, 1, true),
    QUANTITY(tension_end_1_N, STRUM_CABLE_TENSION_END_1, 1, true),
    QUANTITY(tension_end_2_N, STRUM_CABLE_TENSION_END_2, 1, true),
    QUANTITY(tension_parallel_to_chord_N, STRUM_CABLE_TENSION_PARALLEL_TO_CHORD, 1, false),
    QUANTITY(catenary_parameter_m, STRUM_CABLE_CATENARY_PARAMETER, 1, false),
    QUANTITY(sag_mid_m, STRUM_CABLE_SAG_MID, 1, false),
    QUANTITY(sag_max_m, STRUM_CABLE_SAG_MAX, 1, false),
    QUANTITY(depth_below_end_1_m, STRUM_CABLE_DEPTH_BELOW_END_1, 1, false),
    QUANTITY(angle_end_1_deg, STRUM_CABLE_ANGLE_END_1, M_PI / 180, false),
    QUANTITY(angle_end_2_deg, STRUM_CABLE_ANGLE_END_2, M_PI / 180, false),
    {NULL, 0, STRUM_CABLE_LENGTHS, 0, false}};

/* The table lets one of them through; the stretched length beside sections is checked here. */
static const quantity *find_given(const schema *s, hung_input *in, problem *p)
{
    static const quantity stretched = {
        "/length_m", offsetof(hung_input, flat) + offsetof(section_input, length_m),
        STRUM_CABLE_STRETCHED_LENGTH, 1, false};
    const quantity *q = quantities;
    while (q->pointer != NULL && !field_given_at(s, in, q->offset))
        q++;
    if (in->sections.count > 0 && field_given_at(s, in, stretched.offset)) {
        if (q->pointer == NULL)
            q = &stretched;
        else
            problem_add(p, "/length_m",
                        "beside sections it is the stretched length of the whole, and cannot "
                        "stand beside %s",
                        q->pointer + 1);
    }
    in->params.given = q->given;
    in->given_pointer = q->pointer;
    if (q->pointer != NULL)
        in->params.value = *(const double *)((const char *)in + q->offset) * q->unit;
    return q;
}

/* Pointer of the length of a section. */
static void length_pointer(const hung_input *in, size_t i, char pointer[48])
{
    if (in->sections.count > 0)
        (void)snprintf(pointer, 48, "/sections/%zu/length_m", i);
    else
        (void)snprintf(pointer, 48, "/length_m");
}

/* A missing length is a fault but for the first one where one may be missing. */
static void check_lengths(hung_input *in, bool one_may_miss, const char *why, problem *p)
{
    size_t missing = 0;
    for (size_t i = 0; i < in->params.section_count; i++) {
        char pointer[48];
        if (in->params.sections[i].length > 0)
            continue;
        missing++;
        if (missing == 1 && one_may_miss) {
            in->params.adjusted = i;
            continue;
        }
        length_pointer(in, i, pointer);
        problem_add(p, pointer, "missing: %s",
                    one_may_miss ? "one length can be found, not two" : why);
    }
}

static size_t missing_lengths(const hung_input *in)
{
    size_t missing = 0;
    for (size_t i = 0; i < in->params.section_count; i++)
        missing += !(in->params.sections[i].length > 0);
    return missing;
}

/* With all lengths there, the one that is found must be named. */
static void check_adjusted(const schema *s, hung_input *in, bool found, problem *p)
{
    const bool named = FIELD_GIVEN(s, in, adjust_section);
    const size_t missing = missing_lengths(in), count = in->params.section_count;
    if (named && in->adjust_section > (int64_t)count) {
        problem_add(p, "/adjust_section", "there are %zu sections", count);
    } else if (named && !found && in->taken_in_m == 0) {
        problem_add(p, "/adjust_section",
                    "no length is to be found: it follows from a tension, sag, angle or "
                    "stretched length, or is taken_in_m");
    } else if (named && missing == 1 && found &&
               in->params.adjusted != (size_t)in->adjust_section - 1) {
        problem_add(p, "/adjust_section", "the length left out is that of section %zu",
                    in->params.adjusted + 1);
    } else if (named) {
        in->params.adjusted = (size_t)in->adjust_section - 1;
    } else if (found && missing == 0) {
        problem_add(p, in->given_pointer,
                    "nothing is left to be found with span_m and every length: leave out one "
                    "length (or name its section by adjust_section), or span_m");
    }
}

static void prepare_geometry(const schema *s, hung_input *in, problem *p)
{
    strum_cable_params *params = &in->params;
    const quantity *q = find_given(s, in, p);
    const bool given = q->pointer != NULL, span = FIELD_GIVEN(s, in, span_m);
    params->span = in->span_m;
    params->rise = in->rise_m;
    params->slack_branch = in->branch == 1;
    params->adjusted = params->section_count - 1;
    params->span_unknown = given && !span;
    if (!span && !given)
        problem_add(p, "/span_m", "missing: horizontal distance of end 2 from end 1");
    if (!span && given && !q->tension)
        problem_add(p, "/span_m",
                    "missing: only horizontal_tension_N, tension_end_1_N or tension_end_2_N "
                    "give a span");
    check_lengths(in, given && span,
                  given ? "a tension gives the span where every length is there"
                        : "or give a tension, sag, angle or stretched length, so that it is "
                          "found",
                  p);
    check_adjusted(s, in, given && span, p);
}

/* ---- the rest ---- */

static strum_cable_end end_of(const hung_end *in, const char *pointer, problem *p)
{
    const schema *s = &hung_end_schema;
    const bool sprung = FIELD_GIVEN(s, in, rotational_stiffness_N_m_per_rad);
    const bool angle = FIELD_GIVEN(s, in, angle_deg);
    if (angle && !sprung && in->rotation == 0)
        problem_add(p, pointer,
                    "a pinned end turns freely: give rotation clamped or "
                    "rotational_stiffness_N_m_per_rad");
    return (strum_cable_end){sprung              ? STRUM_CABLE_SPRUNG
                             : in->rotation == 1 ? STRUM_CABLE_CLAMPED
                                                 : STRUM_CABLE_PINNED,
                             in->rotational_stiffness_N_m_per_rad,
                             angle ? in->angle_deg * M_PI / 180 : NAN};
}

static void prepare_spans(const schema *s, hung_input *in, problem *p)
{
    const bool hanger = FIELD_GIVEN(s, in, hanger), bed = FIELD_GIVEN(s, in, bed);
    in->params.spans = (size_t)in->spans;
    in->params.hanger_length = in->hanger.length_m;
    in->params.hanger_mass = in->hanger.mass_kg;
    in->params.bed =
        (strum_cable_bed){bed, in->bed.depth_below_end_1_m, in->bed.slope_deg * M_PI / 180,
                          in->bed.friction_coefficient};
    if (in->spans > 1 && !hanger)
        problem_add(p, "/hanger", "missing: what the cable hangs from between its spans");
    if (in->spans == 1 && hanger)
        problem_add(p, "/hanger", "hangs between spans: needs spans above 1");
    if (in->spans > 1 && in->rise_m != 0)
        problem_add(p, "/rise_m", "several spans are level: must be 0");
    if (in->spans > 1 && bed)
        problem_add(p, "/bed", "several spans hang free: cannot stand beside spans above 1");
    for (size_t i = 0; i < in->params.section_count && !bed; i++) {
        char pointer[48];
        if (isnan(in->params.sections[i].bed_friction))
            continue;
        if (in->sections.count > 0)
            (void)snprintf(pointer, sizeof pointer, "/sections/%zu/bed_friction", i);
        else
            (void)snprintf(pointer, sizeof pointer, "/bed_friction");
        problem_add(p, pointer, "needs a bed");
    }
}

static void prepare_statics(hung_input *in)
{
    bool stiff = false;
    for (size_t i = 0; i < in->params.section_count; i++)
        stiff = stiff || in->params.sections[i].bending_stiffness > 0;
    in->params.stiff = stiff && in->statics == HUNG_STIFF;
}

void hung_prepare(const schema *s, hung_input *in, schema_arena *arena, problem *p)
{
    in->params = (strum_cable_params)STRUM_CABLE_PARAMS_INIT;
    resolve_sections(s, in, arena, p);
    if (in->params.sections == NULL || in->properties == NULL)
        return;
    prepare_geometry(s, in, p);
    attachments_prepare(in, arena, p);
    in->params.end_1 = end_of(&in->end_1, "/end_1/angle_deg", p);
    in->params.end_2 = end_of(&in->end_2, "/end_2/angle_deg", p);
    prepare_spans(s, in, p);
    prepare_statics(in);
    in->params.temperature_change = in->temperature_change_K;
    in->params.expansion = in->expansion_per_K;
    in->params.taken_in = in->taken_in_m;
    if (in->temperature_change_K != 0 && in->expansion_per_K == 0)
        problem_add(p, "/expansion_per_K", "is needed with temperature_change_K");
}

void hung_check_shape_points(int64_t shape_points, problem *p)
{
    if (shape_points == 1)
        problem_add(p, "/shape_points",
                    "must be 0 or at least 2, so that both ends are among them");
}
