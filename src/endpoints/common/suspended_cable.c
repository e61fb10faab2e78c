/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "endpoints/common/suspended_cable.h"

#include <math.h>

const char *const cable_geometry_groups[] = {
    "[rise_to_span] sag_parameter",
    "xi_1 xi_2",
    "chi_1 chi_2",
    "span_m [rise_m] length_m",
    "span_m [rise_m] unstretched_length_m +axial_stiffness_N",
    "span_m [rise_m] horizontal_tension_N",
    "span_m [rise_m] tension_end_1_N [branch]",
    "span_m [rise_m] tension_end_2_N [branch]",
    "span_m [rise_m] tension_parallel_to_chord_N",
    "span_m [rise_m] catenary_parameter_m",
    "span_m [rise_m] sag_mid_m",
    "span_m [rise_m] sag_max_m",
    "span_m [rise_m] depth_below_end_1_m",
    "span_m [rise_m] angle_end_1_deg",
    "span_m [rise_m] angle_end_2_deg",
    NULL};
const char *const cable_branches[] = {"taut", "slack", NULL};
const char *const cable_elasticity_groups[] = {"flexibility", "axial_stiffness_N", NULL};

void cable_refuse(const strum_error *fault, strum_status status, problem *p)
{
    const char *reason = fault->reason[0] != '\0' ? fault->reason : strum_status_text(status);
    const int http = status == STRUM_ERR_MEMORY      ? 503
                     : status == STRUM_ERR_INTERNAL  ? 500
                     : status == STRUM_ERR_CANCELLED ? 503
                     : status == STRUM_ERR_TIME      ? 503
                                                     : 422;
    problem_set(p, http, "%s", reason);
}

/* The catenary of whichever group was given. */
static strum_status find_catenary(const schema *s, cable_input *in, strum_catenary *c,
                                  strum_error *error)
{
    if (FIELD_GIVEN(s, in, sag_parameter))
        return strum_catenary_from_sag(in->rise_to_span, in->sag_parameter, c, error);
    if (FIELD_GIVEN(s, in, xi_2))
        return strum_catenary_from_xi(in->xi_1, in->xi_2, c, error);
    if (FIELD_GIVEN(s, in, chi_2))
        return strum_catenary_from_chi(in->chi_1, in->chi_2, c, error);
    if (FIELD_GIVEN(s, in, length_m))
        return strum_catenary_from_length(in->span_m, in->rise_m, in->length_m, c, error);
    if (cable_figure_pointer(s, in) != NULL)
        return cable_find_by_figure(s, in, c, error);
    return strum_catenary_from_unstretched(
        in->span_m, in->rise_m, in->unstretched_length_m,
        in->weight_N_per_m * in->unstretched_length_m / in->axial_stiffness_N, c, error);
}

/* The field to lay an error of the catenary at: the one of its group that decides. */
static const char *field_at_fault(const schema *s, const cable_input *in, int argument)
{
    const char *figure = cable_figure_pointer(s, in);
    if (figure != NULL)
        return figure;
    switch (argument) {
    case STRUM_CATENARY_ARG_RISE:
        return "/rise_to_span";
    case STRUM_CATENARY_ARG_SAG_PARAMETER:
        return "/sag_parameter";
    case STRUM_CATENARY_ARG_XI:
        return "/xi_2";
    case STRUM_CATENARY_ARG_CHI:
        return "/chi_2";
    default:
        return FIELD_GIVEN(s, in, length_m) ? "/length_m" : "/unstretched_length_m";
    }
}

/* A tension tells how a cable hangs by its weight. */
static bool needs_mass(const schema *s, const cable_input *in)
{
    return FIELD_GIVEN(s, in, horizontal_tension_N) || FIELD_GIVEN(s, in, tension_end_1_N) ||
           FIELD_GIVEN(s, in, tension_end_2_N) ||
           FIELD_GIVEN(s, in, tension_parallel_to_chord_N);
}

/* Weight follows from mass unless given; what hangs on a mass needs one. */
static void complete_masses(const schema *s, cable_input *in, problem *p)
{
    const round_masses masses = {in->gravity_m_per_s2,
                                 &in->mass_kg_per_m,
                                 &in->weight_N_per_m,
                                 &in->added_mass_kg_per_m,
                                 FIELD_GIVEN(s, in, mass_kg_per_m),
                                 FIELD_GIVEN(s, in, weight_N_per_m)};
    if (round_complete(&in->round, &masses, p) && p->status == 0) {
        FIELD_GIVE(s, in, mass_kg_per_m);
        FIELD_GIVE(s, in, weight_N_per_m);
    }
    const bool mass = FIELD_GIVEN(s, in, mass_kg_per_m);
    if (!mass && FIELD_GIVEN(s, in, weight_N_per_m))
        problem_add(p, "/mass_kg_per_m", "is needed with weight_N_per_m");
    if (!mass && in->added_mass_kg_per_m > 0)
        problem_add(p, "/mass_kg_per_m", "is needed with added_mass_kg_per_m");
    if (mass && !FIELD_GIVEN(s, in, weight_N_per_m)) {
        in->weight_N_per_m = in->mass_kg_per_m * in->gravity_m_per_s2;
        FIELD_GIVE(s, in, weight_N_per_m);
    }
    const bool metres = FIELD_GIVEN(s, in, span_m);
    if (FIELD_GIVEN(s, in, axial_stiffness_N) && !metres)
        problem_add(p, "/axial_stiffness_N",
                    "needs a geometry in metres; give flexibility with a dimensionless one");
    else if (FIELD_GIVEN(s, in, axial_stiffness_N) && !mass)
        problem_add(p, "/mass_kg_per_m", "is needed with axial_stiffness_N");
    else if (needs_mass(s, in) && !mass)
        problem_add(
            p, "/mass_kg_per_m",
            "missing: a tension needs it, or diameter_m with material_density_kg_per_m3");
}

void cable_prepare(const schema *s, cable_input *in, problem *p)
{
    complete_masses(s, in, p);
    if (FIELD_GIVEN(s, in, xi_2) && !(in->xi_1 < in->xi_2))
        problem_add(p, "/xi_2", "must be greater than xi_1");
    if (FIELD_GIVEN(s, in, chi_2) && !(in->chi_1 < in->chi_2))
        problem_add(p, "/chi_2", "must be greater than chi_1");
    if (p->status != 0)
        return;
    strum_error error = {0};
    const strum_status status = find_catenary(s, in, &in->catenary, &error);
    if (status != STRUM_OK) {
        cable_refuse(&error, status, p);
        problem_add(p, field_at_fault(s, in, error.argument), "%s", error.reason);
        return;
    }
    const strum_catenary *c = &in->catenary;
    const bool mass = FIELD_GIVEN(s, in, mass_kg_per_m);
    in->a_m = FIELD_GIVEN(s, in, span_m) ? in->span_m / c->span : 0;
    in->tension_N = mass ? in->weight_N_per_m * in->a_m : 0;
    /* the core's unit of frequency is sqrt(H/(m a^2)) = sqrt(w/(m a)) */
    in->ratio =
        mass ? sqrt(in->weight_N_per_m / (in->mass_kg_per_m * in->gravity_m_per_s2)) : 1;
    in->rad_per_s = in->a_m > 0 ? sqrt(in->gravity_m_per_s2 / in->a_m) : 0;
    in->elastic_profile =
        FIELD_GIVEN(s, in, unstretched_length_m) ||
        (cable_figure_pointer(s, in) != NULL && FIELD_GIVEN(s, in, axial_stiffness_N));
    const double kappa = in->elastic_profile ? c->kappa
                         : FIELD_GIVEN(s, in, axial_stiffness_N)
                             ? in->tension_N / in->axial_stiffness_N
                             : in->flexibility;
    in->cable =
        (strum_cable){.chi_m = c->chi_m,
                      .mu = c->mu,
                      .kappa_t = kappa,
                      .kappa_n = in->elastic_profile ? kappa : 0,
                      .mass_t = 1,
                      .mass_n = mass ? 1 + in->added_mass_kg_per_m / in->mass_kg_per_m : 1,
                      .eta_t = in->eta_tangential / in->ratio,
                      .eta_n = in->eta_normal / in->ratio};
}

bool cable_damped(const cable_input *in)
{
    return in->eta_tangential > 0 || in->eta_normal > 0;
}

static double unstretched_length(const cable_input *in)
{
    if (in->unstretched_length_m > 0)
        return in->unstretched_length_m;
    if (in->elastic_profile)
        return in->rest_length_m;
    if (in->cable.kappa_t >
        0) /* an inextensible profile, of what would be so long without load */
        return strum_catenary_unstretched(&in->catenary, in->cable.kappa_t) * in->a_m;
    return in->length_m > 0 ? in->length_m : in->catenary.length * in->a_m;
}

/* One mass in both conventions of "per metre": the one given is per unstretched metre where the
 * profile is elastic, else per metre of the hanging cable. Weight per length goes alike. */
static void write_masses(json_writer *json, const cable_input *in)
{
    const double length = in->length_m > 0 ? in->length_m : in->catenary.length * in->a_m;
    const double share = length / unstretched_length(in), mass = in->mass_kg_per_m;
    if (in->cable.kappa_t == 0)
        return;
    json_put_number(json, "mass_per_unstretched_length_kg_per_m",
                    in->elastic_profile ? mass : mass * share);
    json_put_number(json, "mass_per_stretched_length_kg_per_m",
                    in->elastic_profile ? mass / share : mass);
}

void cable_write_geometry(json_writer *json, const cable_input *in)
{
    const strum_catenary *c = &in->catenary;
    const double chi_1 = c->chi_m - c->mu, chi_2 = c->chi_m + c->mu,
                 sag = strum_catenary_sag(c);
    json_key(json, "geometry");
    json_open_object(json);
    json_put_number(json, "a_to_span", 1 / c->span);
    /* what was asked is given back as it was typed */
    const bool profile = in->length_m > 0;
    json_put_number(json, "length_to_span",
                    profile ? in->length_m / in->span_m : c->length / c->span);
    json_put_number(json, "rise_to_span",
                    in->a_m > 0             ? in->rise_m / in->span_m
                    : in->sag_parameter > 0 ? in->rise_to_span
                                            : c->rise / c->span);
    json_put_number(json, "sag_to_span", sag / c->span);
    const bool by_xi = in->xi_1 < in->xi_2, by_chi = in->chi_1 < in->chi_2;
    json_put_number(json, "xi_1", by_xi ? in->xi_1 : strum_xi_of_chi(chi_1));
    json_put_number(json, "xi_2", by_xi ? in->xi_2 : strum_xi_of_chi(chi_2));
    json_put_number(json, "chi_1", by_chi ? in->chi_1 : chi_1);
    json_put_number(json, "chi_2", by_chi ? in->chi_2 : chi_2);
    json_put_number(json, "flexibility", in->cable.kappa_t);
    if (in->a_m > 0) {
        json_put_number(json, "a_m", in->a_m);
        json_put_number(json, "span_m", in->span_m);
        json_put_number(json, "rise_m", in->rise_m);
        json_put_number(json, "length_m", profile ? in->length_m : c->length * in->a_m);
        json_put_number(json, "unstretched_length_m", unstretched_length(in));
        json_put_number(json, "sag_m", sag * in->a_m);
    }
    if (in->tension_N > 0) {
        json_put_number(json, "horizontal_tension_N", in->tension_N);
        json_put_number(json, "tension_1_N", in->tension_N * cosh(chi_1));
        json_put_number(json, "tension_2_N", in->tension_N * cosh(chi_2));
        write_masses(json, in);
    }
    if (in->solutions > 0)
        json_put_integer(json, "solutions", in->solutions);
    if (in->solutions > 1)
        json_put_number(json, "other_unstretched_length_m", in->other_length_m);
    json_close_object(json);
}

void cable_write_rates(json_writer *json, const cable_input *in, double _Complex s)
{
    const double frequency = cimag(s), decay = 0 - creal(s), size = cabs(s);
    const double to_rad_per_s = in->ratio * in->rad_per_s;
    const double angular = frequency * to_rad_per_s;
    if (frequency > 0) {
        json_put_number(json, "frequency_ratio", frequency * in->ratio);
        if (to_rad_per_s > 0)
            put_frequency(json, angular);
    }
    if (!cable_damped(in))
        return;
    json_put_number(json, "decay_ratio", decay * in->ratio);
    if (to_rad_per_s > 0)
        json_put_number(json, "decay_rate_per_s", decay * to_rad_per_s);
    if (frequency > 0) {
        json_put_number(json, "damping_ratio", decay / size);
        json_put_number(json, "loss_ratio", decay / frequency);
        json_put_number(json, "log_decrement", 2 * M_PI * decay / frequency);
    }
}

/* Few cables in water weigh less than this part of what they do in air; a mass in place of a
 * weight is 1/9.8 of it. */
#define BUOYANT_REACH 0.11

void cable_warn_weight(double weight, double mass, double added_mass, double gravity, answer *a)
{
    const double share = weight / (mass * gravity);
    if (share > 1.001)
        answer_warn(a,
                    "weight_N_per_m is %.4g times mass_kg_per_m times gravity: are the units "
                    "mixed up?",
                    share);
    else if (share < BUOYANT_REACH)
        answer_warn(
            a,
            "weight_N_per_m is only %.2g of mass_kg_per_m times gravity: is a mass given "
            "for a weight?",
            share);
    else if (share < 0.999 && added_mass == 0)
        answer_warn(a,
                    "weight_N_per_m is %.4g of mass_kg_per_m times gravity, as in water, but "
                    "added_mass_kg_per_m is 0",
                    share);
}

void cable_warn(const cable_input *in, answer *a)
{
    if (in->mass_kg_per_m > 0)
        cable_warn_weight(in->weight_N_per_m, in->mass_kg_per_m, in->added_mass_kg_per_m,
                          in->gravity_m_per_s2, a);
}
