/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/numerics/status.h"

#include <stdarg.h>
#include <stdio.h>

#include <strum/version.h>

const char *strum_status_text(strum_status status)
{
    switch (status) {
#define STRUM_STATUS_CASE(name, value, text)                                                   \
    case name:                                                                                 \
        return text;
        STRUM_STATUS_LIST(STRUM_STATUS_CASE)
#undef STRUM_STATUS_CASE
    }
    return "unknown status";
}

const char *strum_version(void)
{
    return STRUM_VERSION;
}

int strum_solver(void)
{
    return STRUM_SOLVER;
}

__attribute__((format(printf, 5, 0))) static strum_status set(strum_error *error,
                                                              strum_status status, int argument,
                                                              size_t index, const char *format,
                                                              va_list arguments)
{
    if (error != NULL) {
        error->status = status;
        error->argument = argument;
        error->index = index;
        (void)vsnprintf(error->reason, sizeof error->reason, format, arguments);
    }
    return status;
}

strum_status error_set(strum_error *error, strum_status status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    set(error, status, 0, STRUM_NO_INDEX, format, arguments);
    va_end(arguments);
    return status;
}

strum_status error_at(strum_error *error, strum_status status, int argument, size_t index,
                      const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    set(error, status, argument, index, format, arguments);
    va_end(arguments);
    return status;
}
