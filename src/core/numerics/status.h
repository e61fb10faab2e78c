/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CORE_NUMERICS_STATUS_H
#define CORE_NUMERICS_STATUS_H

#include <strum/status.h>

/* Writes code and reason into `error` (may be NULL) and returns the code, so that a failing
 * function can end in `return error_set(error, STRUM_ERR_..., "...", ...)`. */
strum_status error_set(strum_error *error, strum_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* The same of one parameter (a STRUM_*_ARG_*) and, where it is a list, one item of it. */
strum_status error_at(strum_error *error, strum_status status, int argument, size_t index,
                      const char *format, ...) __attribute__((format(printf, 5, 6)));

#endif
