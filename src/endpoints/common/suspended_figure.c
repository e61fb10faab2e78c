/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A suspended cable given by its span, its rise and one figure that tells how it hangs: a tension,
 * a sag, a depth, an angle. The general cable's statics find the length, with axial stiffness the
 * unstretched one; strum/cable.h defines the figures.
 */
#include <math.h>

#include <strum/cable.h>

#include "endpoints/common/suspended_cable.h"

typedef struct figure {
    const char *pointer;
    size_t offset; /* of its member in cable_input */
    strum_cable_given given;
    double unit; /* of the field in that of the core */
} figure;

#define FIGURE(member, given_, unit_)                                                          \
    {                                                                                          \
        "/" #member, offsetof(cable_input, member), given_, unit_                              \
    }

static const figure figures[] = {
    FIGURE(horizontal_tension_N, STRUM_CABLE_HORIZONTAL_TENSION, 1),
    FIGURE(tension_end_1_N, STRUM_CABLE_TENSION_END_1, 1),
    FIGURE(tension_end_2_N, STRUM_CABLE_TENSION_END_2, 1),
    FIGURE(tension_parallel_to_chord_N, STRUM_CABLE_TENSION_PARALLEL_TO_CHORD, 1),
    FIGURE(catenary_parameter_m, STRUM_CABLE_CATENARY_PARAMETER, 1),
    FIGURE(sag_mid_m, STRUM_CABLE_SAG_MID, 1),
    FIGURE(sag_max_m, STRUM_CABLE_SAG_MAX, 1),
    FIGURE(depth_below_end_1_m, STRUM_CABLE_DEPTH_BELOW_END_1, 1),
    FIGURE(angle_end_1_deg, STRUM_CABLE_ANGLE_END_1, M_PI / 180),
    FIGURE(angle_end_2_deg, STRUM_CABLE_ANGLE_END_2, M_PI / 180),
};

static const figure *figure_of(const schema *s, const cable_input *in)
{
    for (size_t i = 0; i < sizeof figures / sizeof *figures; i++)
        if (field_given_at(s, in, figures[i].offset))
            return &figures[i];
    return NULL;
}

const char *cable_figure_pointer(const schema *s, const cable_input *in)
{
    const figure *f = figure_of(s, in);
    return f != NULL ? f->pointer : NULL;
}

strum_status cable_find_by_figure(const schema *s, cable_input *in, strum_catenary *c,
                                  strum_error *error)
{
    const figure *f = figure_of(s, in);
    const bool elastic = FIELD_GIVEN(s, in, axial_stiffness_N);
    const double weight = in->weight_N_per_m > 0 ? in->weight_N_per_m : 1;
    strum_cable_section section = STRUM_CABLE_SECTION_INIT;
    section.mass = in->mass_kg_per_m;
    section.weight = weight;
    section.axial_stiffness = elastic ? in->axial_stiffness_N : HUGE_VAL;
    strum_cable_params params = STRUM_CABLE_PARAMS_INIT;
    params.sections = &section;
    params.section_count = 1;
    params.span = in->span_m;
    params.rise = in->rise_m;
    params.given = f->given;
    params.value = *(const double *)(const void *)((const char *)in + f->offset) * f->unit;
    params.slack_branch = in->branch == CABLE_SLACK;
    strum_hanging *hanging;
    strum_status status = strum_cable_hang(&params, NULL, &hanging, error);
    if (status != STRUM_OK)
        return status;
    strum_cable_statics statics;
    strum_cable_statics_get(hanging, &statics);
    strum_cable_free(hanging);
    in->solutions = statics.solutions;
    in->other_length_m = statics.other_length;
    in->rest_length_m = statics.unstretched_length;
    /* The tension where it is parallel to the chord determines the profile without cancellation,
     * however taut. */
    const double pull = weight * statics.unstretched_length;
    return strum_catenary_from_chord(pull / statics.tension_parallel_to_chord,
                                     atan2(in->rise_m, in->span_m),
                                     elastic ? pull / in->axial_stiffness_N : 0, c, error);
}
