/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every call that takes options can be stopped wherever it asks, and then gives nothing out. */
#include "taut/parts.h"

#define PARTS 7

typedef struct asked {
    int times, stop_after;
} asked;

static bool stop(void *context)
{
    asked *a = context;
    return a->times++ >= a->stop_after;
}

static strum_taut *mixed_chain(double damping)
{
    strum_taut_link links[2];
    strum_taut_joint joint;
    levesque_absorber(9.0, 0.12, damping, links, &joint);
    const strum_taut_component parts[PARTS] = {
        part_cable(LEVESQUE_TENSION, 1.5, 30.0, 0.0),
        part_body(LEVESQUE_TENSION, LEVESQUE_TENSION, links, &joint, 2),
        part_varying(LEVESQUE_TENSION, 7000.0, 1.5, 40.0, false),
        part_mass(5.0),
        part_varying(7000.0, 8000.0, 1.5, 10.0, true),
        part_hanging(4.0, 300.0, damping),
        part_cable(8000.0, 1.5, 20.0, 0.0)};
    return fixed_chain(parts, PARTS);
}

/* ---- one call each; the figure that the whole call gives, NaN when it gives nothing ---- */

static strum_status frequencies(const strum_taut *chain, const strum_options *options,
                                double *figure)
{
    const long numbers[3] = {1, 7, 40};
    double w[3];
    const strum_status status = strum_taut_frequencies(chain, numbers, 3, options, w, NULL);
    *figure = status == STRUM_OK ? w[2] : NAN;
    return status;
}

static strum_status solve(const strum_taut *chain, const strum_options *options, double *figure)
{
    const strum_taut_query query = {.lowest = 1.0, .highest = 30.0, .max_decay = 5.0};
    strum_taut_roots *roots;
    const strum_status status = strum_taut_solve(chain, &query, options, &roots, NULL);
    *figure = roots != NULL ? roots->roots[roots->count - 1].frequency : NAN;
    strum_taut_roots_free(roots);
    return status;
}

static strum_status follow(const strum_taut *chain, const strum_options *options,
                           double *figure)
{
    const double factors[2] = {0.5, 1.0};
    strum_taut_root roots[2];
    const strum_status status = strum_taut_follow(chain, 3, factors, 2, options, roots, NULL);
    *figure = status == STRUM_OK ? roots[1].decay : NAN;
    return status;
}

static strum_status shape(const strum_taut *chain, const strum_options *options, double *figure)
{
    const strum_taut_root root = {.mode = 3, .frequency = frequency_of(chain, 3)};
    strum_taut_shape *made;
    strum_taut_point points[9];
    const strum_status status = strum_taut_shape_make(chain, &root, options, &made, NULL);
    *figure = NAN;
    if (made != NULL && strum_taut_shape_sample(made, 9, points, NULL) == STRUM_OK)
        *figure = creal(points[2].displacement);
    strum_taut_shape_free(made);
    return status;
}

static strum_status verify(const strum_taut *chain, const strum_options *options,
                           double *figure)
{
    strum_taut_roots *roots = roots_of(chain, 0, 1.0, 8.0, 2.0);
    strum_verification v;
    const strum_status status = strum_taut_verify(chain, roots, options, &v, NULL);
    *figure = status == STRUM_OK ? (double)v.modes_expected : NAN;
    strum_taut_roots_free(roots);
    return status;
}

typedef strum_status (*call)(const strum_taut *chain, const strum_options *options,
                             double *figure);

static void check_call(call what, const strum_taut *chain)
{
    double whole, figure;
    assert_int_equal(what(chain, NULL, &whole), STRUM_OK);
    asked a = {0, 1 << 30};
    const strum_options never = {.cancelled = stop, .context = &a};
    assert_int_equal(what(chain, &never, &figure), STRUM_OK);
    assert_true(figure == whole);
    const int places = a.times;
    assert_true(places > 0);
    for (int k = 0; k < places; k += 1 + k / 8) {
        a = (asked){0, k};
        const strum_options here = {.cancelled = stop, .context = &a};
        assert_int_equal(what(chain, &here, &figure), STRUM_ERR_CANCELLED);
        assert_true(isnan(figure));
    }
    const strum_options little = {.work_max = 1e-3};
    assert_int_equal(what(chain, &little, &figure), STRUM_ERR_WORK);
}

static void undamped_calls_can_be_stopped(void **state)
{
    (void)state;
    strum_taut *chain = mixed_chain(0.0);
    check_call(frequencies, chain);
    check_call(solve, chain);
    check_call(shape, chain);
    check_call(verify, chain);
    strum_taut_free(chain);
}

static void damped_calls_can_be_stopped(void **state)
{
    (void)state;
    strum_taut *chain = mixed_chain(40.0);
    check_call(solve, chain);
    check_call(follow, chain);
    check_call(shape, chain);
    check_call(verify, chain);
    strum_taut_free(chain);
}

/* A loop of pi metres has as many nodes as its mode number less one. */
static void a_shape_has_so_many_nodes_at_most(void **state)
{
    (void)state;
    const strum_taut_component part = part_cable(1.0, 1.0, M_PI, 0.0);
    strum_taut *chain = fixed_chain(&part, 1);
    strum_taut_root root = {.mode = 1, .frequency = STRUM_TAUT_NODES_MAX / 2.0};
    strum_taut_shape *made;
    strum_error error;
    const double *nodes;
    assert_int_equal(strum_taut_shape_make(chain, &root, NULL, &made, &error), STRUM_OK);
    assert_int_equal(strum_taut_shape_nodes(made, &nodes), STRUM_TAUT_NODES_MAX / 2 - 1);
    strum_taut_shape_free(made);
    for (double w = 2.0 * STRUM_TAUT_NODES_MAX; w < 1e120; w *= 1e30) {
        root.frequency = w;
        assert_int_equal(strum_taut_shape_make(chain, &root, NULL, &made, &error),
                         STRUM_ERR_METHOD);
        assert_null(made);
    }
    root.frequency = 1e200; /* its square is beyond a double */
    assert_int_equal(strum_taut_shape_make(chain, &root, NULL, &made, &error), STRUM_ERR_RANGE);
    strum_taut_free(chain);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(undamped_calls_can_be_stopped),
        cmocka_unit_test(damped_calls_can_be_stopped),
        cmocka_unit_test(a_shape_has_so_many_nodes_at_most),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
