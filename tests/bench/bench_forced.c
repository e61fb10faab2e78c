/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A forced tension curve of 1000 frequencies against one modal solution, which it starts with.
 */
#include <strum/strum.h>

#include "bench.h"

enum { FREQUENCIES = 1000 };

typedef struct task {
    strum_cable cable;
    double highest;
    strum_forced *forced;
    strum_response *response;
    double sum; /* keeps the work from being dropped */
} task;

static void make(void *data)
{
    task *t = data;
    strum_forced *forced;
    if (strum_forced_solve(&(strum_forced_params){t->cable, t->highest, true, false}, NULL,
                           &forced, NULL) != STRUM_OK)
        exit(1);
    strum_forced_free(forced);
}

static void curve(void *data)
{
    task *t = data;
    const strum_end_motion motion = {0.01, 0, 0};
    for (int i = 0; i < FREQUENCIES; i++) {
        strum_peak peak;
        if (strum_response_solve(t->response, t->highest * i / (FREQUENCIES - 1), &motion,
                                 NULL) == STRUM_OK) {
            strum_response_peak(t->response, &peak);
            t->sum += peak.tension;
        }
    }
}

int main(void)
{
    static const double rises[] = {0, 0.3};
    static const char *const names[] = {"level-0.90", "inclined-0.30-0.90"};
    double worst = 0;
    char name[80];
    for (int i = 0; i < 2; i++) {
        strum_catenary c;
        if (strum_catenary_from_sag(rises[i], 0.9, &c, NULL) != STRUM_OK)
            return 1;
        task t = {.cable = {.chi_m = c.chi_m, .mu = c.mu, .mass_t = 1, .mass_n = 1},
                  .highest = 10};
        const double once = bench_median_us(make, &t, 15);
        if (strum_forced_solve(&(strum_forced_params){t.cable, t.highest, true, false}, NULL,
                               &t.forced, NULL) != STRUM_OK)
            return 1;
        if (strum_response_make(t.forced, &t.response, NULL) != STRUM_OK)
            return 1;
        const double all = once + bench_median_us(curve, &t, 7);
        (void)snprintf(name, sizeof name, "forced/%s/modal-solution", names[i]);
        bench_time(name, once);
        (void)snprintf(name, sizeof name, "forced/%s/curve-of-1000", names[i]);
        bench_time(name, all);
        worst = all / once > worst ? all / once : worst;
        strum_response_free(t.response);
        strum_forced_free(t.forced);
    }
    bench_ratio("forced/curve-over-modal-solution", worst, "at-most", 3);
    return 0;
}
