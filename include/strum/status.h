/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Status codes of libstrum and their texts, from one table, and what a failing call says.
 *
 *     strum_error error;
 *     if (strum_modes_solve(&params, NULL, &modes, &error) != STRUM_OK)
 *         fprintf(stderr, "%s\n", error.reason[0] ? error.reason : strum_status_text(error.status));
 *
 * Every function of the library that can fail returns a strum_status: 0 is success, a negative
 * value an error. A function that can say more than the code takes a `strum_error *` (may be
 * NULL). The library never aborts, never prints, and changes no global state of its host.
 */
#ifndef STRUM_STATUS_H
#define STRUM_STATUS_H

#include <stddef.h>

#include <strum/export.h>

STRUM_BEGIN_DECLS

/* ENTRY(name, value, text) */
#define STRUM_STATUS_LIST(ENTRY)                                                               \
    ENTRY(STRUM_OK, 0, "success")                                                              \
    ENTRY(STRUM_ERR_RANGE, -1, "an argument is outside its documented range")                  \
    ENTRY(STRUM_ERR_IMPOSSIBLE, -2, "no such cable, or no such motion of it, can exist")       \
    ENTRY(STRUM_ERR_METHOD, -3, "the method does not apply to this cable")                     \
    ENTRY(STRUM_ERR_ACCURACY, -4,                                                              \
          "the promised accuracy was not reached within the size limit")                       \
    ENTRY(STRUM_ERR_MEMORY, -5, "out of memory")                                               \
    ENTRY(STRUM_ERR_CANCELLED, -6, "the computation was cancelled")                            \
    ENTRY(STRUM_ERR_INTERNAL, -7, "internal error")                                            \
    ENTRY(STRUM_ERR_WORK, -8, "the limit of work was reached")                                 \
    ENTRY(STRUM_ERR_TIME, -9, "the limit of CPU time was reached")                             \
    ENTRY(STRUM_ERR_BYTES, -10, "the limit of memory was reached")

typedef enum strum_status {
#define STRUM_STATUS_ENTRY(name, value, text) name = value,
    STRUM_STATUS_LIST(STRUM_STATUS_ENTRY)
#undef STRUM_STATUS_ENTRY
} strum_status;

/* No item of a list is at fault, or it is not known which. */
#define STRUM_NO_INDEX ((size_t)-1)

/* Why a call failed. Written by the failing call only. */
typedef struct strum_error {
    strum_status status;
    int argument; /* which parameter is at fault: a STRUM_*_ARG_* of the call's header; 0: none
                     alone */
    size_t index; /* which item of it, from 0, where it is a list; else STRUM_NO_INDEX */
    char reason[240]; /* a sentence the user can act on, NUL-terminated; may be empty */
} strum_error;

/* The text of a code: static, never NULL. */
const char *strum_status_text(strum_status status);

STRUM_END_DECLS
#endif
