/* SPDX-License-Identifier: GPL-3.0-or-later */
/* In-plane frequencies of suspended cables: libstrum against Gale's algorithm, and its growth
 * with the number of modes. With an argument GEOMETRY MODES it only solves in a loop, for a
 * profiler. */
#include <math.h>
#include <string.h>

#include <strum/strum.h>

#include "bench.h"
#include "gale.h"

#define MODES 6

typedef struct geometry {
    const char *name;
    double rise_to_span, sag_parameter;
} geometry;

/* Of his table B-3: level, from shallow to deep, and inclined. */
static const geometry geometries[] = {
    {"level-0.95", 0, 0.95},           {"level-0.85", 0, 0.85},
    {"level-0.60", 0, 0.60},           {"inclined-0.25-0.90", 0.25, 0.90},
    {"inclined-0.50-0.80", 0.5, 0.80},
};

typedef struct task {
    strum_cable cable;
    int count;
    gale_cable gale;
    double omega[STRUM_MODES_MAX], step, highest;
    int found;
} task;

static void fail(const char *name, const char *why)
{
    fprintf(stderr, "bench_catenary: %s: %s\n", name, why);
    exit(1);
}

static void solve(void *data)
{
    task *t = data;
    strum_modes *spectrum;
    strum_error fault = {0};
    if (strum_modes_solve(&(strum_modes_params){t->cable, STRUM_IN_PLANE, t->count, false},
                          NULL, &spectrum, &fault) != STRUM_OK)
        fail("strum_modes_solve", fault.reason);
    for (int i = 0; i < t->count; i++) {
        strum_mode mode;
        if (strum_modes_get(spectrum, (size_t)i, &mode) != STRUM_OK)
            fail("strum_modes_get", "no such mode");
        t->omega[i] = mode.frequency;
    }
    strum_modes_free(spectrum);
}

/* As he ran it: a guess for every mode (1 % off), his stop rule. */
static void gale_as_run(void *data)
{
    task *t = data;
    t->gale.determinants = 0;
    for (int i = 0; i < MODES; i++)
        (void)gale_frequency(&t->gale, t->omega[i] * (i % 2 == 0 ? 1.01 : 0.99));
}

static void gale_alone(void *data)
{
    task *t = data;
    double omega[MODES];
    t->gale.determinants = 0;
    t->found = gale_scan(&t->gale, t->step, t->highest, 1e-12, MODES, omega);
    for (int i = 0; i < t->found; i++)
        if (!(fabs(omega[i] / t->omega[i] - 1) < 1e-12))
            t->found = 0;
}

static task task_of(const geometry *g, int count)
{
    strum_catenary c;
    if (strum_catenary_from_sag(g->rise_to_span, g->sag_parameter, &c, NULL) != STRUM_OK)
        fail(g->name, "no such cable");
    task t = {.cable = {.chi_m = c.chi_m, .mu = c.mu, .mass_t = 1, .mass_n = 1},
              .count = count,
              .gale = {.xi_1 = strum_xi_of_chi(c.chi_m - c.mu),
                       .xi_2 = strum_xi_of_chi(c.chi_m + c.mu),
                       .match = 0.7,
                       .terms = 80}};
    return t;
}

static double least_against_run = INFINITY, least_alone = INFINITY;

static void compare(const geometry *g)
{
    char name[100];
    task t = task_of(g, MODES);
    const double ours = bench_median_us(solve, &t, 15);
    snprintf(name, sizeof name, "catenary/%s/strum-6-modes", g->name);
    bench_time(name, ours);

    const double as_run = bench_median_us(gale_as_run, &t, 15);
    snprintf(name, sizeof name, "catenary/%s/gale-as-run-%d-determinants", g->name,
             t.gale.determinants);
    bench_time(name, as_run);
    least_against_run = fmin(least_against_run, as_run / ours);

    /* 80 terms and 0.7 do not give 1e-12 in all of these; nothing is known of the spacing, so
     * that the scan must be finer than any pair that may be met */
    t.gale.terms = 120;
    t.gale.match = 0.6;
    t.highest = 1.2 * t.omega[MODES - 1];
    t.step = t.omega[MODES - 1] / MODES / 16;
    const double alone = bench_median_us(gale_alone, &t, 15);
    snprintf(name, sizeof name, "catenary/%s/gale-no-guesses-1e-12-%d-determinants", g->name,
             t.gale.determinants);
    if (t.found != MODES)
        fail(g->name, "Gale's method did not reach 1e-12");
    bench_time(name, alone);
    least_alone = fmin(least_alone, alone / ours);
}

static void grow(void)
{
    static const int counts[] = {6, 20, 60, 200};
    double before = 0, exponent = 0;
    for (int i = 0; i < 4; i++) {
        task t = task_of(&geometries[1], counts[i]);
        char name[100];
        const double us = bench_median_us(solve, &t, 7);
        snprintf(name, sizeof name, "catenary/growth/%d-modes", counts[i]);
        bench_time(name, us);
        if (i > 0)
            exponent =
                fmax(exponent, log(us / before) / log((double)counts[i] / counts[i - 1]));
        before = us;
    }
    bench_ratio("catenary/growth-exponent", exponent, "at-most", 2.5);
}

int main(int argc, char **argv)
{
    const size_t count = sizeof geometries / sizeof *geometries;
    if (argc == 4) {
        for (size_t i = 0; i < count; i++)
            if (strcmp(geometries[i].name, argv[1]) == 0) {
                task t = task_of(&geometries[i], atoi(argv[2]));
                for (int k = 0; k < atoi(argv[3]); k++)
                    solve(&t);
            }
        return 0;
    }
    for (size_t i = 0; i < count; i++)
        compare(&geometries[i]);
    bench_ratio("catenary/gale-no-guesses-over-strum", least_alone, "at-least", 10);
    bench_ratio("catenary/gale-as-run-over-strum", least_against_run, "at-least", 1);
    grow();
    return 0;
}
