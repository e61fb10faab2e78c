/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/numerics/work.h"

#include <stddef.h>

#include "core/numerics/status.h"

work work_begin(const strum_options *options)
{
    return (work){.options = options != NULL ? *options : (strum_options)STRUM_OPTIONS_INIT};
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
    return w->status;
}

strum_status work_error(const work *w, strum_error *error)
{
    if (w->status == STRUM_ERR_WORK)
        return error_set(error, w->status, "the work passed its limit of %g us",
                         w->options.work_max);
    return error_set(error, w->status, "%s", strum_status_text(w->status));
}
