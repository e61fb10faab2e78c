/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What every solve and verification takes beside its parameters: how it can be stopped, and
 * what it may use.
 *
 *     strum_options options = STRUM_OPTIONS_INIT;
 *     options.cancelled = user_pressed_stop;
 *     options.cpu_seconds = 2;
 *     status = strum_modes_solve(&params, &options, &modes, &error);
 *
 * A NULL in place of the options is STRUM_OPTIONS_INIT: never stopped, no limits.
 */
#ifndef STRUM_OPTIONS_H
#define STRUM_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

#include <strum/export.h>

STRUM_BEGIN_DECLS

typedef struct strum_options {
    /* Asked now and then from the calling thread, often enough that a solve ends within about
     * 0.3 s once it returns true; may be NULL. The solve then returns STRUM_ERR_CANCELLED. */
    bool (*cancelled)(void *context);
    void *context; /* handed to `cancelled`; the caller's */
    /* Most work, in microseconds of a present-day core; 0: no limit of the caller's. Work is
     * estimated from sizes and counted, never timed, so that the same call always ends the
     * same way; beyond the limit it returns STRUM_ERR_WORK. */
    double work_max;
    /* Most CPU time of the calling thread, in seconds from the call on; 0: no limit. Measured,
     * so that a call near the limit may end either way; beyond it STRUM_ERR_TIME. */
    double cpu_seconds;
    /* Most memory, in bytes, that the call holds at any moment, with what it returns; 0: no
     * limit. Counted where it grows with the question: of suspended and inclined cables'
     * solves. A request that would pass it is not made: STRUM_ERR_BYTES. */
    size_t bytes_max;
} strum_options;

#define STRUM_OPTIONS_INIT                                                                     \
    {                                                                                          \
        0, 0, 0.0, 0.0, 0                                                                      \
    }

STRUM_END_DECLS
#endif
