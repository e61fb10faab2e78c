/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "endpoints/cable/motion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "endpoints/common/members.h"

/* Held and sliding frequencies that differ by more are worth a warning. */
#define SLIDING_DIFFERS 0.01

void motion_free(motion planes[2])
{
    for (int plane = 0; plane < 2; plane++) {
        strum_cable_modes_free(planes[plane].modes);
        strum_cable_modes_free(planes[plane].sliding);
    }
}

/* ---- one mode ---- */

/* Undamped values are real. */
static void put_value(json_writer *json, const char *key, bool damped, strum_complex value)
{
    if (damped)
        json_put_complex(json, key, value);
    else
        json_put_number(json, key, creal(value));
}

static void write_pair(json_writer *json, const char *key, bool damped,
                       const strum_complex values[2])
{
    json_key(json, key);
    json_open_array(json);
    for (int end = 0; end < 2; end++) {
        if (damped)
            json_complex(json, values[end]);
        else
            json_number(json, creal(values[end]));
    }
    json_close_array(json);
}

static void write_figures(json_writer *json, size_t i, const strum_cable_mode *m)
{
    json_put_integer(json, "mode", (int64_t)i + 1);
    put_frequency(json, m->frequency);
    if (m->damped) {
        json_put_number(json, "decay_rate_per_s", m->decay);
        json_put_number(json, "damping_ratio", m->decay / hypot(m->frequency, m->decay));
        put_finite(json, "loss_ratio", m->decay / m->frequency);
        put_finite(json, "log_decrement", 2 * M_PI * m->decay / m->frequency);
    }
    json_key(json, "energy");
    json_open_object(json);
    json_put_number(json, "tension", m->energy_tension);
    json_put_number(json, "bending", m->energy_bending);
    json_put_number(json, "axial", m->energy_axial);
    json_put_number(json, "attachments", m->energy_attachments);
    json_close_object(json);
    json_put_number(json, "attachment_share", m->attachment_share);
    json_put_number(json, "symmetric_share", m->symmetric_share);
    write_pair(json, "end_tension_N_per_m", m->damped, m->end_tension);
    write_pair(json, "end_moment_N_m_per_m", m->damped, m->end_moment);
}

static strum_status write_shape(const strum_cable_modes *modes, size_t i, size_t count,
                                strum_plane plane, bool damped, json_writer *json)
{
    strum_cable_motion_point *points = malloc(count * sizeof *points);
    if (points == NULL)
        return STRUM_ERR_MEMORY;
    const strum_status status = strum_cable_modes_shape(modes, i, NULL, count, points);
    json_key(json, "shape");
    json_open_array(json);
    for (size_t k = 0; k < count && status == STRUM_OK; k++) {
        json_open_object(json);
        json_put_number(json, "position_m", points[k].position);
        if (plane == STRUM_IN_PLANE) {
            put_value(json, "x", damped, points[k].x);
            put_value(json, "z", damped, points[k].z);
            put_value(json, "tension", damped, points[k].tension);
        } else {
            put_value(json, "y", damped, points[k].y);
        }
        put_value(json, "curvature", damped, points[k].curvature);
        json_close_object(json);
    }
    json_close_array(json);
    free(points);
    return status;
}

/* The frequency of the same number where what lies slides; NAN where there is none. */
static double sliding_frequency(const motion *m, size_t i)
{
    strum_cable_mode other;
    return m->sliding != NULL && strum_cable_modes_get(m->sliding, i, &other) == STRUM_OK
               ? other.frequency
               : NAN;
}

static strum_status write_mode(const motion *m, size_t i, strum_plane plane,
                               size_t shape_points, json_writer *json)
{
    strum_cable_mode mode;
    strum_status status = strum_cable_modes_get(m->modes, i, &mode);
    if (status != STRUM_OK)
        return status;
    json_open_object(json);
    write_figures(json, i, &mode);
    if (m->held) {
        json_put_integer(json, "run", (int64_t)mode.run + 1);
        put_finite(json, "frequency_Hz_sliding", sliding_frequency(m, i) / (2 * M_PI));
    }
    if (shape_points > 0)
        status = write_shape(m->modes, i, shape_points, plane, mode.damped, json);
    json_close_object(json);
    return status;
}

/* ---- all of them ---- */

static void write_overdamped(const motion planes[2], json_writer *json)
{
    json_key(json, "overdamped");
    json_open_array(json);
    for (int plane = 0; plane < 2; plane++) {
        const double *decays;
        if (planes[plane].modes == NULL)
            continue;
        const size_t count = strum_cable_modes_overdamped(planes[plane].modes, &decays);
        for (size_t i = 0; i < count; i++) {
            json_open_object(json);
            json_put_string(json, "plane", plane_keys[plane]);
            json_put_number(json, "decay_rate_per_s", decays[i]);
            json_close_object(json);
        }
    }
    json_close_array(json);
}

static void write_count(const motion planes[2], json_writer *json)
{
    strum_cable_certificate sum = {"", 0, 0, 0};
    for (int plane = 0; plane < 2; plane++) {
        strum_cable_certificate c;
        if (planes[plane].modes == NULL)
            continue;
        strum_cable_modes_certificate(planes[plane].modes, &c);
        /* damped in one plane only: its count is the longer story */
        if (strlen(c.method) > strlen(sum.method))
            sum.method = c.method;
        sum.expected += c.expected;
        sum.found += c.found;
        sum.error = fmax(sum.error, c.error);
    }
    json_key(json, "count");
    json_open_object(json);
    json_put_string(json, "method", sum.method);
    json_put_integer(json, "expected", sum.expected);
    json_put_integer(json, "found", sum.found);
    json_put_number(json, "error_estimate", sum.error);
    json_close_object(json);
}

strum_status motion_write(const motion planes[2], size_t shape_points, json_writer *json)
{
    strum_status status = STRUM_OK;
    for (int plane = 0; plane < 2; plane++) {
        const motion *m = &planes[plane];
        if (m->modes == NULL)
            continue;
        json_key(json, plane_keys[plane]);
        json_open_array(json);
        for (size_t i = 0; i < strum_cable_modes_count(m->modes) && status == STRUM_OK; i++)
            status = write_mode(m, i, (strum_plane)plane, shape_points, json);
        json_close_array(json);
    }
    write_overdamped(planes, json);
    write_count(planes, json);
    if (shape_points > 0)
        json_put_string(json, "normalisation",
                        "the largest displacement component along the cable is 1");
    return status;
}

double motion_bytes(size_t modes, size_t shape_points)
{
    static const size_t keys = sizeof "{\"position_m\":,\"y\":,\"curvature\":},";
    return (double)modes * (double)shape_points * ((double)keys + 2 * ANSWER_NUMBER_BYTES);
}

strum_status motion_verify(const motion planes[2], const strum_options *options, answer *a,
                           strum_error *error)
{
    strum_verification worst = {.method = NULL};
    for (int plane = 0; plane < 2; plane++) {
        strum_verification v;
        if (planes[plane].modes == NULL)
            continue;
        const strum_status status =
            strum_cable_modes_verify(planes[plane].modes, options, &v, error);
        if (status == STRUM_ERR_ACCURACY) {
            answer_warn(a, "not verified %s: %s",
                        plane == STRUM_IN_PLANE ? "in plane" : "out of plane", error->reason);
            continue;
        }
        if (status != STRUM_OK)
            return status;
        worst.method = v.method;
        worst.max_relative_difference =
            fmax(worst.max_relative_difference, v.max_relative_difference);
        worst.max_residual = fmax(worst.max_residual, v.max_residual);
        worst.modes_expected += v.modes_expected;
        worst.modes_found += v.modes_found;
    }
    if (worst.method != NULL)
        put_verification(a->result, &worst);
    return STRUM_OK;
}

/* ---- warnings ---- */

bool motion_acts(strum_cable_direction direction, strum_plane plane)
{
    if (direction == STRUM_CABLE_ALL)
        return true;
    return (direction == STRUM_CABLE_ACROSS) == (plane == STRUM_OUT_OF_PLANE);
}

/* Only where one plane is asked: with both, each link acts in one of them. */
static void warn_links(const hung_input *in, strum_plane plane, answer *a)
{
    size_t last = SIZE_MAX;
    for (size_t i = 0; i < in->params.attachment_count; i++) {
        const strum_cable_attachment *one = &in->params.attachments[i];
        const bool link = one->kind == STRUM_CABLE_SPRING || one->kind == STRUM_CABLE_DAMPER ||
                          one->kind == STRUM_CABLE_INERTER || one->kind == STRUM_CABLE_ABSORBER;
        if (!link || motion_acts(one->direction, plane) || in->origin[i] == last)
            continue;
        last = in->origin[i];
        answer_warn(a, "attachments/%zu cannot act %s: its direction lies %s", last,
                    plane == STRUM_IN_PLANE ? "in the plane" : "out of the plane",
                    plane == STRUM_IN_PLANE ? "out of it" : "in it");
    }
}

static void warn_sliding(const motion *m, strum_plane plane, answer *a)
{
    double worst = 0;
    size_t which = 0;
    for (size_t i = 0; i < strum_cable_modes_count(m->modes); i++) {
        strum_cable_mode mode;
        if (strum_cable_modes_get(m->modes, i, &mode) != STRUM_OK)
            continue;
        const double difference = fabs(sliding_frequency(m, i) / mode.frequency - 1);
        if (difference > worst) {
            worst = difference;
            which = i + 1;
        }
    }
    if (worst > SLIDING_DIFFERS)
        answer_warn(a,
                    "%s mode %zu changes by %.2g %% where what lies on the bed slides rather "
                    "than is held: the truth lies between, by the friction of the bed",
                    plane == STRUM_IN_PLANE ? "in-plane" : "out-of-plane", which, 100 * worst);
}

void motion_warn(const hung_input *in, const motion planes[2], answer *a)
{
    for (int plane = 0; plane < 2; plane++) {
        if (planes[plane].modes == NULL)
            continue;
        if (planes[1 - plane].modes == NULL)
            warn_links(in, (strum_plane)plane, a);
        if (planes[plane].sliding != NULL)
            warn_sliding(&planes[plane], (strum_plane)plane, a);
    }
}
