/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/numerics/status.h"

#include <stdarg.h>
#include <stdio.h>

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

strum_status error_set(strum_error *fault, strum_status status, const char *format, ...)
{
    if (fault != NULL) {
        va_list arguments;
        va_start(arguments, format);
        fault->status = status;
        (void)vsnprintf(fault->reason, sizeof fault->reason, format, arguments);
        va_end(arguments);
    }
    return status;
}
