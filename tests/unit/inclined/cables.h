/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inclined cables, and their modes by a model, for the tests of this folder. */
#ifndef TESTS_UNIT_INCLINED_CABLES_H
#define TESTS_UNIT_INCLINED_CABLES_H

#include <strum/strum.h>

#include <stdlib.h>

#include "check.h"

#define COUNT(list) (int)(sizeof(list) / sizeof *(list))
static const double degree = M_PI / 180;

static inline double uniform(double low, double high)
{
    return low + (high - low) * (rand() / (double)RAND_MAX);
}

static inline strum_inclined_cable taut(double epsilon, double degrees, double lambda_squared,
                                        double h)
{
    return (strum_inclined_cable){.epsilon = epsilon,
                                  .inclination = degrees * degree,
                                  .lambda_squared = lambda_squared,
                                  .mass_ratio = h};
}

static inline strum_status solve(const strum_inclined_cable *cable, strum_inclined_model model,
                                 size_t count, strum_inclined **modes, strum_error *error)
{
    const strum_inclined_params params = {.cable = *cable, .model = model, .count = count};
    return strum_inclined_solve(&params, NULL, modes, error);
}

static inline strum_inclined *solved(const strum_inclined_cable *cable,
                                     strum_inclined_model model, int count)
{
    strum_inclined *modes;
    strum_error error = {0};
    if (solve(cable, model, (size_t)count, &modes, &error) != STRUM_OK)
        fail_msg("epsilon %.17g, %.17g rad, lambda^2 %.17g, model %d: %s", cable->epsilon,
                 cable->inclination, cable->lambda_squared, (int)model, error.reason);
    assert_int_equal(strum_inclined_count(modes), count);
    return modes;
}

static inline strum_inclined_mode mode_at(const strum_inclined *modes, int i)
{
    strum_inclined_mode mode;
    assert_int_equal(strum_inclined_get(modes, (size_t)i, &mode), STRUM_OK);
    return mode;
}

static inline double kl(const strum_inclined *modes, int mode)
{
    return mode_at(modes, mode - 1).kl;
}

#endif
