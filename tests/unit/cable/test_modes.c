/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Modes of the general cable: frequencies, counts, refusals. */
#include "check.h"

#include "cable/modes_table.h"

static strum_hanging *hung(const mode_case *c)
{
    strum_cable_params params = c->params;
    strum_hanging *cable;
    strum_error error;
    params.sections = c->sections;
    params.attachments = c->attachments;
    if (strum_cable_hang(&params, NULL, &cable, &error) != STRUM_OK)
        fail_msg("%s: %s", c->name, error.reason);
    return cable;
}

static strum_cable_modes *solved(const strum_hanging *cable, strum_plane plane, int count)
{
    strum_cable_modes_params params = STRUM_CABLE_MODES_PARAMS_INIT;
    strum_cable_modes *modes;
    strum_error error;
    params.plane = plane;
    params.count = count;
    if (strum_cable_modes_solve(cable, &params, NULL, &modes, &error) != STRUM_OK)
        fail_msg("%s", error.reason);
    return modes;
}

static void check_case(const mode_case *c)
{
    strum_hanging *cable = hung(c);
    strum_cable_modes *modes = solved(cable, c->plane, c->count);
    strum_cable_free(cable); /* the modes hold it */
    assert_int_equal(strum_cable_modes_count(modes), c->count);
    for (int i = 0; i < c->count; i++) {
        strum_cable_mode mode;
        assert_int_equal(strum_cable_modes_get(modes, (size_t)i, &mode), STRUM_OK);
        const double size = hypot(c->frequency[i], c->decay[i]);
        const double error =
            hypot(mode.frequency - c->frequency[i], mode.decay - c->decay[i]) / size;
        if (!(error < (c->decay[0] != 0 ? 1e-11 : 5e-13)))
            fail_msg("%s, mode %d: %.17g, %.17g: off by %.1e", c->name, i + 1, mode.frequency,
                     mode.decay, error);
    }
    const double *decays;
    const size_t roots = strum_cable_modes_overdamped(modes, &decays);
    assert_true(roots >= (size_t)c->overdamped);
    for (int i = 0; i < c->overdamped; i++)
        check_relative(decays[i], c->root[i], 1e-11);
    strum_cable_certificate certificate;
    strum_cable_modes_certificate(modes, &certificate);
    assert_true(certificate.found >= c->count);
    assert_int_equal(certificate.expected, certificate.found);
    strum_cable_modes_free(modes);
}

static void reference(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof mode_cases / sizeof *mode_cases; i++)
        check_case(mode_cases + i);
}

/* The lowest of many modes are those that are found alone. */
static void many_modes(void **state)
{
    (void)state;
    const strum_cable_section section = {.length = 100.05,
                                         .mass = 2,
                                         .weight = 19.6133,
                                         .axial_stiffness = 1e6,
                                         .bending_stiffness = 30,
                                         .bed_friction = NAN};
    strum_cable_params params = STRUM_CABLE_PARAMS_INIT;
    strum_hanging *cable;
    params.sections = &section;
    params.section_count = 1;
    params.span = 100;
    assert_int_equal(strum_cable_hang(&params, NULL, &cable, NULL), STRUM_OK);
    strum_cable_modes *few = solved(cable, STRUM_IN_PLANE, 5);
    strum_cable_modes *many = solved(cable, STRUM_IN_PLANE, STRUM_CABLE_MODES_MAX);
    assert_int_equal(strum_cable_modes_count(many), STRUM_CABLE_MODES_MAX);
    for (size_t i = 0; i < 5; i++) {
        strum_cable_mode a, b;
        assert_int_equal(strum_cable_modes_get(few, i, &a), STRUM_OK);
        assert_int_equal(strum_cable_modes_get(many, i, &b), STRUM_OK);
        check_relative(a.frequency, b.frequency, 1e-12);
    }
    strum_cable_modes_free(few);
    strum_cable_modes_free(many);
    strum_cable_free(cable);
}

static void refusals(void **state)
{
    (void)state;
    strum_hanging *cable = hung(mode_cases);
    strum_cable_modes_params params = STRUM_CABLE_MODES_PARAMS_INIT;
    strum_cable_modes *modes;
    strum_error error;
    params.count = 0;
    assert_int_equal(strum_cable_modes_solve(cable, &params, NULL, &modes, &error),
                     STRUM_ERR_RANGE);
    assert_int_equal(error.argument, STRUM_CABLE_ARG_COUNT);
    assert_null(modes);
    params.count = 6;
    const strum_options little = {.bytes_max = 10000}, hasty = {.work_max = 20};
    assert_int_equal(strum_cable_modes_solve(cable, &params, &little, &modes, &error),
                     STRUM_ERR_BYTES);
    assert_int_equal(strum_cable_modes_solve(cable, &params, &hasty, &modes, &error),
                     STRUM_ERR_WORK);
    assert_null(modes);
    strum_cable_modes_free(NULL);
    strum_cable_free(cable);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reference),
        cmocka_unit_test(many_modes),
        cmocka_unit_test(refusals),
    };
    return cmocka_run_group_tests_name("cable_modes", tests, NULL, NULL);
}
