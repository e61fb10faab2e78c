/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/bed.h"

#include <float.h>
#include <math.h>

#include "core/cable/lay.h"
#include "core/numerics/bracket.h"

/* Steps towards a range of the force along the bed. */
#define STEPS_MAX 1000

typedef struct {
    bed_frame frame;
    bed_touch touch;
    const strum_cable_section *sections;
    cable_form *form;
    double fold;
    bool level; /* and no horizontal load: the force along is the same everywhere */
    lay_result result;
} bed_search;

/* ---- above or below ---- */

static double height_above(const strum_cable_bed *bed, double x, double z)
{
    return (z + bed->depth - x * tan(bed->slope)) * cos(bed->slope);
}

double bed_clearance(const cable_form *form, const strum_cable_bed *bed)
{
    const double cosine = cos(bed->slope), sine = sin(bed->slope);
    double least = INFINITY;
    for (size_t i = 0; i < form->count; i++) {
        const cable_piece *p = form->pieces + i;
        if (p->lies)
            continue;
        const double w = p->section->weight * cosine, n = p->v * cosine - p->h * sine;
        if (n < 0 && n + w * p->length > 0) {
            const form_state at = form_at(p, -n / w);
            least = fmin(least, height_above(bed, at.x, at.z));
        }
        if (i > 0 && !form->pieces[i - 1].lies && form->pieces[i - 1].run == p->run)
            least = fmin(least, height_above(bed, p->x, p->z));
    }
    return least;
}

bool bed_leaves(const cable_form *form, const strum_cable_bed *bed)
{
    const cable_piece *first = form->pieces;
    const double cosine = cos(bed->slope), sine = sin(bed->slope);
    const double n_1 = first->v * cosine - first->h * sine,
                 n_2 = form->v * cosine - form->h * sine;
    const bool on_1 = bed->depth == 0;
    const bool on_2 =
        height_above(bed, form->x, form->z) <= 1e-12 * (hypot(form->x, form->z) + bed->depth);
    return (!on_1 || n_1 >= 0) && (!on_2 || n_2 <= 0);
}

strum_status bed_check(const strum_cable_params *p, double span, strum_error *error)
{
    const double height = height_above(&p->bed, span, p->rise);
    const double near = 1e-12 * (hypot(span, p->rise) + p->bed.depth);
    if (height < -near)
        return error_at(error, STRUM_ERR_IMPOSSIBLE, STRUM_CABLE_ARG_BED, STRUM_NO_INDEX,
                        "end 2 lies %.6g m below the bed", -height);
    return STRUM_OK;
}

static bed_frame frame_of(const cable_line *line, const strum_cable_params *p, double span,
                          work *w)
{
    const strum_cable_bed *bed = &p->bed;
    bed_frame f = {.line = line,
                   .cosine = cos(bed->slope),
                   .sine = bed->slope == 0 ? 0 : sin(bed->slope),
                   .work = w};
    double up;
    const double near = 1e-12 * (hypot(span, p->rise) + bed->depth);
    bed_from_world(&f, span, p->rise, &f.along_2, &up);
    f.height_1 = bed->depth * f.cosine;
    f.height_2 = height_above(bed, span, p->rise);
    if (fabs(f.height_2) <= near)
        f.height_2 = 0;
    for (size_t i = 0; i < line->count; i++)
        f.load += fabs(line->pieces[i].arc.weight) * line->pieces[i].arc.length +
                  hypot(line->pieces[i].load_x, line->pieces[i].load_z) +
                  fabs(line->pieces[i].jump);
    return f;
}

/* ---- the force along the bed ---- */

/* How far the line ends beyond end 2, with this force at end 1; -INFINITY where it would have to
 * push. Next to no force is none: it would only underflow. */
static double beyond(bed_search *q, double t)
{
    if (fabs(t) < 1e-30 * q->frame.load)
        t = 0;
    if (t < 0 && q->level)
        return -INFINITY;
    if (!touch_solve(&q->frame, t, &q->touch))
        return NAN;
    q->result = lay_form(&q->frame, &q->touch, q->sections, q->fold, q->form);
    return q->result.compressed ? -INFINITY : q->result.along - q->frame.along_2;
}

/* For a search: where the line must push it is short by far. */
static double beyond_at(double t, const void *data)
{
    bed_search *q = (bed_search *)data;
    const double by = beyond(q, t);
    return isnan(by) ? 0 : fmax(by, -1e3 * q->frame.line->length);
}

/* Two forces, with `*low` of which the line ends short of end 2, or must push, and beyond it with
 * `*high`. */
static bool enclose(bed_search *q, double *low, double *high)
{
    const double tiny = 1e-14 * q->frame.load;
    double by = beyond(q, *high), step = 1e-3 * q->frame.load;
    for (int i = 0; i < STEPS_MAX && !(by >= 0) && !isnan(by); i++)
        by = beyond(q, *high *= 2);
    *low = *high;
    for (int i = 0; i < STEPS_MAX && by > 0; i++) {
        *high = *low;
        if (*low > tiny) {
            *low /= 4;
        } else if (*low > 0) {
            *low = 0;
        } else {
            *low -= step;
            step *= 2;
        }
        by = beyond(q, *low);
    }
    return !isnan(by) && !(by > 0);
}

/* From a force with which the line must push, or next to it, to the least with which it reaches
 * beyond end 2. */
static double least_beyond(bed_search *q, double t)
{
    double step = 4 * DBL_EPSILON * fmax(fabs(t), 1e-30 * q->frame.load);
    for (int i = 0; i < 100 && !(beyond(q, t) > 0); i++, step *= 2)
        t += step;
    return t;
}

/* ---- refusals ---- */

static strum_status slides(strum_error *error)
{
    return error_at(
        error, STRUM_ERR_IMPOSSIBLE, STRUM_CABLE_ARG_BED, STRUM_NO_INDEX,
        "the cable would lie slack on the slope and slide: friction, where there is "
        "any, holds only what lies from end 1 on, up to its own angle");
}

/* Slack cable stays where it lies on a level bed, and on a slope by friction from end 1 on. */
static bool slack_stays(const bed_search *q)
{
    const bed_frame *f = &q->frame;
    for (size_t i = 0; i < q->form->count && f->sine != 0; i++) {
        const cable_piece *p = q->form->pieces + i;
        const double friction = f->line->pieces[q->form->origin[i]].friction;
        if (p->lies && p->h == 0 && p->v == 0 && p->rate == 0 &&
            (p->run > 0 || f->height_1 > 0 || friction * f->cosine < fabs(f->sine)))
            return false;
    }
    return true;
}

/* The first weightless piece without tension; form->count: there is none. */
static size_t slack_weightless(const bed_search *q, double part)
{
    const cable_form *form = q->form;
    size_t i = 0;
    while (i < form->count &&
           !(form->pieces[i].section->weight == 0 &&
             !(hypot(form->pieces[i].h, form->pieces[i].v) > part * q->frame.load)))
        i++;
    return i;
}

static strum_status refuse_weightless(const bed_search *q, double part, strum_error *error)
{
    const size_t origin = q->form->origin[slack_weightless(q, part)];
    return error_at(
        error, STRUM_ERR_IMPOSSIBLE, STRUM_CABLE_ARG_SECTIONS,
        q->frame.line->pieces[origin].section,
        "a weightless piece without tension, or with next to none, has no shape: the "
        "cable is too long, or nothing pulls at this section");
}

/* More cable than the ends leave room for: what is slack folds. On a slope it is not slack where
 * friction does not hold it, but slides. */
static strum_status fold(bed_search *q, double t, strum_error *error)
{
    const double by = beyond(q, t);
    if (slack_weightless(q, 1e-6) < q->form->count)
        return refuse_weightless(q, 1e-6, error);
    if (!(q->result.slack > 0))
        return q->frame.sine != 0
                   ? slides(error)
                   : error_set(error, STRUM_ERR_ACCURACY,
                               "the contact with the bed was not found: no cable lies slack");
    q->fold = 1 - by / q->result.slack;
    (void)beyond(q, t);
    return q->frame.sine != 0 && q->fold < 0 ? slides(error) : STRUM_OK;
}

static strum_status judge(const bed_search *q, const strum_cable_params *p, strum_error *error)
{
    const cable_form *form = q->form;
    const double length = q->frame.line->length;
    const double clearance = bed_clearance(form, &p->bed);
    double x, z;
    bed_to_world(&q->frame, q->frame.along_2, q->frame.height_2 - q->frame.height_1, &x, &z);
    const bool closes = hypot(form->x - x, form->z - z) <= 1e-11 * length;
    if (slack_weightless(q, closes ? 1e-12 : 1e-6) < form->count)
        return refuse_weightless(q, closes ? 1e-12 : 1e-6, error);
    if (!slack_stays(q))
        return slides(error);
    if (!(clearance >= -1e-9 * length) || form->reaction < -1e-9 * q->frame.load || !closes)
        return error_set(error, STRUM_ERR_ACCURACY,
                         "the contact with the bed was not found: an inequality is not met");
    return STRUM_OK;
}

strum_status bed_settle(const cable_line *line, const strum_hanging *cable, double span,
                        double h, double v, cable_form *form, bed_contact *contacts, work *w,
                        strum_error *error)
{
    const strum_cable_params *p = &cable->params;
    bed_search q = {.frame = frame_of(line, p, span, w),
                    .touch = {.contacts = contacts, .room = line->count + 1},
                    .sections = cable->sections,
                    .form = form,
                    .fold = 1,
                    .level = p->bed.slope == 0};
    for (size_t i = 0; i < line->count; i++)
        q.level = q.level && line->pieces[i].load_x == 0;
    double low = 0, high, across;
    bed_from_world(&q.frame, h, v, &high, &across);
    high = fmax(fabs(high), 1e-6 * q.frame.load);
    const bool found = enclose(&q, &low, &high);
    if (w->status != STRUM_OK)
        return work_error(w, error);
    if (!found)
        return error_set(error, STRUM_ERR_ACCURACY,
                         "the contact with the bed was not found: no force reaches end 2");
    const double t = bracket_root(beyond_at, &q, low, high);
    strum_status status = STRUM_OK;
    if (!(fabs(beyond(&q, t)) <= 1e-11 * line->length))
        status = fold(&q, least_beyond(&q, t), error);
    if (w->status != STRUM_OK)
        return work_error(w, error);
    return status == STRUM_OK ? judge(&q, p, error) : status;
}
