/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From parameters to a cable as it hangs. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/cable/check.h"
#include "core/cable/ends.h"
#include "core/cable/form.h"
#include "core/cable/rod_ends.h"
#include "core/cable/settle.h"

/* ---- the object ---- */

strum_hanging *cable_share(const strum_hanging *cable)
{
    strum_hanging *shared = (strum_hanging *)cable;
    atomic_fetch_add(&shared->references, 1);
    return shared;
}

void strum_cable_free(strum_hanging *cable)
{
    if (cable == NULL || atomic_fetch_sub(&cable->references, 1) != 1)
        return;
    arena_free(&cable->memory);
    free(cable);
}

/* ---- copies ---- */

static int by_position(const void *a, const void *b)
{
    const strum_cable_attachment *const *first = a, *const *second = b;
    const double from = (*first)->position, to = (*second)->position;
    if (from != to)
        return from < to ? -1 : 1;
    return *first < *second ? -1 : *first > *second;
}

/* Attachments sorted by position, those at one place as they were handed in. */
static strum_status copy_attachments(const strum_cable_params *p, strum_hanging *cable)
{
    const size_t n = p->attachment_count;
    if (n == 0)
        return STRUM_OK;
    arena scratch = {.work = cable->memory.work};
    const strum_cable_attachment **sorted = arena_alloc(&scratch, n, sizeof *sorted);
    cable->attachments = arena_alloc(&cable->memory, n, sizeof *cable->attachments);
    cable->order = arena_alloc(&cable->memory, n, sizeof *cable->order);
    const bool room = sorted != NULL && cable->attachments != NULL && cable->order != NULL;
    if (room) {
        for (size_t i = 0; i < n; i++)
            sorted[i] = p->attachments + i;
        qsort(sorted, n, sizeof *sorted, by_position);
        for (size_t i = 0; i < n; i++) {
            cable->attachments[i] = *sorted[i];
            cable->order[sorted[i] - p->attachments] = i;
        }
    }
    arena_free(&scratch);
    return room ? STRUM_OK : STRUM_ERR_MEMORY;
}

static strum_status copy_params(const strum_cable_params *p, strum_hanging *cable)
{
    cable->params = *p;
    cable->sections = arena_alloc(&cable->memory, p->section_count, sizeof *cable->sections);
    if (cable->sections == NULL)
        return STRUM_ERR_MEMORY;
    memcpy(cable->sections, p->sections, p->section_count * sizeof *cable->sections);
    const strum_status status = copy_attachments(p, cable);
    cable->params.sections = cable->sections;
    cable->params.attachments = cable->attachments;
    return status;
}

/* ---- what happens after the shape was found ---- */

/* Attachments in the sections behind the adjusted one move with them. */
static void take_in(strum_hanging *cable)
{
    double end = 0;
    for (size_t i = 0; i <= cable->params.adjusted; i++)
        end += cable->sections[i].length;
    cable->sections[cable->params.adjusted].length -= cable->params.taken_in;
    for (size_t i = 0; i < cable->params.attachment_count; i++)
        if (cable->attachments[i].position > end)
            cable->attachments[i].position -= cable->params.taken_in;
}

static void warm(strum_hanging *cable, double stretch)
{
    for (size_t i = 0; i < cable->params.section_count; i++) {
        strum_cable_section *s = cable->sections + i;
        double *per_metre[] = {&s->mass,        &s->weight,
                               &s->added_mass,  &s->added_mass_tangential,
                               &s->drag_normal, &s->drag_tangential};
        s->length *= stretch;
        for (size_t k = 0; k < sizeof per_metre / sizeof *per_metre; k++)
            *per_metre[k] /= stretch;
    }
    for (size_t i = 0; i < cable->params.attachment_count; i++)
        cable->attachments[i].position *= stretch;
}

/* The second state, where there is one; `*changed` says so. */
static strum_status second_state(strum_hanging *cable, bool *changed, strum_error *error)
{
    strum_cable_params *p = &cable->params;
    const double stretch = 1 + p->expansion * p->temperature_change;
    *changed = p->taken_in != 0 || stretch != 1;
    if (p->taken_in != 0) {
        double end = 0;
        for (size_t i = 0; i <= p->adjusted; i++)
            end += cable->sections[i].length;
        const double left = cable->sections[p->adjusted].length - p->taken_in;
        bool holds = left > 0;
        for (size_t i = 0; i < p->attachment_count; i++) {
            const double at = cable->attachments[i].position;
            holds = holds && !(at <= end && at >= end - p->taken_in);
        }
        if (!holds)
            return error_at(error, STRUM_ERR_IMPOSSIBLE, STRUM_CABLE_ARG_TAKEN_IN,
                            STRUM_NO_INDEX,
                            "as much as is taken in is not left of the section, up to its "
                            "last attachment");
        take_in(cable);
    }
    if (stretch != 1)
        warm(cable, stretch);
    return STRUM_OK;
}

/* ---- the answer ---- */

/* Lengths and span so that the figure that is given holds, as the cable was handed in. */
static strum_status first_state(cable_settler *s, strum_error *error)
{
    strum_hanging *cable = s->cable;
    cable->statics.solutions = 1;
    cable->statics.other_length = NAN;
    if (cable->params.given == STRUM_CABLE_LENGTHS)
        return settle(s, error);
    const strum_status status = ends_find(s, &cable->statics, error);
    return status == STRUM_OK && settle_bends(cable) ? rod_ends_find(s, error) : status;
}

/* Whether the figures that every cable has are numbers. */
static bool is_finite(const strum_cable_statics *s)
{
    const double all[] = {
        s->horizontal_end_1, s->vertical_end_1, s->horizontal_end_2, s->vertical_end_2,
        s->tension_min,      s->tension_max,    s->length,           s->angle_end_1,
        s->angle_end_2,      s->lowest.x,       s->lowest.z,         s->highest.x,
        s->highest.z,        s->moment_end_1,   s->moment_end_2,     s->closure};
    bool finite = true;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        finite = finite && isfinite(all[i]);
    return finite;
}

static strum_status hang(const strum_cable_params *p, strum_hanging *cable, work *w,
                         strum_error *error)
{
    cable_settler s;
    bool changed = false;
    strum_status status = copy_params(p, cable);
    if (status == STRUM_OK)
        status = settle_begin(cable, w, &s);
    if (status != STRUM_OK)
        return work_result(w, status, error);
    if (p->bed.present && settle_bends(cable))
        return error_at(
            error, STRUM_ERR_METHOD, STRUM_CABLE_ARG_BED, STRUM_NO_INDEX,
            "bending stiffness in the static shape goes without a bed only: ask for "
            "flexible statics");
    status = first_state(&s, error);
    if (status == STRUM_OK)
        status = second_state(cable, &changed, error);
    if (status == STRUM_OK && changed)
        status = settle(&s, error);
    if (status != STRUM_OK)
        return status;
    cable->params.span = s.span;
    status = settle_keep(&s, error);
    if (status != STRUM_OK || is_finite(&cable->statics))
        return status;
    return error_set(error, STRUM_ERR_ACCURACY,
                     "the shape was not found in double precision: its sections are too "
                     "unlike, or its bending stiffness is next to none (statics flexible has "
                     "none)");
}

strum_status strum_cable_hang(const strum_cable_params *params, const strum_options *options,
                              strum_hanging **cable, strum_error *error)
{
    work w = work_begin(options);
    *cable = NULL;
    strum_status status = cable_check(params, error);
    if (status != STRUM_OK)
        return status;
    strum_hanging *made = calloc(1, sizeof *made);
    if (made == NULL)
        return error_set(error, STRUM_ERR_MEMORY, "%s", strum_status_text(STRUM_ERR_MEMORY));
    atomic_init(&made->references, 1);
    made->memory.work = &w;
    status = hang(params, made, &w, error);
    made->memory.work = NULL;
    if (status != STRUM_OK) {
        strum_cable_free(made);
        return status;
    }
    *cable = made;
    return STRUM_OK;
}
