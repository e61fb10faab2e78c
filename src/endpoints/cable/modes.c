/* SPDX-License-Identifier: GPL-3.0-or-later */
/* /v1/cable/modes: small motion of a cable about its static shape. */
#include <math.h>

#include "endpoints/cable/answer.h"
#include "endpoints/cable/comparison.h"
#include "endpoints/cable/motion.h"
#include "endpoints/cable/prepare.h"

enum { PLANE_IN, PLANE_OUT, PLANE_BOTH };
static const char *const planes[] = {"in_plane", "out_of_plane", "both", NULL};
static const char *const contacts[] = {"held", "sliding", NULL};

typedef struct request {
    hung_input in;
    int plane, contact;
    int64_t modes, shape_points;
    bool compare;
} request;

static const field fields[] = {
    HUNG_FIELDS,
    {FIELD_AT(FIELD_CHOICE, request, plane), .choices = planes, .flags = FIELD_DEFAULT,
     .fallback = PLANE_BOTH, .help = "of the motion"},
    {FIELD_AT(FIELD_INTEGER, request, modes), .min = 1, .max = STRUM_CABLE_MODES_MAX,
     .flags = FIELD_DEFAULT, .fallback = 6, .help = "modes of each plane, from the lowest"},
    {FIELD_AT(FIELD_CHOICE, request, contact), .choices = contacts, .flags = FIELD_DEFAULT,
     .help = "what lies on the bed is held there, or slides without friction"},
    {FIELD_AT(FIELD_INTEGER, request, shape_points), .min = 0, .max = HUNG_SHAPE_POINTS_MAX,
     .flags = FIELD_DEFAULT,
     .help = "points of the static shape and of each mode's, equally spaced in unstretched "
             "length, ends included; 0: none, else at least 2"},
    {FIELD_AT(FIELD_FLAG, request, compare), .flags = FIELD_DEFAULT,
     .help = "put the simpler theories beside the answer, with differences"},
    {.kind = FIELD_END}};
static const field_groups groups[] = {HUNG_GROUPS, {0}};

static const schema request_schema = {
    .name = "cable_modes_request", .fields = fields, .groups = groups, .size = sizeof(request)};

static bool asks(const request *r, strum_plane plane)
{
    return r->plane == PLANE_BOTH ||
           r->plane == (plane == STRUM_IN_PLANE ? PLANE_IN : PLANE_OUT);
}

static void prepare(void *data, schema_arena *arena, problem *p)
{
    request *r = data;
    hung_prepare(&request_schema, &r->in, arena, p);
    hung_check_shape_points(r->shape_points, p);
}

static size_t plane_count(const request *r)
{
    return r->plane == PLANE_BOTH ? 2 : 1;
}

/* Damping along the cable, which the reduced model has as a full matrix. */
static bool drags(const strum_cable_params *p)
{
    for (size_t i = 0; i < p->section_count; i++) {
        const strum_cable_section *s = &p->sections[i];
        if (s->axial_loss > 0 || s->bending_loss > 0 || s->drag_normal > 0 ||
            s->drag_tangential > 0)
            return true;
    }
    return false;
}

/* Measured, tests/bench/costs. */
static double cost_us(const void *data)
{
    const request *r = data;
    const strum_cable_params *p = &r->in.params;
    const double modes = (double)r->modes,
                 pieces = (double)(p->section_count + p->attachment_count);
    double plane = (350 + 250 * modes * (1 + pow(modes / 60, 3))) * (0.75 + 0.25 * pieces) *
                   (double)p->spans;
    plane *= (p->stiff ? 2 : 1) * (p->bed.present ? 8 : 1) * (drags(p) ? 10 : 1);
    plane *= r->compare ? 4 : 1;
    return hung_cost_us(&r->in, (size_t)r->shape_points) +
           (double)plane_count(r) * (plane + 1.7 * modes * (double)r->shape_points);
}

static double answer_bytes(const void *data, const char **pointer)
{
    const request *r = data;
    *pointer = "/shape_points";
    return hung_bytes(&r->in, (size_t)r->shape_points) +
           (double)plane_count(r) * motion_bytes((size_t)r->modes, (size_t)r->shape_points);
}

/* Modes of one plane; where what lies is held, those of a sliding cable beside them, if there are
 * such (one that lies slack has none). */
static strum_status solve_plane(const request *r, const strum_hanging *cable, strum_plane plane,
                                const strum_options *options, motion *m, strum_error *error)
{
    strum_cable_statics s;
    strum_cable_modes_params params = {
        plane, (int)r->modes, r->contact == 1 ? STRUM_CABLE_SLIDING : STRUM_CABLE_HELD};
    strum_status status = strum_cable_modes_solve(cable, &params, options, &m->modes, error);
    strum_cable_statics_get(cable, &s);
    m->held = s.contacts > 0 && r->contact == 0;
    if (status != STRUM_OK || !m->held)
        return status;
    strum_error none;
    params.contact = STRUM_CABLE_SLIDING;
    status = strum_cable_modes_solve(cable, &params, options, &m->sliding, &none);
    const bool found =
        status == STRUM_OK || status == STRUM_ERR_IMPOSSIBLE || status == STRUM_ERR_ACCURACY;
    if (!found)
        *error = none;
    return found ? STRUM_OK : status;
}

static const char *theory(const request *r)
{
    return r->in.params.stiff
               ? "small motion of an extensible rod about its own static shape: Galerkin's "
                 "method in strains, counted by inertia"
               : "small motion about elastic catenaries, with bending stiffness where there is "
                 "any: Galerkin's method in strains, counted by inertia";
}

static void warn_few(const request *r, const motion found[2], answer *a)
{
    for (int plane = 0; plane < 2; plane++)
        if (found[plane].modes != NULL &&
            strum_cable_modes_count(found[plane].modes) < (size_t)r->modes)
            answer_warn(a, "the cable has only %zu modes that oscillate %s",
                        strum_cable_modes_count(found[plane].modes),
                        plane == STRUM_IN_PLANE ? "in plane" : "out of plane");
}

static strum_status write_result(const request *r, const strum_hanging *cable,
                                 const motion found[2], answer *a, strum_error *error)
{
    hung_warn(&r->in, cable, a);
    motion_warn(&r->in, found, a);
    warn_few(r, found, a);
    json_open_object(a->result);
    strum_status status = hung_write(&r->in, cable, (size_t)r->shape_points, a->result);
    if (status == STRUM_OK)
        status = motion_write(found, (size_t)r->shape_points, a->result);
    if (status == STRUM_OK && r->compare) {
        const strum_options options = answer_options(a);
        status = comparison_write(&r->in, cable, found, (size_t)r->modes, &options, a->result,
                                  error);
    }
    json_close_object(a->result);
    return status;
}

static bool respond(const void *data, answer *a)
{
    const request *r = data;
    const strum_options options = answer_options(a);
    strum_hanging *cable = NULL;
    motion found[2] = {{NULL, NULL, false}, {NULL, NULL, false}};
    strum_error error = {0};
    strum_status status = hung_solve(&r->in, a, &cable, &error);
    for (int plane = 0; plane < 2 && status == STRUM_OK; plane++)
        if (asks(r, (strum_plane)plane))
            status = solve_plane(r, cable, (strum_plane)plane, &options, &found[plane], &error);
    if (status == STRUM_OK) {
        a->theory = theory(r);
        status = write_result(r, cable, found, a, &error);
    }
    motion_free(found);
    strum_cable_free(cable);
    if (status != STRUM_OK)
        hung_refuse(&r->in, &error, status, a->problem);
    return status == STRUM_OK;
}

const endpoint cable_modes = {
    .path = "/v1/cable/modes",
    .title = "Modes of a cable as it hangs: sag, bending, bodies, dampers, sea bed",
    .request = &request_schema,
    .query = true,
    .prepare = prepare,
    .cost_us = cost_us,
    .answer_bytes = answer_bytes,
    .answer = respond};
