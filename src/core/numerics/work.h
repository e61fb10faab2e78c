/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The work of one solve: counted as it is done, so that a caller can stop or bound it
 * (include/strum/options.h). One `work` goes with a solve, from its public call down.
 */
#ifndef CORE_NUMERICS_WORK_H
#define CORE_NUMERICS_WORK_H

#include <strum/options.h>
#include <strum/status.h>

typedef struct work {
    strum_options options;
    double done;         /* microseconds of a present-day core, as estimated */
    strum_status status; /* STRUM_OK, or why all further work is refused: it stays so */
} work;

/* `options` may be NULL. */
work work_begin(const strum_options *options);
/* Says that work of about `us` microseconds comes next. Not STRUM_OK (STRUM_ERR_CANCELLED,
 * STRUM_ERR_WORK): do not begin it. `w` may be NULL: no limit. */
strum_status work_spend(work *w, double us);
/* error_set with a sentence for the status that work_spend returned. */
strum_status work_error(const work *w, strum_error *error);

#endif
