/* SPDX-License-Identifier: GPL-3.0-or-later */
/* /v1/identify/tension: the usual formulas beside the answer. */
#include "endpoints/identify/answer.h"

#include <math.h>

static void write_tension(json_writer *json, double tension)
{
    if (isnan(tension))
        json_string(json, "no solution");
    else
        json_number(json, tension);
}

static void write_list(json_writer *json, const char *key, const double *tensions, size_t count)
{
    json_key(json, key);
    json_open_array(json);
    for (size_t i = 0; i < count; i++)
        write_tension(json, tensions[i]);
    json_close_array(json);
}

/* A formula of one mode, where that mode is among the data. */
static void write_one(json_writer *json, const char *key, const char *branch_key,
                      double tension, const char *branch, bool outside)
{
    if (branch == NULL)
        return;
    json_put_number(json, key, tension);
    json_key(json, branch_key);
    json_open_object(json);
    json_put_string(json, "branch", branch);
    json_put_flag(json, "outside_its_range", outside);
    json_close_object(json);
}

static void write_flags(json_writer *json, const char *key, const bool *flags, size_t count)
{
    json_key(json, key);
    json_open_array(json);
    for (size_t i = 0; i < count; i++)
        json_flag(json, flags[i]);
    json_close_array(json);
}

void identify_write_comparison(json_writer *json, const strum_identify *found)
{
    strum_identify_comparison c;
    const size_t count = strum_identify_count(found);
    if (strum_identify_compare(found, &c) != STRUM_OK)
        return;
    json_key(json, "comparison");
    json_open_object(json);
    write_list(json, "string_rule_N", c.string_rule, count);
    json_put_number(json, "string_mean_N", c.string_mean);
    if (isfinite(c.regression)) {
        json_put_number(json, "regression_N", c.regression);
        json_put_number(json, "regression_bending_stiffness_N_m2", c.regression_bending);
    }
    write_one(json, "zui_mode_1_N", "zui_mode_1", c.zui_1, c.zui_1_branch, c.zui_1_outside);
    write_one(json, "zui_mode_2_N", "zui_mode_2", c.zui_2, c.zui_2_branch, c.zui_2_outside);
    json_key(json, "zui_higher_modes");
    json_open_array(json);
    for (size_t i = 0; i < count; i++) {
        strum_identify_mode m;
        if (isnan(c.zui_n[i]) || strum_identify_get(found, i, &m) != STRUM_OK)
            continue;
        json_open_object(json);
        json_put_integer(json, "mode", m.mode);
        json_put_number(json, "tension_N", c.zui_n[i]);
        json_put_flag(json, "outside_its_range", c.zui_n_outside[i]);
        json_close_object(json);
    }
    json_close_array(json);
    write_one(json, "ren_N", "ren", c.ren, c.ren_branch, c.ren_outside);
    write_list(json, "mehrabi_tabatabai_N", c.mehrabi_tabatabai, count);
    write_flags(json, "mehrabi_tabatabai_outside_its_range", c.mehrabi_tabatabai_outside,
                count);
    json_close_object(json);
}
