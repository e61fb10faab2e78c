/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "endpoints/common/members.h"

#include <math.h>

const char *const plane_keys[] = {"in_plane", "out_of_plane"};
const char *const symmetry_names[] = {"none", "symmetric", "antisymmetric"};

void put_frequency(json_writer *json, double rad_per_s)
{
    json_put_number(json, "angular_frequency_rad_per_s", rad_per_s);
    json_put_number(json, "frequency_Hz", rad_per_s / (2 * M_PI));
    put_finite(json, "period_s", 2 * M_PI / rad_per_s);
}

void put_finite(json_writer *json, const char *key, double value)
{
    if (isfinite(value))
        json_put_number(json, key, value);
}

void put_verification(json_writer *json, const strum_verification *v)
{
    json_key(json, "verification");
    json_open_object(json);
    put_verification_members(json, v);
    json_close_object(json);
}

void put_verification_members(json_writer *json, const strum_verification *v)
{
    json_put_string(json, "method", v->method);
    json_put_number(json, "max_relative_difference", v->max_relative_difference);
    json_put_integer(json, "modes_expected", v->modes_expected);
    json_put_integer(json, "modes_found", v->modes_found);
    json_put_number(json, "max_residual", v->max_residual);
}
