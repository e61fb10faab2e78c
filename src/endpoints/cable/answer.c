/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "endpoints/cable/answer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "endpoints/common/members.h"

/* ---- solving and refusing ---- */

strum_status hung_solve(const hung_input *in, const answer *a, strum_hanging **cable,
                        strum_error *error)
{
    const strum_options options = answer_options(a);
    return strum_cable_hang(&in->params, &options, cable, error);
}

/* The field of an error's argument; "" where it is none of one field. */
static const char *field_at_fault(const hung_input *in, const strum_error *error,
                                  char pointer[64])
{
    const bool listed = in->sections.count > 0, item = error->index != STRUM_NO_INDEX;
    switch (error->argument) {
    case STRUM_CABLE_ARG_SECTIONS:
        if (!listed)
            return "/length_m";
        (void)snprintf(pointer, 64, item ? "/sections/%zu" : "/sections", error->index);
        return pointer;
    case STRUM_CABLE_ARG_ATTACHMENTS:
        (void)snprintf(pointer, 64, item ? "/attachments/%zu" : "/attachments",
                       item ? in->origin[error->index] : 0);
        return pointer;
    case STRUM_CABLE_ARG_VALUE:
        return in->given_pointer != NULL ? in->given_pointer : "";
    case STRUM_CABLE_ARG_ADJUSTED:
        return "/adjust_section";
    case STRUM_CABLE_ARG_SPAN:
        return "/span_m";
    case STRUM_CABLE_ARG_RISE:
        return "/rise_m";
    case STRUM_CABLE_ARG_END_1:
        return "/end_1";
    case STRUM_CABLE_ARG_END_2:
        return "/end_2";
    case STRUM_CABLE_ARG_SPANS:
        return "/spans";
    case STRUM_CABLE_ARG_HANGER:
        return "/hanger";
    case STRUM_CABLE_ARG_BED:
        return "/bed";
    case STRUM_CABLE_ARG_TEMPERATURE:
        return "/temperature_change_K";
    case STRUM_CABLE_ARG_TAKEN_IN:
        return "/taken_in_m";
    case STRUM_CABLE_ARG_COUNT:
        return "/modes";
    case STRUM_CABLE_ARG_PLACES:
        return "/shape_points";
    default:
        return "";
    }
}

void hung_refuse(const hung_input *in, const strum_error *error, strum_status status,
                 problem *p)
{
    const char *reason = error->reason[0] != '\0' ? error->reason : strum_status_text(status);
    const bool later =
        status == STRUM_ERR_MEMORY || status == STRUM_ERR_CANCELLED || status == STRUM_ERR_TIME;
    const int http = later ? 503 : status == STRUM_ERR_INTERNAL ? 500 : 422;
    char text[64];
    problem_set(p, http, "%s", reason);
    const char *pointer = http == 422 ? field_at_fault(in, error, text) : "";
    if (pointer[0] != '\0')
        problem_add(p, pointer, "%s", reason);
}

/* ---- statics ---- */

void put_number_or_infinite(json_writer *json, const char *key, double value)
{
    if (isinf(value))
        json_put_string(json, key, "infinite");
    else
        json_put_number(json, key, value);
}

static double degrees(double radians)
{
    return radians * 180 / M_PI;
}

static void write_place(json_writer *json, const char *key, strum_cable_place place)
{
    json_key(json, key);
    json_open_object(json);
    json_put_number(json, "x_m", place.x);
    json_put_number(json, "z_m", place.z);
    json_close_object(json);
}

static void write_figures(json_writer *json, const strum_cable_statics *s)
{
    json_put_number(json, "horizontal_force_end_1_N", s->horizontal_end_1);
    json_put_number(json, "vertical_force_end_1_N", s->vertical_end_1);
    json_put_number(json, "tension_end_1_N", s->tension_end_1);
    json_put_number(json, "horizontal_force_end_2_N", s->horizontal_end_2);
    json_put_number(json, "vertical_force_end_2_N", s->vertical_end_2);
    json_put_number(json, "tension_end_2_N", s->tension_end_2);
    json_put_number(json, "tension_min_N", s->tension_min);
    json_put_number(json, "tension_max_N", s->tension_max);
    put_finite(json, "tension_parallel_to_chord_N", s->tension_parallel_to_chord);
    json_put_number(json, "span_m", s->span);
    json_put_number(json, "rise_m", s->rise);
    json_put_number(json, "unstretched_length_m", s->unstretched_length);
    json_put_number(json, "length_m", s->length);
    put_finite(json, "sag_mid_m", s->sag_mid);
    put_finite(json, "sag_max_m", s->sag_max);
    json_put_number(json, "depth_below_end_1_m", 0 - s->lowest.z);
    json_put_number(json, "angle_end_1_deg", degrees(s->angle_end_1));
    json_put_number(json, "angle_end_2_deg", degrees(s->angle_end_2));
    write_place(json, "lowest_point", s->lowest);
    write_place(json, "highest_point", s->highest);
}

static strum_status write_contacts(json_writer *json, const strum_hanging *cable, size_t count)
{
    strum_cable_contact c;
    strum_status status = STRUM_OK;
    json_key(json, "touchdown_m");
    json_open_array(json);
    for (size_t i = 0; i < count && status == STRUM_OK; i++) {
        status = strum_cable_contact_get(cable, i, &c);
        if (status == STRUM_OK)
            json_number(json, c.touchdown);
    }
    json_close_array(json);
    json_key(json, "contacts");
    json_open_array(json);
    for (size_t i = 0; i < count && status == STRUM_OK; i++) {
        status = strum_cable_contact_get(cable, i, &c);
        if (status != STRUM_OK)
            break;
        json_open_object(json);
        json_put_number(json, "from_m", c.from);
        json_put_number(json, "to_m", c.to);
        json_put_number(json, "slack_to_m", c.slack_to);
        json_put_number(json, "x_from_m", c.x_from);
        json_put_number(json, "x_to_m", c.x_to);
        json_close_object(json);
    }
    json_close_array(json);
    return status;
}

static void write_check(json_writer *json, const strum_cable_statics *s)
{
    json_put_integer(json, "solutions", s->solutions);
    if (isfinite(s->other_length)) {
        json_key(json, "other_branch");
        json_open_object(json);
        json_put_number(json, "unstretched_length_m", s->other_length);
        json_close_object(json);
    }
    json_key(json, "check");
    json_open_object(json);
    json_put_number(json, "closure", s->closure);
    put_finite(json, "lowest_clearance_m", s->lowest_clearance);
    put_finite(json, "smallest_reaction_N", s->smallest_reaction);
    json_close_object(json);
}

static strum_status write_attachments(const hung_input *in, const strum_hanging *cable,
                                      json_writer *json)
{
    strum_status status = STRUM_OK;
    json_key(json, "attachments");
    json_open_array(json);
    for (size_t i = 0; i < in->params.attachment_count; i++) {
        strum_cable_joint joint;
        status = strum_cable_attachment_get(cable, i, &joint);
        if (status != STRUM_OK)
            break;
        json_open_object(json);
        json_put_number(json, "position_m", joint.position);
        json_put_number(json, "x_m", joint.x);
        json_put_number(json, "z_m", joint.z);
        json_put_number(json, "tension_left_N", joint.tension_left);
        json_put_number(json, "tension_right_N", joint.tension_right);
        json_put_number(json, "kink_deg", degrees(joint.kink));
        json_close_object(json);
    }
    json_close_array(json);
    return status;
}

static strum_status write_shape(const strum_hanging *cable, size_t count, json_writer *json)
{
    strum_cable_point *points = malloc(count * sizeof *points);
    if (points == NULL)
        return STRUM_ERR_MEMORY;
    const strum_status status = strum_cable_shape(cable, NULL, count, points);
    json_key(json, "shape");
    json_open_array(json);
    for (size_t i = 0; i < count && status == STRUM_OK; i++) {
        json_open_object(json);
        json_put_number(json, "position_m", points[i].position);
        json_put_number(json, "x_m", points[i].x);
        json_put_number(json, "z_m", points[i].z);
        json_put_number(json, "tension_N", points[i].tension);
        json_put_number(json, "angle_deg", degrees(points[i].angle));
        json_close_object(json);
    }
    json_close_array(json);
    free(points);
    return status;
}

static strum_status write_statics(const hung_input *in, const strum_hanging *cable,
                                  size_t shape_points, json_writer *json)
{
    strum_cable_statics s;
    strum_cable_statics_get(cable, &s);
    json_key(json, "statics");
    json_open_object(json);
    write_figures(json, &s);
    strum_status status = write_contacts(json, cable, s.contacts);
    json_put_number(json, "lying_m", s.lying);
    json_put_flag(json, "slack", s.slack);
    write_check(json, &s);
    if (status == STRUM_OK)
        status = write_attachments(in, cable, json);
    json_put_number(json, "moment_end_1_N_m", s.moment_end_1);
    json_put_number(json, "moment_end_2_N_m", s.moment_end_2);
    if (status == STRUM_OK && shape_points > 0)
        status = write_shape(cable, shape_points, json);
    json_close_object(json);
    return status;
}

/* ---- sections and groups ---- */

/* By the names of the request, so that they can be posted again. */
static void write_section(const strum_cable_section *s, double diameter, json_writer *json)
{
    json_open_object(json);
    json_put_number(json, "length_m", s->length);
    json_put_number(json, "mass_kg_per_m", s->mass);
    json_put_number(json, "weight_N_per_m", s->weight);
    json_put_number(json, "added_mass_kg_per_m", s->added_mass);
    json_put_number(json, "added_mass_tangential_kg_per_m", s->added_mass_tangential);
    put_number_or_infinite(json, "axial_stiffness_N", s->axial_stiffness);
    json_put_number(json, "bending_stiffness_N_m2", s->bending_stiffness);
    json_put_number(json, "axial_loss_factor", s->axial_loss);
    json_put_number(json, "bending_loss_factor", s->bending_loss);
    json_put_number(json, "drag_normal_N_s_per_m2", s->drag_normal);
    json_put_number(json, "drag_tangential_N_s_per_m2", s->drag_tangential);
    put_finite(json, "bed_friction", s->bed_friction);
    if (diameter > 0)
        json_put_number(json, "diameter_m", diameter);
    json_close_object(json);
}

static strum_status write_sections(const hung_input *in, const strum_hanging *cable,
                                   json_writer *json)
{
    strum_status status = STRUM_OK;
    json_key(json, "sections");
    json_open_array(json);
    for (size_t i = 0; i < in->params.section_count && status == STRUM_OK; i++) {
        strum_cable_section s;
        status = strum_cable_section_get(cable, i, &s);
        if (status == STRUM_OK)
            write_section(&s, in->properties[i].outer_diameter, json);
    }
    json_close_array(json);
    return status;
}

/* Where the figures of chains are from. */
static void write_rules(const hung_input *in, json_writer *json)
{
    bool open = false;
    for (size_t i = 0; i < in->params.section_count; i++) {
        if (in->properties[i].rule == NULL)
            continue;
        if (!open) {
            json_key(json, "chain_rules");
            json_open_array(json);
        }
        open = true;
        json_open_object(json);
        json_put_integer(json, "section", (int64_t)i + 1);
        json_put_string(json, "rule", in->properties[i].rule);
        json_close_object(json);
    }
    if (open)
        json_close_array(json);
}

/* A cable as Irvine and Grinfogel see it: one weight, one stiffness, one tension. */
typedef struct mean_cable {
    double weight, compliance, length; /* N/m, 1/N, m unstretched */
} mean_cable;

static strum_status mean_of(const hung_input *in, const strum_hanging *cable, mean_cable *mean)
{
    *mean = (mean_cable){0, 0, 0};
    for (size_t i = 0; i < in->params.section_count; i++) {
        strum_cable_section s;
        const strum_status status = strum_cable_section_get(cable, i, &s);
        if (status != STRUM_OK)
            return status;
        mean->length += s.length;
        mean->weight += s.length * s.weight;
        mean->compliance += s.length / s.axial_stiffness;
    }
    mean->weight /= mean->length;
    mean->compliance /= mean->length;
    return STRUM_OK;
}

/* lambda^2 = (w l cos(theta)/T)^2 EA l/(T Le), Le = l (1 + (w l cos(theta)/T)^2/8), l and theta
 * of the chord, T where the cable is parallel to it  [Irvine 1981];  epsilon = w L/T [Grinfogel
 * 1984]. */
static void write_mean_groups(const strum_cable_statics *s, const mean_cable *mean,
                              json_writer *json)
{
    const double chord = hypot(s->span, s->rise), t = s->tension_parallel_to_chord;
    if (s->contacts > 0 || !(t > 0))
        return;
    const double pull = mean->weight * s->span / t;
    const double lambda = pull * pull / (t * mean->compliance * (1 + pull * pull / 8));
    if (chord > 0 && (mean->compliance > 0 || pull == 0)) {
        if (pull == 0)
            json_put_number(json, "lambda_squared", 0);
        else
            put_finite(json, "lambda_squared", lambda);
    } else if (chord > 0) {
        json_put_string(json, "lambda_squared", "infinite");
    }
    put_finite(json, "epsilon", mean->weight * mean->length / t);
}

/* Tension where each section begins, and where the last ends. */
static strum_status section_tensions(const hung_input *in, const strum_hanging *cable,
                                     strum_cable_point *points)
{
    const size_t count = in->params.section_count;
    strum_cable_statics s;
    double *places = malloc((count + 1) * sizeof *places);
    if (places == NULL)
        return STRUM_ERR_MEMORY;
    strum_cable_statics_get(cable, &s);
    strum_status status = STRUM_OK;
    places[0] = 0;
    for (size_t i = 0; i < count && status == STRUM_OK; i++) {
        strum_cable_section section;
        status = strum_cable_section_get(cable, i, &section);
        if (status == STRUM_OK)
            places[i + 1] = fmin(places[i] + section.length, s.unstretched_length);
    }
    if (status == STRUM_OK)
        status = strum_cable_shape(cable, places, count + 1, points);
    free(places);
    return status;
}

/* xi = L sqrt(T/EI), L the whole unstretched length, T where the section begins: 0 where a clamp
 * bends a rod so that it is compressed there. */
static double xi_of(const strum_cable_section *section, double tension, double length)
{
    return section->bending_stiffness > 0
               ? length * sqrt(fmax(tension, 0) / section->bending_stiffness)
               : INFINITY;
}

static strum_status write_groups(const hung_input *in, const strum_hanging *cable,
                                 json_writer *json)
{
    const size_t count = in->params.section_count;
    strum_cable_statics s;
    mean_cable mean;
    strum_cable_statics_get(cable, &s);
    strum_cable_point *points = malloc((count + 1) * sizeof *points);
    strum_status status = points != NULL ? mean_of(in, cable, &mean) : STRUM_ERR_MEMORY;
    if (status == STRUM_OK)
        status = section_tensions(in, cable, points);
    json_key(json, "groups");
    json_open_object(json);
    if (status == STRUM_OK)
        write_mean_groups(&s, &mean, json);
    json_key(json, "xi");
    json_open_array(json);
    for (size_t i = 0; i < count && status == STRUM_OK; i++) {
        const double xi =
            xi_of(&in->params.sections[i], points[i].tension, s.unstretched_length);
        if (isinf(xi))
            json_string(json, "infinite");
        else
            json_number(json, xi);
    }
    json_close_array(json);
    json_close_object(json);
    free(points);
    return status;
}

strum_status hung_write(const hung_input *in, const strum_hanging *cable, size_t shape_points,
                        json_writer *json)
{
    strum_status status = write_statics(in, cable, shape_points, json);
    if (status == STRUM_OK)
        status = write_sections(in, cable, json);
    if (status == STRUM_OK)
        status = write_groups(in, cable, json);
    write_rules(in, json);
    return status;
}

/* ---- size and work ---- */

double hung_bytes(const hung_input *in, size_t shape_points)
{
    static const size_t keys =
        sizeof "{\"position_m\":,\"x_m\":,\"z_m\":,\"tension_N\":,\"angle_deg\":},";
    (void)in;
    return (double)shape_points * ((double)keys + 5 * ANSWER_NUMBER_BYTES);
}

double hung_cost_us(const hung_input *in, size_t shape_points)
{
    const double pieces =
        (double)in->params.section_count + (double)in->params.attachment_count;
    const double unknown = in->params.given != STRUM_CABLE_LENGTHS ? 12 : 1;
    const double states = in->taken_in_m != 0 || in->temperature_change_K != 0 ? 2 : 1;
    const double bed = in->params.bed.present ? 20 : 1;
    return 20 + 3 * pieces + unknown * states * bed * (5 + 3 * pieces) +
           (in->params.stiff ? 400 + 300 * pieces : 0) + 1.5 * (double)shape_points;
}
