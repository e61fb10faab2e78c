/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Taut chains: 500 modes of a cable with 380 masses, each certain by the exact count, against a
 * finite element model accurate to 1e-6 whose eigenvalues LAPACK finds by bisection (dstebz);
 * how the time grows with masses and modes; and damped bands with their certificate, against
 * the quadratic eigenproblem of finite elements.
 */
#include <lapacke.h>
#include <math.h>

#include <strum/strum.h>

#include "bench.h"

#define LENGTH   2000.0
#define TENSION  20000.0
#define MASS     2.0
#define ACCURACY 1e-6

typedef struct task {
    int masses, modes;
    double *x, *m; /* masses: places and values */
    strum_taut *chain;
    long *numbers;
    double *w;
    strum_taut_query query;
    const strum_taut_roots *found;
} task;

static void fail(const char *name, const char *why)
{
    fprintf(stderr, "bench_taut: %s: %s\n", name, why);
    exit(1);
}

static void *room(size_t count, size_t size)
{
    void *memory = calloc(count, size);
    if (memory == NULL)
        fail("room", "no memory");
    return memory;
}

static strum_taut_component cable(double length, double drag)
{
    return (strum_taut_component){.kind = STRUM_TAUT_CABLE,
                                  .tension_left = TENSION,
                                  .tension_right = TENSION,
                                  .cable = {length, MASS, drag}};
}

/* Unevenly spaced, uneven masses: x_i = L (i + .35 sin 2.1 i)/(N + 1), 3 + 2 sin(1.3 i + .4)
 * kg. */
static task many_masses(int masses, int modes, double drag)
{
    task t = {.masses = masses, .modes = modes};
    strum_taut_component *parts = room(2 * (size_t)masses + 1, sizeof *parts);
    t.x = room((size_t)masses, sizeof *t.x);
    t.m = room((size_t)masses, sizeof *t.m);
    t.numbers = room((size_t)modes, sizeof *t.numbers);
    t.w = room((size_t)modes, sizeof *t.w);
    double before = 0.0;
    for (int i = 1; i <= masses; i++) {
        t.x[i - 1] = round(1000.0 * LENGTH * (i + 0.35 * sin(2.1 * i)) / (masses + 1)) / 1000.0;
        t.m[i - 1] = round(1000.0 * (3.0 + 2.0 * sin(1.3 * i + 0.4))) / 1000.0;
        parts[2 * i - 2] = cable(t.x[i - 1] - before, drag);
        parts[2 * i - 1] = (strum_taut_component){.kind = STRUM_TAUT_GROUND,
                                                  .ground = {.inertance = t.m[i - 1]}};
        before = t.x[i - 1];
    }
    parts[2 * masses] = cable(LENGTH - before, drag);
    strum_error fault = {0};
    if (strum_taut_make(parts, 2 * (size_t)masses + 1, STRUM_TAUT_FIXED, STRUM_TAUT_FIXED,
                        &t.chain, &fault) != STRUM_OK)
        fail("many masses", fault.reason);
    for (int k = 0; k < modes; k++)
        t.numbers[k] = k + 1;
    free(parts);
    return t;
}

static void end(task *t)
{
    strum_taut_free(t->chain);
    free(t->x);
    free(t->m);
    free(t->numbers);
    free(t->w);
}

static void frequencies(void *data)
{
    task *t = data;
    strum_error fault = {0};
    if (strum_taut_frequencies(t->chain, t->numbers, (size_t)t->modes, NULL, t->w, &fault) !=
        STRUM_OK)
        fail("strum_taut_frequencies", fault.reason);
}

static void roots(void *data)
{
    task *t = data;
    strum_taut_roots *found;
    strum_error fault = {0};
    if (strum_taut_solve(t->chain, &t->query, NULL, &found, &fault) != STRUM_OK)
        fail("strum_taut_solve", fault.reason);
    strum_taut_roots_free(found);
}

/* ---- finite elements ---- */

/* Spectral elements as accurate as the roots, all eigenvalues by LAPACK (dgeev). */
static void damped_elements(void *data)
{
    const task *t = data;
    strum_verification v;
    strum_error fault = {0};
    if (strum_taut_verify(t->chain, t->found, NULL, &v, &fault) != STRUM_OK)
        fail("strum_taut_verify", fault.reason);
    if (v.modes_expected != t->found->expected || !(v.max_relative_difference < 1e-9))
        fail("damped elements", "they do not agree");
}

/* Linear elements with lumped masses, nodes at all attached masses; the smallest eigenvalues of
 * M^{-1/2} K M^{-1/2} by bisection. The dispersion (k h)^2/24 of the highest mode sets h.
 * Returns the largest relative error of the frequencies. */
static double finite_elements(const task *t, double *us)
{
    const double k = t->w[t->modes - 1] * sqrt(MASS / TENSION);
    const double h = sqrt(24.0 * 0.75 * ACCURACY) / k;
    const int most = (int)(LENGTH / h) + 2 * t->masses + 10;
    double *mass = room((size_t)most, sizeof *mass),
           *spring = room((size_t)most, sizeof *spring);
    int n = 0; /* free nodes so far; spring[i] is left of node i */
    for (int s = 0; s <= t->masses; s++) {
        const double from = s == 0 ? 0.0 : t->x[s - 1], to = s == t->masses ? LENGTH : t->x[s];
        const int elements = (int)ceil((to - from) / h);
        const double each = (to - from) / elements;
        for (int e = 0; e < elements; e++) {
            spring[n] = TENSION / each;
            if (n > 0)
                mass[n - 1] += 0.5 * MASS * each;
            mass[n] += 0.5 * MASS * each;
            n++;
        }
        if (s < t->masses)
            mass[n - 1] += t->m[s];
    }
    const int size = n - 1; /* the last node is held */
    double *d = room((size_t)size, sizeof *d), *e = room((size_t)size, sizeof *e),
           *values = room((size_t)size, sizeof *values);
    lapack_int *block = room((size_t)size, sizeof *block),
               *split = room((size_t)size, sizeof *split);
    for (int i = 0; i < size; i++) {
        d[i] = (spring[i] + spring[i + 1]) / mass[i];
        if (i + 1 < size)
            e[i] = -spring[i + 1] / sqrt(mass[i] * mass[i + 1]);
    }
    lapack_int found, blocks;
    /* to a tenth of the discretisation's error, of the lowest eigenvalue too */
    const double tolerance = 0.1 * ACCURACY * t->w[0] * t->w[0];
    const double begin = bench_now_us();
    const lapack_int info = LAPACKE_dstebz('I', 'E', size, 0.0, 0.0, 1, t->modes, tolerance, d,
                                           e, &found, &blocks, values, block, split);
    *us = bench_now_us() - begin;
    if (info != 0 || found != t->modes)
        fail("dstebz", "it did not find the eigenvalues");
    double error = 0.0;
    for (int i = 0; i < t->modes; i++)
        error = fmax(error, fabs(sqrt(values[i]) / t->w[i] - 1.0));
    printf("finite elements: %d unknowns, largest error %.2e\n", size, error);
    free(mass);
    free(spring);
    free(d);
    free(e);
    free(values);
    free(block);
    free(split);
    return error;
}

static void against_finite_elements(void)
{
    task t = many_masses(380, 500, 0.0);
    const double ours = bench_median_us(frequencies, &t, 15);
    bench_time("taut/380-masses-500-modes/strum", ours);
    /* all counts are exact: mode k is the k-th */
    for (int i = 0; i < t.modes; i++)
        if (strum_taut_count(t.chain, t.w[i] * (1.0 - 1e-11)) != i ||
            strum_taut_count(t.chain, t.w[i] * (1.0 + 1e-11)) != i + 1)
            fail("380 masses", "a count is wrong");
    double us;
    if (!(finite_elements(&t, &us) < 1.2 * ACCURACY))
        fail("finite elements", "not as accurate as they should be");
    bench_time("taut/380-masses-500-modes/finite-elements-1e-6-dstebz", us);
    bench_ratio("taut/dstebz-over-strum", us / ours, "at-least", 10);
    end(&t);
}

/* Largest exponent of the time between successive sizes. */
static double grow(const int *masses, const int *modes, int count)
{
    double before = 0.0, exponent = 0.0;
    for (int i = 0; i < count; i++) {
        task t = many_masses(masses[i], modes[i], 0.0);
        char name[100];
        const double us = bench_median_us(frequencies, &t, 7);
        snprintf(name, sizeof name, "taut/growth/%d-masses-%d-modes", masses[i], modes[i]);
        bench_time(name, us);
        if (i > 0) {
            const double size = (double)masses[i] * modes[i] / masses[i - 1] / modes[i - 1];
            exponent = fmax(exponent, log(us / before) / log(size));
        }
        before = us;
        end(&t);
    }
    return exponent;
}

/* Levesque's baseline system: two links of 9 kg in the middle of 50 m. */
static void damped_band(void)
{
    const strum_taut_link links[2] = {{0.2, 0.2, 9.0, 0.12}, {0.2, 0.2, 9.0, 0.12}};
    const strum_taut_joint joint = {0.03, 0.03, 10.0, 2240.0, 5000.0};
    strum_taut_component parts[3] = {{.kind = STRUM_TAUT_CABLE,
                                      .tension_left = 5000.0,
                                      .tension_right = 5000.0,
                                      .cable = {25.0, 1.0, 0.0}}};
    parts[2] = parts[0];
    parts[1] = (strum_taut_component){.kind = STRUM_TAUT_BODY,
                                      .tension_left = 5000.0,
                                      .tension_right = 5000.0,
                                      .body = {links, &joint, 2}};
    task t = {.query = {.lowest = 0.5, .highest = 200.3, .max_decay = 40.0}};
    strum_error fault = {0};
    if (strum_taut_make(parts, 3, STRUM_TAUT_FIXED, STRUM_TAUT_FIXED, &t.chain, &fault) !=
        STRUM_OK)
        fail("baseline", fault.reason);
    bench_time("taut/baseline-47-damped-roots-certified", bench_median_us(roots, &t, 15));
    /* as much of it as the elements resolve with 400 unknowns */
    t.query.highest = 150.0;
    const double ours = bench_median_us(roots, &t, 15);
    bench_time("taut/baseline-35-damped-roots/strum", ours);
    strum_taut_roots *found;
    if (strum_taut_solve(t.chain, &t.query, NULL, &found, &fault) != STRUM_OK)
        fail("baseline", fault.reason);
    if (found->expected != 35 || found->found != 35)
        fail("baseline", "35 roots are right");
    t.found = found;
    const double theirs = bench_median_us(damped_elements, &t, 3);
    bench_time("taut/baseline-35-damped-roots/spectral-elements-dgeev", theirs);
    bench_ratio("taut/damped-dgeev-over-strum", theirs / ours, "at-least", 10);
    strum_taut_roots_free(found);
    strum_taut_free(t.chain);
    /* a long chain, every mode damped */
    task many = many_masses(380, 1, 0.1);
    many.query = (strum_taut_query){.lowest = 0.01, .highest = 14.0, .max_decay = 5.0};
    bench_time("taut/380-masses-101-damped-roots-certified", bench_median_us(roots, &many, 3));
    end(&many);
}

int main(void)
{
    against_finite_elements();
    const int masses[3] = {100, 316, 1000}, hundred[3] = {100, 100, 100};
    bench_ratio("taut/growth-exponent-masses", grow(masses, hundred, 3), "at-most", 1.15);
    const int same[3] = {380, 380, 380}, modes[3] = {100, 316, 1000};
    bench_ratio("taut/growth-exponent-modes", grow(same, modes, 3), "at-most", 1.3);
    damped_band();
    return 0;
}
