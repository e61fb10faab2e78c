/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Natural frequencies of a suspended cable: 125 m of cable between level supports 100 m apart,
 * the cable of Gale's Table B-3 with sag parameter b/l = 0.8.
 *
 *     cc frequencies.c $(pkg-config --cflags --libs strum) -lm -o frequencies
 */
#include <math.h>
#include <stdio.h>

#include <strum/strum.h>

#define SPAN    100.0   /* m */
#define LENGTH  125.0   /* m */
#define GRAVITY 9.80665 /* m/s^2 */
#define TWO_PI  6.283185307179586

static int fail(const strum_error *error)
{
    fprintf(stderr, "%s\n",
            error->reason[0] != '\0' ? error->reason : strum_status_text(error->status));
    return 1;
}

int main(void)
{
    strum_error error;
    strum_catenary profile;
    if (strum_catenary_from_length(SPAN, 0, LENGTH, &profile, &error) != STRUM_OK)
        return fail(&error);

    /* An inextensible cable in vacuum: no flexibility, no added mass, no damping. */
    strum_modes_params params = STRUM_MODES_PARAMS_INIT;
    params.cable.chi_m = profile.chi_m;
    params.cable.mu = profile.mu;
    params.count = 6;
    strum_modes *modes = NULL;
    if (strum_modes_solve(&params, NULL, &modes, &error) != STRUM_OK)
        return fail(&error);

    /* The library measures lengths in a = H/w and times in sqrt(a/g). */
    double a = SPAN / profile.span;
    printf("mode  ratio to sqrt(g/a)  Hz\n");
    strum_mode mode;
    for (size_t i = 0; strum_modes_get(modes, i, &mode) == STRUM_OK; i++)
        printf("%zu  %.12g  %.12g\n", i + 1, mode.frequency,
               mode.frequency * sqrt(GRAVITY / a) / TWO_PI);
    strum_modes_free(modes);
    return 0;
}
