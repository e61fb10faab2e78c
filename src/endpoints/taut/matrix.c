/* SPDX-License-Identifier: GPL-3.0-or-later */
/* /v1/taut/matrix: transfer matrices of a chain and of its components (Li's library, in
 * Levesque 1997). */
#include "endpoints/common/chain.h"
#include "endpoints/common/frequency.h"

#define FREQUENCIES_MAX 10000
/* Matrices of one answer, those of components included. */
#define MATRICES_MAX 100000

typedef struct request {
    chain_input in;
    complexes_value angular_frequencies;
    frequencies_input real;

    complexes_value asked; /* computed by prepare, owned by the arena: whichever is given */
} request;

static const field fields[] = {
    CHAIN_FIELDS,
    {FIELD_AT(FIELD_COMPLEXES, request, angular_frequencies), .unit = "rad/s", .max = 1e9,
     .min_items = 1, .max_items = FREQUENCIES_MAX,
     .help = "frequencies w of e^{i w t}: numbers, or {re, im}; im > 0 decays"},
    FREQUENCIES_FIELDS(request, real, FREQUENCIES_MAX),
    {.kind = FIELD_END}};

static const char *const which[] = {"angular_frequencies", FREQUENCIES_GROUPS(""), NULL};
static const field_groups groups[] = {{"frequencies", false, which}, {0}};

static const schema request_schema = {
    .name = "taut_matrix_request", .fields = fields, .groups = groups, .size = sizeof(request)};

/* Whichever list is given. */
static void find_frequencies(request *r, schema_arena *arena, problem *p)
{
    numbers_value real;
    bool good = frequencies_read(&r->real, arena, &real);
    r->asked = r->angular_frequencies;
    if (good && real.count > 0) {
        r->asked.count = real.count;
        r->asked.items = schema_alloc(arena, real.count * sizeof *r->asked.items);
        good = r->asked.items != NULL;
        for (size_t i = 0; good && i < real.count; i++)
            r->asked.items[i] = real.items[i];
    }
    if (!good)
        problem_out_of_memory(p);
}

static void prepare(void *data, schema_arena *arena, problem *p)
{
    request *r = data;
    const char *pointer = frequencies_pointer(&r->real);
    chain_prepare(&r->in, arena, p);
    find_frequencies(r, arena, p);
    if ((r->in.part_count + 1) * r->asked.count > MATRICES_MAX)
        problem_add(p, pointer != NULL ? pointer : "/angular_frequencies",
                    "%zu frequencies of %zu components are more than %d matrices",
                    r->asked.count, r->in.part_count, MATRICES_MAX);
}

static double cost_us(const void *data)
{
    const request *r = data;
    return 10 + 2.0 * (double)(r->in.part_count * r->asked.count);
}

/* The chain alone; matrices are written as they are made. */
static double solve_bytes(const void *data)
{
    const request *r = data;
    return 4096.0 * (double)r->in.part_count;
}

static void write_matrix(json_writer *json, const double _Complex matrix[4])
{
    json_open_array(json);
    for (int k = 0; k < 4; k++)
        json_complex(json, matrix[k]);
    json_close_array(json);
}

/* The members of one frequency. */
static strum_status write_at(json_writer *json, const strum_taut *chain, size_t components,
                             double _Complex w, strum_error *fault)
{
    double _Complex matrix[4];
    strum_status status = strum_taut_matrix(chain, creal(w), cimag(w), matrix, fault);
    if (status != STRUM_OK)
        return status;
    json_open_object(json);
    json_put_complex(json, "angular_frequency", w);
    json_key(json, "chain");
    write_matrix(json, matrix);
    json_key(json, "components");
    json_open_array(json);
    for (size_t i = 0; i < components && status == STRUM_OK; i++) {
        status = strum_taut_component_matrix(chain, i, creal(w), cimag(w), matrix, fault);
        if (status == STRUM_OK)
            write_matrix(json, matrix);
    }
    json_close_array(json);
    json_close_object(json);
    return status;
}

static bool respond(const void *data, answer *a)
{
    const request *r = data;
    json_writer *json = a->result;
    strum_error fault = {0};
    strum_taut *chain;
    a->theory =
        "transfer matrices of Li's library (in Levesque 1997), from rigid-body mechanics "
        "where the printed ones err; state (y, T y'), right = F left, F = F_n ... F_1, "
        "e^{+i w t}";
    strum_status status = chain_make(&r->in, NULL, &chain, &fault);
    json_open_object(json);
    json_key(json, "matrices");
    json_open_array(json);
    for (size_t i = 0; i < r->asked.count && status == STRUM_OK; i++) {
        status = write_at(json, chain, r->in.part_count, r->asked.items[i], &fault);
        if (answer_cancelled(a))
            status = STRUM_ERR_CANCELLED;
    }
    json_close_array(json);
    json_close_object(json);
    strum_taut_free(chain);
    if (status != STRUM_OK)
        chain_refuse(&r->in, &fault, status, a->problem);
    return status == STRUM_OK;
}

const endpoint taut_matrix = {.path = "/v1/taut/matrix",
                              .title = "Transfer matrices of a chain and of its components",
                              .request = &request_schema,
                              .prepare = prepare,
                              .cost_us = cost_us,
                              .solve_bytes = solve_bytes,
                              .answer = respond};
