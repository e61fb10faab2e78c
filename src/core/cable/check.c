/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/check.h"

#include <math.h>

#include "core/numerics/status.h"

/* One number of a struct: where, what it may be, and its name. */
typedef struct {
    size_t offset;
    enum { POSITIVE, NOT_NEGATIVE, ANY, POSITIVE_OR_INFINITE, NOT_NEGATIVE_OR_NONE } range;
    const char *name;
} number;

#define SECTION(member, range)                                                                 \
    {                                                                                          \
        offsetof(strum_cable_section, member), range, #member                                  \
    }
#define ATTACHMENT(member, range)                                                              \
    {                                                                                          \
        offsetof(strum_cable_attachment, member), range, #member                               \
    }

static const number section_numbers[] = {
    SECTION(mass, NOT_NEGATIVE),
    SECTION(weight, ANY),
    SECTION(added_mass, NOT_NEGATIVE),
    SECTION(added_mass_tangential, NOT_NEGATIVE),
    SECTION(axial_stiffness, POSITIVE_OR_INFINITE),
    SECTION(bending_stiffness, NOT_NEGATIVE),
    SECTION(axial_loss, NOT_NEGATIVE),
    SECTION(bending_loss, NOT_NEGATIVE),
    SECTION(drag_normal, NOT_NEGATIVE),
    SECTION(drag_tangential, NOT_NEGATIVE),
    SECTION(bed_friction, NOT_NEGATIVE_OR_NONE),
};

static const number attachment_numbers[] = {
    ATTACHMENT(position, POSITIVE),
    ATTACHMENT(angle, ANY),
    ATTACHMENT(mass, NOT_NEGATIVE),
    ATTACHMENT(weight, ANY),
    ATTACHMENT(added_mass, NOT_NEGATIVE),
    ATTACHMENT(rotary_inertia, NOT_NEGATIVE),
    ATTACHMENT(stiffness, NOT_NEGATIVE),
    ATTACHMENT(damping, NOT_NEGATIVE),
    ATTACHMENT(inertance, NOT_NEGATIVE),
    ATTACHMENT(force_x, ANY),
    ATTACHMENT(force_z, ANY),
    ATTACHMENT(jump, ANY),
};

/* What is wrong with a value; NULL: nothing. */
static const char *fault_of(double value, int range)
{
    if (range == POSITIVE_OR_INFINITE && isinf(value) && value > 0)
        return NULL;
    if (range == NOT_NEGATIVE_OR_NONE && isnan(value))
        return NULL;
    if (!(fabs(value) <= STRUM_CABLE_SIZE_MAX))
        return "must be a number of at most 1e30";
    if ((range == POSITIVE || range == POSITIVE_OR_INFINITE) &&
        !(value >= 1 / STRUM_CABLE_SIZE_MAX))
        return "must be above 0, at least 1e-30";
    if ((range == NOT_NEGATIVE || range == NOT_NEGATIVE_OR_NONE) && !(value >= 0))
        return "must not be negative";
    return NULL;
}

static strum_status check_numbers(const void *item, const number *numbers, size_t count,
                                  int argument, size_t index, strum_error *error)
{
    for (size_t i = 0; i < count; i++) {
        const double *value = (const double *)((const char *)item + numbers[i].offset);
        const char *fault = fault_of(*value, numbers[i].range);
        if (fault != NULL)
            return error_at(error, STRUM_ERR_RANGE, argument, index, "%s %s", numbers[i].name,
                            fault);
    }
    return STRUM_OK;
}

#define COUNT(list) (sizeof(list) / sizeof *(list))

static strum_status check_sections(const strum_cable_params *p, strum_error *error)
{
    const bool one_unknown = p->given != STRUM_CABLE_LENGTHS && !p->span_unknown;
    if (p->sections == NULL || p->section_count < 1 ||
        p->section_count > STRUM_CABLE_SECTIONS_MAX)
        return error_at(error, STRUM_ERR_RANGE, STRUM_CABLE_ARG_SECTIONS, STRUM_NO_INDEX,
                        "a cable has 1 to %d sections", STRUM_CABLE_SECTIONS_MAX);
    for (size_t i = 0; i < p->section_count; i++) {
        static const number length = SECTION(length, POSITIVE);
        strum_status status =
            check_numbers(p->sections + i, section_numbers, COUNT(section_numbers),
                          STRUM_CABLE_ARG_SECTIONS, i, error);
        if (status == STRUM_OK && !(one_unknown && i == p->adjusted))
            status =
                check_numbers(p->sections + i, &length, 1, STRUM_CABLE_ARG_SECTIONS, i, error);
        if (status != STRUM_OK)
            return status;
    }
    return STRUM_OK;
}

static strum_status check_attachments(const strum_cable_params *p, strum_error *error)
{
    const bool lengths_known = p->given == STRUM_CABLE_LENGTHS || p->span_unknown;
    double length = 0;
    if (p->attachment_count > STRUM_CABLE_ATTACHMENTS_MAX ||
        (p->attachment_count > 0 && p->attachments == NULL))
        return error_at(error, STRUM_ERR_RANGE, STRUM_CABLE_ARG_ATTACHMENTS, STRUM_NO_INDEX,
                        "a cable has at most %d attachments", STRUM_CABLE_ATTACHMENTS_MAX);
    for (size_t i = 0; i < p->section_count; i++)
        length += p->sections[i].length;
    for (size_t i = 0; i < p->attachment_count; i++) {
        const strum_cable_attachment *a = p->attachments + i;
        const strum_status status =
            check_numbers(a, attachment_numbers, COUNT(attachment_numbers),
                          STRUM_CABLE_ARG_ATTACHMENTS, i, error);
        if (status != STRUM_OK)
            return status;
        if (a->kind > STRUM_CABLE_TENSION_JUMP || a->direction > STRUM_CABLE_ANGLE)
            return error_at(error, STRUM_ERR_RANGE, STRUM_CABLE_ARG_ATTACHMENTS, i,
                            "no such kind or direction of an attachment");
        if (lengths_known && !(a->position < length))
            return error_at(error, STRUM_ERR_RANGE, STRUM_CABLE_ARG_ATTACHMENTS, i,
                            "the position must lie before the end of the cable, at %.15g m",
                            length);
    }
    return STRUM_OK;
}

static strum_status check_value(const strum_cable_params *p, strum_error *error)
{
    const bool angle =
        p->given == STRUM_CABLE_ANGLE_END_1 || p->given == STRUM_CABLE_ANGLE_END_2;
    const char *fault = fault_of(p->value, angle ? ANY : POSITIVE);
    if (p->given > STRUM_CABLE_ANGLE_END_2)
        return error_at(error, STRUM_ERR_RANGE, STRUM_CABLE_ARG_VALUE, STRUM_NO_INDEX,
                        "no such given quantity");
    if (p->given == STRUM_CABLE_LENGTHS) {
        if (p->span_unknown)
            return error_at(error, STRUM_ERR_RANGE, STRUM_CABLE_ARG_VALUE, STRUM_NO_INDEX,
                            "an unknown span needs a tension that is given");
        if (p->taken_in != 0 && p->adjusted >= p->section_count)
            return error_at(error, STRUM_ERR_RANGE, STRUM_CABLE_ARG_ADJUSTED, STRUM_NO_INDEX,
                            "there is no such section");
        return STRUM_OK;
    }
    if (fault != NULL)
        return error_at(error, STRUM_ERR_RANGE, STRUM_CABLE_ARG_VALUE, STRUM_NO_INDEX,
                        "the given quantity %s", fault);
    if (angle && !(fabs(p->value) < M_PI_2))
        return error_at(error, STRUM_ERR_RANGE, STRUM_CABLE_ARG_VALUE, STRUM_NO_INDEX,
                        "the angle must lie between -90 and 90 degrees");
    if (p->adjusted >= p->section_count)
        return error_at(error, STRUM_ERR_RANGE, STRUM_CABLE_ARG_ADJUSTED, STRUM_NO_INDEX,
                        "there is no such section");
    if (p->given == STRUM_CABLE_CATENARY_PARAMETER && p->sections[p->adjusted].weight == 0)
        return error_at(error, STRUM_ERR_RANGE, STRUM_CABLE_ARG_VALUE, STRUM_NO_INDEX,
                        "a weightless section has no catenary parameter");
    if (p->span_unknown && p->given != STRUM_CABLE_HORIZONTAL_TENSION &&
        p->given != STRUM_CABLE_TENSION_END_1 && p->given != STRUM_CABLE_TENSION_END_2)
        return error_at(error, STRUM_ERR_RANGE, STRUM_CABLE_ARG_VALUE, STRUM_NO_INDEX,
                        "an unknown span follows from the horizontal tension or that of an "
                        "end only");
    return STRUM_OK;
}

static strum_status check_geometry(const strum_cable_params *p, strum_error *error)
{
    if (!p->span_unknown && fault_of(p->span, NOT_NEGATIVE) != NULL)
        return error_at(error, STRUM_ERR_RANGE, STRUM_CABLE_ARG_SPAN, STRUM_NO_INDEX,
                        "the span %s", fault_of(p->span, NOT_NEGATIVE));
    if (fault_of(p->rise, ANY) != NULL)
        return error_at(error, STRUM_ERR_RANGE, STRUM_CABLE_ARG_RISE, STRUM_NO_INDEX,
                        "the rise %s", fault_of(p->rise, ANY));
    if (p->spans < 1 || p->spans > STRUM_CABLE_SPANS_MAX)
        return error_at(error, STRUM_ERR_RANGE, STRUM_CABLE_ARG_SPANS, STRUM_NO_INDEX,
                        "there may be 1 to %d spans", STRUM_CABLE_SPANS_MAX);
    if (p->spans > 1 && (p->rise != 0 || p->bed.present))
        return error_at(error, STRUM_ERR_RANGE, STRUM_CABLE_ARG_SPANS, STRUM_NO_INDEX,
                        "several spans in a row must be level, and without a bed");
    if (p->spans > 1 && (fault_of(p->hanger_length, POSITIVE) != NULL ||
                         fault_of(p->hanger_mass, NOT_NEGATIVE) != NULL))
        return error_at(error, STRUM_ERR_RANGE, STRUM_CABLE_ARG_HANGER, STRUM_NO_INDEX,
                        "a hanger between spans has a length above 0 and a mass of at least 0");
    return STRUM_OK;
}

static strum_status check_ends(const strum_cable_params *p, strum_error *error)
{
    const strum_cable_end *ends[] = {&p->end_1, &p->end_2};
    for (int i = 0; i < 2; i++) {
        const strum_cable_end *e = ends[i];
        const bool stiff =
            e->rotation != STRUM_CABLE_SPRUNG || fault_of(e->stiffness, NOT_NEGATIVE) == NULL;
        if (e->rotation > STRUM_CABLE_SPRUNG || !stiff ||
            !(isnan(e->angle) || fabs(e->angle) <= 2 * M_PI))
            return error_at(error, STRUM_ERR_RANGE,
                            i == 0 ? STRUM_CABLE_ARG_END_1 : STRUM_CABLE_ARG_END_2,
                            STRUM_NO_INDEX,
                            "an end is pinned, clamped or sprung, by a stiffness of at least "
                            "0, at an angle within a turn");
    }
    return STRUM_OK;
}

static strum_status check_bed(const strum_cable_params *p, strum_error *error)
{
    const strum_cable_bed *b = &p->bed;
    if (!b->present)
        return STRUM_OK;
    if (fault_of(b->depth, NOT_NEGATIVE) != NULL || fault_of(b->friction, NOT_NEGATIVE) != NULL)
        return error_at(error, STRUM_ERR_RANGE, STRUM_CABLE_ARG_BED, STRUM_NO_INDEX,
                        "depth and friction of the bed must not be negative");
    if (!(fabs(b->slope) <= STRUM_CABLE_BED_SLOPE_MAX))
        return error_at(error, STRUM_ERR_RANGE, STRUM_CABLE_ARG_BED, STRUM_NO_INDEX,
                        "the slope of the bed must lie within +-80 degrees");
    return STRUM_OK;
}

static strum_status check_state(const strum_cable_params *p, strum_error *error)
{
    const double stretch = 1 + p->expansion * p->temperature_change;
    if (!(isfinite(stretch) && stretch >= 0.1 && stretch <= 10))
        return error_at(error, STRUM_ERR_RANGE, STRUM_CABLE_ARG_TEMPERATURE, STRUM_NO_INDEX,
                        "1 + expansion times the change of temperature must lie within 0.1 "
                        "and 10");
    if (fault_of(p->taken_in, ANY) != NULL)
        return error_at(error, STRUM_ERR_RANGE, STRUM_CABLE_ARG_TAKEN_IN, STRUM_NO_INDEX,
                        "what is taken in %s", fault_of(p->taken_in, ANY));
    return STRUM_OK;
}

strum_status cable_check(const strum_cable_params *p, strum_error *error)
{
    static strum_status (*const checks[])(const strum_cable_params *, strum_error *) = {
        check_sections, check_value, check_attachments, check_geometry,
        check_ends,     check_bed,   check_state,
    };
    for (size_t i = 0; i < COUNT(checks); i++) {
        const strum_status status = checks[i](p, error);
        if (status != STRUM_OK)
            return status;
    }
    return STRUM_OK;
}
