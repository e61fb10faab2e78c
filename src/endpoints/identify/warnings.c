/* SPDX-License-Identifier: GPL-3.0-or-later */
/* /v1/identify/tension: what the client should know beside the figures. */
#include "endpoints/identify/answer.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The sag term errs by more beyond: 4e-3 of frequencies at sag/span 1/30, 1e-2 above 45 degrees. */
#define SAG_REACH       0.02
#define SAG_REACH_STEEP 0.01
#define STEEP_DEG       45.0
/* Longitudinal waves mix in. */
#define STIFF_REACH 50.0
/* The model does not describe the data. */
#define P_SMALL 0.01

static double value_of(const strum_identify *found, strum_identify_quantity q)
{
    return strum_identify_estimate_of(found, q)->value;
}

static void warn_of_fit(const identify_request *r, const strum_identify *found, answer *a)
{
    const strum_identify_summary *s = strum_identify_summary_of(found);
    if (s->better_shift != 0)
        answer_warn(a,
                    "the mode numbers shifted by %+d fit better: chi squared %.3g times "
                    "smaller, tension then %.6g N",
                    s->better_shift, s->shift_ratio, s->shift_tension);
    if (s->outlier != STRUM_NO_INDEX) {
        strum_identify_mode m;
        (void)strum_identify_get(found, s->outlier, &m);
        char tension[64] = "";
        if (isfinite(s->outlier_tension))
            (void)snprintf(tension, sizeof tension, "; without it the tension is %.6g N",
                           s->outlier_tension);
        answer_warn(a,
                    "%.6g %s (mode %d) disagrees with the others: studentized residual %.3g%s",
                    m.measured, r->params.frequencies != NULL ? "Hz" : "(a damping ratio)",
                    m.mode, m.studentized, tension);
    }
    for (size_t i = 0; i < strum_identify_count(found); i++) {
        strum_identify_mode m;
        (void)strum_identify_get(found, i, &m);
        if (m.excluded)
            answer_warn(a, "%.6g (mode %d) was left out: it disagrees with the others",
                        m.measured, m.mode);
    }
    if (s->p_value < P_SMALL)
        answer_warn(a,
                    "p = %.2g: the model does not describe the data within their standard "
                    "deviations (dampers, "
                    "sleeves, another length, the other plane?)",
                    s->p_value);
    if (s->degrees_of_freedom == 0 && r->params.standard_deviations == NULL &&
        r->params.damping_standard_deviations == NULL)
        answer_warn(
            a, "as many unknowns as data, and no standard deviations: there is no interval");
}

/* What goes with what along the weakest direction. */
static void weakest_text(const strum_identify_summary *s, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (size_t i = 0; i < s->unknowns && used < size; i++) {
        const int more = snprintf(text + used, size - used, "%s%s %+.2g", i > 0 ? ", " : "",
                                  identify_unknowns[s->which[i]], s->weakest[i]);
        used += more > 0 ? (size_t)more : 0;
    }
}

static void warn_of_undetermined(const strum_identify *found, answer *a)
{
    const strum_identify_summary *s = strum_identify_summary_of(found);
    const strum_identify_solution *solutions;
    const size_t count = strum_identify_solutions(found, &solutions);
    if (count > 1)
        answer_warn(a, "%zu solutions fit equally: see solutions; a further mode decides",
                    count);
    bool any = false;
    for (size_t i = 0; i < s->unknowns; i++) {
        const strum_identify_estimate *e = strum_identify_estimate_of(found, s->which[i]);
        if (e->determined)
            continue;
        any = true;
        if (s->which[i] == STRUM_IDENTIFY_BENDING && e->high > 0)
            answer_warn(a,
                        "these frequencies do not determine the bending stiffness: it is at "
                        "most %.4g N m^2%s",
                        e->high, e->low > 0 ? "" : ", and may be 0");
        else if (s->which[i] == STRUM_IDENTIFY_FIXITY)
            answer_warn(a, "these frequencies do not determine the fixity: anything between "
                           "pinned and clamped fits");
    }
    if (any && s->unknowns > 1) {
        char text[160];
        weakest_text(s, text, sizeof text);
        answer_warn(a,
                    "the weakest direction (changes of logarithms, of the fixity itself, that "
                    "frequencies hardly show): %s",
                    text);
    }
}

static void warn_of_model(const identify_request *r, const strum_identify *found, answer *a)
{
    const strum_identify_summary *s = strum_identify_summary_of(found);
    const strum_identify_end *ends = r->params.ends;
    const bool pinned =
        ends[0].kind == STRUM_IDENTIFY_PINNED && ends[1].kind == STRUM_IDENTIFY_PINNED;
    const bool stated = FIELD_GIVEN(&identify_schema, r, ends) ||
                        FIELD_GIVEN(&identify_schema, r, end_1) ||
                        FIELD_GIVEN(&identify_schema, r, end_2);
    if (pinned && !stated && isfinite(s->xi) && isfinite(s->tension_if_clamped))
        answer_warn(a,
                    "the ends were taken as pinned; clamped, the tension is %.6g N (about 4/xi "
                    "= %.2g less)",
                    s->tension_if_clamped, 4 / s->xi);
    if (!isfinite(s->sag_to_span))
        return;
    const double reach = r->inclination_deg > STEEP_DEG ? SAG_REACH_STEEP : SAG_REACH;
    if (s->sag_to_span > reach)
        answer_warn(a,
                    "sag/span %.3g: beyond %.3g the sag term errs by more than about half a "
                    "percent of the tension",
                    s->sag_to_span, reach);
    const double stretch =
        value_of(found, STRUM_IDENTIFY_AXIAL) / value_of(found, STRUM_IDENTIFY_TENSION);
    if (stretch < STIFF_REACH)
        answer_warn(a,
                    "EA/T = %.3g: below %.3g longitudinal motion mixes into these modes, and "
                    "the sag term errs",
                    stretch, STIFF_REACH);
}

static void warn_of_values(const identify_request *r, answer *a)
{
    const bool given[] = {FIELD_GIVEN(&identify_schema, r, in.tension_N) &&
                              r->params.components == NULL,
                          r->bending_stiffness_N_m2 > 0,
                          false,
                          FIELD_GIVEN(&identify_schema, r, length_m),
                          FIELD_GIVEN(&identify_schema, r, mass_kg_per_m),
                          FIELD_GIVEN(&identify_schema, r, axial_stiffness_N),
                          false};
    for (int q = 0; q < STRUM_IDENTIFY_QUANTITIES; q++) {
        const strum_identify_value *v = &r->params.quantities[q];
        if (given[q] && v->unknown && !(v->standard_deviation > 0))
            answer_warn(a,
                        "%s is sought: the value given was not used; with a relative standard "
                        "deviation it would be",
                        identify_fields[q]);
    }
}

/* In plane without the sag term the first mode alone is high. */
static void warn_of_ambiguity(const strum_identify *found, answer *a)
{
    const strum_identify_reading *readings;
    bool ambiguous, by_price;
    double deviation;
    const size_t count =
        strum_identify_readings(found, &readings, &ambiguous, &by_price, &deviation);
    if (count > 1 && ambiguous)
        answer_warn(a, "the mode numbers are ambiguous: the next reading gives %.6g N",
                    readings[1].tension);
    if (count > 0 && isfinite(deviation))
        answer_warn(a,
                    "no standard deviations: mode numbers were chosen with 1 %% of the mean "
                    "spacing, %.3g Hz",
                    deviation);
}

void identify_warn(const identify_request *r, const strum_identify *found, answer *a)
{
    warn_of_values(r, a);
    warn_of_ambiguity(found, a);
    warn_of_fit(r, found, a);
    warn_of_undetermined(found, a);
    warn_of_model(r, found, a);
}
