/* SPDX-License-Identifier: GPL-3.0-or-later */
/* /v1/absorber/optimize, the request: its fields, the checks across them, what follows from
 * them. */
#include "endpoints/absorber/request.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const field variable_fields[] = {
    {FIELD_AT(FIELD_NAME, absorber_variable, name), .flags = FIELD_REQUIRED,
     .help = "name by which numbers of the chain refer to it"},
    {FIELD_AT(FIELD_NUMBER, absorber_variable, min), .unit = "of the number", .min = -1e15,
     .max = 1e15, .flags = FIELD_REQUIRED, .help = "lower bound"},
    {FIELD_AT(FIELD_NUMBER, absorber_variable, max), .unit = "of the number", .min = -1e15,
     .max = 1e15, .flags = FIELD_REQUIRED, .help = "upper bound"},
    {.kind = FIELD_END}};
static const schema variable_row = {
    .name = "absorber_variable", .fields = variable_fields, .size = sizeof(absorber_variable)};

static const field required_fields[] = {
    {FIELD_AT(FIELD_NUMBER, absorber_required, strouhal), .unit = "1", .min = 0, .max = 10,
     .flags = FIELD_OPEN_MIN | FIELD_DEFAULT, .fallback = 0.2, .help = "Strouhal number"},
    {FIELD_AT(FIELD_NUMBER, absorber_required, reduced_damping), .unit = "1", .min = 0,
     .max = 100, .flags = FIELD_OPEN_MIN | FIELD_DEFAULT, .fallback = 0.2,
     .help = "Griffin's S_G at which vibration begins to fall"},
    {FIELD_AT(FIELD_NUMBER, absorber_required, diameter_m), .unit = "m", .min = 0, .max = 1e3,
     .flags = FIELD_OPEN_MIN | FIELD_REQUIRED, .help = "diameter of the cable in the flow"},
    {FIELD_AT(FIELD_NUMBER, absorber_required, fluid_kg_per_m3), .unit = "kg/m^3", .min = 0,
     .max = 1e5, .flags = FIELD_OPEN_MIN | FIELD_DEFAULT, .fallback = 1025,
     .help = "density of the fluid"},
    {.kind = FIELD_END}};
static const schema required_row = {
    .name = "absorber_required", .fields = required_fields, .size = sizeof(absorber_required)};

static const field sweep_fields[] = {
    {FIELD_AT(FIELD_NAME, absorber_sweep, variable), .flags = FIELD_REQUIRED,
     .help = "the variable that runs through its range, the others staying at the optimum"},
    {FIELD_AT(FIELD_INTEGER, absorber_sweep, points), .min = 2, .max = 2000,
     .flags = FIELD_DEFAULT, .fallback = 101, .help = "values, both bounds included"},
    {.kind = FIELD_END}};
static const schema sweep_row = {
    .name = "absorber_sweep", .fields = sweep_fields, .size = sizeof(absorber_sweep)};

static const char *const objectives[] = {"max_min_damping", NULL};

static const field fields[] = {
    CHAIN_FIELDS,
    CHAIN_END_FIELDS,
    {FIELD_AT(FIELD_OBJECTS, absorber_request, variables), .schema = &variable_row,
     .min_items = 1, .max_items = STRUM_ABSORBER_VARIABLES_MAX,
     .help = "what may vary, within which bounds"},
    {FIELD_AT(FIELD_FLAG, absorber_request, assess),
     .help =
         "true: nothing varies; each mode of the chain as it is, its damping beside what is "
         "required"},
    {FIELD_AT(FIELD_NUMBERS, absorber_request, modes), .min = 1, .max = STRUM_TAUT_MODE_MAX,
     .min_items = 1, .max_items = STRUM_ABSORBER_MODES_MAX,
     .flags = FIELD_WHOLE | FIELD_ASCENDING,
     .help = "branches, numbered at zero damping and followed in damping"},
    BAND_FIELDS(absorber_request, asked_band, 0, FIELD_OPEN_MIN,
                "all modes in this band, however many, found anew at every trial"),
    {FIELD_AT(FIELD_NUMBERS, absorber_request, current_m_per_s), .unit = "m/s", .min = 0,
     .max = 1e3, .min_items = 2, .max_items = 2, .flags = FIELD_OPEN_MIN | FIELD_ASCENDING,
     .help = "currents whose vortices excite: the band 2 pi St U/D, with required.diameter_m"},
    {FIELD_AT(FIELD_CHOICE, absorber_request, objective), .choices = objectives,
     .flags = FIELD_DEFAULT, .help = "the largest smallest damping ratio"},
    {FIELD_AT(FIELD_OBJECT, absorber_request, required), .schema = &required_row,
     .help = "how much damping stops vortex-induced vibration (Griffin's reduced damping)"},
    {FIELD_AT(FIELD_OBJECT, absorber_request, sweep), .schema = &sweep_row,
     .help = "every branch against one variable"},
    {FIELD_AT(FIELD_INTEGER, absorber_request, max_evaluations), .min = 100, .max = 200000,
     .flags = FIELD_DEFAULT, .fallback = 6000, .help = "trials of the search, at most"},
    {FIELD_AT(FIELD_NUMBER, absorber_request, time_limit_s), .unit = "s", .min = 0, .max = 600,
     .flags = FIELD_OPEN_MIN | FIELD_DEFAULT, .fallback = 60,
     .help = "the best so far is answered then, with a warning; a sweep has as long again"},
    {.kind = FIELD_END}};

static const char *const excited[] = {
    "modes", "band_rad_per_s", "band_Hz", "band_s", "current_m_per_s +required", NULL};
static const char *const asked[] = {"variables [assess]", "assess", NULL};
static const field_groups groups[] = {
    {"excited modes", false, excited}, {"task", false, asked}, {0}};

const schema absorber_schema = {.name = "absorber_optimize_request",
                                .fields = fields,
                                .groups = groups,
                                .size = sizeof(absorber_request)};

/* ---- checks across fields ---- */

typedef struct naming {
    const absorber_request *r;
    problem *p;
    bool used[STRUM_ABSORBER_VARIABLES_MAX];
} naming;

/* Every name is declared, and its range keeps the number that uses it in range. */
static void see(void *context, const char *pointer, const field *f, const variable_value *v)
{
    naming *n = context;
    const absorber_variable *all = n->r->variables.items;
    for (size_t i = 0; i < n->r->variables.count; i++) {
        if (strcmp(all[i].name.text, v->name.text) != 0)
            continue;
        n->used[i] = true;
        const double a = v->value + v->scale * all[i].min, b = v->value + v->scale * all[i].max;
        const double low = fmin(a, b), high = fmax(a, b);
        const bool open = (f->flags & FIELD_OPEN_MIN) != 0;
        if (low < f->min || (open && low <= f->min) || high > f->max)
            problem_add(n->p, pointer,
                        "the variable %s takes it from %.15g to %.15g, beyond %s%.15g to %.15g",
                        v->name.text, low, high, open ? "above " : "", f->min, f->max);
        return;
    }
    problem_add(n->p, pointer, "the variable %s is not among variables", v->name.text);
}

static void check_variables(const absorber_request *r, problem *p)
{
    naming n = {.r = r, .p = p};
    const absorber_variable *all = r->variables.items;
    char pointer[64];
    schema_variables(&absorber_schema, r, see, &n);
    if (r->assess && r->variables.count > 0)
        problem_add(p, "/assess",
                    "cannot be true beside variables: a chain is assessed as it is");
    if (r->assess && FIELD_GIVEN(&absorber_schema, r, sweep))
        problem_add(p, "/sweep", "needs variables; with assess nothing varies");
    if (!r->assess && FIELD_GIVEN(&absorber_schema, r, assess) && r->variables.count == 0)
        problem_add(p, "/assess",
                    "is false: give variables, or true to assess the chain as it is");
    for (size_t i = 0; i < r->variables.count; i++) {
        (void)snprintf(pointer, sizeof pointer, "/variables/%zu/max", i);
        if (!(all[i].min < all[i].max))
            problem_add(p, pointer, "must be greater than min");
        (void)snprintf(pointer, sizeof pointer, "/variables/%zu/name", i);
        if (absorber_variable_index(r, all[i].name.text) < (int)i)
            problem_add(p, pointer, "stands for an earlier variable already");
        else if (!n.used[i])
            problem_add(p, pointer, "no number of the chain refers to %s", all[i].name.text);
    }
    if (FIELD_GIVEN(&absorber_schema, r, sweep) &&
        absorber_variable_index(r, r->sweep.variable.text) < 0)
        problem_add(p, "/sweep/variable", "is not among variables");
}

int absorber_variable_index(const absorber_request *r, const char *name)
{
    const absorber_variable *all = r->variables.items;
    for (size_t i = 0; i < r->variables.count; i++)
        if (strcmp(all[i].name.text, name) == 0)
            return (int)i;
    return -1;
}

void absorber_prepare(void *data, schema_arena *arena, problem *p)
{
    absorber_request *r = data;
    chain_prepare(&r->in, arena, p);
    check_variables(r, p);
    const absorber_variable *all = r->variables.items;
    r->mode_numbers = schema_alloc(arena, STRUM_ABSORBER_MODES_MAX * sizeof *r->mode_numbers);
    if (r->mode_numbers == NULL) {
        problem_out_of_memory(p);
        return;
    }
    for (size_t i = 0; i < r->modes.count; i++)
        r->mode_numbers[i] = (long)r->modes.items[i];
    for (size_t i = 0; i < r->variables.count; i++) {
        r->names[i] = all[i].name;
        r->low[i] = all[i].min;
        r->high[i] = all[i].max;
    }
    band_read(&r->asked_band, r->band);
    for (int i = 0; i < 2 && r->current_m_per_s.count == 2; i++)
        r->band[i] = 2 * M_PI * r->required.strouhal * r->current_m_per_s.items[i] /
                     r->required.diameter_m;
}

/* A few chains at a time, and the sweep's branches. */
double absorber_solve_bytes(const void *data)
{
    const absorber_request *r = data;
    return 2e6 + 8192 * (double)r->in.part_count + 4096 * (double)r->sweep.points;
}

double absorber_cost_us(const void *data)
{
    const absorber_request *r = data;
    const double variables = (double)r->variables.count;
    const chain_variables lowest = {r->names, r->low, r->variables.count};
    strum_taut *chain;
    double work = 1100 * (double)r->sweep.points + 1.7 * (double)r->max_evaluations;
    if (r->assess)
        work = 2000 + 4000 * (double)r->modes.count;
    if (r->modes.count > 0) { /* each is followed from zero damping, past those below it */
        double highest = 0;
        for (size_t i = 0; i < r->modes.count; i++)
            highest = fmax(highest, (double)r->mode_numbers[i]);
        const double modes = (double)r->modes.count;
        work += 19000 + 2100 * highest + modes * variables * (520 * variables + 780 * modes);
    } else if (chain_make(&r->in, &lowest, &chain, NULL) == STRUM_OK) {
        const double modes = (double)strum_taut_count(chain, r->band[1]) -
                             (double)strum_taut_count(chain, r->band[0]);
        strum_taut_free(chain);
        work += r->assess ? 4000 * modes : 0;
        work += modes * variables * (520 * variables + 780 * modes);
    }
    return fmin(work, 120.0 * (double)r->max_evaluations);
}
