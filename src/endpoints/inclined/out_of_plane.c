/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Modes of an inclined cable out of its plane: they do not know of models, for they are those of a
 * string whose tension varies as the static shape has it. */
#include <math.h>
#include <stdlib.h>

#include "endpoints/common/suspended_cable.h"
#include "endpoints/inclined/answer.h"

void inclined_write_frequency(json_writer *json, const inclined_request *r, double kl)
{
    json_put_number(json, "kl_over_pi", kl / M_PI);
    if (r->rad_per_s > 0)
        put_frequency(json, kl * r->rad_per_s);
}

/* About the same profile as the in-plane modes; masses in M, forces in H. */
static strum_modes_params params_of(const inclined_request *r)
{
    const strum_catenary *c = &r->at_rest.profile;
    return (strum_modes_params){.cable = {.chi_m = c->chi_m,
                                          .mu = c->mu,
                                          .kappa_t = c->kappa,
                                          .kappa_n = r->cable.elastic_statics ? c->kappa : 0,
                                          .mass_t = 1,
                                          .mass_n = 1},
                                .plane = STRUM_OUT_OF_PLANE,
                                .count = (int)r->modes,
                                .shapes = r->shape_points > 0 || r->verify};
}

/* Slope parameters of points equally spaced along the unstretched cable. */
static void place_points(const inclined_request *r, double *chi, size_t points)
{
    const strum_catenary *c = &r->at_rest.profile;
    const double first = c->chi_m - c->mu, last = c->chi_m + c->mu;
    for (size_t i = 0; i < points; i++) {
        const double s = (double)i / (double)(points - 1);
        chi[i] = fmin(fmax(asinh(sinh(first) + s * c->unstretched_length), first), last);
    }
    chi[0] = first;
    chi[points - 1] = last;
}

static void write_points(json_writer *json, const inclined_request *r,
                         const strum_shape_point *shape, size_t points)
{
    json_key(json, "shape");
    json_open_array(json);
    for (size_t i = 0; i < points; i++) {
        const double s = (double)i / (double)(points - 1);
        json_open_object(json);
        json_put_number(json, "s", s);
        if (r->tension > 0)
            json_put_number(json, "s_m", s * r->length_m);
        json_put_number(json, "out_of_plane", creal(shape[i].normal));
        json_close_object(json);
    }
    json_close_array(json);
}

static strum_status write_list(json_writer *json, const inclined_request *r,
                               const strum_modes *modes, double *chi, strum_shape_point *shape)
{
    const size_t points = (size_t)r->shape_points;
    /* kL = omega L sqrt(M/T_a), omega in sqrt(H/(M a^2)), H = T_a cos(phi_a) */
    const double kl = r->at_rest.profile.unstretched_length * sqrt(cos(r->cable.inclination));
    strum_mode mode;
    strum_status status = STRUM_OK;
    if (points > 0)
        place_points(r, chi, points);
    json_key(json, plane_keys[STRUM_OUT_OF_PLANE]);
    json_open_array(json);
    for (size_t k = 0; k < (size_t)r->modes && status == STRUM_OK; k++) {
        status = strum_modes_get(modes, k, &mode);
        if (status != STRUM_OK)
            break;
        json_open_object(json);
        json_put_integer(json, "mode", (int64_t)k + 1);
        inclined_write_frequency(json, r, mode.frequency * kl);
        json_put_string(json, "symmetry", symmetry_names[mode.symmetry]);
        if (points > 0)
            status = strum_modes_shape(modes, k, chi, points, shape);
        if (points > 0 && status == STRUM_OK)
            write_points(json, r, shape, points);
        json_close_object(json);
    }
    json_close_array(json);
    return status;
}

strum_status inclined_write_out_of_plane(json_writer *json, const inclined_request *r,
                                         const strum_options *options, strum_error *error)
{
    const strum_modes_params params = params_of(r);
    const size_t points = (size_t)r->shape_points;
    double *chi = malloc((points + 1) * sizeof *chi);
    strum_shape_point *shape = calloc(points + 1, sizeof *shape);
    strum_modes *modes = NULL;
    strum_verification v;
    strum_status status = chi != NULL && shape != NULL ? STRUM_OK : STRUM_ERR_MEMORY;
    if (status == STRUM_OK)
        status = strum_modes_solve(&params, options, &modes, error);
    if (status == STRUM_OK)
        status = write_list(json, r, modes, chi, shape);
    if (status == STRUM_OK && r->verify)
        status = strum_modes_verify(modes, options, &v, error);
    if (status == STRUM_OK && r->verify) {
        json_key(json, "verification_out_of_plane");
        json_open_object(json);
        put_verification_members(json, &v);
        json_close_object(json);
    }
    strum_modes_free(modes);
    free(shape);
    free(chi);
    return status;
}

double inclined_out_of_plane_us(const inclined_request *r)
{
    const strum_modes_params params = params_of(r);
    return strum_modes_work(&params) * (r->verify ? 3 : 1) +
           4 * (double)(r->modes * r->shape_points);
}
