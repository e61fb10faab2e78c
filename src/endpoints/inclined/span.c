/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An inclined cable between two given supports: by its unstretched length, or by one figure that
 * tells how it hangs. The general cable's statics find the tension parallel to the chord. */
#include <math.h>

#include <strum/cable.h>

#include "endpoints/common/suspended_cable.h"
#include "endpoints/inclined/request.h"

typedef struct figure {
    const char *pointer;
    size_t offset; /* of its member in inclined_request */
    strum_cable_given given;
} figure;

#define FIGURE(member, given_)                                                                 \
    {                                                                                          \
        "/" #member, offsetof(inclined_request, member), given_                                \
    }
static const figure figures[] = {
    FIGURE(length_m, STRUM_CABLE_LENGTHS),
    FIGURE(horizontal_tension_N, STRUM_CABLE_HORIZONTAL_TENSION),
    FIGURE(tension_end_1_N, STRUM_CABLE_TENSION_END_1),
    FIGURE(tension_end_2_N, STRUM_CABLE_TENSION_END_2),
    FIGURE(tension_parallel_to_chord_N, STRUM_CABLE_TENSION_PARALLEL_TO_CHORD),
    FIGURE(catenary_parameter_m, STRUM_CABLE_CATENARY_PARAMETER),
    FIGURE(sag_mid_m, STRUM_CABLE_SAG_MID),
    FIGURE(sag_max_m, STRUM_CABLE_SAG_MAX),
    FIGURE(depth_below_end_1_m, STRUM_CABLE_DEPTH_BELOW_END_1),
    FIGURE(stretched_length_m, STRUM_CABLE_STRETCHED_LENGTH),
};

/* All are above 0 where they are given. */
static double value_of(const inclined_request *r, const figure *f)
{
    return *(const double *)(const void *)((const char *)r + f->offset);
}

static const figure *figure_of(const inclined_request *r)
{
    const size_t count = sizeof figures / sizeof *figures;
    size_t i = 0;
    while (i + 1 < count && !(value_of(r, &figures[i]) > 0))
        i++;
    return &figures[i];
}

const char *inclined_figure_pointer(const inclined_request *r)
{
    return figure_of(r)->pointer;
}

/* Weight is known, inclination too. */
static strum_status hang(inclined_request *r, const figure *f, strum_cable_statics *statics,
                         strum_error *error)
{
    const bool elastic = r->cable.elastic_statics && r->axial_stiffness_N > 0;
    const double value = value_of(r, f);
    strum_cable_section section = STRUM_CABLE_SECTION_INIT;
    section.mass = r->mass_kg_per_m;
    section.weight = r->weight_N_per_m;
    section.axial_stiffness = elastic ? r->axial_stiffness_N : HUGE_VAL;
    section.length = f->given == STRUM_CABLE_LENGTHS ? value : 0;
    strum_cable_params params = STRUM_CABLE_PARAMS_INIT;
    params.sections = &section;
    params.section_count = 1;
    params.span = r->span_m;
    params.rise = r->rise_m;
    params.given = f->given;
    params.value = f->given == STRUM_CABLE_LENGTHS ? 0 : value;
    params.slack_branch = r->branch == CABLE_SLACK;
    strum_hanging *hanging = NULL;
    const strum_status status = strum_cable_hang(&params, NULL, &hanging, error);
    if (status == STRUM_OK)
        strum_cable_statics_get(hanging, statics);
    strum_cable_free(hanging);
    return status;
}

void inclined_span(inclined_request *r, problem *p)
{
    const double angle = atan2(r->rise_m, r->span_m);
    const figure *f = figure_of(r);
    strum_cable_statics statics;
    strum_error error = {0};
    r->cable.inclination = angle;
    if (angle > STRUM_INCLINATION_MAX_DEG * M_PI / 180)
        problem_add(p, "/rise_m",
                    "the chord is %.4g degrees steep, above %g: /v1/cable/modes "
                    "answers steep and vertical cables",
                    angle * 180 / M_PI, STRUM_INCLINATION_MAX_DEG);
    if (r->cable.elastic_statics && !(r->axial_stiffness_N > 0) && !r->inextensible)
        problem_add(p, "/axial_stiffness_N", "is needed with statics elastic and span_m");
    if (p->status != 0)
        return;
    const strum_status status = hang(r, f, &statics, &error);
    if (status != STRUM_OK) {
        cable_refuse(&error, status, p);
        problem_add(p, f->pointer, "%s", error.reason);
        return;
    }
    r->solutions = f->given == STRUM_CABLE_LENGTHS ? 0 : statics.solutions;
    r->other_length_m = statics.other_length;
    r->length_m = statics.unstretched_length;
    r->tension = statics.tension_parallel_to_chord;
}
