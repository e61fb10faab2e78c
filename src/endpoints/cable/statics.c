/* SPDX-License-Identifier: GPL-3.0-or-later */
/* /v1/cable/statics: the shape and the forces of a cable as it hangs. */
#include "endpoints/cable/answer.h"
#include "endpoints/cable/prepare.h"

typedef struct request {
    hung_input in;
    int64_t shape_points;
} request;

static const field fields[] = {
    HUNG_FIELDS,
    {FIELD_AT(FIELD_INTEGER, request, shape_points), .min = 0, .max = HUNG_SHAPE_POINTS_MAX,
     .flags = FIELD_DEFAULT,
     .help = "points of the shape, equally spaced in unstretched length, ends included; 0: "
             "none, else at least 2"},
    {.kind = FIELD_END}};
static const field_groups groups[] = {HUNG_GROUPS, {0}};

static const schema request_schema = {.name = "cable_statics_request",
                                      .fields = fields,
                                      .groups = groups,
                                      .size = sizeof(request)};

static void prepare(void *data, schema_arena *arena, problem *p)
{
    request *r = data;
    hung_prepare(&request_schema, &r->in, arena, p);
    hung_check_shape_points(r->shape_points, p);
}

static double cost_us(const void *data)
{
    const request *r = data;
    return hung_cost_us(&r->in, (size_t)r->shape_points);
}

static double answer_bytes(const void *data, const char **pointer)
{
    const request *r = data;
    *pointer = "/shape_points";
    return hung_bytes(&r->in, (size_t)r->shape_points);
}

static bool respond(const void *data, answer *a)
{
    const request *r = data;
    strum_hanging *cable = NULL;
    strum_error error = {0};
    strum_status status = hung_solve(&r->in, a, &cable, &error);
    if (status == STRUM_OK) {
        a->theory = r->in.params.stiff
                        ? "statics of an extensible rod with bending stiffness"
                        : "elastic catenaries between sections and loads: the minimum of a "
                          "convex function";
        hung_warn(&r->in, cable, a);
        json_open_object(a->result);
        status = hung_write(&r->in, cable, (size_t)r->shape_points, a->result);
        json_close_object(a->result);
    }
    strum_cable_free(cable);
    if (status != STRUM_OK)
        hung_refuse(&r->in, &error, status, a->problem);
    return status == STRUM_OK;
}

const endpoint cable_statics = {
    .path = "/v1/cable/statics",
    .title = "Shape and forces of a cable as it hangs, free or on a sea bed",
    .request = &request_schema,
    .query = true,
    .prepare = prepare,
    .cost_us = cost_us,
    .answer_bytes = answer_bytes,
    .answer = respond};
