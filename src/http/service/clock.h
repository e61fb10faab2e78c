/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Time that only moves forward. */
#ifndef HTTP_SERVICE_CLOCK_H
#define HTTP_SERVICE_CLOCK_H

#include <stdint.h>
#include <time.h>

/* Accurate to a few milliseconds, and nearly free. */
static inline int64_t clock_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC_COARSE, &now);
    return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

static inline double clock_us(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e6 + (double)now.tv_nsec * 1e-3;
}

#endif
