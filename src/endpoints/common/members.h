/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Members that several answers write alike, into the object that is open. */
#ifndef ENDPOINTS_COMMON_MEMBERS_H
#define ENDPOINTS_COMMON_MEMBERS_H

#include <strum/types.h>

#include "json/write.h"

/* By strum_plane: also the keys of what is split by plane. */
extern const char *const plane_keys[];
/* By strum_symmetry. */
extern const char *const symmetry_names[];

/* A number that may be beyond a double, as a time is next to frequency 0: then it is left out. */
void put_finite(json_writer *json, const char *key, double value);
/* angular_frequency_rad_per_s and frequency_Hz, and period_s where it is finite. */
void put_frequency(json_writer *json, double rad_per_s);
/* The object "verification", and its members alone. */
void put_verification(json_writer *json, const strum_verification *v);
void put_verification_members(json_writer *json, const strum_verification *v);

#endif
