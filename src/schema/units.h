/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The unit in a field's name: tension_kN, weight_lbf_per_ft, band_Hz, frequency_Hz_min. */
#ifndef SCHEMA_UNITS_H
#define SCHEMA_UNITS_H

#include <stdbool.h>

#include "schema/schema.h"

typedef struct name_unit {
    bool known;
    int powers[4];                /* of metre, kilogram, second, radian */
    double factor;                /* one of this unit is so many of those */
    char text[NAME_MAX_SIZE];     /* "N/m" */
    char quantity[NAME_MAX_SIZE]; /* the name without the unit: "frequency_min" */
} name_unit;

name_unit unit_of_name(const char *name);
bool same_dimension(const name_unit *a, const name_unit *b);

#endif
