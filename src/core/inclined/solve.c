/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Modes of an inclined cable by any model: solve, read, verify. */
#include <limits.h>
#include <math.h>
#include <stdlib.h>

#include "core/inclined/mode_metrics.h"
#include "core/inclined/statics.h"
#include "core/numerics/status.h"
#include "core/suspended/modes.h"

/* Below it the characteristic functions round away too much of the spurious root to tell it. */
#define SPURIOUS_MIN 1e-3

static const inclined_model *const models[] = {
    [STRUM_INCLINED_FULL] = &inclined_full,
    [STRUM_INCLINED_AIRY] = &inclined_airy,
    [STRUM_INCLINED_AIRY_TANGENT] = &inclined_airy_tangent,
    [STRUM_INCLINED_ASYMPTOTIC] = &inclined_asymptotic,
    [STRUM_INCLINED_IRVINE] = &inclined_irvine,
};
#define MODELS (sizeof models / sizeof *models)

static strum_status check(const strum_inclined_params *p, strum_error *error)
{
    if (p->count < 1 || p->count > STRUM_MODES_MAX)
        return error_at(error, STRUM_ERR_RANGE, STRUM_INCLINED_ARG_COUNT, STRUM_NO_INDEX,
                        "1 to %d modes can be asked for", STRUM_MODES_MAX);
    if ((size_t)p->model >= MODELS)
        return error_at(error, STRUM_ERR_RANGE, STRUM_INCLINED_ARG_MODEL, STRUM_NO_INDEX,
                        "there is no model %d", (int)p->model);
    return STRUM_OK;
}

static strum_status check_model(const strum_inclined *m, strum_error *error)
{
    if (m->model->expansion && m->cable.epsilon > STRUM_EXPANSION_EPSILON_MAX)
        return error_at(error, STRUM_ERR_METHOD, STRUM_INCLINED_ARG_MODEL, STRUM_NO_INDEX,
                        "epsilon is %.3g, and the report's expansions are in powers of it: "
                        "above %g only the full model answers",
                        m->cable.epsilon, STRUM_EXPANSION_EPSILON_MAX);
    return STRUM_OK;
}

static strum_status find_statics(const strum_inclined_params *p, strum_inclined_statics *s,
                                 strum_error *error)
{
    if (p->statics == NULL)
        return strum_inclined_statics_find(&p->cable, s, error);
    *s = *p->statics;
    return STRUM_OK;
}

static strum_status solve(strum_inclined *m, work *w, strum_error *error)
{
    m->modes = arena_alloc(&m->memory, (size_t)m->count, sizeof *m->modes);
    m->unit = arena_doubles(&m->memory, (size_t)m->count);
    if (m->modes == NULL || m->unit == NULL)
        return work_result(w, STRUM_ERR_MEMORY, error);
    strum_status status = check_model(m, error);
    if (status == STRUM_OK)
        status = m->model->solve(m, w, error);
    if (status == STRUM_OK) {
        status = inclined_measure(m, w);
        if (status != STRUM_OK)
            error_set(error, status, "%s", strum_status_text(status));
    }
    return w->status == STRUM_OK ? status : work_error(w, error);
}

strum_status strum_inclined_solve(const strum_inclined_params *p, const strum_options *options,
                                  strum_inclined **modes, strum_error *error)
{
    *modes = NULL;
    work w = work_begin(options);
    strum_inclined_statics statics;
    strum_status status = check(p, error);
    if (status == STRUM_OK)
        status = find_statics(p, &statics, error);
    if (status != STRUM_OK)
        return status;
    strum_inclined *m = calloc(1, sizeof *m);
    if (m == NULL)
        return error_set(error, STRUM_ERR_MEMORY, "out of memory");
    m->cable = p->cable;
    m->kind = p->model;
    m->model = models[p->model];
    m->statics = statics;
    m->count = (int)p->count;
    m->length = p->cable.epsilon / cos(p->cable.inclination);
    m->memory.work = &w;
    status = solve(m, &w, error);
    if (status != STRUM_OK) {
        strum_inclined_free(m);
        return status;
    }
    m->memory.work = NULL; /* it ends here */
    *modes = m;
    return status;
}

double strum_inclined_work(const strum_inclined_params *p)
{
    strum_inclined_statics s;
    if (check(p, NULL) != STRUM_OK || find_statics(p, &s, NULL) != STRUM_OK)
        return 0;
    const strum_cable mechanics = inclined_mechanics(&p->cable, &s);
    const mapping x = mapping_linear(&mechanics);
    const int count = (int)p->count;
    const double size = 1.35 * spectrum_first_size(&mechanics, &x, STRUM_IN_PLANE, count);
    return models[p->model]->work_us(&mechanics, count, size);
}

size_t strum_inclined_count(const strum_inclined *m)
{
    return (size_t)m->count;
}

strum_status strum_inclined_get(const strum_inclined *m, size_t i, strum_inclined_mode *mode)
{
    if (i >= (size_t)m->count)
        return STRUM_ERR_RANGE;
    *mode = m->modes[i];
    return STRUM_OK;
}

double strum_inclined_spurious(const strum_inclined *m)
{
    return m->spurious > SPURIOUS_MIN ? m->spurious : 0;
}

/* x of each point; the supports exactly. */
static bool find_places(const strum_inclined *m, const double *s, size_t n, double *x)
{
    for (size_t i = 0; i < n; i++) {
        const double at = s != NULL ? s[i] : (double)i / ((double)n - 1.0);
        if (!(at >= 0 && at <= 1))
            return false;
        x[i] = at == 0 ? -1 : at == 1 ? 1 : inclined_x_of_s(m, at);
    }
    return true;
}

strum_status strum_inclined_shape(const strum_inclined *m, size_t i, const double *s, size_t n,
                                  strum_inclined_point *shape)
{
    if (i >= (size_t)m->count || n < (s != NULL ? 1 : 2) || n > INT_MAX)
        return STRUM_ERR_RANGE;
    arena scratch = {0};
    double *x = arena_doubles(&scratch, n);
    const inclined_samples at = {(int)i, (int)i + 1, (int)n, x, shape};
    const strum_status status = x == NULL ? STRUM_ERR_MEMORY
                                : !find_places(m, s, n, x)
                                    ? STRUM_ERR_RANGE
                                    : m->model->evaluate(m, &at, &scratch, NULL);
    for (size_t k = 0; status == STRUM_OK && k < n; k++) {
        shape[k].s = s != NULL ? s[k] : (double)k / ((double)n - 1.0);
        shape[k].transverse /= m->unit[i];
        shape[k].longitudinal /= m->unit[i];
        shape[k].tension /= m->unit[i];
        /* the force form meets the supports to rounding; (34) and (37) do not meet them */
        if (fabs(x[k]) == 1 && m->model->meets_supports)
            shape[k].transverse = shape[k].longitudinal = 0;
    }
    arena_free(&scratch);
    return status;
}

strum_status strum_inclined_verify(const strum_inclined *m, const strum_options *options,
                                   strum_verification *v, strum_error *error)
{
    *v = (strum_verification){.modes_found = m->count};
    work w = work_begin(options);
    arena a = {.work = &w};
    const strum_status status = m->model->verify(m, v, &a, &w, error);
    arena_free(&a);
    return w.status == STRUM_OK ? status : work_error(&w, error);
}

void strum_inclined_free(strum_inclined *m)
{
    if (m != NULL) {
        arena_free(&m->memory);
        free(m);
    }
}
