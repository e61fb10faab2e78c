/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A taut chain of any components (taut.h) whose tensions keep their ratios. Where nothing but
 * tension and mass acts, all frequencies go exactly with the root of the tension, and one solution
 * answers for all of them. */
#include "core/identify/problem.h"

#include <stdlib.h>
#include <string.h>

/* Does `c` hold by stiffness of its own? */
static bool stiff(const strum_taut_component *c)
{
    switch (c->kind) {
    case STRUM_TAUT_HANGING:
        return isfinite(c->hanging.damping);
    case STRUM_TAUT_GROUND:
        return c->ground.stiffness > 0;
    case STRUM_TAUT_BODY:
        for (size_t i = 0; i + 1 < c->body.count; i++)
            if (c->body.joints[i].stiffness > 0)
                return true;
        return false;
    default:
        return false;
    }
}

/* A copy with all tensions, and the forces of joints, times `factor`; NULL without memory. `joints`
 * owns the copies of these. */
static strum_taut_component *scaled(const strum_identify_params *c, double factor,
                                    strum_taut_joint **joints)
{
    size_t count = 0, used = 0;
    for (size_t i = 0; i < c->component_count; i++)
        if (c->components[i].kind == STRUM_TAUT_BODY)
            count += c->components[i].body.count;
    strum_taut_component *copy = malloc(c->component_count * sizeof *copy);
    *joints = malloc((count + 1) * sizeof **joints);
    if (copy == NULL || *joints == NULL) {
        free(copy);
        free(*joints);
        return NULL;
    }
    for (size_t i = 0; i < c->component_count; i++) {
        copy[i] = c->components[i];
        copy[i].tension_left *= factor;
        copy[i].tension_right *= factor;
        if (copy[i].kind != STRUM_TAUT_BODY || copy[i].body.count < 2)
            continue;
        strum_taut_joint *mine = *joints + used;
        for (size_t k = 0; k + 1 < copy[i].body.count; k++) {
            mine[k] = copy[i].body.joints[k];
            mine[k].force *= factor;
        }
        copy[i].body.joints = mine;
        used += copy[i].body.count;
    }
    return copy;
}

strum_status model_chain(const strum_identify_params *c, double factor, strum_taut **chain,
                         strum_error *error)
{
    strum_taut_joint *joints;
    strum_taut_component *parts = scaled(c, factor, &joints);
    if (parts == NULL)
        return STRUM_ERR_MEMORY;
    const strum_status status =
        strum_taut_make(parts, c->component_count, c->left, c->right, chain, error);
    free(parts);
    free(joints);
    return status;
}

/* Frequencies of the data's modes, in Hz, at a tension. */
static strum_status solve(const problem *p, double tension, double *hz, strum_error *error)
{
    strum_taut *chain = NULL;
    strum_status status =
        model_chain(p->chain, tension / p->chain->reference_tension, &chain, error);
    long numbers[DATA_MAX];
    for (size_t i = 0; i < p->count; i++)
        numbers[i] = p->modes[i];
    if (status == STRUM_OK)
        status = strum_taut_frequencies(chain, numbers, p->count,
                                        p->work != NULL ? &p->work->options : NULL, hz, error);
    for (size_t i = 0; i < p->count && status == STRUM_OK; i++)
        hz[i] /= 2 * M_PI;
    strum_taut_free(chain);
    return status;
}

strum_status model_prepare_chain(problem *p, strum_error *error)
{
    const strum_identify_params *c = p->chain;
    p->chain_scales = true;
    for (size_t i = 0; i < c->component_count; i++)
        p->chain_scales = p->chain_scales && !stiff(&c->components[i]);
    double hz[DATA_MAX];
    const strum_status status = solve(p, c->reference_tension, hz, error);
    for (size_t i = 0; i < p->count && status == STRUM_OK; i++)
        p->chain_unit[i] = hz[i] / sqrt(c->reference_tension);
    return status;
}

/* d f/d ln T by differences of fourth order in ln T: about 1e-12 of f. */
#define STRIDE 1e-3
static strum_status differences(const problem *p, double tension, double *slope)
{
    double at[4][DATA_MAX];
    static const double places[4] = {-2, -1, 1, 2};
    for (int k = 0; k < 4; k++) {
        const strum_status status = solve(p, tension * exp(places[k] * STRIDE), at[k], NULL);
        if (status != STRUM_OK)
            return status;
    }
    for (size_t i = 0; i < p->count; i++)
        slope[i] = (8 * (at[2][i] - at[1][i]) - (at[3][i] - at[0][i])) / (12 * STRIDE);
    return STRUM_OK;
}

strum_status model_predict_chain(const problem *p, const state *s, prediction *out)
{
    const double tension = s->q[TENSION];
    double hz[DATA_MAX], slope[DATA_MAX];
    strum_status status = STRUM_OK;
    if (!p->chain_scales)
        status = solve(p, tension, hz, NULL);
    if (status == STRUM_OK && !p->chain_scales)
        status = differences(p, tension, slope);
    for (size_t i = 0; i < p->count && status == STRUM_OK; i++) {
        out[i] =
            (prediction){.value = p->chain_scales ? p->chain_unit[i] * sqrt(tension) : hz[i],
                         .tension = NAN,
                         .bending = NAN,
                         .ends = NAN,
                         .sag = NAN};
        out[i].by[TENSION] = p->chain_scales ? 0.5 * out[i].value : slope[i];
    }
    return status;
}
