/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is said of an optimum: the modes there, whether they suffice, the closed forms beside
 * it, a sweep. */
#include "endpoints/absorber/answer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Modes within this of the least damped one limit it too: two branches cross at an optimum, or
 * coalesce. */
#define LIMITING (1 + 1e-4)

static double damping_of(const strum_taut_root *root)
{
    return root->decay / hypot(root->frequency, root->decay);
}

static void write_values(json_writer *json, const absorber_request *r, const double *values)
{
    json_open_object(json);
    for (size_t i = 0; i < r->variables.count; i++)
        json_put_number(json, r->names[i].text, values[i]);
    json_close_object(json);
}

static void write_root(json_writer *json, const strum_taut_root *root)
{
    json_open_object(json);
    chain_write_root(json, root);
    json_close_object(json);
}

static void write_modes(json_writer *json, const strum_absorber_optimum *best,
                        const strum_taut_roots *roots)
{
    double closest = INFINITY;
    const double limit = best->damping_ratio * LIMITING;
    json_key(json, "limiting_modes");
    json_open_array(json);
    for (size_t i = 0; i < roots->count; i++)
        if (damping_of(&roots->roots[i]) <= limit) {
            write_root(json, &roots->roots[i]);
            closest = fmin(closest, roots->roots[i].exceptional);
        }
    json_close_array(json);
    json_key(json, "modes");
    json_open_array(json);
    for (size_t i = 0; i < roots->count; i++)
        write_root(json, &roots->roots[i]);
    json_close_array(json);
    json_key(json, "overdamped");
    json_open_array(json);
    for (size_t i = 0; i < roots->overdamped_count; i++)
        write_root(json, &roots->overdamped[i]);
    json_close_array(json);
    json_put_flag(json, "exceptional_point", closest < CHAIN_EXCEPTIONAL);
}

static void write_search(json_writer *json, const absorber_request *r,
                         const strum_absorber_optimum *best)
{
    json_key(json, "search");
    json_open_object(json);
    json_put_flag(json, "complete", best->complete);
    json_put_integer(json, "starts", best->starts);
    if (r->modes.count == 0)
        json_put_number(json, "max_decay_per_s", STRUM_ABSORBER_DECAY * r->band[1]);
    json_key(json, "local_optima");
    json_open_array(json);
    for (int i = 0; i < best->optima_count; i++) {
        json_open_object(json);
        json_put_number(json, "damping_ratio", best->optima[i].damping_ratio);
        json_key(json, "values");
        write_values(json, r, best->optima[i].values);
        json_close_object(json);
    }
    json_close_array(json);
    if (best->optima_count > 0)
        json_put_number(
            json, "spread",
            fmax(0, best->damping_ratio - best->optima[best->optima_count - 1].damping_ratio));
    json_close_object(json);
}

/* S_G = 8 pi^2 St^2 zeta m/(rho D^2)  [Griffin; Levesque 1-2, 4-1], solved for zeta. */
static void write_required(json_writer *json, const absorber_request *r,
                           const strum_absorber_optimum *best)
{
    if (!FIELD_GIVEN(&absorber_schema, r, required))
        return;
    const chain_variables x = {r->names, best->values, r->variables.count};
    const absorber_required *q = &r->required;
    const double mass = chain_mean_mass(&r->in, &x);
    if (!(mass > 0))
        return;
    const double ratio = q->reduced_damping * q->fluid_kg_per_m3 * q->diameter_m *
                         q->diameter_m / (8 * M_PI * M_PI * q->strouhal * q->strouhal * mass);
    json_put_number(json, "required_damping_ratio", ratio);
    json_put_flag(json, "met", best->damping_ratio >= ratio);
}

/* ---- closed forms ---- */

/* The exact model's least damping with a form's values in place of the variables that they set.
 */
static strum_status write_form(json_writer *json, absorber_solving *s, const char *name,
                               const char *criterion, const chain_glance *part,
                               const strum_absorber_form *form, const double *optimum)
{
    const absorber_request *r = s->r;
    const char *names[2] = {part->stiffness_name, part->damping_name};
    const double wanted[2] = {form->stiffness, form->damping};
    double values[STRUM_ABSORBER_VARIABLES_MAX];
    bool set = false;
    memcpy(values, optimum, sizeof values);
    for (int k = 0; k < 2; k++) {
        const int i = names[k] != NULL ? absorber_variable_index(r, names[k]) : -1;
        if (i < 0 || (k == 0 && !(form->stiffness > 0)))
            continue;
        values[i] = wanted[k];
        set = true;
    }
    if (!set)
        return STRUM_OK;
    strum_taut_roots *roots = NULL;
    strum_status status = strum_absorber_roots(&s->params, &s->options, values, &roots, NULL);
    if (status == STRUM_ERR_MEMORY || status == STRUM_ERR_CANCELLED)
        return status;
    json_open_object(json);
    json_put_string(json, "name", name);
    json_put_string(json, "criterion", criterion);
    json_key(json, "values");
    write_values(json, r, values);
    if (isfinite(form->damping_ratio))
        json_put_number(json, "damping_ratio", form->damping_ratio);
    const int limiting = status == STRUM_OK ? strum_absorber_limiting(roots) : -1;
    if (limiting >= 0) {
        json_put_number(json, "exact_damping_ratio", damping_of(&roots->roots[limiting]));
        json_put_number(json, "exact_loss_ratio",
                        roots->roots[limiting].decay / roots->roots[limiting].frequency);
    }
    json_close_object(json);
    strum_taut_roots_free(roots);
    return STRUM_OK;
}

/* One absorber or damper between two pieces of one cable: what the textbooks say of the lowest
 * mode in question. */
static strum_status write_closed_forms(json_writer *json, absorber_solving *s,
                                       const strum_absorber_optimum *best)
{
    const absorber_request *r = s->r;
    const chain_variables x = {r->names, best->values, r->variables.count};
    chain_glance left, part, right;
    json_key(json, "closed_forms");
    json_open_array(json);
    strum_status status = STRUM_OK;
    if (r->in.components.count == 3 && chain_look(&r->in, &x, 0, &left) &&
        chain_look(&r->in, &x, 1, &part) && chain_look(&r->in, &x, 2, &right) &&
        left.length > 0 && right.length > 0 && left.tension == right.tension &&
        left.mass_per_length == right.mass_per_length) {
        const double length = left.length + right.length, rho = left.mass_per_length;
        const double first = M_PI / length * sqrt(left.tension / rho);
        const long mode =
            r->modes.count > 0 ? r->mode_numbers[0] : (long)fmax(1, ceil(r->band[0] / first));
        const double share = sin((double)mode * M_PI * left.length / length);
        const double ratio = part.mass / (rho * length / 2) * share * share;
        if (part.absorber && ratio > 0) {
            const strum_absorber_form h =
                strum_absorber_den_hartog(part.mass, ratio, (double)mode * first);
            const strum_absorber_form c =
                strum_absorber_coalescence(part.mass, ratio, (double)mode * first);
            status = write_form(json, s, "Den Hartog",
                                "equal peaks of the steady response, not largest damping",
                                &part, &h, best->values);
            if (status == STRUM_OK)
                status = write_form(json, s, "pole coalescence",
                                    "both poles of one mode and absorber coalesce", &part, &c,
                                    best->values);
        } else if (part.damper) {
            const strum_absorber_form u =
                strum_absorber_universal_curve(length, rho, left.tension, left.length, mode);
            status = write_form(json, s, "universal curve",
                                "largest damping of one mode by a damper near an end (Pacheco, "
                                "Fujino and Sulekh 1993)",
                                &part, &u, best->values);
        }
    }
    json_close_array(json);
    return status;
}

/* ---- sweep ---- */

/* The roots at each value, to be written branch by branch. */
typedef struct swept {
    double value;
    strum_taut_roots *roots; /* NULL where the chain cannot exist */
} swept;

static void write_branch(json_writer *json, const swept *rows, int64_t points, long mode)
{
    json_open_object(json);
    json_put_integer(json, "mode", mode);
    json_key(json, "points");
    json_open_array(json);
    for (int64_t i = 0; i < points; i++)
        for (size_t k = 0; rows[i].roots != NULL && k < rows[i].roots->count; k++)
            if (rows[i].roots->roots[k].mode == mode) {
                json_open_object(json);
                json_put_number(json, "value", rows[i].value);
                chain_write_root(json, &rows[i].roots->roots[k]);
                json_close_object(json);
            }
    json_close_array(json);
    json_close_object(json);
}

static int by_number(const void *left, const void *right)
{
    const long l = *(const long *)left, r = *(const long *)right;
    return l < r ? -1 : l > r;
}

/* Every mode number that occurs, once, ascending. */
static size_t modes_met(const swept *rows, int64_t points, long *modes)
{
    size_t count = 0, kept = 0;
    for (int64_t i = 0; i < points; i++)
        for (size_t k = 0; rows[i].roots != NULL && k < rows[i].roots->count; k++)
            modes[count++] = rows[i].roots->roots[k].mode;
    qsort(modes, count, sizeof *modes, by_number);
    for (size_t i = 0; i < count; i++)
        if (i == 0 || modes[i] != modes[i - 1])
            modes[kept++] = modes[i];
    return kept;
}

static strum_status write_sweep(json_writer *json, absorber_solving *s,
                                const strum_absorber_optimum *best)
{
    const absorber_request *r = s->r;
    if (!FIELD_GIVEN(&absorber_schema, r, sweep))
        return STRUM_OK;
    const int at = absorber_variable_index(r, r->sweep.variable.text);
    int64_t points = r->sweep.points;
    swept *rows = calloc((size_t)points, sizeof *rows);
    strum_status status = rows == NULL ? STRUM_ERR_MEMORY : STRUM_OK;
    double values[STRUM_ABSORBER_VARIABLES_MAX];
    size_t all = 1;
    memcpy(values, best->values, sizeof values);
    absorber_allow(s, r->time_limit_s);
    for (int64_t i = 0; i < points && status == STRUM_OK; i++) {
        rows[i].value = values[at] = strum_absorber_scale(
            r->low[at], r->high[at], (double)i / (double)(r->sweep.points - 1));
        status = strum_absorber_roots(&s->params, &s->options, values, &rows[i].roots, NULL);
        all += rows[i].roots != NULL ? rows[i].roots->count : 0;
        if (answer_cancelled(s->a))
            status = STRUM_ERR_CANCELLED;
        else if (status != STRUM_ERR_MEMORY)
            status = STRUM_OK; /* a value without a chain leaves a gap */
        if (s->late) {
            answer_warn(s->a,
                        "the time limit of %g s ended the sweep after %lld of %lld values",
                        r->time_limit_s, (long long)i, (long long)points);
            s->a->transient = true;
            points = i;
        }
    }
    long *modes = calloc(all, sizeof *modes);
    if (modes == NULL)
        status = STRUM_ERR_MEMORY;
    if (status == STRUM_OK) {
        const size_t count = modes_met(rows, points, modes);
        json_key(json, "sweep");
        json_open_object(json);
        json_put_string(json, "variable", r->names[at].text);
        json_key(json, "branches");
        json_open_array(json);
        for (size_t i = 0; i < count; i++)
            write_branch(json, rows, points, modes[i]);
        json_close_array(json);
        json_close_object(json);
    }
    for (int64_t i = 0; rows != NULL && i < r->sweep.points; i++)
        strum_taut_roots_free(rows[i].roots);
    free(rows);
    free(modes);
    return status;
}

bool absorber_write(absorber_solving *s, const strum_absorber_optimum *best,
                    const strum_taut_roots *roots)
{
    json_writer *json = s->a->result;
    json_open_object(json);
    json_key(json, "optimum");
    write_values(json, s->r, best->values);
    json_put_number(json, "damping_ratio", best->damping_ratio);
    json_put_number(json, "loss_ratio", best->loss_ratio);
    write_modes(json, best, roots);
    write_required(json, s->r, best);
    strum_status status = write_closed_forms(json, s, best);
    if (status == STRUM_OK)
        status = write_sweep(json, s, best);
    json_put_integer(json, "evaluations", best->evaluations);
    write_search(json, s->r, best);
    json_close_object(json);
    if (status != STRUM_OK)
        chain_refuse(&(strum_error){0}, status, s->a->problem);
    return status == STRUM_OK;
}
