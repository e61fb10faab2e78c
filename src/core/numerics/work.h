/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What one solve uses: work and memory, counted as they are used, and CPU time, so that a caller
 * can stop or bound it (include/strum/options.h). One `work` goes with a solve, from its public
 * call down; arenas that belong to it point at it.
 */
#ifndef CORE_NUMERICS_WORK_H
#define CORE_NUMERICS_WORK_H

#include <stddef.h>

#include <strum/options.h>
#include <strum/status.h>

/* One of zeros has no limits. */
typedef struct work {
    strum_options options;
    double done;         /* microseconds of a present-day core, as estimated */
    double looked;       /* `done` when the clock was read last */
    double cpu_end;      /* of the thread's CPU clock, in seconds; 0: no limit */
    size_t bytes;        /* held now by the arenas of this solve */
    strum_status status; /* STRUM_OK, or why all further work is refused: it stays so */
} work;

/* `options` may be NULL. */
work work_begin(const strum_options *options);
/* Says that work of about `us` microseconds comes next; 0 only asks. Not STRUM_OK
 * (STRUM_ERR_CANCELLED, STRUM_ERR_WORK, STRUM_ERR_TIME, STRUM_ERR_BYTES): do not begin it. `w` may
 * be NULL: no limit. */
strum_status work_spend(work *w, double us);
/* Asks before each piece of a long loop, of which every one takes microseconds. */
static inline strum_status work_poll(work *w)
{
    return work_spend(w, 0);
}

/* Says that so much memory will be held; false: it may not. `w` may be NULL. */
bool work_take(work *w, size_t bytes);
/* And that it is held no more. */
void work_give_back(work *w, size_t bytes);

/* error_set with a sentence for the status in `w`. */
strum_status work_error(const work *w, strum_error *error);
/* The same where `w` ended the solve, else a sentence for `status`; STRUM_OK as it is. */
strum_status work_result(const work *w, strum_status status, strum_error *error);

#endif
