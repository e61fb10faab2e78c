/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A forced curve: the upper end of a level cable of sag parameter 0.9 moves by a hundredth of
 * a = H/w along its tangent; the largest dynamic tension in H, against the forcing frequency in
 * sqrt(g/a) (Gale's Table C-2).
 *
 *     cc forced.c $(pkg-config --cflags --libs strum) -lm -o forced
 */
#include <stdio.h>
#include <string.h>

#include <strum/strum.h>

static int fail(const strum_error *error)
{
    fprintf(stderr, "%s\n",
            error->reason[0] != '\0' ? error->reason : strum_status_text(error->status));
    return 1;
}

static int print_curve(strum_response *response)
{
    const double frequencies[] = {0, 0.5, 1, 1.5, 2, 2.5, 3, 3.27, 3.31, 3.5, 4, 4.5, 5};
    strum_end_motion motion;
    memset(&motion, 0, sizeof motion);
    /* The real part comes first, in C's complex numbers and in the struct that C++ sees. */
    *(double *)&motion.tangential = 0.01;
    for (size_t i = 0; i < sizeof frequencies / sizeof *frequencies; i++) {
        strum_peak peak;
        strum_status status = strum_response_solve(response, frequencies[i], &motion, NULL);
        if (status != STRUM_OK) {
            fprintf(stderr, "%s\n", strum_status_text(status));
            return 1;
        }
        strum_response_peak(response, &peak);
        printf("%g  %.12g\n", frequencies[i], peak.tension);
    }
    return 0;
}

int main(void)
{
    strum_error error;
    strum_catenary profile;
    if (strum_catenary_from_sag(0, 0.9, &profile, &error) != STRUM_OK)
        return fail(&error);

    strum_forced_params params = STRUM_FORCED_PARAMS_INIT;
    params.cable.chi_m = profile.chi_m;
    params.cable.mu = profile.mu;
    params.frequency_max = 5;
    strum_forced *forced = NULL;
    if (strum_forced_solve(&params, NULL, &forced, &error) != STRUM_OK)
        return fail(&error);

    strum_response *response = NULL;
    strum_status status = strum_response_make(forced, &response, &error);
    strum_forced_free(forced); /* the response keeps what it needs */
    if (status != STRUM_OK)
        return fail(&error);
    int failed = print_curve(response);
    strum_response_free(response);
    return failed;
}
