/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/ends.h"

#include <math.h>

#include "core/cable/unknown.h"
#include "core/numerics/bracket.h"
#include "core/numerics/peak.h"

/* |length/chord - 1|, or |span/greatest - 1|: from, to, and steps a decade. */
#define NEAREST    -13
#define FARTHEST   9
#define DECADE     2
#define STEPS      ((FARTHEST - NEAREST) * DECADE)
#define PLACES_MAX (2 * (STEPS + 1))

/* What trying found. */
typedef struct {
    double unknown, figure;
} trial;

/* bracket_function is handed this; a trial that has no shape ends the search. */
typedef struct {
    cable_settler *settler;
    strum_error *error;
    strum_status status;
} search;

static bool is_end_tension(strum_cable_given given)
{
    return given == STRUM_CABLE_TENSION_END_1 || given == STRUM_CABLE_TENSION_END_2;
}

/* The figure of the shape with this unknown; NAN where there is none. */
static double figure_at(cable_settler *s, double unknown, strum_error *error)
{
    strum_error ignored;
    unknown_set(s, unknown);
    if (settle(s, error != NULL ? error : &ignored) != STRUM_OK)
        return NAN;
    return unknown_figure(s);
}

static double excess_figure(double unknown, const void *data)
{
    const search *q = data;
    const double figure = figure_at(q->settler, unknown, NULL);
    return isnan(figure) ? 0 : figure - q->settler->cable->params.value;
}

/* ---- the range ---- */

/* Least value of the unknown: every section and every attachment needs its place. */
static double least_unknown(const cable_settler *s)
{
    const strum_cable_params *p = &s->cable->params;
    double others = 0;
    if (p->span_unknown)
        return 0;
    for (size_t i = 0; i < p->section_count; i++)
        others += i != p->adjusted ? p->sections[i].length : 0;
    for (size_t i = 0; i < p->attachment_count; i++)
        others = fmax(others, p->attachments[i].position);
    return others * (1 + 1e-12);
}

/* Where an inextensible cable is straight. */
static double straight_unknown(const cable_settler *s)
{
    const strum_cable_params *p = &s->cable->params;
    if (!p->span_unknown)
        return hypot(s->span, p->rise);
    double length = 0;
    for (size_t i = 0; i < p->section_count; i++)
        length += p->sections[i].length;
    const double square = (length - p->rise) * (length + p->rise);
    return square > 0 ? sqrt(square) : length * 1e-3;
}

/* Values of the unknown to be tried, ascending. */
static int places(const cable_settler *s, double place[PLACES_MAX])
{
    const double straight = straight_unknown(s), least = least_unknown(s);
    int count = 0;
    for (int side = -1; side <= 1; side += 2)
        for (int i = 0; i <= STEPS; i++) {
            const int k = side < 0 ? STEPS - i : i;
            const double part = pow(10, NEAREST + (double)k / DECADE);
            const double value = side < 0 ? straight / (1 + part) : straight * (1 + part);
            if (value > least && (count == 0 || value > place[count - 1]))
                place[count++] = value;
        }
    return count;
}

/* ---- refusals ---- */

static double less_tension(void *data, double logarithm)
{
    const double figure = figure_at(data, exp(logarithm), NULL);
    return isnan(figure) ? -INFINITY : -figure;
}

/* The smallest figure between two places that enclose it. */
static trial least_between(cable_settler *s, double low, double high)
{
    double at;
    const double figure = -peak_golden(less_tension, s, log(low), log(high), &at);
    return (trial){exp(at), figure};
}

static strum_status none(const cable_settler *s, const trial *tried, int count,
                         const trial *least, strum_error *error)
{
    const strum_cable_params *p = &s->cable->params;
    const char *what = p->span_unknown ? "span" : "unstretched length";
    double low = INFINITY, high = -INFINITY;
    if (least != NULL)
        return error_at(error, STRUM_ERR_IMPOSSIBLE, STRUM_CABLE_ARG_VALUE, STRUM_NO_INDEX,
                        "the least possible tension at this end is %.15g N, at the %s %.12g m",
                        least->figure, what, least->unknown);
    for (int i = 0; i < count; i++) {
        low = fmin(low, tried[i].figure);
        high = fmax(high, tried[i].figure);
    }
    return error_at(error, STRUM_ERR_IMPOSSIBLE, STRUM_CABLE_ARG_VALUE, STRUM_NO_INDEX,
                    "no %s gives this: from the shortest to the longest the given quantity "
                    "runs between %.12g and %.12g (N, m or radians)",
                    what, low, high);
}

/* ---- the search ---- */

/* Roots between neighbouring trials, ascending; at most `room`, the last of them in the last
 * place. Returns how many there are. */
static int crossings(search *q, const trial *tried, int count, double *root, int room)
{
    const double value = q->settler->cable->params.value;
    int found = 0;
    for (int i = 1; i < count; i++) {
        const trial *a = tried + i - 1, *b = tried + i;
        if ((a->figure - value) * (b->figure - value) > 0 || a->figure == value)
            continue;
        root[found < room ? found : room - 1] =
            bracket_root(excess_figure, q, a->unknown, b->unknown);
        found++;
    }
    return found;
}

/* Whether an end tension dips below the value between the trials: the least one joins them. */
static int add_least(cable_settler *s, trial *tried, int count, trial *least)
{
    int at = 0;
    for (int i = 1; i < count; i++)
        at = tried[i].figure < tried[at].figure ? i : at;
    *least = tried[at];
    if (at == 0 || at == count - 1)
        return count;
    *least = least_between(s, tried[at - 1].unknown, tried[at + 1].unknown);
    const int place = least->unknown < tried[at].unknown ? at : at + 1;
    for (int i = count; i > place; i--)
        tried[i] = tried[i - 1];
    tried[place] = *least;
    return count + 1;
}

/* Of cable that lies slack more changes nothing. */
static bool lies_slack(const cable_settler *s, const trial *tried, int count)
{
    return !s->cable->params.span_unknown && s->form.slack && s->form.contact_count > 0 &&
           count > 1 &&
           fabs(tried[count - 1].figure - tried[count - 2].figure) <=
               1e-12 * fabs(tried[count - 1].figure);
}

static int look_through(cable_settler *s, trial *tried, strum_error *error)
{
    double place[PLACES_MAX];
    const int all = places(s, place);
    int count = 0;
    for (int i = 0; i < all; i++) {
        const double figure = figure_at(s, place[i], error);
        if (s->work->status != STRUM_OK)
            return 0;
        if (isfinite(figure))
            tried[count++] = (trial){place[i], figure};
        if (lies_slack(s, tried, count))
            break;
    }
    return count;
}

/* The last digits of forces, which the length alone does not hold. */
static strum_status finish(cable_settler *s, double unknown, strum_error *error)
{
    unknown_set(s, unknown);
    const strum_status status = settle(s, error);
    if (status != STRUM_OK || s->form.contact_count > 0 ||
        hypot(s->span, s->cable->params.rise) == 0)
        return status;
    const double h = s->form.pieces[0].h, v = s->form.pieces[0].v;
    return unknown_solve(s, h, v) ? STRUM_OK : settle(s, error);
}

/* A straight cable under this tension along its chord: what a taut one is near to. */
static bool from_straight(cable_settler *s)
{
    const strum_cable_params *p = &s->cable->params;
    const double straight = straight_unknown(s);
    double tension = p->value, stretch = 0, length = 0;
    if (!(straight > least_unknown(s)))
        return false;
    unknown_set(s, straight);
    const double distance = hypot(s->span, p->rise);
    if (p->given == STRUM_CABLE_CATENARY_PARAMETER)
        tension *= fabs(p->sections[p->adjusted].weight);
    if (p->given == STRUM_CABLE_HORIZONTAL_TENSION ||
        p->given == STRUM_CABLE_CATENARY_PARAMETER)
        tension *= distance / s->span;
    for (size_t i = 0; i < p->section_count; i++) {
        stretch += p->sections[i].length * tension / p->sections[i].axial_stiffness;
        length += p->sections[i].length;
    }
    if (!(s->span > 0 && stretch < length))
        return false;
    unknown_set(s, p->span_unknown ? straight * (1 + stretch / length)
                                   : straight / (1 + stretch / length));
    return unknown_now(s) > least_unknown(s) &&
           unknown_solve(s, tension * s->span / distance, tension * p->rise / distance);
}

static bool is_tension(strum_cable_given given)
{
    return given <= STRUM_CABLE_CATENARY_PARAMETER;
}

strum_status ends_find(cable_settler *s, strum_cable_statics *statics, strum_error *error)
{
    const strum_cable_params *p = &s->cable->params;
    const bool two = is_end_tension(p->given);
    const bool one_piece = p->section_count == 1 && p->attachment_count == 0;
    trial tried[PLACES_MAX + 1], least = {0};
    double root[2];
    if (p->given == STRUM_CABLE_DEPTH_BELOW_END_1 && !(p->value > -p->rise))
        return error_at(error, STRUM_ERR_IMPOSSIBLE, STRUM_CABLE_ARG_VALUE, STRUM_NO_INDEX,
                        "the lowest point lies at least as deep as end 2, %.12g m below end 1",
                        -p->rise);
    if (is_tension(p->given) && !two && one_piece && !p->bed.present && from_straight(s))
        return STRUM_OK;
    int count = look_through(s, tried, error);
    if (s->work->status != STRUM_OK)
        return work_error(s->work, error);
    search q = {.settler = s};
    int found = crossings(&q, tried, count, root, 2);
    if (found == 0 && two && count > 0) {
        count = add_least(s, tried, count, &least);
        found = crossings(&q, tried, count, root, 2);
    }
    if (s->work->status != STRUM_OK)
        return work_error(s->work, error);
    if (found == 0) {
        if (is_tension(p->given) && !p->bed.present && from_straight(s))
            return STRUM_OK;
        if (count == 0 && error != NULL && error->status != STRUM_OK)
            return error->status;
        if (count == 0)
            return error_at(error, STRUM_ERR_IMPOSSIBLE, STRUM_CABLE_ARG_VALUE, STRUM_NO_INDEX,
                            "no unstretched length gives this");
        return none(s, tried, count, two && p->value < least.figure ? &least : NULL, error);
    }
    statics->solutions = found;
    const int taken = found > 1 && p->slack_branch ? 1 : 0;
    const strum_status status = finish(s, root[taken], error);
    if (found > 1 && !p->span_unknown)
        statics->other_length = root[1 - taken];
    return status;
}
