/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Damped modes of a chain: 50 m of taut cable with a mass that hangs at mid-span on a spring
 * and a damper (the question about a taut cable in README.md).
 *
 *     cc chain.c $(pkg-config --cflags --libs strum) -lm -o chain
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <strum/strum.h>

#define TWO_PI 6.283185307179586

static int fail(const strum_error *error)
{
    fprintf(stderr, "%s\n",
            error->reason[0] != '\0' ? error->reason : strum_status_text(error->status));
    return 1;
}

static strum_taut_component half_of_the_cable(void)
{
    strum_taut_component cable;
    memset(&cable, 0, sizeof cable);
    cable.kind = STRUM_TAUT_CABLE;
    cable.tension_left = cable.tension_right = 5000; /* N */
    cable.cable.length = 25;                         /* m */
    cable.cable.mass_per_length = 1;                 /* kg/m */
    return cable;
}

static strum_taut_component absorber(void)
{
    strum_taut_component hanging;
    memset(&hanging, 0, sizeof hanging);
    hanging.kind = STRUM_TAUT_HANGING;
    hanging.hanging.mass = 5;          /* kg */
    hanging.hanging.stiffness = 68.45; /* N/m */
    hanging.hanging.damping = 15;      /* N s/m */
    return hanging;
}

int main(void)
{
    strum_error error;
    strum_taut_component components[3] = {half_of_the_cable(), absorber(), half_of_the_cable()};
    strum_taut *chain = NULL;
    if (strum_taut_make(components, 3, STRUM_TAUT_FIXED, STRUM_TAUT_FIXED, &chain, &error) !=
        STRUM_OK)
        return fail(&error);

    const long numbers[] = {1, 2};
    strum_taut_query query;
    memset(&query, 0, sizeof query);
    query.numbers = numbers;
    query.count = 2;
    query.method = STRUM_TAUT_CERTIFIED;
    strum_taut_roots *roots = NULL;
    strum_status status = strum_taut_solve(chain, &query, NULL, &roots, &error);
    strum_taut_free(chain);
    if (status != STRUM_OK)
        return fail(&error);

    printf("mode  Hz  damping ratio\n");
    for (size_t i = 0; i < roots->count; i++) {
        const strum_taut_root *root = &roots->roots[i];
        printf("%ld  %.12g  %.12g\n", root->mode, root->frequency / TWO_PI,
               root->decay / hypot(root->frequency, root->decay));
    }
    strum_taut_roots_free(roots);
    return 0;
}
