/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Ends as people have them. Reference values: closed catenaries with all unknowns in one Newton
 * iteration of 40 digits, the figure that is given met to 1e-38.
 */
#include "cable/lines.h"

typedef struct {
    const char *name;
    strum_cable_given given;
    double value;
    bool slack;
    double span, rise, weight, axial_stiffness;
    double unstretched, h, tension_2, sag_mid, sag_max, length;
} row;

/* clang-format off */
static const row rows[] = {
    {"span-tension", STRUM_CABLE_HORIZONTAL_TENSION, 35316.0, false, 500.0, 0.0, 17.658, 36024000.0, 500.8082984430964, 35316.0, 35591.72270410493, 15.62997298940016, 15.62997298940016, 501.30054376765645},
    {"span-parameter", STRUM_CABLE_CATENARY_PARAMETER, 2000.0, false, 500.0, 0.0, 17.658, 36024000.0, 500.8082984430964, 35316.0, 35591.722704104934, 15.629972989400159, 15.629972989400159, 501.30054376765645},
    {"span-end-angle", STRUM_CABLE_ANGLE_END_2, 7.0 * M_PI / 180, false, 500.0, 0.0, 17.658, 36024000.0, 500.74924552781704, 36007.0928808486, 36277.499863664314, 15.328931802395113, 15.328931802395113, 501.25101455769226},
    {"span-depth", STRUM_CABLE_DEPTH_BELOW_END_1, 20.0, false, 500.0, 0.0, 17.658, 36024000.0, 501.7405539912924, 27628.05128400207, 27980.938913849546, 20.0, 20.0, 502.12699866844446},
    {"stay-parallel-tension", STRUM_CABLE_TENSION_PARALLEL_TO_CHORD, 2000000.0, false, 153.4, 88.6, 506.02314, 1206900000.0, 176.86625950067304, 1731882.275714134, 2022838.429018434, 0.9908645942641415, 0.9908680288136567, 177.1593818705103},
    {"stay-sag-max", STRUM_CABLE_SAG_MAX, 15.0, false, 300.0, 120.0, 506.02314, 1206900000.0, 324.58763691607857, 409505.31680892676, 478641.3056895133, 14.99804739905862, 15.0, 324.7070293632265},
    {"stay-top-tension", STRUM_CABLE_TENSION_END_2, 200000.0, false, 300.0, 120.0, 506.02314, 1206900000.0, 337.582162875478, 137002.24176385428, 200000.0, 45.59780699294974, 45.64704111515456, 337.62591054844137},
    {"stay-top-tension", STRUM_CABLE_TENSION_END_2, 200000.0, true, 300.0, 120.0, 506.02314, 1206900000.0, 657.3130249167058, 32910.3344387986, 200000.0, 269.12186433109684, 270.56721310730916, 657.364850407221},
    {"stay-top-tension-inextensible", STRUM_CABLE_TENSION_END_2, 200000.0, false, 300.0, 120.0, 506.02314, INFINITY, 337.6320655168638, 136990.89134413787, 200000.0, 45.60764842608311, 45.656924598350834, 337.6320655168638},
    {"stay-top-tension-inextensible", STRUM_CABLE_TENSION_END_2, 200000.0, true, 300.0, 120.0, 506.02314, INFINITY, 657.2921535452487, 32914.67225919003, 200000.0, 269.08117021239104, 270.5265022475574, 657.2921535452487},
};
/* clang-format on */

static void reference(void **state)
{
    (void)state;
    for (int i = 0; i < COUNT(rows); i++) {
        const row *r = rows + i;
        line l;
        make_line(&l, r->span, r->rise, 1, &(part){0, r->weight, r->axial_stiffness}, 0, NULL);
        l.params.given = r->given;
        l.params.value = r->value;
        l.params.slack_branch = r->slack;
        strum_hanging *cable = hang(&l);
        const strum_cable_statics s = statics_of(cable);
        check_relative(s.unstretched_length, r->unstretched, 1e-13);
        check_relative(s.horizontal_end_1, r->h, 1e-12);
        check_relative(s.tension_end_2, r->tension_2, 1e-12);
        check_relative(s.sag_mid, r->sag_mid, 1e-12);
        check_relative(s.sag_max, r->sag_max, 1e-12);
        check_relative(s.length, r->length, 1e-13);
        strum_cable_section section;
        assert_int_equal(strum_cable_section_get(cable, 0, &section), STRUM_OK);
        check_relative(section.length, r->unstretched, 1e-13);
        const bool two = r->given == STRUM_CABLE_TENSION_END_2;
        assert_int_equal(s.solutions, two ? 2 : 1);
        assert_int_equal(isnan(s.other_length), !two);
        strum_cable_free(cable);
    }
}

/* Two shapes with one tension name each other. */
static void branches(void **state)
{
    (void)state;
    line l;
    make_line(&l, 300, 120, 1, &(part){0, 51.6 * 9.80665, 1206900000.0}, 0, NULL);
    l.params.given = STRUM_CABLE_TENSION_END_2;
    l.params.value = 200000;
    strum_hanging *taut = hang(&l);
    l.params.slack_branch = true;
    strum_hanging *slack = hang(&l);
    check_relative(statics_of(taut).other_length, statics_of(slack).unstretched_length, 1e-10);
    check_relative(statics_of(slack).other_length, statics_of(taut).unstretched_length, 1e-10);
    strum_cable_free(taut);
    strum_cable_free(slack);
    /* the least possible one, 150 462.258 N at 400.554999531 m, by its own derivative in 40
     * digits; and of the level inextensible cable X/2a tanh(X/2a) = 1 */
    strum_error error;
    l.params.value = 150462.2;
    assert_int_equal(strum_cable_hang(&l.params, NULL, &taut, &error), STRUM_ERR_IMPOSSIBLE);
    assert_int_equal(error.argument, STRUM_CABLE_ARG_VALUE);
    assert_non_null(strstr(error.reason, "150462.25"));
    l.params.value = 150462.3;
    taut = hang(&l);
    check_relative(statics_of(taut).unstretched_length, 400.554999531, 1e-3);
    assert_int_equal(statics_of(taut).solutions, 2);
    strum_cable_free(taut);
}

/* What a shape of several pieces has, given back, gives its length back. */
static void round_trips(void **state)
{
    (void)state;
    static const part parts[] = {{120, 80, 4e6}, {60, 25, INFINITY}, {70, 12, 9e6}};
    static const load loads[] = {{40, 500, 0, 0}, {150, 300, 0, 0}};
    line l;
    make_line(&l, 230, 35, COUNT(parts), parts, COUNT(loads), loads);
    strum_hanging *cable = hang(&l);
    const strum_cable_statics s = statics_of(cable);
    strum_cable_free(cable);
    const struct {
        strum_cable_given given;
        double value;
    } given[] = {
        {STRUM_CABLE_HORIZONTAL_TENSION, s.horizontal_end_1},
        {STRUM_CABLE_TENSION_END_1, s.tension_end_1},
        {STRUM_CABLE_TENSION_END_2, s.tension_end_2},
        {STRUM_CABLE_TENSION_PARALLEL_TO_CHORD, s.tension_parallel_to_chord},
        {STRUM_CABLE_SAG_MID, s.sag_mid},
        {STRUM_CABLE_SAG_MAX, s.sag_max},
        {STRUM_CABLE_DEPTH_BELOW_END_1, -s.lowest.z},
        {STRUM_CABLE_STRETCHED_LENGTH, s.length},
        {STRUM_CABLE_ANGLE_END_1, s.angle_end_1},
        {STRUM_CABLE_ANGLE_END_2, s.angle_end_2},
        {STRUM_CABLE_CATENARY_PARAMETER, s.horizontal_end_1 / 12},
    };
    for (int i = 0; i < COUNT(given); i++) {
        l.params.given = given[i].given;
        l.params.value = given[i].value;
        l.params.adjusted = 2;
        cable = hang(&l);
        check_relative(statics_of(cable).unstretched_length, 250, 1e-9);
        strum_cable_free(cable);
    }
    l.params.span_unknown = true;
    for (int i = 0; i < 3; i++) {
        l.params.given = given[i].given;
        l.params.value = given[i].value;
        l.params.span = 0;
        cable = hang(&l);
        check_relative(statics_of(cable).span, 230, 1e-9);
        strum_cable_free(cable);
    }
}

/* A string: weightless and inextensible, it is straight under any tension. */
static void strings(void **state)
{
    (void)state;
    line l;
    make_line(&l, 0, 3, 1, &(part){5, 0, INFINITY}, 1, &(load){2, 0, 0, 0});
    l.params.given = STRUM_CABLE_HORIZONTAL_TENSION;
    l.params.value = 800;
    l.params.span_unknown = true;
    strum_hanging *cable = hang(&l);
    check_relative(statics_of(cable).span, 4, 1e-14);
    check_relative(statics_of(cable).tension_end_2, 1000, 1e-14);
    strum_cable_free(cable);
    make_line(&l, 4, -3, 1, &(part){0, 0, INFINITY}, 0, NULL);
    l.params.given = STRUM_CABLE_TENSION_END_1;
    l.params.value = 1000;
    cable = hang(&l);
    check_relative(statics_of(cable).unstretched_length, 5, 1e-14);
    check_relative(statics_of(cable).horizontal_end_2, 800, 1e-14);
    strum_cable_free(cable);
}

static void refuse(const line *l, const char *word)
{
    strum_hanging *cable;
    strum_error error = {0};
    assert_true(strum_cable_hang(&l->params, NULL, &cable, &error) != STRUM_OK);
    assert_int_equal(error.argument, STRUM_CABLE_ARG_VALUE);
    if (strstr(error.reason, word) == NULL)
        fail_msg("'%s' does not say '%s'", error.reason, word);
}

static void refusals(void **state)
{
    (void)state;
    line l;
    make_line(&l, 100, -20, 1, &(part){0, 10, 1e7}, 0, NULL);
    l.params.given = STRUM_CABLE_DEPTH_BELOW_END_1;
    l.params.value = 15;
    refuse(&l, "lowest point");
    l.params.given = STRUM_CABLE_SAG_MAX;
    l.params.value = -1;
    refuse(&l, "above 0");
    l.params.given = STRUM_CABLE_ANGLE_END_2;
    l.params.value = 1.6;
    refuse(&l, "90 degrees");
    l.params.value = -0.5; /* below the chord */
    refuse(&l, "no unstretched length");
    l.params.given = STRUM_CABLE_STRETCHED_LENGTH;
    l.params.value = 101;
    refuse(&l, "no unstretched length");
    l.params.given = STRUM_CABLE_SAG_MID;
    l.params.span_unknown = true;
    l.sections[0].length = 120;
    refuse(&l, "unknown span");
}

/* A search ends soon after it was cancelled. */
static bool later(void *context)
{
    return ++*(int *)context > 100;
}

static void stops(void **state)
{
    (void)state;
    line l;
    int asked = 0;
    make_line(&l, 300, 120, 1, &(part){0, 500, 1e9}, 0, NULL);
    l.params.given = STRUM_CABLE_TENSION_END_2;
    l.params.value = 200000;
    strum_options options = STRUM_OPTIONS_INIT;
    options.cancelled = later;
    options.context = &asked;
    strum_hanging *cable;
    assert_int_equal(strum_cable_hang(&l.params, &options, &cable, NULL), STRUM_ERR_CANCELLED);
    assert_true(asked <= 102);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reference), cmocka_unit_test(branches), cmocka_unit_test(round_trips),
        cmocka_unit_test(strings),   cmocka_unit_test(refusals), cmocka_unit_test(stops),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
