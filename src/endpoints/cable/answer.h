/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What every answer about a general cable has: its statics, its sections as resolved, its
 * groups, and the warnings about them. */
#ifndef ENDPOINTS_CABLE_ANSWER_H
#define ENDPOINTS_CABLE_ANSWER_H

#include "endpoints/cable/fields.h"

/* The cable as it hangs; the caller ends it by strum_cable_free. */
strum_status hung_solve(const hung_input *in, const answer *a, strum_hanging **cable,
                        strum_error *error);
/* Turns an error of the core into a problem, laid at the field that it is about. */
void hung_refuse(const hung_input *in, const strum_error *error, strum_status status,
                 problem *p);

/* The members statics, sections and groups of an open object; a shape of so many points where
 * that is above 0. */
strum_status hung_write(const hung_input *in, const strum_hanging *cable, size_t shape_points,
                        json_writer *json);
void hung_warn(const hung_input *in, const strum_hanging *cable, answer *a);

/* Work and least size of what hung_write writes. */
double hung_cost_us(const hung_input *in, size_t shape_points);
double hung_bytes(const hung_input *in, size_t shape_points);

/* "infinite" where it is. */
void put_number_or_infinite(json_writer *json, const char *key, double value);

#define HUNG_SHAPE_POINTS_MAX 2000

#endif
