/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cases of tests/cases in the program's own read-only memory, for /v1/validation. Written
 * at build time by cases.py, which spells out every tolerance. */
#ifndef VALIDATION_CASES_H
#define VALIDATION_CASES_H

#include <stddef.h>

typedef struct validation_case {
    const char *report; /* "gale" */
    const char *family, *id, *path, *source;
    const char *body; /* of the request; not ended by NUL */
    size_t body_size;
    const char
        *expect; /* JSON: {"checks": [..]} of an answer, {"status", "errors"} of a refusal */
} validation_case;

/* Those of one family stand together; ended by report NULL. */
extern const validation_case validation_cases[];

#endif
