/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "endpoints/cable/comparison.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <strum/handbook.h>

#include "endpoints/common/members.h"

/* A spring of so many times the stiffness that the cable has at a place holds it there. */
#define LOCKED 1e8
/* A damping ratio below is none: a damper at a node leaves it to the roundings. */
#define UNDAMPED 1e-12

/* ---- the same cable, changed ---- */

typedef struct changed {
    strum_cable_params params;
    strum_cable_section *sections;
    strum_cable_attachment *attachments;
} changed;

static void changed_free(changed *c)
{
    free(c->sections);
    free(c->attachments);
}

static strum_status copy(const strum_cable_params *from, changed *c)
{
    const size_t sections = from->section_count, attachments = from->attachment_count;
    c->params = *from;
    c->sections = malloc(sections * sizeof *c->sections);
    c->attachments = malloc((attachments + 1) * sizeof *c->attachments);
    if (c->sections == NULL || c->attachments == NULL) {
        changed_free(c);
        return STRUM_ERR_MEMORY;
    }
    memcpy(c->sections, from->sections, sections * sizeof *c->sections);
    for (size_t i = 0; i < attachments; i++)
        c->attachments[i] = from->attachments[i];
    c->params.sections = c->sections;
    c->params.attachments = c->attachments;
    return STRUM_OK;
}

/* Frees `c`. */
static strum_status solve(changed *c, strum_plane plane, size_t count,
                          const strum_options *options, strum_cable_modes **modes,
                          strum_error *error)
{
    strum_hanging *cable = NULL;
    const strum_cable_modes_params params = {plane, (int)count, STRUM_CABLE_HELD};
    strum_status status = strum_cable_hang(&c->params, options, &cable, error);
    if (status == STRUM_OK)
        status = strum_cable_modes_solve(cable, &params, options, modes, error);
    strum_cable_free(cable);
    changed_free(c);
    return status;
}

/* A cable that the simpler theory cannot have is no fault of the answer. */
static strum_status forgive(strum_status status)
{
    const bool fatal = status == STRUM_ERR_MEMORY || status == STRUM_ERR_CANCELLED ||
                       status == STRUM_ERR_TIME || status == STRUM_ERR_WORK;
    return fatal ? status : STRUM_OK;
}

static strum_status without_bending(const hung_input *in, strum_plane plane, size_t count,
                                    const strum_options *options, strum_cable_modes **modes,
                                    strum_error *error)
{
    changed c;
    bool bends = false;
    for (size_t i = 0; i < in->params.section_count; i++)
        bends = bends || in->params.sections[i].bending_stiffness > 0;
    if (!bends)
        return STRUM_OK;
    if (copy(&in->params, &c) != STRUM_OK)
        return STRUM_ERR_MEMORY;
    for (size_t i = 0; i < in->params.section_count; i++)
        c.sections[i].bending_stiffness = 0;
    c.params.stiff = false;
    c.params.end_1 = c.params.end_2 = (strum_cable_end){STRUM_CABLE_PINNED, 0, NAN};
    return forgive(solve(&c, plane, count, options, modes, error));
}

/* ---- one damper, by two undamped frequencies ---- */

/* Local flexibility of a tensioned half-beam at x from its end, over that of a string, x/T:
 *     r = x sqrt(T/EI),  E = exp(-r),  q = (1 - E)/r
 *     clamped: 1 - q - r q^2/2      pinned: 1 - (1 - E^2)/(2 r)
 * (the static deflection of the half-beam under a point force). */
static double local_flexibility(double x, double tension, double bending, bool clamped)
{
    if (!(bending > 0))
        return 1;
    const double r = x * sqrt(tension / bending), e = exp(-r), q = -expm1(-r) / r;
    return clamped ? 1 - q - r * q * q / 2 : 1 - (1 - e * e) / (2 * r);
}

typedef struct damper {
    size_t index;
    double damping, flexibility; /* N s/m, m/N */
} damper;

/* The only cause of damping is one damper that acts in the plane. */
static bool find_damper(const hung_input *in, const strum_hanging *cable, strum_plane plane,
                        damper *d)
{
    size_t found = 0;
    for (size_t i = 0; i < in->params.section_count; i++) {
        const strum_cable_section *s = &in->params.sections[i];
        if (s->axial_loss > 0 || s->bending_loss > 0 || s->drag_normal > 0 ||
            s->drag_tangential > 0)
            return false;
    }
    for (size_t i = 0; i < in->params.attachment_count; i++) {
        const strum_cable_attachment *a = &in->params.attachments[i];
        if (a->kind == STRUM_CABLE_ABSORBER)
            return false;
        if (a->kind == STRUM_CABLE_DAMPER && motion_acts(a->direction, plane)) {
            found++;
            d->index = i;
        }
    }
    strum_cable_joint joint;
    strum_cable_statics s;
    if (found != 1 || in->params.spans > 1 ||
        strum_cable_attachment_get(cable, d->index, &joint) != STRUM_OK)
        return false;
    strum_cable_statics_get(cable, &s);
    const bool near_1 = joint.position < s.unstretched_length / 2;
    const strum_cable_end *end = near_1 ? &in->params.end_1 : &in->params.end_2;
    const strum_cable_section *section =
        &in->params.sections[near_1 ? 0 : in->params.section_count - 1];
    const double x = near_1 ? joint.position : s.unstretched_length - joint.position;
    d->damping = in->params.attachments[d->index].damping;
    d->flexibility = x / joint.tension_left *
                     local_flexibility(x, joint.tension_left, section->bending_stiffness,
                                       end->rotation == STRUM_CABLE_CLAMPED);
    return s.contacts == 0 && d->damping > 0 && d->flexibility > 0 &&
           (end->rotation != STRUM_CABLE_SPRUNG || !(section->bending_stiffness > 0));
}

/* Modes with the damper held fast, or taken away. */
static strum_status damper_as(const hung_input *in, const damper *d, bool locked,
                              strum_plane plane, size_t count, const strum_options *options,
                              strum_cable_modes **modes, strum_error *error)
{
    changed c;
    if (copy(&in->params, &c) != STRUM_OK)
        return STRUM_ERR_MEMORY;
    c.attachments[d->index].kind = STRUM_CABLE_SPRING;
    c.attachments[d->index].damping = 0;
    c.attachments[d->index].stiffness = locked ? LOCKED / d->flexibility : 0;
    return forgive(solve(&c, plane, count, options, modes, error));
}

/* zeta = (omega_locked - omega_free)/omega_free eta/(1 + eta^2), eta = c omega_free x f/T, f the
 * local flexibility. NAN where there is no such mode. */
static double two_frequencies(const damper *d, const strum_cable_modes *locked,
                              const strum_cable_modes *free_of_it, size_t i)
{
    strum_cable_mode held, loose;
    if (locked == NULL || free_of_it == NULL ||
        strum_cable_modes_get(locked, i, &held) != STRUM_OK ||
        strum_cable_modes_get(free_of_it, i, &loose) != STRUM_OK)
        return NAN;
    const double eta = d->damping * loose.frequency * d->flexibility;
    return (held.frequency - loose.frequency) / loose.frequency * eta / (1 + eta * eta);
}

/* ---- the handbook ---- */

/* Chord, tension along it, and the mean section. False where nothing of the kind hangs. */
static bool handbook_of(const hung_input *in, const strum_hanging *cable, strum_handbook *h)
{
    strum_cable_statics s;
    double weight = 0, mass = 0, compliance = 0, length = 0;
    strum_cable_statics_get(cable, &s);
    for (size_t i = 0; i < in->params.section_count; i++) {
        strum_cable_section one;
        if (strum_cable_section_get(cable, i, &one) != STRUM_OK)
            return false;
        length += one.length;
        weight += one.length * one.weight;
        mass += one.length * (one.mass + one.added_mass);
        compliance += one.length / one.axial_stiffness;
    }
    h->chord = hypot(s.span, s.rise);
    h->tension = s.tension_parallel_to_chord;
    h->mass = mass / length;
    h->sag_ratio = fabs(weight / length * s.span / h->tension);
    h->lambda_squared =
        compliance > 0 ? h->sag_ratio * h->sag_ratio * length /
                             (h->tension * compliance * (1 + h->sag_ratio * h->sag_ratio / 8))
                       : INFINITY;
    return s.contacts == 0 && in->params.spans == 1 && h->chord > 0 && h->tension > 0 &&
           h->mass > 0;
}

/* The n-th in plane: symmetric and antisymmetric ones in one ascending list. */
static double shallow_frequency(const strum_handbook *h, size_t n)
{
    int symmetric = 1, antisymmetric = 1;
    double value = 0;
    if (!(h->lambda_squared > 0))
        return strum_handbook_string(h, (int)n);
    for (size_t i = 0; i < n; i++) {
        const double a = strum_handbook_in_plane(h, STRUM_SYMMETRIC, symmetric);
        const double b = strum_handbook_in_plane(h, STRUM_ANTISYMMETRIC, antisymmetric);
        value = fmin(a, b);
        *(a <= b ? &symmetric : &antisymmetric) += 1;
    }
    return value;
}

/* ---- writing ---- */

static void put_beside(json_writer *json, const char *key, const char *difference,
                       double rad_per_s, double exact)
{
    if (!isfinite(rad_per_s))
        return;
    json_put_number(json, key, rad_per_s / (2 * M_PI));
    put_finite(json, difference, rad_per_s / exact - 1);
}

/* What one plane is compared with; NULL: not there. */
typedef struct others {
    strum_cable_modes *bare, *locked, *loose;
    bool damped, shallow;
    damper damper;
    strum_handbook handbook;
} others;

static double frequency_of(const strum_cable_modes *modes, size_t i)
{
    strum_cable_mode mode;
    return modes != NULL && strum_cable_modes_get(modes, i, &mode) == STRUM_OK ? mode.frequency
                                                                               : NAN;
}

static void write_mode(json_writer *json, size_t i, strum_plane plane,
                       const strum_cable_mode *mode, const others *o)
{
    json_open_object(json);
    json_put_integer(json, "mode", (int64_t)i + 1);
    json_put_number(json, "frequency_Hz", mode->frequency / (2 * M_PI));
    put_beside(json, "without_bending_Hz", "without_bending_difference",
               frequency_of(o->bare, i), mode->frequency);
    if (o->shallow) {
        const double string = strum_handbook_string(&o->handbook, (int)i + 1);
        put_beside(json, "shallow_cable_Hz", "shallow_cable_difference",
                   plane == STRUM_IN_PLANE ? shallow_frequency(&o->handbook, i + 1) : string,
                   mode->frequency);
        put_beside(json, "taut_string_Hz", "taut_string_difference", string, mode->frequency);
    }
    const double estimate = two_frequencies(&o->damper, o->locked, o->loose, i);
    if (mode->damped && isfinite(estimate)) {
        const double ratio = mode->decay / hypot(mode->frequency, mode->decay);
        json_put_number(json, "damping_ratio", ratio);
        json_put_number(json, "two_frequencies_damping_ratio", estimate);
        if (ratio > UNDAMPED)
            put_finite(json, "two_frequencies_difference", estimate / ratio - 1);
    }
    json_close_object(json);
}

static strum_status compare_plane(const hung_input *in, const strum_hanging *cable,
                                  strum_plane plane, const strum_cable_modes *modes,
                                  size_t count, const strum_options *options, json_writer *json,
                                  strum_error *error)
{
    others o = {0};
    o.shallow = handbook_of(in, cable, &o.handbook);
    o.damped = find_damper(in, cable, plane, &o.damper);
    strum_status status = without_bending(in, plane, count, options, &o.bare, error);
    if (status == STRUM_OK && o.damped)
        status = damper_as(in, &o.damper, true, plane, count, options, &o.locked, error);
    if (status == STRUM_OK && o.damped)
        status = damper_as(in, &o.damper, false, plane, count, options, &o.loose, error);
    json_key(json, plane_keys[plane]);
    json_open_array(json);
    for (size_t i = 0; i < strum_cable_modes_count(modes) && status == STRUM_OK; i++) {
        strum_cable_mode mode;
        status = strum_cable_modes_get(modes, i, &mode);
        if (status == STRUM_OK)
            write_mode(json, i, plane, &mode, &o);
    }
    json_close_array(json);
    strum_cable_modes_free(o.bare);
    strum_cable_modes_free(o.locked);
    strum_cable_modes_free(o.loose);
    return status;
}

strum_status comparison_write(const hung_input *in, const strum_hanging *cable,
                              const motion planes[2], size_t count,
                              const strum_options *options, json_writer *json,
                              strum_error *error)
{
    strum_status status = STRUM_OK;
    json_key(json, "comparison");
    json_open_object(json);
    json_put_string(json, "theories",
                    "the same cable without bending stiffness; the shallow cable of Irvine and "
                    "Caughey and the taut string, of the mean section along the chord, bare; "
                    "one damper by two undamped frequencies; matched by order");
    for (int plane = 0; plane < 2 && status == STRUM_OK; plane++)
        if (planes[plane].modes != NULL)
            status = compare_plane(in, cable, (strum_plane)plane, planes[plane].modes, count,
                                   options, json, error);
    json_close_object(json);
    return status;
}
