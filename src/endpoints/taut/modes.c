/* SPDX-License-Identifier: GPL-3.0-or-later */
/* /v1/taut/modes: modes of a taut chain (Levesque 1997; Sergev and Iwan 1980). */
#include <math.h>
#include <stdlib.h>

#include "endpoints/common/plausibility.h"
#include "endpoints/common/chain.h"
#include "endpoints/common/frequency.h"
#include "endpoints/common/members.h"

#define MODES_MAX        1000
#define SHAPE_POINTS_MAX 2000
/* Nodes of one answer: an upper bound from the mode numbers. */
#define NODES_MAX 200000
/* Roots of damped chains hold to this, relative, or the answer says to what. */
#define DIGITS_HELD 1e-10
/* The band of a chain with more of these is not counted beforehand. */
#define VARYING_COUNTED_MAX 20

static const char *const methods[] = {"certified", "muller", NULL};

typedef struct request {
    chain_input in;
    int64_t modes, first_mode, shape_points;
    numbers_value mode_numbers;
    band_input asked_band;
    double max_decay_per_s;
    int method;
    bool nodes, verify;

    long *numbers; /* asked by number: computed by prepare, owned by the arena */
    size_t number_count;
    double band[2];               /* rad/s; 0 where none is asked */
    double band_below, band_last; /* modes below its two ends, without damping */
    strum_taut *chain; /* made by prepare, owned by the arena; NULL where it cannot be made */
} request;

static const field fields[] = {
    CHAIN_FIELDS,
    CHAIN_END_FIELDS,
    {FIELD_AT(FIELD_INTEGER, request, modes), .min = 1, .max = MODES_MAX,
     .flags = FIELD_DEFAULT, .fallback = 10,
     .help = "how many modes, by frequency, from first_mode on"},
    {FIELD_AT(FIELD_INTEGER, request, first_mode), .min = 1, .max = STRUM_TAUT_MODE_MAX,
     .flags = FIELD_DEFAULT, .fallback = 1,
     .help = "place of the first mode among all by frequency; without damping its number"},
    {FIELD_AT(FIELD_NUMBERS, request, mode_numbers), .min = 1, .max = STRUM_TAUT_MODE_MAX,
     .flags = FIELD_ASCENDING | FIELD_WHOLE, .min_items = 1, .max_items = MODES_MAX,
     .help = "these modes"},
    BAND_FIELDS(request, asked_band, 1e-9, 0, "all modes between these two frequencies"),
    {FIELD_AT(FIELD_NUMBER, request, max_decay_per_s), .unit = "1/s", .min = 0, .max = 1e9,
     .flags = FIELD_OPEN_MIN,
     .help = "with a band: up to this decay; default the upper end of the band"},
    {FIELD_AT(FIELD_CHOICE, request, method), .choices = methods, .flags = FIELD_DEFAULT,
     .help = "certified: counted, so that none is missing; muller: Muller's method with "
             "deflation as in the report, with a warning where it misses or hops"},
    {FIELD_AT(FIELD_INTEGER, request, shape_points), .min = 0, .max = SHAPE_POINTS_MAX,
     .flags = FIELD_DEFAULT,
     .help = "points of each mode shape, equally spaced, ends included; 0: none, else at least "
             "2"},
    {FIELD_AT(FIELD_FLAG, request, nodes), .flags = FIELD_DEFAULT, .fallback = 1,
     .help = "give nodes and antinodes (of chains without damping)"},
    {FIELD_AT(FIELD_FLAG, request, verify), .flags = FIELD_DEFAULT,
     .help = "check the answer by a second, independent method"},
    {.kind = FIELD_END}};

static const char *const which[] = {"[modes] [first_mode]",
                                    "mode_numbers",
                                    "band_rad_per_s [max_decay_per_s]",
                                    "band_Hz [max_decay_per_s]",
                                    "band_s [max_decay_per_s]",
                                    NULL};
static const field_groups groups[] = {{"which modes", true, which}, {0}};

static const schema request_schema = {
    .name = "taut_modes_request", .fields = fields, .groups = groups, .size = sizeof(request)};

static bool by_band(const request *r)
{
    return band_given(&r->asked_band);
}

static void check_nodes(const request *r, const char *pointer, double nodes, problem *p)
{
    if (r->nodes && nodes > NODES_MAX)
        problem_add(
            p, pointer,
            "these modes have up to %.0f nodes, more than %d: ask fewer modes, or nodes: "
            "false",
            nodes, NODES_MAX);
}

static void fill_numbers(request *r, schema_arena *arena, problem *p)
{
    const bool listed = r->mode_numbers.count > 0;
    r->number_count = listed ? r->mode_numbers.count : (size_t)r->modes;
    r->numbers = schema_alloc(arena, r->number_count * sizeof *r->numbers);
    if (r->numbers == NULL) {
        problem_out_of_memory(p);
        return;
    }
    double nodes = 0.0;
    for (size_t i = 0; i < r->number_count; i++) {
        r->numbers[i] = listed ? (long)r->mode_numbers.items[i] : (long)r->first_mode + (long)i;
        nodes += (double)r->numbers[i];
    }
    if (r->numbers[r->number_count - 1] > STRUM_TAUT_MODE_MAX)
        problem_add(p, "/first_mode", "mode numbers go up to %d", STRUM_TAUT_MODE_MAX);
    check_nodes(r, "/nodes", nodes, p);
}

static void free_chain(void *chain)
{
    strum_taut_free(chain);
}

/* Two shots along the chain; with many varying cables these are too much for the thread that
 * reads requests, and the band is taken to be full. */
static void count_band(request *r, problem *p)
{
    r->band_last = STRUM_TAUT_ROOTS_MAX;
    if (chain_varying(&r->in) > VARYING_COUNTED_MAX)
        return;
    r->band_below = (double)strum_taut_count(r->chain, r->band[0]);
    r->band_last = (double)strum_taut_count(r->chain, r->band[1]);
    if (!strum_taut_is_damped(r->chain))
        check_nodes(r, band_pointer(&r->asked_band),
                    0.5 * (r->band_last - r->band_below) * (r->band_last + r->band_below - 1.0),
                    p);
}

/* The chain, for the cost and the answer; the answer says why there is none. */
static void keep_chain(request *r, schema_arena *arena, problem *p)
{
    if (chain_make(&r->in, NULL, &r->chain, NULL) != STRUM_OK)
        return;
    if (!schema_arena_own(arena, r->chain, free_chain)) {
        r->chain = NULL;
        problem_out_of_memory(p);
    } else if (by_band(r)) {
        count_band(r, p);
    }
}

static void prepare(void *data, schema_arena *arena, problem *p)
{
    request *r = data;
    chain_prepare(&r->in, arena, p);
    band_read(&r->asked_band, r->band);
    if (r->shape_points == 1)
        problem_add(p, "/shape_points",
                    "must be 0 or at least 2, so that both ends are among them");
    if (!by_band(r)) {
        fill_numbers(r, arena, p);
    } else if (!FIELD_GIVEN(&request_schema, r, max_decay_per_s)) {
        r->max_decay_per_s = r->band[1];
        FIELD_GIVE(&request_schema, r, max_decay_per_s);
    }
    if (p->status == 0)
        keep_chain(r, arena, p);
}

/* Modes asked, or about as many as the band holds. */
static double mode_estimate(const request *r)
{
    return by_band(r) ? r->band_last - r->band_below + 3.0 : (double)r->number_count;
}

/* Mode n has n - 1 nodes, or about as many. */
static double node_estimate(const request *r, double modes)
{
    if (by_band(r))
        return modes * (r->band_below + modes / 2);
    double nodes = 0;
    for (size_t i = 0; i < r->number_count; i++)
        nodes += (double)r->numbers[i];
    return nodes;
}

/* Measured: 3 MB for 400 components; the second method of a damped chain fills matrices of up to
 * 800 rows. */
static double solve_bytes(const void *data)
{
    const request *r = data;
    const double parts = (double)r->in.part_count;
    const double rows = r->verify ? fmin(2 * parts, 800) : 0;
    return 2e6 + 4096 * parts + 48 * rows * rows;
}

/* Damped chains far from any cable can take minutes: a worker, whom a timeout ends, has each. */
#define DAMPED_LEAST_US 300

static double cost_us(const void *data)
{
    const request *r = data;
    const double parts = (double)r->in.part_count;
    const double varying = (double)chain_varying(&r->in);
    if (r->chain == NULL)
        return 10.0;
    const double modes = mode_estimate(r);
    const bool damped = strum_taut_is_damped(r->chain);
    const double nodes = node_estimate(r, modes);
    double work = modes * (0.9 * (double)r->shape_points + (r->nodes ? 0.8 : 0)) +
                  (r->nodes ? 0.8 * nodes : 0);
    if (damped)
        work += DAMPED_LEAST_US + modes * (11 * parts + 290 * varying) +
                (r->verify ? 2200 + 490 * modes * parts + 90 * nodes : 0);
    else
        work += 27 + modes * (0.8 * parts + 190 * varying) +
                (r->verify ? 160 + 190 * modes * varying : 0);
    return work;
}

/* Of the mode shapes: modes times points. */
static double answer_bytes(const void *data, const char **pointer)
{
    static const size_t keys = sizeof "{\"x_m\":,\"displacement\":,\"force_N_per_m\":},";
    const request *r = data;
    const bool damped = r->chain != NULL && strum_taut_is_damped(r->chain);
    const double numbers = 1 + 2 * (damped ? 3 : 1); /* {"re":, "im":} */
    const double modes = by_band(r) ? r->band_last - r->band_below : (double)r->number_count;
    *pointer = "/shape_points";
    /* A damped band may hold fewer roots than modes; one from the first mode on may be uncounted. */
    if (by_band(r) && (damped || r->band_below == 0))
        return 0;
    return modes * (double)r->shape_points * ((double)keys + numbers * ANSWER_NUMBER_BYTES);
}

/* ---- answering ---- */

static void write_nodes(json_writer *json, const strum_taut_shape *shape)
{
    const double *nodes;
    const strum_taut_antinode *antinodes;
    const size_t node_count = strum_taut_shape_nodes(shape, &nodes);
    const size_t antinode_count = strum_taut_shape_antinodes(shape, &antinodes);
    json_key(json, "nodes_m");
    json_open_array(json);
    for (size_t i = 0; i < node_count; i++)
        json_number(json, nodes[i]);
    json_close_array(json);
    json_key(json, "antinodes");
    json_open_array(json);
    for (size_t i = 0; i < antinode_count; i++) {
        json_open_object(json);
        json_put_number(json, "x_m", antinodes[i].x);
        json_put_number(json, "amplitude", antinodes[i].amplitude);
        json_close_object(json);
    }
    json_close_array(json);
}

/* Undamped shapes are real. */
static void put_value(json_writer *json, const char *key, bool damped, double _Complex value)
{
    if (damped)
        json_put_complex(json, key, value);
    else
        json_put_number(json, key, creal(value));
}

static strum_status write_shape(json_writer *json, const request *r, bool damped,
                                const strum_taut_shape *shape, strum_error *fault)
{
    const size_t count = (size_t)r->shape_points;
    strum_taut_point *points = malloc(count * sizeof *points);
    if (points == NULL)
        return STRUM_ERR_MEMORY;
    const strum_status status = strum_taut_shape_sample(shape, count, points, fault);
    json_key(json, "shape");
    json_open_array(json);
    for (size_t i = 0; i < count && status == STRUM_OK; i++) {
        json_open_object(json);
        json_put_number(json, "x_m", points[i].x);
        put_value(json, "displacement", damped, points[i].displacement);
        put_value(json, "force_N_per_m", damped, points[i].force);
        json_close_object(json);
    }
    json_close_array(json);
    free(points);
    return status;
}

/* There half the digits are all there are, and the answer says so anyway. */
static bool at_coalescence(const strum_taut_root *root)
{
    return root->exceptional < CHAIN_EXCEPTIONAL;
}

static strum_status write_mode(const request *r, const strum_taut_root *root, answer *a,
                               strum_error *fault)
{
    json_writer *json = a->result;
    const bool damped = strum_taut_is_damped(r->chain);
    const strum_options options = answer_options(a);
    strum_taut_shape *shape = NULL;
    strum_status status = STRUM_OK;
    json_open_object(json);
    chain_write_root(json, root);
    if (root->mode == 0)
        json_put_flag(json, "unnumbered", true);
    if (root->error > DIGITS_HELD && !at_coalescence(root))
        json_put_number(json, "relative_error", root->error);
    if (root->frequency > 0.0 && ((r->nodes && !damped) || r->shape_points > 0))
        status = strum_taut_shape_make(r->chain, root, &options, &shape, fault);
    if (status == STRUM_OK && shape != NULL && r->nodes && !damped)
        write_nodes(json, shape);
    if (status == STRUM_OK && shape != NULL && r->shape_points > 0)
        status = write_shape(json, r, damped, shape, fault);
    strum_taut_shape_free(shape);
    json_close_object(json);
    return status;
}

static void write_count(json_writer *json, const strum_taut_roots *roots)
{
    json_key(json, "count");
    json_open_object(json);
    json_put_string(json, "method", roots->count_method);
    json_put_integer(json, "expected", roots->expected);
    json_put_integer(json, "found", roots->found);
    json_put_number(json, "lowest_rad_per_s", roots->lowest);
    json_put_number(json, "highest_rad_per_s", roots->highest);
    json_put_number(json, "max_decay_per_s", roots->max_decay);
    json_put_integer(json, "axis_expected", roots->axis_expected);
    json_put_integer(json, "axis_found", roots->axis_found);
    json_put_integer(json, "evaluations", roots->evaluations);
    json_close_object(json);
}

static strum_status write_verification(json_writer *json, const strum_taut *chain,
                                       const strum_taut_roots *roots, answer *a,
                                       strum_error *fault)
{
    strum_verification v;
    const strum_options options = answer_options(a);
    const strum_status status = strum_taut_verify(chain, roots, &options, &v, fault);
    if (status == STRUM_ERR_METHOD) {
        answer_warn(a, "not verified: %s; ask a narrower band", fault->reason);
        return STRUM_OK;
    }
    if (status != STRUM_OK)
        return status;
    put_verification(json, &v);
    return STRUM_OK;
}

/* A damper to ground this near an end, in lengths, is that of a stay. */
#define STAY_DAMPER 0.1
/* w L/T from which sag matters to it: no steel cable is strained by more than 1/200, so that
 * lambda^2 = (w L/T)^2 EA/T is then 1 at least  [Irvine 1981]. */
#define STAY_SAGS  0.07
#define STAY_STIFF 200.0
#define GRAVITY    9.80665

/* A chain is straight; a stay sags, and its sag takes damping from mode 1. Said only of what the
 * request shows to be one: cable alone, with a damper near its end. */
static void warn_sag(const request *r, answer *a)
{
    double length = 0, mass = 0, tension = 0, at = -1;
    chain_glance part;
    for (size_t i = 0; i < r->in.part_count; i++) {
        if (!chain_look(&r->in, NULL, i, &part) || part.absorber)
            return;
        if (part.damper)
            at = length;
        length += part.length;
        mass += part.length * part.mass_per_length;
        tension = fmax(tension, part.tension);
    }
    const double near = fmin(at, length - at) / length, share = mass * GRAVITY / tension;
    if (r->in.left_end != STRUM_TAUT_FIXED || r->in.right_end != STRUM_TAUT_FIXED || at < 0 ||
        near > STAY_DAMPER || !(share > STAY_SAGS))
        return;
    answer_warn(a,
                "a chain is straight: if this is a stay in air, its weight over its tension is "
                "%.2g, lambda^2 some %.1g or more, and its sag takes damping from mode 1; "
                "/v1/cable/modes knows sag and bending stiffness",
                share, STAY_STIFF * share * share);
}

/* Mode numbers without an oscillating root, and roots without a number. */
static void warn_of_numbers(const strum_taut_roots *roots, answer *a)
{
    bool unnumbered = false;
    if (roots->missing_count > 0)
        answer_warn(a,
                    "%zu mode numbers, the first of them %ld, have no oscillating root: "
                    "missing_modes says what became of each",
                    roots->missing_count, roots->missing[0].mode);
    for (size_t i = 0; i < roots->count; i++)
        unnumbered = unnumbered || roots->roots[i].mode == 0;
    if (unnumbered)
        answer_warn(a, "roots without a number lie on no branch from zero damping");
}

/* Roots that rounding moves further than is promised. */
static void warn_of_digits(const strum_taut_roots *roots, answer *a)
{
    const strum_taut_root *worst = NULL;
    size_t count = 0;
    for (size_t i = 0; i < roots->count; i++) {
        const strum_taut_root *root = &roots->roots[i];
        if (!(root->error > DIGITS_HELD) || at_coalescence(root))
            continue;
        count++;
        worst = worst == NULL || root->error > worst->error ? root : worst;
    }
    if (worst != NULL)
        answer_warn(a,
                    "%zu roots are not known to ten digits, the least at %.6g rad/s with about "
                    "%.0f (relative_error): a damper nearly matches its cable, and rounding "
                    "of their difference moves the roots",
                    count, worst->frequency, fmax(0.0, floor(-log10(worst->error))));
}

static void warn(const request *r, const strum_taut_roots *roots, answer *a)
{
    warn_of_numbers(roots, a);
    warn_of_digits(roots, a);
    if (roots->hidden_beyond)
        answer_warn(a,
                    "a damper matches its cable: beyond a decay of %.6g 1/s rounding hides "
                    "whatever roots there are, and none is answered there",
                    roots->max_decay);
    if (!by_band(r) && r->mode_numbers.count == 0 && roots->count < r->number_count)
        answer_warn(a,
                    "the chain has %zu oscillating roots only where %zu were asked for; "
                    "looked for up to %.6g rad/s",
                    roots->count, r->number_count, roots->highest);
    if (roots->missed > 0)
        answer_warn(a,
                    "Muller's method missed %ld of the roots that the count expects; "
                    "method certified gives them all",
                    roots->missed);
    if (roots->hopped > 0)
        answer_warn(a,
                    "Muller's method hopped: %ld of its roots belong to another mode than the "
                    "one whose undamped frequency it started from",
                    roots->hopped);
    for (size_t i = 0; i < roots->count; i++)
        if (roots->roots[i].exceptional < CHAIN_EXCEPTIONAL) {
            answer_warn(
                a,
                "two roots coalesce at %.9g rad/s (an exceptional point): frequencies and "
                "decays there have half the digits, and the numbers of the two modes "
                "depend on the path",
                roots->roots[i].frequency);
            break;
        }
}

/* What became of the modes that no oscillating root has the number of. */
static void write_missing(json_writer *json, const strum_taut_roots *roots)
{
    static const char *const fates[] = {"overdamped", "unbounded", "coalesced"};
    if (roots->missing_count == 0)
        return;
    json_key(json, "missing_modes");
    json_open_array(json);
    for (size_t i = 0; i < roots->missing_count; i++) {
        json_open_object(json);
        json_put_integer(json, "mode", roots->missing[i].mode);
        json_put_string(json, "fate", fates[roots->missing[i].fate]);
        json_put_number(json, "followed_to", roots->missing[i].factor);
        json_close_object(json);
    }
    json_close_array(json);
}

static strum_status write_result(const request *r, const strum_taut_roots *roots, answer *a,
                                 strum_error *fault)
{
    json_writer *json = a->result;
    strum_status status = STRUM_OK;
    json_open_object(json);
    json_put_number(json, "length_m", strum_taut_length(r->chain));
    json_put_flag(json, "damped", strum_taut_is_damped(r->chain));
    json_key(json, "modes");
    json_open_array(json);
    for (size_t i = 0; i < roots->count && status == STRUM_OK; i++) {
        status = write_mode(r, &roots->roots[i], a, fault);
        if (answer_cancelled(a))
            status = STRUM_ERR_CANCELLED;
    }
    json_close_array(json);
    json_key(json, "overdamped");
    json_open_array(json);
    for (size_t i = 0; i < roots->overdamped_count; i++) {
        json_open_object(json);
        chain_write_root(json, &roots->overdamped[i]);
        json_close_object(json);
    }
    json_close_array(json);
    write_missing(json, roots);
    write_count(json, roots);
    json_put_string(json, "normalisation",
                    "the largest displacement along the chain is 1 (the leftmost where tied)");
    if (r->verify && status == STRUM_OK)
        status = write_verification(json, r->chain, roots, a, fault);
    json_close_object(json);
    return status;
}

/* Why `prepare` could make no chain. */
static strum_status refusal(const request *r, strum_error *fault)
{
    strum_taut *chain = NULL;
    const strum_status status = chain_make(&r->in, NULL, &chain, fault);
    strum_taut_free(chain);
    /* made after all: memory was short then */
    return status != STRUM_OK ? status : STRUM_ERR_MEMORY;
}

static bool respond(const void *data, answer *a)
{
    const request *r = data;
    const bool listed = r->mode_numbers.count > 0, placed = !by_band(r) && !listed;
    const strum_taut_query query = {.numbers = listed ? r->numbers : NULL,
                                    .count = listed ? r->number_count : 0,
                                    .first = placed ? (long)r->first_mode : 0,
                                    .wanted = placed ? r->number_count : 0,
                                    .lowest = r->band[0],
                                    .highest = r->band[1],
                                    .max_decay = by_band(r) ? r->max_decay_per_s : 0.0,
                                    .method = r->method == 1 ? STRUM_TAUT_MULLER
                                                             : STRUM_TAUT_CERTIFIED};
    const strum_options options = answer_options(a);
    strum_error fault = {0};
    strum_taut_roots *roots = NULL;
    strum_status status = r->chain != NULL ? STRUM_OK : refusal(r, &fault);
    if (status == STRUM_OK)
        status = strum_taut_solve(r->chain, &query, &options, &roots, &fault);
    if (status == STRUM_OK) {
        a->theory = strum_taut_is_damped(r->chain)
                        ? "taut chain by transfer matrices (Levesque 1997): branches followed "
                          "from zero damping, certified by the argument principle"
                        : "taut chain by transfer matrices (Levesque 1997; Sergev and Iwan "
                          "1980): every mode by an exact shooting count";
        warn_chain(&r->in, a);
        warn_sag(r, a);
        warn(r, roots, a);
        status = write_result(r, roots, a, &fault);
    }
    strum_taut_roots_free(roots);
    if (status != STRUM_OK)
        chain_refuse(&r->in, &fault, status, a->problem);
    return status == STRUM_OK;
}

const endpoint taut_modes = {
    .path = "/v1/taut/modes",
    .title = "Modes of a taut chain of cables, masses, rigid bodies, absorbers and supports",
    .request = &request_schema,
    .prepare = prepare,
    .cost_us = cost_us,
    .solve_bytes = solve_bytes,
    .answer_bytes = answer_bytes,
    .answer = respond};
