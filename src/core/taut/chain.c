/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chains: checking what was given, resolving limits, and their transfer matrices. */
#include "core/taut/taut.h"

#include <stdint.h>
#include <stdlib.h>

strum_taut_link strum_taut_bar(double length, double mass)
{
    return (strum_taut_link){0.5 * length, 0.5 * length, mass, mass * length * length / 12.0};
}

strum_taut_link strum_taut_sphere(double diameter, double mass)
{
    return (strum_taut_link){0.5 * diameter, 0.5 * diameter, mass,
                             mass * diameter * diameter / 10.0};
}

/* Li (A.7): the centre lies 3 h/4 from the apex; L_c = h (he prints D). */
strum_taut_link strum_taut_cone(double height, double base_radius, double mass, bool apex_left)
{
    const double far = 0.75 * height, near = 0.25 * height;
    const double inertia =
        mass * 3.0 * (base_radius * base_radius + 0.25 * height * height) / 20.0;
    return (strum_taut_link){apex_left ? far : near, apex_left ? near : far, mass, inertia};
}

double taut_travel_time(const taut_component *c)
{
    return c->model->travel_time != NULL ? c->model->travel_time(c) : 0.0;
}

static strum_status component_make(const strum_taut_component *given, size_t index,
                                   taut_component *c, strum_error *error)
{
    const taut_kind *kind = taut_kind_of(given->kind);
    const char *why = kind == NULL ? "unknown kind" : NULL;
    if (why == NULL && kind->tensioned &&
        (!taut_positive(given->tension_left) || !taut_positive(given->tension_right)))
        why = "the tension must be positive";
    if (why == NULL)
        why = kind->fault(given);
    if (why != NULL)
        return error_at(error, STRUM_ERR_RANGE, STRUM_TAUT_ARG_COMPONENTS, index,
                        "component %zu: %s", index + 1, why);
    const strum_status status = kind->make(given, c, error);
    if (status == STRUM_OK && c->model->states != 2)
        return error_at(error, STRUM_ERR_INTERNAL, STRUM_TAUT_ARG_COMPONENTS, index,
                        "component %zu: a taut chain passes on y and V only", index + 1);
    return status;
}

static strum_status fill(strum_taut *chain, const strum_taut_component *given, size_t count,
                         strum_error *error)
{
    for (size_t i = 0; i < count; i++) {
        taut_component *c = &chain->components[i];
        strum_status status = component_make(&given[i], i, c, error);
        chain->count = i + 1;
        if (status != STRUM_OK) {
            if (error != NULL) {
                error->argument = STRUM_TAUT_ARG_COMPONENTS;
                error->index = i;
            }
            return status;
        }
        chain->length += c->length;
        if (c->length > 0.0)
            chain->tension +=
                c->length * 0.5 * (given[i].tension_left + given[i].tension_right);
        chain->travel += taut_travel_time(c);
        chain->dampers += c->model->damped != NULL && c->model->damped(c);
        chain->moves = chain->moves || c->model->flexible;
    }
    chain->damped = chain->dampers > 0;
    if (chain->length > 0.0)
        chain->tension /= chain->length;
    return STRUM_OK;
}

strum_status strum_taut_make(const strum_taut_component *components, size_t count,
                             strum_taut_end left, strum_taut_end right, strum_taut **chain,
                             strum_error *error)
{
    *chain = NULL;
    if (components == NULL || count < 1 || count > STRUM_TAUT_COMPONENTS_MAX)
        return error_set(error, STRUM_ERR_RANGE, "a chain has 1 to %d components",
                         STRUM_TAUT_COMPONENTS_MAX);
    strum_taut *made = calloc(1, sizeof *made);
    if (made != NULL)
        made->components = calloc(count, sizeof *made->components);
    if (made == NULL || made->components == NULL) {
        free(made);
        return error_set(error, STRUM_ERR_MEMORY, "no memory for %zu components", count);
    }
    made->references = 1;
    made->free_left = left == STRUM_TAUT_FREE;
    made->free_right = right == STRUM_TAUT_FREE;
    const strum_status status = fill(made, components, count, error);
    if (status == STRUM_OK)
        *chain = made;
    else
        strum_taut_free(made);
    return status;
}

strum_taut *taut_ref(const strum_taut *chain)
{
    strum_taut *counted = (strum_taut *)(uintptr_t)chain; /* only its count changes */
    atomic_fetch_add(&counted->references, 1);
    return counted;
}

void strum_taut_free(strum_taut *chain)
{
    if (chain == NULL || atomic_fetch_sub(&chain->references, 1) > 1)
        return;
    for (size_t i = 0; i < chain->count; i++)
        if (chain->components[i].model != NULL && chain->components[i].model->release != NULL)
            chain->components[i].model->release(&chain->components[i]);
    free(chain->components);
    free(chain);
}

double strum_taut_length(const strum_taut *chain)
{
    return chain->length;
}

bool strum_taut_is_damped(const strum_taut *chain)
{
    return chain->damped;
}

/* ---- transfer matrices ---- */

static strum_status multiply(const strum_taut *chain, size_t first, size_t last, cplx w,
                             cplx matrix[4], strum_error *error)
{
    const taut_at at = taut_at_s(times(CMPLX(0.0, 1.0), w), 1.0);
    if (!isfinite(creal(w)) || !isfinite(cimag(w)))
        return error_set(error, STRUM_ERR_RANGE, "the frequency is not finite");
    cplx f[4] = {1.0, 0.0, 0.0, 1.0};
    for (size_t i = first; i < last; i++) {
        taut_factor n;
        chain->components[i].model->factor(&chain->components[i], &at, &n);
        if (n.den.v == 0.0)
            return error_at(error, STRUM_ERR_IMPOSSIBLE, STRUM_TAUT_ARG_COMPONENTS, i,
                            "component %zu resonates with both ends held: its matrix has a "
                            "pole at this frequency",
                            i + 1);
        const cplx scale = over(exp(n.log_scale), n.den.v);
        const cplx a = f[0], b = f[1];
        f[0] = times(scale, times(n.n11.v, a) + times(n.n12.v, f[2]));
        f[1] = times(scale, times(n.n11.v, b) + times(n.n12.v, f[3]));
        f[2] = times(scale, times(n.n21.v, a) + times(n.n22.v, f[2]));
        f[3] = times(scale, times(n.n21.v, b) + times(n.n22.v, f[3]));
    }
    for (int k = 0; k < 4; k++) {
        if (!isfinite(creal(f[k])) || !isfinite(cimag(f[k])))
            return error_set(error, STRUM_ERR_RANGE,
                             "an entry of the matrix is beyond a double at this frequency");
        matrix[k] = f[k];
    }
    return STRUM_OK;
}

strum_status strum_taut_component_matrix(const strum_taut *chain, size_t index,
                                         double frequency, double decay,
                                         double _Complex matrix[4], strum_error *error)
{
    if (index >= chain->count)
        return error_set(error, STRUM_ERR_RANGE, "the chain has %zu components", chain->count);
    return multiply(chain, index, index + 1, CMPLX(frequency, decay), matrix, error);
}

strum_status strum_taut_matrix(const strum_taut *chain, double frequency, double decay,
                               double _Complex matrix[4], strum_error *error)
{
    return multiply(chain, 0, chain->count, CMPLX(frequency, decay), matrix, error);
}
