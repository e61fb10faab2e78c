/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "endpoints/identify/request.h"

#include <math.h>
#include <stdio.h>

#define GRAVITY 9.80665

const char *const identify_unknowns[] = {"tension", "bending_stiffness", "fixity",  "length",
                                         "mass",    "axial_stiffness",   "damping", NULL};
const char *const identify_fields[] = {
    "tension_N",         "bending_stiffness_N_m2", "fixity", "length_m", "mass_kg_per_m",
    "axial_stiffness_N", "damping_N_s_per_m",      NULL};
static const char *const planes[] = {"out_of_plane", "in_plane", NULL};
enum { ROTATION_PINNED, ROTATION_CLAMPED, ROTATION_ELASTIC };
static const char *const rotations[] = {"pinned", "clamped", "elastic", NULL};

static const field end_fields[] = {
    {FIELD_AT(FIELD_CHOICE, identify_end, rotation), .choices = rotations,
     .flags = FIELD_DEFAULT,
     .help = "elastic: a rotational spring, of unknown fixity where no number is given"},
    {FIELD_AT(FIELD_NUMBER, identify_end, rotational_stiffness_N_m_per_rad), .unit = "N m/rad",
     .min = 0, .max = 1e18, .help = "of an elastic end"},
    {FIELD_AT(FIELD_NUMBER, identify_end, fixity), .unit = "1", .min = 0, .max = 1,
     .help = "of an elastic end: k/(k + 3 EI/L + sqrt(T EI)); 0 pinned, 1 clamped"},
    {FIELD_AT(FIELD_NUMBER, identify_end, fixity_standard_deviation), .unit = "1", .min = 0,
     .max = 10, .flags = FIELD_OPEN_MIN,
     .help = "of the fixity, which is then unknown and known to this"},
    {.kind = FIELD_END}};
static const char *const end_words[] = {"rotational_stiffness_N_m_per_rad",
                                        "fixity [fixity_standard_deviation]", NULL};
static const field_groups end_groups[] = {{"elastic end", true, end_words}, {0}};
static const schema end_schema = {"identify_end", end_fields, end_groups, sizeof(identify_end)};

#define POSITIVE(member, unit_, max_, help_)                                                   \
    {                                                                                          \
        FIELD_AT(FIELD_NUMBER, identify_request, member),                                      \
            .unit = (unit_), .min = 0, .max = (max_), .flags = FIELD_OPEN_MIN, .help = (help_) \
    }
#define RELATIVE(member, what)                                                                 \
    POSITIVE(member, "1", 10,                                                                  \
             "standard deviation of the " what                                                 \
             " over it: it is then unknown, and known to this")
#define LIST(member, unit_, max_, flags_, help_)                                               \
    {                                                                                          \
        FIELD_AT(FIELD_NUMBERS, identify_request, member),                                     \
            .unit = (unit_), .min = 0, .max = (max_), .flags = FIELD_OPEN_MIN | (flags_),      \
            .min_items = 1, .max_items = STRUM_IDENTIFY_FREQUENCIES_MAX, .help = (help_)       \
    }
#define END(member, help_)                                                                     \
    {                                                                                          \
        FIELD_AT(FIELD_OBJECT, identify_request, member), .schema = &end_schema,               \
                                                          .help = (help_)                      \
    }

static const field fields[] = {
    LIST(frequencies_Hz, "Hz", 1e6, FIELD_ASCENDING, "measured natural frequencies"),
    LIST(periods_s, "s", 1e6, 0, "in place of frequencies, the longest first"),
    POSITIVE(pulse_time_s, "s", 1e6,
             "in place of frequencies: time of `pulses` returns of a pulse to one end: "
             "frequency 1 is pulses/time"),
    {FIELD_AT(FIELD_INTEGER, identify_request, pulses), .min = 1, .max = 1000,
     .flags = FIELD_DEFAULT, .fallback = 1, .help = "returns of the pulse that were timed"},
    LIST(frequency_standard_deviations_Hz, "Hz", 1e6, 0,
         "standard deviation of each frequency"),
    POSITIVE(frequency_standard_deviation_Hz, "Hz", 1e6,
             "standard deviation of every frequency"),
    {FIELD_AT(FIELD_NUMBERS, identify_request, mode_numbers), .min = 1,
     .max = STRUM_IDENTIFY_MODE_MAX, .flags = FIELD_ASCENDING | FIELD_WHOLE, .min_items = 1,
     .max_items = STRUM_IDENTIFY_FREQUENCIES_MAX,
     .help = "numbers of the modes; left out: all that are possible are tried"},
    {FIELD_AT(FIELD_INTEGER, identify_request, first_mode_at_most), .min = 1, .max = 100,
     .flags = FIELD_DEFAULT, .fallback = 6,
     .help = "without mode numbers: the first frequency is mode 1 to this"},
    {FIELD_AT(FIELD_INTEGER, identify_request, missing_modes_at_most), .min = 0, .max = 100,
     .flags = FIELD_DEFAULT, .fallback = 4,
     .help = "without mode numbers: so many modes below the last may not have been seen"},
    LIST(damping_ratios, "1", 0.9, 0,
         "measured damping ratios of the modes, of a string with a damper"),
    LIST(damping_ratio_standard_deviations, "1", 1, 0,
         "standard deviation of each damping ratio"),
    POSITIVE(damper_position_m, "m", 1e7, "of the damper, from one end"),
    POSITIVE(length_m, "m", 1e7, "free length between the ends"),
    POSITIVE(mass_kg_per_m, "kg/m", 1e6, "mass per length, without added mass"),
    {FIELD_AT(FIELD_NUMBER, identify_request, added_mass_kg_per_m), .unit = "kg/m", .min = 0,
     .max = 1e6, .flags = FIELD_DEFAULT, .help = "mass of fluid that moves with the cable"},
    {FIELD_AT(FIELD_NUMBER, identify_request, bending_stiffness_N_m2), .unit = "N m^2",
     .min = 0, .max = 1e15, .help = "EI; default 0 where it is known"},
    POSITIVE(axial_stiffness_N, "N", 1e15, "EA; in plane, where the sag stretches the cable"),
    {FIELD_AT(FIELD_NUMBER, identify_request, weight_N_per_m), .unit = "N/m", .min = 0,
     .max = 1e8, .help = "weight per length; in plane the default is mass times 9.80665"},
    {FIELD_AT(FIELD_NUMBER, identify_request, inclination_deg), .unit = "deg", .min = 0,
     .max = 89.9, .flags = FIELD_DEFAULT, .help = "of the chord"},
    {FIELD_AT(FIELD_NUMBER, chain_input, tension_N), .unit = "N", .min = 0, .max = 1e12,
     .flags = FIELD_OPEN_MIN | FIELD_VARIABLE,
     .help = "where it is not sought; of a chain: the tension to which the components' own "
             "tensions belong"},
    RELATIVE(tension_relative_standard_deviation, "tension"),
    RELATIVE(length_relative_standard_deviation, "length"),
    RELATIVE(mass_relative_standard_deviation, "mass"),
    RELATIVE(bending_stiffness_relative_standard_deviation, "bending stiffness"),
    RELATIVE(axial_stiffness_relative_standard_deviation, "axial stiffness"),
    {FIELD_AT(FIELD_CHOICE, identify_request, plane), .choices = planes, .flags = FIELD_DEFAULT,
     .help = "of the motion; in plane the sag acts, and raises the odd modes"},
    END(end_1, "rotation at one end; default pinned"),
    END(end_2, "rotation at the other end; default pinned"),
    END(ends, "rotation at both ends"),
    {FIELD_AT(FIELD_VARIANTS, chain_input, components), .variants = chain_variants,
     .min_items = 1, .max_items = 1000,
     .help =
         "in place of length and mass: a taut chain as in /v1/taut/modes, from left to right"},
    CHAIN_END_FIELDS,
    {FIELD_AT(FIELD_CHOICES, identify_request, unknowns), .choices = identify_unknowns,
     .min_items = 1, .max_items = STRUM_IDENTIFY_UNKNOWNS_MAX,
     .help = "what is sought; default tension (with damping ratios: damping), and the fixity "
             "of elastic ends without a number"},
    {FIELD_AT(FIELD_NUMBER, identify_request, confidence), .unit = "1", .min = 0.5,
     .max = 0.9999, .flags = FIELD_DEFAULT, .fallback = 0.95, .help = "of the intervals"},
    {FIELD_AT(FIELD_FLAG, identify_request, exclude_outlier), .flags = FIELD_DEFAULT,
     .help = "leave out the frequency that disagrees most with the others, where one does"},
    {FIELD_AT(FIELD_FLAG, identify_request, compare), .flags = FIELD_DEFAULT,
     .help = "put the usual formulas beside the answer, with their branches and ranges"},
    {FIELD_AT(FIELD_FLAG, identify_request, verify), .flags = FIELD_DEFAULT,
     .help = "check the computed frequencies by a second, independent method"},
    {.kind = FIELD_END}};

static const char *const data_words[] = {"frequencies_Hz", "periods_s", "pulse_time_s [pulses]",
                                         NULL};
static const char *const spread_words[] = {"frequency_standard_deviations_Hz",
                                           "frequency_standard_deviation_Hz", NULL};
static const char *const number_words[] = {"[first_mode_at_most] [missing_modes_at_most]",
                                           "mode_numbers", NULL};
static const char *const ends_words[] = {"end_1 [end_2]", "end_2", "ends", NULL};
static const field_groups groups[] = {{"frequencies", true, data_words},
                                      {"standard deviations", true, spread_words},
                                      {"which modes", true, number_words},
                                      {"ends", true, ends_words},
                                      {0}};
const schema identify_schema = {.name = "identify_tension_request",
                                .fields = fields,
                                .groups = groups,
                                .size = sizeof(identify_request)};

#define GIVEN(r, member) FIELD_GIVEN(&identify_schema, r, member)

bool identify_asks(const identify_request *r, strum_identify_quantity q)
{
    return r->unknowns.bits >> q & 1;
}

/* ---- what is sought ---- */

static void ask(identify_request *r, strum_identify_quantity q)
{
    r->unknowns.bits |= (uint64_t)1 << q;
}

static bool open_end(const identify_end *e)
{
    return e->rotation == ROTATION_ELASTIC &&
           (e->fixity_standard_deviation > 0 ||
            (!FIELD_GIVEN(&end_schema, e, fixity) &&
             !FIELD_GIVEN(&end_schema, e, rotational_stiffness_N_m_per_rad)));
}

/* The tables' ends; where none is given and the fixity is sought both are open. */
static void pick_ends(const identify_request *r, identify_end out[2])
{
    out[0] = GIVEN(r, ends) ? r->ends : r->end_1;
    out[1] = GIVEN(r, ends) ? r->ends : r->end_2;
    if (!GIVEN(r, ends) && !GIVEN(r, end_1) && !GIVEN(r, end_2) &&
        identify_asks(r, STRUM_IDENTIFY_FIXITY))
        out[0].rotation = out[1].rotation = ROTATION_ELASTIC;
}

static void complete_unknowns(identify_request *r)
{
    if (!GIVEN(r, unknowns))
        ask(r, r->damping_ratios.count > 0 ? STRUM_IDENTIFY_DAMPING : STRUM_IDENTIFY_TENSION);
    if (r->tension_relative_standard_deviation > 0)
        ask(r, STRUM_IDENTIFY_TENSION);
    if (r->length_relative_standard_deviation > 0)
        ask(r, STRUM_IDENTIFY_LENGTH);
    if (r->mass_relative_standard_deviation > 0)
        ask(r, STRUM_IDENTIFY_MASS);
    if (r->bending_stiffness_relative_standard_deviation > 0)
        ask(r, STRUM_IDENTIFY_BENDING);
    if (r->axial_stiffness_relative_standard_deviation > 0)
        ask(r, STRUM_IDENTIFY_AXIAL);
    identify_end ends[2];
    pick_ends(r, ends);
    if (open_end(&ends[0]) || open_end(&ends[1]))
        ask(r, STRUM_IDENTIFY_FIXITY);
    FIELD_GIVE(&identify_schema, r, unknowns);
}

/* ---- lists ---- */

static size_t data_count(const identify_request *r)
{
    return r->frequencies_Hz.count > 0 ? r->frequencies_Hz.count
           : r->periods_s.count > 0    ? r->periods_s.count
           : r->pulse_time_s > 0       ? 1
                                       : r->damping_ratios.count;
}

static void check_count(const char *pointer, size_t count, size_t wanted, problem *p)
{
    if (count > 0 && count != wanted)
        problem_add(p, pointer,
                    "must have as many items as there are frequencies: %zu, found %zu", wanted,
                    count);
}

static void check_lists(const identify_request *r, problem *p)
{
    const size_t n = data_count(r);
    if (n == 0)
        problem_add(p, "", "give frequencies_Hz, periods_s or pulse_time_s, or damping_ratios");
    check_count("/frequency_standard_deviations_Hz", r->frequency_standard_deviations_Hz.count,
                n, p);
    check_count("/mode_numbers", r->mode_numbers.count, n, p);
    check_count("/damping_ratios", r->damping_ratios.count, n, p);
    check_count("/damping_ratio_standard_deviations",
                r->damping_ratio_standard_deviations.count, n, p);
    for (size_t i = 1; i < r->periods_s.count; i++)
        if (!(r->periods_s.items[i] < r->periods_s.items[i - 1]))
            problem_add(p, "/periods_s",
                        "must descend: the longest period is that of the lowest mode");
    const bool frequencies =
        n > 0 && (r->damping_ratios.count == 0 || r->frequencies_Hz.count > 0 ||
                  r->periods_s.count > 0 || r->pulse_time_s > 0);
    if (!frequencies && (r->frequency_standard_deviations_Hz.count > 0 ||
                         r->frequency_standard_deviation_Hz > 0))
        problem_add(p, "/frequency_standard_deviations_Hz", "there are no frequencies");
    if (r->damping_ratios.count > 0 && r->mode_numbers.count == 0)
        problem_add(p, "/mode_numbers", "damping ratios need the numbers of their modes");
    if (r->damping_ratios.count > 0 && !(r->damper_position_m > 0))
        problem_add(p, "/damper_position_m", "damping ratios need the place of the damper");
    if (r->damping_ratio_standard_deviations.count > 0 && r->damping_ratios.count == 0)
        problem_add(p, "/damping_ratios", "missing: there are standard deviations of them");
}

static double *copy_list(schema_arena *arena, const numbers_value *from, double one, size_t n,
                         problem *p)
{
    double *list = schema_alloc(arena, n * sizeof *list);
    for (size_t i = 0; list != NULL && i < n; i++)
        list[i] = from->count > 0 ? from->items[i] : one;
    if (list == NULL)
        problem_out_of_memory(p);
    return list;
}

static void set_lists(identify_request *r, schema_arena *arena, problem *p)
{
    strum_identify_params *q = &r->params;
    const size_t n = q->count = data_count(r);
    const bool pulse = r->pulse_time_s > 0;
    if (pulse || r->periods_s.count > 0) {
        double *f = copy_list(arena, &r->periods_s, r->pulse_time_s / (double)r->pulses, n, p);
        for (size_t i = 0; f != NULL && i < n; i++)
            f[i] = 1 / f[i];
        q->frequencies = f;
    } else if (r->frequencies_Hz.count > 0) {
        q->frequencies = r->frequencies_Hz.items;
    }
    if (r->frequency_standard_deviations_Hz.count > 0 || r->frequency_standard_deviation_Hz > 0)
        q->standard_deviations = copy_list(arena, &r->frequency_standard_deviations_Hz,
                                           r->frequency_standard_deviation_Hz, n, p);
    if (r->damping_ratios.count > 0)
        q->damping_ratios = r->damping_ratios.items;
    if (r->damping_ratio_standard_deviations.count > 0)
        q->damping_standard_deviations = r->damping_ratio_standard_deviations.items;
    if (r->mode_numbers.count > 0 || pulse) {
        int *modes = schema_alloc(arena, n * sizeof *modes);
        for (size_t i = 0; modes != NULL && i < n; i++)
            modes[i] = pulse ? 1 : (int)r->mode_numbers.items[i];
        if (modes == NULL)
            problem_out_of_memory(p);
        q->modes = modes;
    }
    q->first_mode_max = (int)r->first_mode_at_most;
    q->missing_max = (int)r->missing_modes_at_most;
    q->damper_position = r->damper_position_m;
}

/* ---- the cable ---- */

static void set_ends(identify_request *r, problem *p)
{
    identify_end ends[2];
    pick_ends(r, ends);
    bool open = false;
    for (int i = 0; i < 2; i++) {
        const identify_end *e = &ends[i];
        const bool stiff = FIELD_GIVEN(&end_schema, e, rotational_stiffness_N_m_per_rad);
        strum_identify_end *to = &r->params.ends[i];
        const char *pointer = GIVEN(r, ends) ? "/ends" : i == 0 ? "/end_1" : "/end_2";
        if (e->rotation != ROTATION_ELASTIC && (stiff || FIELD_GIVEN(&end_schema, e, fixity)))
            problem_add(p, pointer, "a stiffness or fixity needs rotation elastic");
        if (e->rotation == ROTATION_PINNED) {
            to->kind = STRUM_IDENTIFY_PINNED;
        } else if (e->rotation == ROTATION_CLAMPED) {
            to->kind = STRUM_IDENTIFY_CLAMPED;
        } else if (open_end(e)) {
            to->kind = STRUM_IDENTIFY_UNKNOWN_FIXITY;
            open = true;
            if (e->fixity_standard_deviation > 0)
                r->params.quantities[STRUM_IDENTIFY_FIXITY] =
                    (strum_identify_value){true, e->fixity, e->fixity_standard_deviation};
        } else {
            to->kind = stiff ? STRUM_IDENTIFY_STIFFNESS : STRUM_IDENTIFY_FIXED_FIXITY;
            to->value = stiff ? e->rotational_stiffness_N_m_per_rad : e->fixity;
        }
    }
    if (identify_asks(r, STRUM_IDENTIFY_FIXITY) && !open)
        problem_add(p, "/unknowns", "fixity: no end is elastic without a number");
}

static void set_quantity(identify_request *r, strum_identify_quantity q, bool given,
                         double value, double spread, bool needed, problem *p)
{
    const bool unknown = identify_asks(r, q);
    char pointer[64] = "/";
    (void)snprintf(pointer, sizeof pointer, "/%s", identify_fields[q]);
    if (!given && needed && (!unknown || spread > 0))
        problem_add(p, pointer, "missing: give it, or name it among the unknowns");
    r->params.quantities[q] = (strum_identify_value){unknown, value, unknown ? spread : 0};
}

static void set_quantities(identify_request *r, problem *p)
{
    const bool chain = GIVEN(r, in.components), sag = r->plane == 1;
    set_quantity(r, STRUM_IDENTIFY_TENSION, GIVEN(r, in.tension_N), r->in.tension_N.value,
                 r->tension_relative_standard_deviation, true, p);
    set_quantity(r, STRUM_IDENTIFY_BENDING, GIVEN(r, bending_stiffness_N_m2),
                 r->bending_stiffness_N_m2, r->bending_stiffness_relative_standard_deviation,
                 r->bending_stiffness_relative_standard_deviation > 0, p);
    set_quantity(r, STRUM_IDENTIFY_LENGTH, GIVEN(r, length_m), r->length_m,
                 r->length_relative_standard_deviation, !chain, p);
    set_quantity(r, STRUM_IDENTIFY_MASS, GIVEN(r, mass_kg_per_m), r->mass_kg_per_m,
                 r->mass_relative_standard_deviation, !chain, p);
    set_quantity(r, STRUM_IDENTIFY_AXIAL, GIVEN(r, axial_stiffness_N), r->axial_stiffness_N,
                 r->axial_stiffness_relative_standard_deviation, sag, p);
    set_quantity(r, STRUM_IDENTIFY_DAMPING, false, 0, 0, r->damping_ratios.count > 0, p);
    if (identify_asks(r, STRUM_IDENTIFY_FIXITY))
        r->params.quantities[STRUM_IDENTIFY_FIXITY].unknown = true;
    const bool spread = r->tension_relative_standard_deviation > 0 ||
                        r->length_relative_standard_deviation > 0 ||
                        r->mass_relative_standard_deviation > 0 ||
                        r->bending_stiffness_relative_standard_deviation > 0 ||
                        r->axial_stiffness_relative_standard_deviation > 0 ||
                        r->params.quantities[STRUM_IDENTIFY_FIXITY].standard_deviation > 0;
    if (spread && r->frequency_standard_deviations_Hz.count == 0 &&
        !(r->frequency_standard_deviation_Hz > 0))
        problem_add(p, "/frequency_standard_deviations_Hz",
                    "missing: a standard deviation of a quantity counts only against those of "
                    "the frequencies");
    r->params.added_mass = r->added_mass_kg_per_m;
}

static void set_sag(identify_request *r, problem *p)
{
    if (r->plane == 0)
        return;
    if (!GIVEN(r, weight_N_per_m)) {
        if (identify_asks(r, STRUM_IDENTIFY_MASS))
            problem_add(p, "/weight_N_per_m", "missing: in plane, with an unknown mass");
        r->weight_N_per_m = r->mass_kg_per_m * GRAVITY;
        FIELD_GIVE(&identify_schema, r, weight_N_per_m);
    }
    r->params.sag = true;
    r->params.weight = r->weight_N_per_m;
    r->params.inclination = r->inclination_deg * M_PI / 180;
}

static void free_parts(void *parts)
{
    chain_parts_free(parts);
}

/* Components that state a tension of their own need one to which it belongs. */
static void set_chain(identify_request *r, schema_arena *arena, problem *p)
{
    static const char *const foreign[] = {"/length_m", "/mass_kg_per_m", "/damping_ratios",
                                          "/axial_stiffness_N", "/bending_stiffness_N_m2"};
    const bool given[] = {GIVEN(r, length_m), GIVEN(r, mass_kg_per_m),
                          r->damping_ratios.count > 0, GIVEN(r, axial_stiffness_N),
                          r->bending_stiffness_N_m2 > 0};
    if (!GIVEN(r, in.components))
        return;
    for (size_t i = 0; i < 5; i++)
        if (given[i])
            problem_add(p, foreign[i], "does not go with components");
    if (r->plane == 1)
        problem_add(p, "/plane", "components have no sag");
    if (r->unknowns.bits != 1)
        problem_add(p, "/unknowns", "with components only the tension can be unknown");
    const bool own = !GIVEN(r, in.tension_N);
    if (own)
        r->in.tension_N = (variable_value){.value = 1000, .scale = 1};
    chain_prepare(&r->in, arena, p);
    if (p->status != 0)
        return;
    if (chain_parts_make(&r->in, NULL, &r->parts) != STRUM_OK ||
        !schema_arena_own(arena, &r->parts, free_parts)) {
        problem_out_of_memory(p);
        return;
    }
    r->params.components = r->parts.parts;
    r->params.component_count = r->parts.count;
    r->params.left = (strum_taut_end)r->in.left_end;
    r->params.right = (strum_taut_end)r->in.right_end;
    r->params.reference_tension = r->in.tension_N.value;
}

void identify_prepare(void *data, schema_arena *arena, problem *p)
{
    identify_request *r = data;
    r->params = (strum_identify_params)STRUM_IDENTIFY_PARAMS_INIT;
    r->params.confidence = r->confidence;
    r->params.exclude_outlier = r->exclude_outlier;
    complete_unknowns(r);
    if (__builtin_popcountll(r->unknowns.bits) > STRUM_IDENTIFY_UNKNOWNS_MAX)
        problem_add(p, "/unknowns", "at most %d, with all that has a standard deviation",
                    STRUM_IDENTIFY_UNKNOWNS_MAX);
    check_lists(r, p);
    if (!identify_asks(r, STRUM_IDENTIFY_BENDING) && !GIVEN(r, bending_stiffness_N_m2) &&
        !GIVEN(r, in.components))
        FIELD_GIVE(&identify_schema, r, bending_stiffness_N_m2);
    set_ends(r, p);
    set_quantities(r, p);
    set_sag(r, p);
    if (p->status == 0)
        set_lists(r, arena, p);
    set_chain(r, arena, p);
    if (r->compare && (GIVEN(r, in.components) || r->params.frequencies == NULL))
        problem_add(p, "/compare", "the formulas are those of a uniform cable's frequencies");
}

double identify_cost_us(const void *data)
{
    const identify_request *r = data;
    const strum_identify_params *q = &r->params;
    double us = strum_identify_work(q);
    if (r->verify) {
        const double mode = fmin(q->modes != NULL ? q->modes[q->count - 1] : 20, 60);
        us +=
            q->damping_ratios != NULL ? 2e4 + 1e4 * (double)q->count : 3000 + 100 * mode * mode;
    }
    return us;
}
