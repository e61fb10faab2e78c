/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "endpoints/common/suspended_cable.h"

#include <math.h>

const char *const cable_geometry_groups[] = {
    "[rise_to_span] sag_parameter",
    "xi_1 xi_2",
    "chi_1 chi_2",
    "span_m [rise_m] length_m",
    "span_m [rise_m] unstretched_length_m +axial_stiffness_N +mass_kg_per_m",
    NULL};
const char *const cable_elasticity_groups[] = {"flexibility", "axial_stiffness_N", NULL};

void cable_refuse(const strum_error *fault, strum_status status, problem *p)
{
    const char *reason = fault->reason[0] != '\0' ? fault->reason : strum_status_text(status);
    const int http = status == STRUM_ERR_MEMORY      ? 503
                     : status == STRUM_ERR_INTERNAL  ? 500
                     : status == STRUM_ERR_CANCELLED ? 503
                                                     : 422;
    problem_set(p, http, "%s", reason);
}

/* The catenary of whichever group was given; its fault is laid at the field that decides. */
static strum_status find_catenary(const schema *s, const cable_input *in, strum_catenary *c,
                                  const char **pointer, strum_error *fault)
{
    if (FIELD_GIVEN(s, in, sag_parameter)) {
        const strum_status status =
            strum_catenary_from_sag(in->rise_to_span, in->sag_parameter, c, fault);
        /* the rise decides where the same cable would be good between level supports */
        strum_catenary level;
        *pointer = status != STRUM_OK && strum_catenary_from_sag(0, in->sag_parameter, &level,
                                                                 NULL) == STRUM_OK
                       ? "/rise_to_span"
                       : "/sag_parameter";
        return status;
    }
    if (FIELD_GIVEN(s, in, xi_2)) {
        *pointer = "/xi_2";
        return strum_catenary_from_xi(in->xi_1, in->xi_2, c, fault);
    }
    if (FIELD_GIVEN(s, in, chi_2)) {
        *pointer = "/chi_2";
        return strum_catenary_from_chi(in->chi_1, in->chi_2, c, fault);
    }
    if (FIELD_GIVEN(s, in, length_m)) {
        *pointer = "/length_m";
        return strum_catenary_from_length(in->span_m, in->rise_m, in->length_m, c, fault);
    }
    *pointer = "/unstretched_length_m";
    return strum_catenary_from_unstretched(
        in->span_m, in->rise_m, in->unstretched_length_m,
        in->weight_N_per_m * in->unstretched_length_m / in->axial_stiffness_N, c, fault);
}

/* Weight follows from mass unless given; what hangs on a mass needs one. */
static void complete_masses(const schema *s, cable_input *in, problem *p)
{
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
    const char *pointer;
    strum_error fault = {0};
    const strum_status status = find_catenary(s, in, &in->catenary, &pointer, &fault);
    if (status != STRUM_OK) {
        cable_refuse(&fault, status, p);
        problem_add(p, pointer, "%s", fault.reason);
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
    const bool elastic_profile = FIELD_GIVEN(s, in, unstretched_length_m);
    const double kappa = elastic_profile ? c->kappa
                         : FIELD_GIVEN(s, in, axial_stiffness_N)
                             ? in->tension_N / in->axial_stiffness_N
                             : in->flexibility;
    in->cable =
        (strum_cable){.chi_m = c->chi_m,
                      .mu = c->mu,
                      .kappa_t = kappa,
                      .kappa_n = elastic_profile ? kappa : 0,
                      .mass_t = 1,
                      .mass_n = mass ? 1 + in->added_mass_kg_per_m / in->mass_kg_per_m : 1,
                      .eta_t = in->eta_tangential / in->ratio,
                      .eta_n = in->eta_normal / in->ratio};
}

bool cable_damped(const cable_input *in)
{
    return in->eta_tangential > 0 || in->eta_normal > 0;
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
        const bool elastic = in->unstretched_length_m > 0;
        json_put_number(json, "length_m", profile ? in->length_m : c->length * in->a_m);
        json_put_number(json, "unstretched_length_m",
                        elastic ? in->unstretched_length_m : in->length_m);
        json_put_number(json, "sag_m", sag * in->a_m);
    }
    if (in->tension_N > 0) {
        json_put_number(json, "horizontal_tension_N", in->tension_N);
        json_put_number(json, "tension_1_N", in->tension_N * cosh(chi_1));
        json_put_number(json, "tension_2_N", in->tension_N * cosh(chi_2));
    }
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
