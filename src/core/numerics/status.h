/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CORE_NUMERICS_STATUS_H
#define CORE_NUMERICS_STATUS_H

#include <strum/status.h>

/* Writes code and reason into `fault` (may be NULL) and returns the code, so that a failing
 * function can end in `return error_set(fault, STRUM_ERR_..., "...", ...)`. */
strum_status error_set(strum_error *fault, strum_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
