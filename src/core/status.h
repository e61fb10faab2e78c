/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CORE_STATUS_H
#define CORE_STATUS_H

#include <strum/status.h>

/* Writes code and reason into `fault` (may be NULL) and returns the code, so that a failing
 * function can end in `return fault_set(fault, STRUM_ERR_..., "...", ...)`. */
strum_status fault_set(strum_fault *fault, strum_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
