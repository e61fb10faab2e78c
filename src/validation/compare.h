/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An answer held against what a case of cases.h expects. */
#ifndef VALIDATION_COMPARE_H
#define VALIDATION_COMPARE_H

#include <cjson/cJSON.h>
#include <stdbool.h>

#include "json/write.h"

typedef struct comparison {
    json_writer *rows; /* of the caller: one object a value compared is written into it */
    size_t values, missed;
    /* The value that used up most of its tolerance. */
    double worst_difference, worst_tolerance;
    bool failed; /* memory ran out */
} comparison;

/* `checks` as cases.py writes them; adds to `c`. */
void compare_answer(const cJSON *checks, const cJSON *answer, comparison *c);

#endif
