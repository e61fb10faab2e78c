/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a solve may use: CPU time, memory, and how often it asks whether it may go on. */
#include <complex.h>
#include <math.h>
#include <string.h>
#include <time.h>

#include <strum/strum.h>

#include "check.h"
#include "core/numerics/arena.h"
#include "core/numerics/linalg.h"

/* Sanitizers slow the loops between two questions, not LAPACK. */
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
#define ROOM 20
#else
#define ROOM 4
#endif

static double cpu_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

typedef struct watch {
    double last, longest; /* between two questions */
    double until;         /* true from then on */
    long asked;
} watch;

static bool look(void *context)
{
    watch *w = context;
    const double now = cpu_s();
    w->longest = fmax(w->longest, now - w->last);
    w->last = now;
    w->asked++;
    return now > w->until;
}

static strum_options watched(watch *w, double for_s)
{
    *w = (watch){.last = cpu_s()};
    w->until = w->last + for_s;
    return (strum_options){.cancelled = look, .context = w};
}

/* Not one piece of the question is longer than 0.3 s of a present-day core. */
static void check_pieces(const watch *w, long least_asked)
{
    assert_true(cpu_s() - w->last < 0.3 * ROOM);
    assert_true(w->longest < 0.3 * ROOM);
    assert_true(w->asked >= least_asked);
}

static void many_inclined_modes_are_solved_in_pieces(void **state)
{
    (void)state;
    strum_inclined_params params = STRUM_INCLINED_PARAMS_INIT;
    params.cable.epsilon = 0.18;
    params.cable.inclination = 0.41;
    params.cable.lambda_squared = 38;
    params.count = STRUM_MODES_MAX;
    strum_inclined *modes;
    strum_error error;
    strum_verification v;
    watch w;
    strum_options options = watched(&w, 1e9);
    options.bytes_max = 160 << 20; /* 100 MB are used */
    assert_int_equal(strum_inclined_solve(&params, &options, &modes, &error), STRUM_OK);
    check_pieces(&w, 200);
    options = watched(&w, 1e9);
    options.bytes_max = 160 << 20;
    assert_int_equal(strum_inclined_verify(modes, &options, &v, &error), STRUM_OK);
    check_pieces(&w, 500);
    assert_int_equal(v.modes_expected, STRUM_MODES_MAX);
    options = watched(&w, 0.4); /* amid the strains' problem */
    assert_int_equal(strum_inclined_verify(modes, &options, &v, &error), STRUM_ERR_CANCELLED);
    check_pieces(&w, 2);
    strum_inclined_free(modes);
}

static void the_deepest_cable_stops_in_time(void **state)
{
    (void)state;
    strum_modes_params params = STRUM_MODES_PARAMS_INIT;
    params.cable.mu = STRUM_CHI_MAX;
    params.count = STRUM_MODES_MAX;
    params.shapes = true;
    strum_modes *modes;
    strum_error error;
    watch w;
    for (int plane = 0; plane < 2; plane++) {
        params.plane = (strum_plane)plane;
        strum_options options = watched(&w, 1);
        options.bytes_max = 160 << 20;
        assert_int_equal(strum_modes_solve(&params, &options, &modes, &error),
                         STRUM_ERR_CANCELLED);
        assert_null(modes);
        check_pieces(&w, 1);
    }
}

static void shooting_at_a_high_frequency_stops_in_time(void **state)
{
    (void)state;
    const strum_cable cable = {.chi_m = 0, .mu = 1, .mass_t = 1, .mass_n = 1};
    const strum_end_motion motion = {.tangential = 1};
    strum_forced_point points[3] = {{.chi = -1}, {.chi = 0}, {.chi = 1}};
    strum_error error;
    watch w;
    const strum_options options = watched(&w, 0.01);
    const strum_status status =
        strum_forced_shoot(&cable, 1e6, &motion, points, 3, &options, &error);
    assert_true(status == STRUM_ERR_CANCELLED || status == STRUM_ERR_ACCURACY);
    check_pieces(&w, 2);
}

static const strum_modes_params several = {
    {.chi_m = 0.3, .mu = 1.5, .mass_t = 1, .mass_n = 1}, STRUM_IN_PLANE, 40, true};

/* At every limit from nothing on: the error says what ran out, or the modes are the same. */
static void memory_is_bounded(void **state)
{
    (void)state;
    strum_modes *modes = NULL, *free_of_limits;
    strum_error error;
    strum_mode a, b;
    strum_verification v;
    assert_int_equal(strum_modes_solve(&several, NULL, &free_of_limits, &error), STRUM_OK);
    strum_options options = STRUM_OPTIONS_INIT;
    int refused = 0;
    for (options.bytes_max = 1000;; options.bytes_max *= 2, refused++) {
        const strum_status status = strum_modes_solve(&several, &options, &modes, &error);
        if (status == STRUM_OK)
            break;
        assert_int_equal(status, STRUM_ERR_BYTES);
        assert_non_null(strstr(error.reason, "memory"));
        assert_null(modes);
    }
    assert_true(refused > 5);
    assert_true(options.bytes_max < 64 << 20);
    for (size_t i = 0; i < 40; i++) {
        assert_int_equal(strum_modes_get(modes, i, &a), STRUM_OK);
        assert_int_equal(strum_modes_get(free_of_limits, i, &b), STRUM_OK);
        assert_memory_equal(&a.frequency, &b.frequency, sizeof a.frequency);
    }
    options.bytes_max = 100000;
    assert_int_equal(strum_modes_verify(modes, &options, &v, &error), STRUM_ERR_BYTES);
    strum_modes_free(modes);
    strum_modes_free(free_of_limits);
}

static void every_solve_counts_its_memory(void **state)
{
    (void)state;
    const strum_options options = {.bytes_max = 20000};
    strum_error error;
    strum_inclined_params inclined = STRUM_INCLINED_PARAMS_INIT;
    inclined.cable.epsilon = 0.1;
    strum_inclined *modes;
    for (int model = STRUM_INCLINED_FULL; model <= STRUM_INCLINED_IRVINE; model++) {
        inclined.model = (strum_inclined_model)model;
        assert_int_equal(strum_inclined_solve(&inclined, &options, &modes, &error),
                         STRUM_ERR_BYTES);
        assert_null(modes);
    }
    strum_forced_params forced = STRUM_FORCED_PARAMS_INIT;
    forced.cable = several.cable;
    forced.frequency_max = 5;
    strum_forced *f;
    assert_int_equal(strum_forced_solve(&forced, &options, &f, &error), STRUM_ERR_BYTES);
    assert_null(f);
}

static void cpu_time_is_bounded(void **state)
{
    (void)state;
    strum_modes_params params = STRUM_MODES_PARAMS_INIT;
    params.cable.mu = STRUM_CHI_MAX;
    params.count = STRUM_MODES_MAX;
    params.shapes = true;
    const strum_options options = {.cpu_seconds = 0.05}, plenty = {.cpu_seconds = 3600};
    strum_modes *modes;
    strum_error error;
    const double begun = cpu_s();
    assert_int_equal(strum_modes_solve(&params, &options, &modes, &error), STRUM_ERR_TIME);
    assert_null(modes);
    assert_non_null(strstr(error.reason, "CPU time"));
    assert_true(cpu_s() - begun < 0.35 * ROOM);
    assert_int_equal(strum_modes_solve(&several, &plenty, &modes, &error), STRUM_OK);
    strum_modes_free(modes);
}

/* What is freed is free again. */
static void an_arena_gives_back(void **state)
{
    (void)state;
    work w = work_begin(&(strum_options){.bytes_max = 10000});
    for (int i = 0; i < 100; i++) {
        arena a = {.work = &w};
        assert_non_null(arena_doubles(&a, 1000));
        assert_true(w.bytes >= 8000);
        arena_free(&a);
        assert_int_equal(w.bytes, 0);
    }
    assert_int_equal(w.status, STRUM_OK);
    arena a = {.work = &w};
    assert_null(arena_doubles(&a, 2000));
    assert_int_equal(w.status, STRUM_ERR_BYTES);
    assert_int_equal(work_poll(&w), STRUM_ERR_BYTES);
    arena_free(&a);
}

/* 1/(i + j + 1) and its like: A v = mu B v in pieces, against what a pair must satisfy. */
static void check_pairs(int n, int want)
{
    const size_t size = (size_t)n;
    arena a = {0};
    double *s = arena_doubles(&a, size * size), *b = arena_doubles(&a, size * size);
    double *mu = arena_doubles(&a, size), *v = arena_doubles(&a, size * (size_t)want);
    for (size_t j = 0; j < size; j++)
        for (size_t i = 0; i < size; i++) {
            s[i + j * size] = 1.0 / (double)(1 + i + j) + (i == j ? 1.0 / (double)(1 + i) : 0);
            b[i + j * size] = (i == j ? 2 : 0) + 0.5 / (1 + fabs((double)i - (double)j));
        }
    assert_int_equal(linalg_symmetric(n, s, n, b, n, want, mu, v, NULL), STRUM_OK);
    const int some[] = {0, want / 2, want - 1};
    for (size_t k = 0; k < 3; k++) {
        const double *x = v + (size_t)some[k] * size;
        double worst = 0;
        for (size_t i = 0; i < size; i++) {
            double left = 0, right = 0;
            for (size_t j = 0; j < size; j++) {
                left += s[i + j * size] * x[j];
                right += b[i + j * size] * x[j];
            }
            worst = fmax(worst, fabs(left - mu[some[k]] * right));
        }
        assert_true(worst < 1e-12);
    }
    arena_free(&a);
}

static void large_eigenproblems_go_in_pieces(void **state)
{
    (void)state;
    check_pairs(710, 710);
    check_pairs(1300, 5);
}

/* A matrix of rank 40 and 1300 rows is the product of its factor. */
static void a_large_semidefinite_matrix_keeps_its_rank(void **state)
{
    (void)state;
    enum { N = 1300, RANK = 40 };
    arena a = {0};
    double *s = arena_doubles(&a, (size_t)N * N), *l = arena_doubles(&a, (size_t)N * N);
    double *f = arena_doubles(&a, (size_t)N * RANK);
    int rank = 0;
    for (int i = 0; i < N; i++)
        for (int k = 0; k < RANK; k++)
            f[i + k * N] = cos(0.37 * (i + 1) * (k + 1) + k);
    linalg_multiply('N', 'T', N, N, RANK, f, N, f, N, s, N);
    assert_int_equal(linalg_semidefinite_root(N, s, N, l, &rank, NULL), STRUM_OK);
    /* and some of rounding, of which one is as large as the tolerance */
    assert_true(rank >= RANK && rank < N / 4);
    double worst = 0;
    for (int i = 0; i < N; i += 7)
        for (int j = 0; j < N; j += 11) {
            double sum = 0;
            for (int k = 0; k < rank; k++)
                sum += l[i + k * N] * l[j + k * N];
            worst = fmax(worst, fabs(sum - s[i + j * N]));
        }
    assert_true(worst < 1e-11);
    arena_free(&a);
}

/* (z^2 + c_i z + m_i) h_i.g = 0, h_i the columns of a reflection: roots in closed form, some of
 * them real. */
static void a_large_quadratic_problem_has_its_roots(void **state)
{
    (void)state;
    enum { N = 260 };
    arena a = {0};
    double *c = arena_doubles(&a, N * N), *m = arena_doubles(&a, N * N);
    double _Complex *z = arena_alloc(&a, 2 * N, sizeof *z);
    double _Complex *g = arena_alloc(&a, 2 * N * N, sizeof *g),
                    *only = arena_alloc(&a, 2 * N, 16);
    double damping[N], stiffness[N];
    for (int k = 0; k < N; k++) {
        damping[k] = k % 3 == 0 ? 0.02 : 0.503 + 0.01 * k; /* none is critical */
        stiffness[k] = pow(0.05 + 0.01 * k, 2);
    }
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            double cc = 0, mm = 0; /* H = I - 2 v v'/N, v = (1, -1, 1, ..) */
            for (int k = 0; k < N; k++) {
                const double hi = (i == k) - 2.0 / N * ((i + k) % 2 ? -1 : 1);
                const double hj = (j == k) - 2.0 / N * ((j + k) % 2 ? -1 : 1);
                cc += hi * damping[k] * hj;
                mm += hi * stiffness[k] * hj;
            }
            c[i + j * N] = cc;
            m[i + j * N] = mm;
        }
    assert_int_equal(linalg_quadratic(N, c, m, z, g, NULL), STRUM_OK);
    assert_int_equal(linalg_quadratic(N, c, m, only, NULL, NULL), STRUM_OK);
    int real = 0;
    for (int k = 0; k < N; k++) {
        const double _Complex half = csqrt(damping[k] * damping[k] / 4 - stiffness[k]);
        real += cimag(half) == 0;
        for (int sign = -1; sign <= 1; sign += 2) {
            const double _Complex want = -damping[k] / 2 + sign * half;
            double nearest = INFINITY, alone = INFINITY;
            for (int i = 0; i < 2 * N; i++) {
                nearest = fmin(nearest, cabs(z[i] - want));
                alone = fmin(alone, cabs(only[i] - want));
            }
            assert_true(nearest < 1e-9 && alone < 1e-9);
        }
    }
    assert_true(real > 10 && real < N - 10);
    for (int k = 0; k < 2 * N; k += 7) {
        double size = 0, worst = 0;
        for (int i = 0; i < N; i++) {
            double _Complex left = z[k] * z[k] * g[i + k * N];
            for (int j = 0; j < N; j++)
                left += (z[k] * c[i + j * N] + m[i + j * N]) * g[j + k * N];
            size = fmax(size, cabs(g[i + k * N]));
            worst = fmax(worst, cabs(left));
        }
        assert_true(worst < 1e-10 * size);
    }
    arena_free(&a);
}

/* Damping that is not proportional to mass, off the level: the quadratic problem of 540. */
static void damped_modes_are_solved_in_pieces(void **state)
{
    (void)state;
    const strum_modes_params params = {
        {.chi_m = 0.5, .mu = 2.5, .mass_t = 1, .mass_n = 1, .eta_n = 0.2},
        STRUM_IN_PLANE,
        60,
        true};
    strum_modes *modes;
    strum_error error;
    strum_verification v;
    watch w;
    strum_options options = watched(&w, 1e9);
    assert_int_equal(strum_modes_solve(&params, &options, &modes, &error), STRUM_OK);
    check_pieces(&w, 300);
    options = watched(&w, 1e9);
    assert_int_equal(strum_modes_verify(modes, &options, &v, &error), STRUM_OK);
    check_pieces(&w, 100);
    assert_true(v.max_relative_difference < 1e-12);
    assert_int_equal(v.modes_expected, v.modes_found);
    strum_modes_free(modes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(many_inclined_modes_are_solved_in_pieces),
        cmocka_unit_test(the_deepest_cable_stops_in_time),
        cmocka_unit_test(shooting_at_a_high_frequency_stops_in_time),
        cmocka_unit_test(memory_is_bounded),
        cmocka_unit_test(every_solve_counts_its_memory),
        cmocka_unit_test(cpu_time_is_bounded),
        cmocka_unit_test(an_arena_gives_back),
        cmocka_unit_test(large_eigenproblems_go_in_pieces),
        cmocka_unit_test(a_large_quadratic_problem_has_its_roots),
        cmocka_unit_test(damped_modes_are_solved_in_pieces),
        cmocka_unit_test(a_large_semidefinite_matrix_keeps_its_rank),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
