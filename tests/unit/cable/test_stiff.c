/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The static shape with bending stiffness. Reference values: Galerkin's method in double and, as a
 * second method, collocation of the first-order system with residuals in 80 bits.
 */
#include "cable/lines.h"

typedef struct {
    const char *name;
    double span, rise;
    int part_count;
    part parts[PARTS_MAX];
    double bending[PARTS_MAX];
    int load_count;
    load loads[LOADS_MAX];
    strum_cable_end end_1, end_2;
    double h, v, moment_1, moment_2, tangent_1, tangent_2;
} row;

/* clang-format off */
static const row rows[] = {
    {"stiff-01", 100.0, 0.0, 1, {{105.0, 19.6133, 1000000.0}}, {150.0}, 0, {{0, 0, 0, 0}}, {STRUM_CABLE_PINNED, 0.0, NAN}, {STRUM_CABLE_PINNED, 0.0, NAN},
     1766.590818902778, -1029.69825, 6.352564311704159e-32, 0.0, -30.10791180197856, 30.10791180197856},
    {"stiff-03", 100.0, 0.0, 1, {{100.1, 980.665, 200000000.0}}, {30000000.0}, 0, {{0, 0, 0, 0}}, {STRUM_CABLE_CLAMPED, 0.0, 0.0 * M_PI / 180}, {STRUM_CABLE_CLAMPED, 0.0, 0.0 * M_PI / 180},
     229750.6289377362, -49082.28324999999, -432597.4191315693, -432597.4191315693, 0.0, 0.0},
    {"stiff-05", 100.0, 0.0, 1, {{105.0, 19.6133, 1000000.0}}, {150.0}, 1, {{40.0, 588.399, 0.0, 0.0}}, {STRUM_CABLE_PINNED, 0.0, NAN}, {STRUM_CABLE_PINNED, 0.0, NAN},
     2523.510755581796, -1404.393332162487, -1.255552638436067e-32, 0.0, -29.01946286620864, 26.14796120060054},
    {"stiff-06", 170.0, 100.0, 3, {{120.0, 650.0, 400000000.0}, {60.0, -500.0, 400000000.0}, {90.0, 650.0, 400000000.0}}, {90000.0, 90000.0, 90000.0}, 0, {{0, 0, 0, 0}}, {STRUM_CABLE_PINNED, 0.0, NAN}, {STRUM_CABLE_PINNED, 0.0, NAN},
     17106.7391207023, -43947.28562784026, -5.180300684128243e-27, 0.0, -68.31864473272584, 74.52167563052511},
    {"stiff-08", 100.0, 0.0, 1, {{105.0, 19.6133, 1000000.0}}, {150.0}, 0, {{0, 0, 0, 0}}, {STRUM_CABLE_SPRUNG, 300.0, -5.0 * M_PI / 180}, {STRUM_CABLE_SPRUNG, 80.0, 10.0 * M_PI / 180},
     1761.737951296003, -1030.214026213532, -85.50795170304946, -24.59872380327582, -21.33081582464397, 27.61753819169622},
    {"stiff-10", 100.0, 0.0, 1, {{105.0, 19.6133, 1000000.0}}, {150.0}, 1, {{40.0, 98.06649999999999, 0.0, 0.0}}, {STRUM_CABLE_CLAMPED, 0.0, 0.0 * M_PI / 180}, {STRUM_CABLE_CLAMPED, 0.0, 0.0 * M_PI / 180},
     1867.535711304916, -1092.205210606522, -296.9920992708523, -290.1080957995635, 0.0, 0.0},
    {"stiff-02-ou", 100.0, 0.0, 1, {{105.0, 19.6133, 1000000.0}}, {150.0}, 0, {{0, 0, 0, 0}}, {STRUM_CABLE_CLAMPED, 0.0, 0.0 * M_PI / 180}, {STRUM_CABLE_CLAMPED, 0.0, 0.0 * M_PI / 180},
     1745.691191576747, -1029.69825, -289.296216034063, -289.296216034063, 0.0, 0.0},
    {"all-3-nodamp", 60.0, 95.0, 2, {{50.0, 19.6133, 1200000.0}, {66.0, 29.41995, 1600000.0}}, {150.0, 260.0}, 3, {{35.0, 245.16625, 0.0, 0.0}, {60.0, 58.8399, 0.0, 0.0}, {85.0, -150.0, 60.0, 0.0}}, {STRUM_CABLE_CLAMPED, 0.0, NAN}, {STRUM_CABLE_CLAMPED, 0.0, NAN},
     1020.986262142139, 455.9755415699729, 2.344467507037202, 0.5301303732000026, 24.07200978117249, 74.7796899003966},
    {"rand-13", 43.6641, -28.5512, 2, {{23.93, 10.189109349999999, 4546000.0}, {28.35, 8.673981925, 29630000.0}}, {21.77, 379.9}, 0, {{0, 0, 0, 0}}, {STRUM_CABLE_PINNED, 0.0, NAN}, {STRUM_CABLE_CLAMPED, 0.0, NAN},
     1441.627952910398, -1203.658230134376, -5.784753771254206e-32, 1.846159620982094, -39.83380686078595, -26.34452607309126},
};
/* clang-format on */

static void make_row(line *l, const row *r)
{
    make_line(l, r->span, r->rise, r->part_count, r->parts, r->load_count, r->loads);
    for (int i = 0; i < r->part_count; i++)
        l->sections[i].bending_stiffness = r->bending[i];
    l->params.end_1 = r->end_1;
    l->params.end_2 = r->end_2;
    l->params.stiff = true;
}

static void reference(void **state)
{
    (void)state;
    for (int i = 0; i < COUNT(rows); i++) {
        const row *r = rows + i;
        line l;
        make_row(&l, r);
        strum_hanging *cable = hang(&l);
        const strum_cable_statics s = statics_of(cable);
        const double moment = fmax(1, fmax(fabs(r->moment_1), fabs(r->moment_2)));
        check_relative(s.horizontal_end_1, r->h, 1e-12);
        check_absolute(s.vertical_end_1, r->v, 1e-12 * s.tension_end_1);
        check_absolute(s.moment_end_1, r->moment_1, 1e-11 * moment);
        check_absolute(s.moment_end_2, r->moment_2, 1e-11 * moment);
        check_absolute(s.angle_end_1 * 180 / M_PI, r->tangent_1, 1e-11);
        check_absolute(s.angle_end_2 * 180 / M_PI, r->tangent_2, 1e-11);
        assert_true(s.closure <= 1e-13);
        strum_cable_free(cable);
    }
}

/* ---- a second method ---- */

typedef struct {
    double angle, moment, x, z;
} rod;

/* th' = M/EI, M' = -(1 + e) Q, r' = (1 + e) t, under the force (h, v + w s). */
static rod slope_of(const rod *r, const strum_cable_section *s, double h, double v, double at)
{
    const double c = cos(r->angle), d = sin(r->angle), v_s = v + s->weight * at;
    const double stretch = 1 + (h * c + v_s * d) / s->axial_stiffness;
    return (rod){r->moment / s->bending_stiffness, -stretch * (v_s * c - h * d), stretch * c,
                 stretch * d};
}

static rod moved(const rod *r, const rod *slope, double by)
{
    return (rod){r->angle + by * slope->angle, r->moment + by * slope->moment,
                 r->x + by * slope->x, r->z + by * slope->z};
}

/* Runge and Kutta's rule in many small steps from end 1: a rod of few widths sqrt(EI/T) only,
 * since errors grow as e^r. */
static void shoots(void **state)
{
    (void)state;
    const part parts[] = {{100.1, 980.665, 2e8}};
    line l;
    make_line(&l, 100, 4, 1, parts, 0, NULL);
    l.sections[0].bending_stiffness = 3e7;
    l.params.stiff = true;
    l.params.end_1 = (strum_cable_end){STRUM_CABLE_CLAMPED, 0, 0.1};
    l.params.end_2 = (strum_cable_end){STRUM_CABLE_SPRUNG, 2e6, -0.2};
    strum_hanging *cable = hang(&l);
    const strum_cable_statics s = statics_of(cable);
    check_absolute(s.angle_end_1, 0.1, 1e-15);
    check_relative(s.moment_end_2, -2e6 * (s.angle_end_2 + 0.2), 1e-9);
    const int steps = 20000;
    const double by = l.sections[0].length / steps;
    rod r = {s.angle_end_1, s.moment_end_1, 0, 0};
    strum_cable_point points[21];
    assert_int_equal(strum_cable_shape(cable, NULL, 21, points), STRUM_OK);
    for (int i = 0; i < steps; i++) {
        const double at = i * by;
        if (i % 1000 == 0) {
            check_absolute(points[i / 1000].x, r.x, 1e-9);
            check_absolute(points[i / 1000].z, r.z, 1e-9);
            check_absolute(points[i / 1000].angle, r.angle, 1e-9);
        }
        const rod a = slope_of(&r, l.sections, s.horizontal_end_1, s.vertical_end_1, at);
        const rod to_b = moved(&r, &a, by / 2);
        const rod b =
            slope_of(&to_b, l.sections, s.horizontal_end_1, s.vertical_end_1, at + by / 2);
        const rod to_c = moved(&r, &b, by / 2);
        const rod c =
            slope_of(&to_c, l.sections, s.horizontal_end_1, s.vertical_end_1, at + by / 2);
        const rod to_d = moved(&r, &c, by);
        const rod d =
            slope_of(&to_d, l.sections, s.horizontal_end_1, s.vertical_end_1, at + by);
        r = moved(&r, &a, by / 6);
        r = moved(&r, &b, by / 3);
        r = moved(&r, &c, by / 3);
        r = moved(&r, &d, by / 6);
    }
    check_absolute(r.x, 100, 1e-7);
    check_absolute(r.z, 4, 1e-7);
    check_absolute(r.angle, s.angle_end_2, 1e-8);
    check_absolute(r.moment, s.moment_end_2, 1e-7 * fabs(s.moment_end_1));
    strum_cable_free(cable);
}

/* ---- limits ---- */

/* Without bending stiffness in any section the two statics are one; with little of it they come
 * near, as its square root. */
static void little_bending(void **state)
{
    (void)state;
    line l;
    make_line(&l, 100, 10, 1, &(part){105, 20, 1e6}, 1, &(load){40, 300, 0, 0});
    strum_hanging *flexible = hang(&l);
    l.params.stiff = true;
    strum_hanging *same = hang(&l);
    assert_true(statics_of(same).horizontal_end_1 == statics_of(flexible).horizontal_end_1);
    l.sections[0].bending_stiffness = 0.01;
    strum_hanging *stiff = hang(&l);
    const strum_cable_statics a = statics_of(flexible), b = statics_of(stiff);
    check_relative(b.horizontal_end_1, a.horizontal_end_1, 1e-5);
    check_absolute(b.sag_max, a.sag_max, 1e-3);
    check_absolute(b.sag_mid, a.sag_mid, 1e-4);
    check_relative(b.length, a.length, 1e-8);
    check_absolute(b.lowest.z, a.lowest.z, 1e-3);
    check_relative(b.tension_max, a.tension_max, 1e-4);
    strum_cable_joint joint;
    assert_int_equal(strum_cable_attachment_get(stiff, 0, &joint), STRUM_OK);
    check_absolute(joint.kink, 0, 1e-15); /* rounded over sqrt(EI/T) */
    strum_cable_free(flexible);
    strum_cable_free(same);
    strum_cable_free(stiff);
}

/* A section without bending stiffness beside one with it: no moment where they meet, one force
 * along both. */
static void mixed_sections(void **state)
{
    (void)state;
    const part parts[] = {{50, 20, 1e6}, {55, 30, 2e6}};
    line l;
    make_line(&l, 90, 10, 2, parts, 0, NULL);
    l.sections[1].bending_stiffness = 500;
    l.params.stiff = true;
    l.params.end_2.rotation = STRUM_CABLE_CLAMPED;
    l.params.end_2.angle = 0.2;
    strum_hanging *cable = hang(&l);
    const strum_cable_statics s = statics_of(cable);
    check_absolute(s.closure, 0, 1e-13);
    check_absolute(s.angle_end_2, 0.2, 1e-15);
    check_relative(s.vertical_end_2, s.vertical_end_1 + 50 * 20 + 55 * 30, 1e-13);
    check_relative(s.horizontal_end_2, s.horizontal_end_1, 1e-15);
    strum_cable_free(cable);
}

/* The figures of a shape, given back, give its length back. */
static void given_figures(void **state)
{
    (void)state;
    line l;
    make_line(&l, 100, 10, 1, &(part){105, 20, 1e6}, 0, NULL);
    l.sections[0].bending_stiffness = 150;
    l.params.stiff = true;
    l.params.end_1.rotation = STRUM_CABLE_CLAMPED;
    l.params.end_1.angle = 0;
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
        {STRUM_CABLE_STRETCHED_LENGTH, s.length},
        {STRUM_CABLE_DEPTH_BELOW_END_1, -s.lowest.z},
        {STRUM_CABLE_ANGLE_END_2, s.angle_end_2},
    };
    for (int i = 0; i < COUNT(given); i++) {
        l.params.given = given[i].given;
        l.params.value = given[i].value;
        cable = hang(&l);
        check_relative(statics_of(cable).unstretched_length, 105, 1e-10);
        strum_cable_free(cable);
    }
}

static void refusals(void **state)
{
    (void)state;
    line l;
    strum_hanging *cable;
    strum_error error;
    make_line(&l, 100, 10, 1, &(part){105, 20, 1e6}, 0, NULL);
    l.sections[0].bending_stiffness = 150;
    l.params.stiff = true;
    l.params.bed = (strum_cable_bed){true, 5, 0, 0};
    assert_int_equal(strum_cable_hang(&l.params, NULL, &cable, &error), STRUM_ERR_METHOD);
    assert_int_equal(error.argument, STRUM_CABLE_ARG_BED);
    assert_null(cable);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reference),      cmocka_unit_test(shoots),
        cmocka_unit_test(little_bending), cmocka_unit_test(mixed_sections),
        cmocka_unit_test(given_figures),  cmocka_unit_test(refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
