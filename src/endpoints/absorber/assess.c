/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A chain as it is: every mode that is excited, what damps it, whether that suffices. */
#include "endpoints/absorber/assess.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "endpoints/absorber/answer.h"
#include "endpoints/common/members.h"

/* Modes so much beyond a border of the band are listed too: vortices lock in over about a fifth. */
#define BESIDE 1.2
/* A damping ratio below it is none: no part that damps moves in the mode. */
#define UNDAMPED 1e-6
/* A part that moves by less of the largest motion stands near a node. */
#define NEAR_NODE 0.05
#define AT_NODE   1e-9
#define POINTS    4001

typedef struct reason {
    char text[240];
} reason;

static double ratio_of(const strum_taut_root *root)
{
    return root->decay / hypot(root->frequency, root->decay);
}

static bool excited(const absorber_request *r, const strum_taut_root *root)
{
    return r->modes.count > 0 ||
           (root->frequency >= r->band[0] && root->frequency <= r->band[1]);
}

/* The absorber or damper that moves most, how much and where; false where its place is not known
 * (other parts with a length stand in the chain) or there is none. */
static bool moves_most(const absorber_request *r, const chain_variables *x,
                       const strum_taut_point *points, double *amplitude, double *place)
{
    double at = 0;
    const double length = points[POINTS - 1].x;
    bool any = false;
    *amplitude = 0;
    for (size_t i = 0; i < r->in.components.count; i++) {
        chain_glance part;
        if (!chain_look(&r->in, x, i, &part))
            return false;
        at += part.length;
        if (!part.absorber && !part.damper)
            continue;
        const double share = fmin(at / length, 1) * (POINTS - 1);
        const double moves = cabs(points[(size_t)(share + 0.5)].displacement);
        if (!any || moves > *amplitude) {
            *amplitude = moves;
            *place = at;
        }
        any = true;
    }
    return any;
}

/* What keeps a mode from being damped: a node, as far as its shape shows. */
static strum_status find_cause(absorber_solving *s, const chain_variables *x,
                               const strum_taut *chain, const strum_taut_root *root,
                               reason *out)
{
    strum_taut_shape *shape = NULL;
    strum_taut_point *points = malloc(POINTS * sizeof *points);
    double amplitude, place;
    strum_status status = points == NULL ? STRUM_ERR_MEMORY : STRUM_OK;
    if (status == STRUM_OK)
        status = strum_taut_shape_make(chain, root, &s->options, &shape, NULL);
    if (status == STRUM_OK)
        status = strum_taut_shape_sample(shape, POINTS, points, NULL);
    const bool known = status == STRUM_OK && moves_most(s->r, x, points, &amplitude, &place);
    if (known && amplitude < AT_NODE)
        (void)snprintf(
            out->text, sizeof out->text,
            ": every absorber and damper stands on a node of it, as the one at %.6g m", place);
    else if (known && amplitude < NEAR_NODE)
        (void)snprintf(
            out->text, sizeof out->text,
            ": of absorbers and dampers the one at %.6g m moves most, by %.2g of the "
            "largest motion of the mode: it stands near a node",
            place, amplitude);
    else if (ratio_of(root) < UNDAMPED)
        (void)snprintf(out->text, sizeof out->text, ": nothing that damps moves in it");
    strum_taut_shape_free(shape);
    free(points);
    return status == STRUM_ERR_MEMORY || status == STRUM_ERR_CANCELLED ? status : STRUM_OK;
}

static void write_row(json_writer *json, const absorber_request *r, const strum_taut_root *root,
                      double required, const reason *cause)
{
    const double damping = ratio_of(root);
    reason why = {""};
    json_open_object(json);
    if (root->mode > 0)
        json_put_integer(json, "mode", root->mode);
    put_frequency(json, root->frequency);
    json_put_flag(json, "excited", excited(r, root));
    json_put_number(json, "damping_ratio", damping);
    if (required > 0) {
        json_put_number(json, "required_damping_ratio", required);
        json_put_flag(json, "met", damping >= required);
    }
    if (!excited(r, root))
        (void)snprintf(why.text, sizeof why.text,
                       "lies %.3g %% %s the band; vortices may lock in",
                       100 * (root->frequency < r->band[0] ? 1 - root->frequency / r->band[0]
                                                           : root->frequency / r->band[1] - 1),
                       root->frequency < r->band[0] ? "below" : "above");
    else if (!(required > 0))
        (void)snprintf(why.text, sizeof why.text, "no damping is required");
    else if (damping >= required)
        (void)snprintf(why.text, sizeof why.text, "damped %.3g times as much as required",
                       damping / required);
    else
        (void)snprintf(why.text, sizeof why.text, "damped %.3g of what is required%s",
                       damping > UNDAMPED ? damping / required : 0, cause->text);
    if (excited(r, root) && !(required > 0) && cause->text[0] != '\0')
        (void)snprintf(why.text, sizeof why.text, "no damping is required%s", cause->text);
    json_put_string(json, "reason", why.text);
    json_close_object(json);
}

static strum_status write_rows(absorber_solving *s, const strum_taut *chain,
                               const strum_taut_roots *roots, double required)
{
    json_writer *json = s->a->result;
    const chain_variables none = {0};
    strum_status status = STRUM_OK;
    size_t count = 0, failed = 0;
    json_open_object(json);
    json_key(json, "assessment");
    json_open_array(json);
    for (size_t i = 0; i < roots->count && status == STRUM_OK; i++) {
        const strum_taut_root *root = &roots->roots[i];
        const bool met = !(required > 0) || ratio_of(root) >= required;
        reason cause = {""};
        if (!met || ratio_of(root) < UNDAMPED)
            status = find_cause(s, &none, chain, root, &cause);
        write_row(json, s->r, root, required, &cause);
        count += excited(s->r, root);
        failed += excited(s->r, root) && !met;
        if (answer_cancelled(s->a))
            status = STRUM_ERR_CANCELLED;
    }
    json_close_array(json);
    json_put_integer(json, "excited_modes", (int64_t)count);
    if (required > 0)
        json_put_flag(json, "met", failed == 0);
    json_close_object(json);
    if (count == 0)
        answer_warn(s->a, "no mode that oscillates is excited: there is nothing to damp");
    return status;
}

bool absorber_assess(absorber_solving *s)
{
    const absorber_request *r = s->r;
    strum_taut *chain = NULL;
    strum_taut_roots *roots = NULL;
    strum_error error = {0};
    strum_absorber_params wider = s->params;
    wider.lowest = r->band[0] / BESIDE;
    wider.highest = r->band[1] * BESIDE;
    strum_status status = chain_make(&r->in, NULL, &chain, &error);
    if (status == STRUM_OK)
        status = strum_absorber_roots(&wider, &s->options, r->low, &roots, &error);
    if (status == STRUM_OK)
        status = write_rows(s, chain, roots, absorber_required_ratio(r, NULL));
    strum_taut_roots_free(roots);
    strum_taut_free(chain);
    if (status != STRUM_OK)
        chain_refuse(&r->in, &error, status, s->a->problem);
    return status == STRUM_OK;
}

static const char *asking_field(const absorber_request *r)
{
    return r->modes.count > 0           ? "/modes"
           : band_given(&r->asked_band) ? band_pointer(&r->asked_band)
                                        : "/current_m_per_s";
}

void absorber_explain(absorber_solving *s)
{
    const absorber_request *r = s->r;
    double middle[STRUM_ABSORBER_VARIABLES_MAX];
    for (size_t i = 0; i < r->variables.count; i++)
        middle[i] = strum_absorber_scale(r->low[i], r->high[i], 0.5);
    const chain_variables x = {r->names, middle, r->variables.count};
    strum_taut *chain = NULL;
    strum_taut_roots *roots = NULL;
    strum_status status = chain_make(&r->in, &x, &chain, NULL);
    if (status == STRUM_OK)
        status = strum_absorber_roots(&s->params, &s->options, middle, &roots, NULL);
    if (status == STRUM_OK && roots->count == 0 && r->modes.count == 0)
        problem_add(
            s->a->problem, asking_field(r),
            "no oscillating mode between %.6g and %.6g rad/s (%.6g and %.6g Hz) with the "
            "variables in the middle of their bounds; %ld lie below",
            r->band[0], r->band[1], r->band[0] / (2 * M_PI), r->band[1] / (2 * M_PI),
            strum_taut_count(chain, r->band[0]));
    for (size_t i = 0; status == STRUM_OK && i < roots->count; i++) {
        const strum_taut_root *root = &roots->roots[i];
        reason cause = {""};
        if (ratio_of(root) >= UNDAMPED)
            continue;
        status = find_cause(s, &x, chain, root, &cause);
        problem_add(s->a->problem, asking_field(r),
                    "mode %ld at %.6g rad/s (%.6g Hz) is not damped%s", root->mode,
                    root->frequency, root->frequency / (2 * M_PI), cause.text);
    }
    strum_taut_roots_free(roots);
    strum_taut_free(chain);
}
