/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tension and bending stiffness of a stay from ten frequencies, with all that is said beside them. */
#include <strum/identify.h>

#include "bench.h"

static const double frequencies[] = {0.43,  0.857, 1.286, 1.71,  2.143,
                                     2.578, 3.012, 3.443, 3.883, 4.322};
static const double deviations[] = {2e-3, 2e-3, 2e-3, 2e-3, 2e-3, 2e-3, 2e-3, 2e-3, 2e-3, 2e-3};
static const int modes[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};

static void solve(void *data)
{
    strum_identify *found = NULL;
    if (strum_identify_solve(data, NULL, &found, NULL) != STRUM_OK)
        abort();
    strum_identify_free(found);
}

int main(void)
{
    strum_identify_params p = STRUM_IDENTIFY_PARAMS_INIT;
    p.frequencies = frequencies;
    p.standard_deviations = deviations;
    p.modes = modes;
    p.count = 10;
    p.quantities[STRUM_IDENTIFY_TENSION].unknown = true;
    p.quantities[STRUM_IDENTIFY_BENDING].unknown = true;
    p.quantities[STRUM_IDENTIFY_LENGTH].value = 177.168;
    p.quantities[STRUM_IDENTIFY_MASS].value = 51.6;
    p.ends[0].kind = p.ends[1].kind = STRUM_IDENTIFY_CLAMPED;
    bench_time("identify/stay-ten-frequencies/strum", bench_median_us(solve, &p, 21));
    return 0;
}
