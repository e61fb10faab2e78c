/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/numerics/work.h"

#include <time.h>

#include "core/numerics/status.h"

/* Reading the clock takes about a third of a microsecond: it is read before work of this many
 * microseconds, and whenever so much was done since. */
#define CLOCK_US 50

static double cpu_now(void)
{
    struct timespec now;
    return clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) == 0
               ? (double)now.tv_sec + 1e-9 * (double)now.tv_nsec
               : 0;
}

work work_begin(const strum_options *options)
{
    work w = {.options = options != NULL ? *options : (strum_options)STRUM_OPTIONS_INIT};
    if (w.options.cpu_seconds > 0)
        w.cpu_end = cpu_now() + w.options.cpu_seconds;
    return w;
}

/* Whether the time is over. What costs nothing by estimate is a poll within a long loop. */
static bool late(work *w, double us)
{
    if (w->cpu_end == 0 || (us > 0 && w->done - w->looked < CLOCK_US))
        return false;
    w->looked = w->done;
    return cpu_now() >= w->cpu_end;
}

strum_status work_spend(work *w, double us)
{
    if (w == NULL)
        return STRUM_OK;
    w->done += us;
    if (w->status != STRUM_OK)
        return w->status;
    if (w->options.cancelled != NULL && w->options.cancelled(w->options.context))
        w->status = STRUM_ERR_CANCELLED;
    else if (w->options.work_max > 0 && w->done > w->options.work_max)
        w->status = STRUM_ERR_WORK;
    else if (late(w, us))
        w->status = STRUM_ERR_TIME;
    return w->status;
}

bool work_take(work *w, size_t bytes)
{
    if (w == NULL)
        return true;
    const size_t most = w->options.bytes_max;
    if (most > 0 && (bytes > most || w->bytes > most - bytes)) {
        if (w->status == STRUM_OK)
            w->status = STRUM_ERR_BYTES;
        return false;
    }
    w->bytes += bytes;
    return true;
}

void work_give_back(work *w, size_t bytes)
{
    if (w != NULL)
        w->bytes -= bytes;
}

strum_status work_error(const work *w, strum_error *error)
{
    const strum_options *o = &w->options;
    switch (w->status) {
    case STRUM_ERR_WORK:
        return error_set(error, w->status, "the work passed its limit of %g us", o->work_max);
    case STRUM_ERR_TIME:
        return error_set(error, w->status, "the CPU time passed its limit of %g s",
                         o->cpu_seconds);
    case STRUM_ERR_BYTES:
        return error_set(error, w->status, "the memory would pass its limit of %zu bytes",
                         o->bytes_max);
    default:
        return error_set(error, w->status, "%s", strum_status_text(w->status));
    }
}

strum_status work_result(const work *w, strum_status status, strum_error *error)
{
    if (status == STRUM_OK)
        return status;
    return w->status != STRUM_OK ? work_error(w, error)
                                 : error_set(error, status, "%s", strum_status_text(status));
}
