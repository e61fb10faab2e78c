/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The public calls of cable_modes.h. */
#include "core/cable/modes.h"

#include <math.h>
#include <stdlib.h>

#include "core/cable/spans.h"
#include "core/cable/stretch.h"
#include "core/numerics/status.h"

/* ---- stretches that move by themselves ---- */

/* The next stretch from piece `*from` on: all of it where what lies slides, else a hanging run. */
static bool next_stretch(const strum_hanging *cable, motion_choice *c)
{
    size_t i = c->last_piece;
    if (c->sliding) {
        c->first_piece = 0;
        c->last_piece = cable->piece_count;
        return i == 0;
    }
    while (i < cable->piece_count && cable->pieces[i].lies)
        i++;
    c->first_piece = i;
    while (i < cable->piece_count && !cable->pieces[i].lies &&
           cable->pieces[i].run == cable->pieces[c->first_piece].run)
        i++;
    c->last_piece = i;
    return i > c->first_piece;
}

/* Tension below this share of the largest is none. */
#define SLACK 1e-9

/* Smallest tension of what hangs without bending stiffness in its shape, over the largest. */
static double least_tension(const strum_hanging *cable)
{
    double least = HUGE_VAL, most = 0;
    for (size_t i = 0; i < cable->piece_count; i++) {
        const cable_piece *p = cable->pieces + i;
        if (p->lies)
            continue;
        const double v = p->v + p->section->weight * p->length;
        const double low = p->v * v < 0 ? fabs(p->h) : fmin(hypot(p->h, p->v), hypot(p->h, v));
        least = fmin(least, low);
        most = fmax(most, fmax(hypot(p->h, p->v), hypot(p->h, v)));
    }
    return most > 0 ? least / most : HUGE_VAL;
}

/* Less mass than this, on average, is none: frequencies would be beyond all bounds. */
#define MASS_LEAST 1e-12

static double mass_per_length(const strum_hanging *cable)
{
    double mass = 0, length = 0;
    for (size_t i = 0; i < cable->piece_count; i++) {
        const strum_cable_section *s = cable->pieces[i].section;
        mass += cable->pieces[i].length * (s->mass + s->added_mass);
        length += cable->pieces[i].length;
    }
    for (size_t i = 0; i < cable->params.attachment_count; i++)
        mass += cable->attachments[i].mass + cable->attachments[i].inertance;
    return mass / length;
}

/* What pulls at a hanger's foot, half of its own weight included. */
static double hanger_pull(const strum_hanging *cable)
{
    const cable_piece *first = cable->pieces, *last = first + cable->piece_count - 1;
    const double standard_gravity = 9.80665;
    return last->v + last->section->weight * last->length - first->v +
           cable->params.hanger_mass * standard_gravity / 2;
}

static strum_status check_shape(const strum_hanging *cable, const strum_cable_modes_params *p,
                                strum_error *error)
{
    bool hangs = false;
    for (size_t i = 0; i < cable->piece_count; i++)
        hangs = hangs || !cable->pieces[i].lies;
    if (cable->params.spans > 1 && cable->rod != NULL)
        return error_set(error, STRUM_ERR_METHOD,
                         "modes of several spans need the static shape without bending "
                         "stiffness (statics flexible)");
    if (cable->params.spans > 1 && !(hanger_pull(cable) > 0))
        return error_set(error, STRUM_ERR_IMPOSSIBLE,
                         "buoyant spans push their hangers up: such a row is not stable");
    if (!(mass_per_length(cable) > MASS_LEAST))
        return error_set(error, STRUM_ERR_IMPOSSIBLE,
                         "nothing of the cable has mass, so that nothing of it oscillates");
    if (!hangs && p->contact == STRUM_CABLE_HELD)
        return error_set(error, STRUM_ERR_IMPOSSIBLE,
                         "all of the cable lies on the bed and is held: nothing moves");
    /* a rod may be compressed: its stiffness matrix says whether it is stable */
    if (cable->rod == NULL && least_tension(cable) < SLACK)
        return error_set(error, STRUM_ERR_IMPOSSIBLE,
                         "the cable has no tension at a point where it hangs: it has no small "
                         "linear motion");
    return STRUM_OK;
}

static strum_status solve_stretches(const strum_hanging *cable,
                                    const strum_cable_modes_params *p, strum_cable_modes *modes)
{
    motion_choice choice = {
        .plane = p->plane, .sliding = p->contact == STRUM_CABLE_SLIDING, .modes = p->count};
    size_t count = 0;
    while (next_stretch(cable, &choice))
        count++;
    modes->stretches = arena_alloc(&modes->memory, count + 1, sizeof *modes->stretches);
    if (modes->stretches == NULL)
        return STRUM_ERR_MEMORY;
    choice.first_piece = choice.last_piece = 0;
    while (next_stretch(cable, &choice)) {
        const strum_status status = stretch_solve(cable, &choice, &modes->memory,
                                                  modes->stretches + modes->stretch_count);
        if (status != STRUM_OK)
            return status;
        modes->stretch_count++;
    }
    return modes->stretch_count > 0 ? STRUM_OK : STRUM_ERR_IMPOSSIBLE;
}

/* ---- in one row ---- */

static int by_frequency(const void *a, const void *b)
{
    const modes_item *x = a, *y = b;
    const double p = cimag(x->mode->lambda), q = cimag(y->mode->lambda);
    if (p != q)
        return p < q ? -1 : 1;
    return x->mode < y->mode ? -1 : x->mode > y->mode;
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

static strum_status merge(int count, strum_cable_modes *modes)
{
    size_t all = 0, overdamped = 0;
    for (size_t i = 0; i < modes->stretch_count; i++) {
        all += (size_t)modes->stretches[i].count;
        overdamped += (size_t)modes->stretches[i].overdamped;
    }
    modes->items = arena_alloc(&modes->memory, all + 1, sizeof *modes->items);
    modes->decays = arena_alloc(&modes->memory, overdamped + 1, sizeof *modes->decays);
    if (modes->items == NULL || modes->decays == NULL)
        return STRUM_ERR_MEMORY;
    bool damped = false;
    modes->certificate = (strum_cable_certificate){"inertia", 0, 0, 0};
    for (size_t i = 0; i < modes->stretch_count; i++) {
        const spectrum *s = modes->stretches + i;
        for (int k = 0; k < s->count; k++)
            modes->items[modes->count++] = (modes_item){s, s->modes + k, i};
        for (int k = 0; k < s->overdamped; k++)
            modes->decays[modes->overdamped++] = s->decays[k];
        damped = damped || s->damped;
        modes->certificate.expected += s->expected;
        modes->certificate.found += s->found;
        modes->certificate.error = fmax(modes->certificate.error, s->error);
    }
    if (damped)
        modes->certificate.method = "inertia and argument principle";
    qsort(modes->items, modes->count, sizeof *modes->items, by_frequency);
    qsort(modes->decays, modes->overdamped, sizeof *modes->decays, by_size);
    if (modes->count > (size_t)count)
        modes->count = (size_t)count;
    return STRUM_OK;
}

/* ---- the calls ---- */

strum_status strum_cable_modes_solve(const strum_hanging *cable,
                                     const strum_cable_modes_params *params,
                                     const strum_options *options, strum_cable_modes **modes,
                                     strum_error *error)
{
    work w = work_begin(options);
    *modes = NULL;
    if (params->count < 1 || params->count > STRUM_CABLE_MODES_MAX)
        return error_at(error, STRUM_ERR_RANGE, STRUM_CABLE_ARG_COUNT, STRUM_NO_INDEX,
                        "the number of modes must be between 1 and %d", STRUM_CABLE_MODES_MAX);
    const strum_status possible = check_shape(cable, params, error);
    if (possible != STRUM_OK)
        return possible;
    strum_cable_modes *made = calloc(1, sizeof *made);
    if (made == NULL)
        return error_set(error, STRUM_ERR_MEMORY, "%s", strum_status_text(STRUM_ERR_MEMORY));
    made->cable = cable_share(cable);
    made->memory.work = &w;
    made->line = cable;
    strum_status status = STRUM_OK;
    if (cable->params.spans > 1) {
        status = spans_repeat(cable, &made->memory, &made->row);
        made->line = &made->row;
    }
    if (status == STRUM_OK)
        status = solve_stretches(made->line, params, made);
    if (status == STRUM_OK)
        status = merge(params->count, made);
    made->memory.work = NULL;
    if (status != STRUM_OK) {
        strum_cable_modes_free(made);
        if (status == STRUM_ERR_IMPOSSIBLE)
            return error_set(error, status,
                             "the static shape is not stable, or nothing of the cable moves");
        if (status == STRUM_ERR_INTERNAL && w.status == STRUM_OK)
            return error_set(error, STRUM_ERR_ACCURACY,
                             "stiffness and mass of this cable are too far apart, or its shape "
                             "is too near to being unstable, for its modes to be found");
        return work_result(&w, status, error);
    }
    *modes = made;
    return STRUM_OK;
}

size_t strum_cable_modes_count(const strum_cable_modes *modes)
{
    return modes->count;
}

size_t strum_cable_modes_overdamped(const strum_cable_modes *modes, const double **decays)
{
    *decays = modes->decays;
    return modes->overdamped;
}

void strum_cable_modes_certificate(const strum_cable_modes *modes,
                                   strum_cable_certificate *certificate)
{
    *certificate = modes->certificate;
}

void strum_cable_modes_free(strum_cable_modes *modes)
{
    if (modes == NULL)
        return;
    arena_free(&modes->memory);
    strum_cable_free((strum_hanging *)modes->cable);
    free(modes);
}
