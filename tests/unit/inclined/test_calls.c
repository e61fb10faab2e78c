/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The calls of inclined.h: parameters, refusals, places of shapes, and being stopped. */
#include <malloc.h>
#include <time.h>

#include "inclined/cables.h"

/* Each refusal names its parameter; those of the calls of other headers below are not passed
 * on as if they were of this one. */
static void arguments_at_fault(void **state)
{
    (void)state;
    strum_inclined *modes;
    strum_error error;
    strum_inclined_params params = STRUM_INCLINED_PARAMS_INIT;
    assert_int_equal(strum_inclined_solve(&params, NULL, &modes, &error), STRUM_ERR_RANGE);
    assert_int_equal(error.argument, STRUM_INCLINED_ARG_EPSILON); /* it was not set */
    params.cable.epsilon = 0.2;
    params.count = 0;
    assert_int_equal(strum_inclined_solve(&params, NULL, &modes, &error), STRUM_ERR_RANGE);
    assert_int_equal(error.argument, STRUM_INCLINED_ARG_COUNT);
    params.count = 3;
    params.model = (strum_inclined_model)7;
    assert_int_equal(strum_inclined_solve(&params, NULL, &modes, &error), STRUM_ERR_RANGE);
    assert_int_equal(error.argument, STRUM_INCLINED_ARG_MODEL);
    assert_true(strum_inclined_work(&params) == 0);
    /* a slope at the upper end of asinh(tan 89 deg + 900/cos 89 deg) and more */
    params.model = STRUM_INCLINED_FULL;
    params.cable.epsilon = 999;
    params.cable.inclination = 89.89 * degree;
    assert_true(strum_inclined_solve(&params, NULL, &modes, &error) != STRUM_OK);
    assert_int_equal(error.argument, STRUM_INCLINED_ARG_EPSILON);
    params.cable = taut(1.5, 30, 40, 1);
    params.model = STRUM_INCLINED_AIRY;
    assert_int_equal(strum_inclined_solve(&params, NULL, &modes, &error), STRUM_ERR_METHOD);
    assert_int_equal(error.argument, STRUM_INCLINED_ARG_MODEL);
    assert_null(modes);
}

/* The defaults are an inextensible level cable's; statics that are handed in serve as well. */
static void parameters(void **state)
{
    (void)state;
    strum_inclined_params params = STRUM_INCLINED_PARAMS_INIT;
    strum_inclined *modes, *again;
    params.cable.epsilon = 0.05;
    assert_int_equal(strum_inclined_solve(&params, NULL, &modes, NULL), STRUM_OK);
    assert_int_equal(strum_inclined_count(modes), 6);
    check_absolute(kl(modes, 2), 8.98681891581813 + 0.1269 * 0.05 * 0.05, 1e-6);
    strum_inclined_statics statics;
    assert_int_equal(strum_inclined_statics_find(&params.cable, &statics, NULL), STRUM_OK);
    params.statics = &statics;
    assert_int_equal(strum_inclined_solve(&params, NULL, &again, NULL), STRUM_OK);
    for (int k = 1; k <= 6; k++)
        assert_true(kl(modes, k) == kl(again, k));
    strum_inclined_mode mode;
    assert_int_equal(strum_inclined_get(modes, 6, &mode), STRUM_ERR_RANGE);
    strum_inclined_free(modes);
    strum_inclined_free(again);
    strum_inclined_free(NULL);
}

/* A shape at places that are handed in, against the polynomial through nearby equally spaced
 * ones. */
static void shape_at_places(void **state)
{
    (void)state;
    for (int model = STRUM_INCLINED_FULL; model <= STRUM_INCLINED_IRVINE; model++) {
        const strum_inclined_cable cable = taut(0.3, 40, 60, 0.9);
        strum_inclined *modes = solved(&cable, (strum_inclined_model)model, 3);
        const double s[] = {1, 0.3, 0, 0.335};
        strum_inclined_point at[4], equal[101];
        assert_int_equal(strum_inclined_shape(modes, 2, s, 4, at), STRUM_OK);
        assert_int_equal(strum_inclined_shape(modes, 2, NULL, 101, equal), STRUM_OK);
        static const int index[] = {100, 30, 0};
        for (int i = 0; i < 3; i++) {
            assert_true(at[i].s == s[i]);
            check_absolute(at[i].transverse, equal[index[i]].transverse, 1e-13);
            check_absolute(at[i].longitudinal, equal[index[i]].longitudinal, 1e-13);
            check_relative(at[i].tension, equal[index[i]].tension, 1e-12);
        }
        /* Lagrange's polynomial at the middle of six equal steps' points: 3, -25, 150 */
        double middle = 0;
        static const double weights[] = {3, -25, 150, 150, -25, 3};
        for (int i = 0; i < 6; i++)
            middle += weights[i] / 256 * equal[31 + i].transverse;
        check_absolute(at[3].transverse, middle, 1e-7);
        const double outside[] = {0.5, 1.01}, unordered[] = {NAN};
        assert_int_equal(strum_inclined_shape(modes, 2, outside, 2, at), STRUM_ERR_RANGE);
        assert_int_equal(strum_inclined_shape(modes, 2, unordered, 1, at), STRUM_ERR_RANGE);
        strum_inclined_free(modes);
    }
}

/* ---- being stopped ---- */

static bool count_down(void *context)
{
    long *left = context;
    return --*left < 0;
}

/* However late it is cancelled: the code, no object, and not a byte kept. */
static void cancelled_anywhere(void **state)
{
    (void)state;
    for (int model = STRUM_INCLINED_FULL; model <= STRUM_INCLINED_IRVINE; model++) {
        const strum_inclined_params params = {
            .cable = taut(0.3, 40, 60, 0.9), .model = (strum_inclined_model)model, .count = 5};
        strum_inclined_free(solved(&params.cable, params.model, 5)); /* the libraries' own */
        const size_t before = mallinfo2().uordblks;
        long polls = 0, stops = 0;
        for (;; polls += 1 + polls / 7, stops++) {
            long left = polls;
            const strum_options options = {.cancelled = count_down, .context = &left};
            strum_inclined *modes;
            strum_error error;
            const strum_status status = strum_inclined_solve(&params, &options, &modes, &error);
            if (status == STRUM_OK) {
                strum_inclined_free(modes);
                break;
            }
            assert_int_equal(status, STRUM_ERR_CANCELLED);
            assert_int_equal(error.status, STRUM_ERR_CANCELLED);
            assert_string_equal(error.reason, strum_status_text(STRUM_ERR_CANCELLED));
            assert_null(modes);
        }
        assert_true(stops >= 3);
        strum_inclined *modes = solved(&params.cable, params.model, 5);
        const size_t solved_bytes = mallinfo2().uordblks;
        for (polls = stops = 0;; polls += 1 + polls / 7, stops++) {
            long left = polls;
            const strum_options options = {.cancelled = count_down, .context = &left};
            strum_verification v;
            const strum_status status = strum_inclined_verify(modes, &options, &v, NULL);
            if (status == STRUM_OK)
                break;
            assert_int_equal(status, STRUM_ERR_CANCELLED);
        }
        assert_true(stops >= 3);
        assert_int_equal(mallinfo2().uordblks, solved_bytes);
        strum_inclined_free(modes);
        assert_int_equal(mallinfo2().uordblks, before);
    }
}

/* Work is counted, not timed: the same limit ends the same call, and a larger one does not. */
static void work_is_limited(void **state)
{
    (void)state;
    for (int model = STRUM_INCLINED_FULL; model <= STRUM_INCLINED_IRVINE; model++) {
        const strum_inclined_params params = {
            .cable = taut(0.3, 40, 60, 0.9), .model = (strum_inclined_model)model, .count = 5};
        const double work = strum_inclined_work(&params);
        strum_options options = {.work_max = work / 20};
        strum_inclined *modes;
        strum_error error;
        assert_int_equal(strum_inclined_solve(&params, &options, &modes, &error),
                         STRUM_ERR_WORK);
        assert_null(modes);
        options.work_max = 2 * work + 100;
        assert_int_equal(strum_inclined_solve(&params, &options, &modes, &error), STRUM_OK);
        options.work_max = 1;
        strum_verification v;
        assert_int_equal(strum_inclined_verify(modes, &options, &v, &error), STRUM_ERR_WORK);
        strum_inclined_free(modes);
    }
}

static double cpu_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* How many times longer the code itself takes under a sanitizer, at most. */
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
#define SLOWER 30
#else
#define SLOWER 1
#endif

typedef struct stopper {
    double at, last, longest; /* CPU seconds: when to stop, last asked, longest silence */
} stopper;

static bool after_a_while(void *context)
{
    stopper *s = context;
    const double now = cpu_s();
    s->longest = fmax(s->longest, now - s->last);
    s->last = now;
    return now > s->at;
}

/* 200 modes by every model, and their verification, poll often enough to end in time. */
static void cancelled_in_time(void **state)
{
    (void)state;
    for (int model = STRUM_INCLINED_FULL; model <= STRUM_INCLINED_IRVINE; model++) {
        const strum_inclined_params params = {.cable = taut(0.9, 60, 5000, 0.9),
                                              .model = (strum_inclined_model)model,
                                              .count = STRUM_MODES_MAX};
        strum_inclined *modes;
        for (int pass = 0; pass < 2; pass++) {
            const double start = cpu_s();
            stopper s = {.at = pass == 0 ? start + 0.1 : INFINITY, .last = start};
            const strum_options options = {.cancelled = after_a_while, .context = &s};
            const strum_status status = strum_inclined_solve(&params, &options, &modes, NULL);
            print_message("# model %d: solve %.3f s, longest silence %.3f s\n", model,
                          cpu_s() - start, s.longest);
            if (pass == 0 && status == STRUM_OK)
                strum_inclined_free(modes);
            assert_true(status == (pass == 0 ? STRUM_ERR_CANCELLED : STRUM_OK) ||
                        (pass == 0 && cpu_s() - start < 0.2 * SLOWER));
            assert_true(pass == 1 ||
                        cpu_s() - start < 1.5 * SLOWER); /* one call of LAPACK more */
        }
        const double start = cpu_s();
        stopper s = {.at = start + 0.1, .last = start};
        const strum_options options = {.cancelled = after_a_while, .context = &s};
        strum_verification v;
        const strum_status status = strum_inclined_verify(modes, &options, &v, NULL);
        assert_true(status == STRUM_OK || status == STRUM_ERR_CANCELLED);
        print_message("# model %d: verify %.3f s, longest silence %.3f s\n", model,
                      cpu_s() - start, s.longest);
        /* the full model's second method is one eigenproblem, which LAPACK does not leave */
        assert_true(cpu_s() - start < (model == STRUM_INCLINED_FULL ? 20 : 1.5) * SLOWER);
        strum_inclined_free(modes);
    }
}

static void refusals(void **state)
{
    (void)state;
    strum_inclined *modes;
    const strum_inclined_cable good = taut(0.2, 30, 40, 1);
    strum_inclined_cable bad[5] = {good, good, good, good, good};
    bad[0].epsilon = 0;
    bad[1].inclination = M_PI / 2;
    bad[2].lambda_squared = NAN;
    bad[3].mass_ratio = 1.5;
    bad[4].inclination = -0.1;
    static const int arguments[] = {STRUM_INCLINED_ARG_EPSILON, STRUM_INCLINED_ARG_INCLINATION,
                                    STRUM_INCLINED_ARG_LAMBDA_SQUARED,
                                    STRUM_INCLINED_ARG_MASS_RATIO,
                                    STRUM_INCLINED_ARG_INCLINATION};
    for (int i = 0; i < COUNT(bad); i++) {
        strum_error error = {0};
        assert_int_equal(solve(&bad[i], STRUM_INCLINED_FULL, 3, &modes, &error),
                         STRUM_ERR_RANGE);
        assert_null(modes);
        assert_int_equal(error.status, STRUM_ERR_RANGE);
        assert_int_equal(error.argument, arguments[i]);
        assert_true(error.index == STRUM_NO_INDEX && error.reason[0] != '\0');
    }
    assert_int_equal(solve(&good, STRUM_INCLINED_FULL, 0, &modes, NULL), STRUM_ERR_RANGE);
    assert_int_equal(solve(&good, STRUM_INCLINED_FULL, STRUM_MODES_MAX + 1, &modes, NULL),
                     STRUM_ERR_RANGE);
    const strum_inclined_cable slack = taut(1.5, 30, 40, 1);
    assert_int_equal(solve(&slack, STRUM_INCLINED_AIRY, 3, &modes, NULL), STRUM_ERR_METHOD);
    assert_int_equal(solve(&slack, STRUM_INCLINED_ASYMPTOTIC, 3, &modes, NULL),
                     STRUM_ERR_METHOD);
    modes = solved(&slack, STRUM_INCLINED_FULL, 3);
    strum_inclined_point shape[2];
    assert_int_equal(strum_inclined_shape(modes, 3, NULL, 2, shape), STRUM_ERR_RANGE);
    assert_int_equal(strum_inclined_shape(modes, 0, NULL, 1, shape), STRUM_ERR_RANGE);
    strum_inclined_free(modes);
    strum_crossover crossover;
    const strum_inclined_cable stiff = taut(0.2, 30, INFINITY, 1);
    assert_int_equal(strum_inclined_crossover(&stiff, &crossover), STRUM_ERR_METHOD);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arguments_at_fault), cmocka_unit_test(parameters),
        cmocka_unit_test(shape_at_places),    cmocka_unit_test(cancelled_anywhere),
        cmocka_unit_test(work_is_limited),    cmocka_unit_test(cancelled_in_time),
        cmocka_unit_test(refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
