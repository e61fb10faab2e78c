/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where an assumption about a general cable bites. */
#include "endpoints/cable/answer.h"

#include <math.h>
#include <stdio.h>

/* Bending stiffness left out of the static shape is felt below this xi. */
#define XI_LEAST 10
/* The flexible shape's kink that a rod would round. */
#define KINK_MOST 30
/* Strain beyond which EA is hardly a constant. */
#define STRAIN_MOST 0.02
/* Few cables in water weigh less than this part of what they do in air; a mass in place of a
 * weight is 1/9.8 of it. */
#define BUOYANT_REACH 0.11

/* "section 2: ", or nothing for the only one. */
typedef struct label {
    char text[32];
} label;

static label label_of(const hung_input *in, size_t i)
{
    label l = {""};
    if (in->params.section_count > 1)
        (void)snprintf(l.text, sizeof l.text, "section %zu: ", i + 1);
    return l;
}

/* A section alone: is the weight that of its mass? */
static void warn_weight(const hung_input *in, size_t i, answer *a)
{
    const strum_cable_section *s = &in->params.sections[i];
    const bool derived = in->properties[i].outer_diameter > 0;
    const double share = s->weight / (s->mass * in->gravity_m_per_s2);
    const label l = label_of(in, i);
    if (in->fluid_density_kg_per_m3 > 0 && !derived)
        answer_warn(a,
                    "%sfluid_density_kg_per_m3 does nothing to a section without diameter_m: "
                    "weight_N_per_m is taken as it is",
                    l.text);
    if (s->mass == 0) {
        if (s->weight != 0)
            answer_warn(a, "%sweight_N_per_m without mass", l.text);
    } else if (share > 1.001) {
        answer_warn(a,
                    "%sweight_N_per_m is %.4g times mass_kg_per_m times gravity: are the units "
                    "mixed up?",
                    l.text, share);
    } else if (share > 0 && share < BUOYANT_REACH && !derived) {
        answer_warn(a,
                    "%sweight_N_per_m is only %.2g of mass_kg_per_m times gravity: is a mass "
                    "given for a weight?",
                    l.text, share);
    } else if (share < 0.999 && s->weight != 0 && s->added_mass == 0) {
        answer_warn(a,
                    "%sweight_N_per_m is %.4g of mass_kg_per_m times gravity, as in water, but "
                    "added_mass_kg_per_m is 0",
                    l.text, share);
    }
}

/* Tension is largest at an end of a section or at a load on it. */
static double largest_tension(const hung_input *in, const strum_hanging *cable, double from,
                              double to, strum_cable_point ends[2])
{
    double most = fmax(ends[0].tension, ends[1].tension);
    for (size_t i = 0; i < in->params.attachment_count; i++) {
        strum_cable_joint joint;
        if (strum_cable_attachment_get(cable, i, &joint) == STRUM_OK && joint.position > from &&
            joint.position < to)
            most = fmax(most, fmax(joint.tension_left, joint.tension_right));
    }
    return most;
}

static void warn_section(const hung_input *in, const strum_hanging *cable, size_t i,
                         double from, double to, double length, answer *a)
{
    const strum_cable_section *s = &in->params.sections[i];
    const bool flexible = !in->params.stiff && s->bending_stiffness > 0;
    const double places[2] = {from, fmin(to, length)};
    strum_cable_point ends[2];
    if (strum_cable_shape(cable, places, 2, ends) != STRUM_OK)
        return;
    const label l = label_of(in, i);
    const double strain = largest_tension(in, cable, from, to, ends) / s->axial_stiffness;
    if (strain > STRAIN_MOST)
        answer_warn(a,
                    "%sthe strain reaches %.2g: an axial stiffness that does not depend on "
                    "tension is assumed",
                    l.text, strain);
    const double xi =
        length * sqrt(fmin(ends[0].tension, ends[1].tension) / s->bending_stiffness);
    if (flexible && xi < XI_LEAST)
        answer_warn(a,
                    "%sxi is %.2g: with so much bending stiffness the flexible shape is not "
                    "that of the cable; statics stiff has it",
                    l.text, xi);
}

static void warn_kinks(const hung_input *in, const strum_hanging *cable, answer *a)
{
    bool bends = false;
    for (size_t i = 0; i < in->params.section_count; i++)
        bends = bends || in->params.sections[i].bending_stiffness > 0;
    double worst = 0, position = 0;
    for (size_t i = 0; i < in->params.attachment_count; i++) {
        strum_cable_joint joint;
        if (strum_cable_attachment_get(cable, i, &joint) == STRUM_OK &&
            fabs(joint.kink) > worst) {
            worst = fabs(joint.kink);
            position = joint.position;
        }
    }
    worst *= 180 / M_PI;
    if (bends && !in->params.stiff && worst > KINK_MOST)
        answer_warn(a,
                    "the flexible shape has a kink of %.3g degrees at %.6g m, which bending "
                    "stiffness would round; statics stiff does",
                    worst, position);
}

/* In air a cable may well hang below its lower end; in water there is a bed somewhere. */
static void warn_below(const hung_input *in, const strum_cable_statics *s, answer *a)
{
    bool immersed = in->fluid_density_kg_per_m3 > 100;
    for (size_t i = 0; i < in->params.section_count; i++) {
        const strum_cable_section *section = &in->params.sections[i];
        immersed = immersed || section->added_mass > 0 ||
                   section->weight < 0.999 * section->mass * in->gravity_m_per_s2;
    }
    const double lower = fmin(0, s->rise);
    if (!in->params.bed.present && immersed && s->lowest.z < lower - 1e-9 * s->length)
        answer_warn(a,
                    "the cable passes %.3g m below its lower end: give a bed where there is "
                    "one",
                    lower - s->lowest.z);
}

void hung_warn(const hung_input *in, const strum_hanging *cable, answer *a)
{
    strum_cable_statics s;
    strum_cable_statics_get(cable, &s);
    double from = 0;
    for (size_t i = 0; i < in->params.section_count; i++) {
        strum_cable_section section;
        warn_weight(in, i, a);
        if (strum_cable_section_get(cable, i, &section) != STRUM_OK)
            continue;
        warn_section(in, cable, i, from, from + section.length, s.unstretched_length, a);
        from += section.length;
    }
    warn_kinks(in, cable, a);
    warn_below(in, &s, a);
    if (in->params.slack_branch)
        answer_warn(a,
                    "the slack one of two cables with this end tension: a little less length "
                    "lowers its tension");
}
