/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The cable that hangs free. Reference values: the closed piecewise elastic catenary and, as a
 * second method, its balance by quadrature, both in 40 digits and equal to 1e-22 or better.
 */
#include "cable/lines.h"

/* ---- reference values ---- */

typedef struct {
    const char *name;
    double span, rise;
    int part_count;
    part parts[PARTS_MAX];
    int load_count;
    load loads[LOADS_MAX];
    double h_1, v_1, h_2, v_2, length, lowest, highest, tolerance;
} row;

/* clang-format off */
static const row rows[] = {
    {"free-moordyn-hanging", 700.0, 0.0, 1, {{760.0, 3324.385105461581, 1674000000.0}}, 0, {{0, 0, 0, 0}},
     1630566.4345620328, -1263266.340075401, 1630566.4345620328, 1263266.340075401, 760.808785891864, -130.12200852689685, 0.0, 1e-11},
    {"free-deep-inextensible", 60.0, 35.0, 1, {{400.0, 98.06649999999999, INFINITY}}, 0, {{0, 0, 0, 0}},
     742.1687246155726, -17895.898554057618, 742.1687246155726, 21330.70144594238, 400.0, -175.07622502963602, 35.0, 1e-11},
    {"free-near-taut-inextensible", 400.0, 300.0, 1, {{500.00000050000006, 9.80665, INFINITY}}, 0, {{0, 0, 0, 0}},
     20256528.018829312, 15189944.399095776, 20256528.018829312, 15194847.72410068, 500.00000050000006, 0.0, 300.0, 2e-07},
    {"free-length-equals-chord", 246.22420940032947, 263.55766330843164, 1, {{360.63566262396927, 3.08735, 700000000.0}}, 0, {{0, 0, 0, 0}},
     58377.24142265673, 61931.00444292228, 58377.24142265673, 63044.412955924396, 360.6797189671594, 0.0, 263.55766330843164, 1e-11},
    {"free-shorter-than-chord", 400.0, 300.0, 1, {{495.0, 196.13299999999998, 200000000.0}}, 0, {{0, 0, 0, 0}},
     1625787.7514662333, 1171027.4302677794, 1625787.7514662333, 1268113.2652677794, 500.03042780662594, 0.0, 300.0, 1e-11},
    {"free-narrower-loop", 0.0001, 0.0, 1, {{100.0, 49.033249999999995, 10000000.0}}, 0, {{0, 0, 0, 0}},
     0.00014119828835336412, -2451.6625, 0.00014119828835336412, 2451.6625, 100.0122583125, -50.0061262766064, 0.0, 1e-11},
    {"free-stiffness-1e6", 130.0, 20.0, 3, {{50.0, 392.26599999999996, 10000000000.0}, {60.0, 19.6133, 10000.0}, {40.0, 294.1995, 10000000000.0}}, 0, {{0, 0, 0, 0}},
     4305.442009675715, -18875.687510209344, 4305.442009675715, 13682.390489790654, 177.10025449057088, -38.37972597984315, 20.0, 1e-11},
    {"free-five-pieces", 150.0, 70.0, 5, {{30.0, 980.665, 1000000000.0}, {80.0, 49.033249999999995, 20000000.0}, {20.0, 980.665, 1000000000.0}, {70.0, 12.0, 20000000.0}, {10.0, 2941.995, INFINITY}}, 0, {{0, 0, 0, 0}},
     12467.480177244763, -30365.62953708173, 12467.480177244763, 52850.23046291826, 210.14282805262806, -21.454154687382907, 70.0, 1e-11},
    {"free-marker", 500.0, 0.0, 1, {{500.81085060994155, 17.658, 36024000.0}}, 1, {{250.40542530497078, 490.5, 0.0, 0.0}},
     37766.91460460654, -4666.909000035174, 37766.91460460654, 4666.909000035174, 501.3372986269676, -16.23971476735626, 0.0, 1e-11},
    {"free-ballast", 60.0, 0.0, 1, {{70.0, 408.45504865105, 313000000.0}}, 1, {{35.0, 17100.3459375, 0.0, 0.0}},
     26323.018615929202, -22846.099671536747, 26323.018615929202, 22846.099671536747, 70.00690024939159, -17.574821855674646, 0.0, 1e-11},
    {"free-horizontal-force", 200.0, -15.0, 1, {{220.0, 117.6798, 50000000.0}}, 2, {{70.0, 392.26599999999996, 6000.0, 0.0}, {150.0, 0.0, -2500.0, 0.0}},
     18069.00720716264, -14940.580311165304, 14569.007207162638, 11341.241688834694, 220.0725334807618, -48.65884556328757, 0.0, 1e-11},
    {"free-clump-near-taut", 100.0, 0.0, 1, {{100.01, 0.980665, 1000000000.0}}, 1, {{30.0, 98066.5, 0.0, 0.0}},
     970373.4581477429, -68740.57047807935, 970373.4581477429, 29424.005828570647, 100.10715112164434, -2.1214769108223135, 0.0, 1e-11},
    {"vertical-tether", 0.0, 1.5, 1, {{1.3, 4.903325, 1000000.0}}, 0, {{0, 0, 0, 0}},
     0.0, 153842.9666849038, 0.0, 153849.3410074038, 1.5, 0.0, 1.5, 1e-11},
    {"vertical-slack", 0.0, 40.0, 1, {{100.0, 49.033249999999995, 10000000.0}}, 0, {{0, 0, 0, 0}},
     0.0, -1471.2378670306725, 0.0, 3432.0871329693273, 100.01421868114971, -30.007109340574853, 40.0, 1e-11},
    {"vertical-float", 0.0, 92.0, 2, {{60.0, 150.0, 200000000.0}, {30.0, -20.0, 10000000.0}}, 1, {{60.0, -4000.0, 0.0, 0.0}},
     0.0, 601378.7878787878, 0.0, 605778.7878787878, 92.0, 0.0, 92.0, 1e-11},
    {"neutral-straight", 100.0, 0.0, 1, {{99.9, 0.0, 54000000.0}}, 0, {{0, 0, 0, 0}},
     54054.054054050976, 0.0, 54054.054054050976, 0.0, 100.0, 0.0, 0.0, 1e-11},
    {"neutral-with-load", 100.0, 10.0, 1, {{104.0, 0.0, 54000000.0}}, 1, {{40.0, 980.665, 0.0, 0.0}},
     1784.8307111728154, -420.3490609085111, 1784.8307111728154, 560.3159390914889, 104.0035754113838, -9.169922923711129, 10.0, 1e-11},
    {"neutral-middle", 150.0, 60.0, 3, {{100.0, 80.0, 100000000.0}, {50.0, 0.0, 100000000.0}, {70.0, -100.0, 100000000.0}}, 0, {{0, 0, 0, 0}},
     2121.372046497037, -3823.666532450175, 2121.372046497037, -2823.666532450175, 220.00743735226573, -28.142713044435652, 74.10425461576973, 1e-11},
};
/* clang-format on */

static void reference(void **state)
{
    (void)state;
    for (int i = 0; i < COUNT(rows); i++) {
        const row *r = rows + i;
        line l;
        make_line(&l, r->span, r->rise, r->part_count, r->parts, r->load_count, r->loads);
        strum_hanging *cable = hang(&l);
        const strum_cable_statics s = statics_of(cable);
        const double force = fmax(hypot(r->h_1, r->v_1), hypot(r->h_2, r->v_2));
        const double limit = r->tolerance * force, near = 1e-11 * s.unstretched_length;
        check_absolute(s.horizontal_end_1, r->h_1, limit);
        check_absolute(s.vertical_end_1, r->v_1, limit);
        check_absolute(s.horizontal_end_2, r->h_2, limit);
        check_absolute(s.vertical_end_2, r->v_2, limit);
        check_absolute(s.length, r->length, near);
        check_absolute(s.lowest.z, r->lowest, near);
        check_absolute(s.highest.z, r->highest, near);
        assert_true(s.closure <= 1e-13);
        assert_int_equal(s.contacts, 0);
        assert_int_equal(s.solutions, 1);
        strum_cable_free(cable);
    }
}

/* Equal to the last digits to the double root of the catenary's own equation
 *     sqrt(L^2 - Z^2) = 2 a sinh(X/2a),  in 40 digits. */
static void nearly_taut(void **state)
{
    (void)state;
    line l;
    make_line(&l, 400, 300, 1, &(part){500.00000050000006, 9.80665, INFINITY}, 0, NULL);
    strum_hanging *cable = hang(&l);
    check_relative(statics_of(cable).horizontal_end_1, 20256528.0188293122, 1e-13);
    strum_cable_free(cable);
}

/* ---- a second method ---- */

/* 400 panels of Gauss' rule of three points on each piece between loads and sections. */
static void integrate(double h, double v, double length, const strum_cable_section *section,
                      double *x, double *z)
{
    static const double node[] = {-0.774596669241483377, 0, 0.774596669241483377},
                        weight[] = {5. / 9, 8. / 9, 5. / 9};
    const int panels = 400;
    for (int i = 0; i < panels; i++)
        for (int k = 0; k < 3; k++) {
            const double half = length / (2 * panels);
            const double s = half * (2 * i + 1 + node[k]);
            const double v_s = v + section->weight * s;
            const double factor =
                half * weight[k] * (1 / hypot(h, v_s) + 1 / section->axial_stiffness);
            *x += factor * h;
            *z += factor * v_s;
        }
}

/* The line from end 1 by quadrature, its loads as the header of cable.h defines them. */
static void walk(const line *l, double h, double v, double *x, double *z)
{
    double begin = 0;
    size_t next = 0;
    *x = *z = 0;
    for (size_t i = 0; i < l->params.section_count; i++) {
        const strum_cable_section *section = l->sections + i;
        const double end = begin + section->length;
        double at = begin;
        for (;;) {
            for (; next < l->params.attachment_count && l->attachments[next].position <= at;
                 next++) {
                const strum_cable_attachment *a = l->attachments + next;
                const double tension = hypot(h, v);
                h += a->jump * h / tension - a->force_x;
                v += a->jump * v / tension + a->weight - a->force_z;
            }
            const bool cut =
                next < l->params.attachment_count && l->attachments[next].position < end;
            const double to = cut ? l->attachments[next].position : end;
            integrate(h, v, to - at, section, x, z);
            v += section->weight * (to - at);
            at = to;
            if (!cut)
                break;
        }
        begin = end;
    }
}

static void closes_by_quadrature(void **state)
{
    (void)state;
    static const part parts[] = {{60, 80, 4e6}, {50, -35, 1e6}, {70, 12, INFINITY}};
    static const load loads[] = {{25, 900, 0, 0}, {60, -1200, 300, -50}, {140, 10, -2000, 700}};
    static const double jumps[] = {0, 1500, -300};
    for (int i = 0; i < COUNT(jumps); i++) {
        line l;
        make_line(&l, 120, 35, COUNT(parts), parts, COUNT(loads), loads);
        if (jumps[i] != 0)
            l.attachments[l.params.attachment_count++] = (strum_cable_attachment){
                .kind = STRUM_CABLE_TENSION_JUMP, .position = 165, .jump = jumps[i]};
        strum_hanging *cable = hang(&l);
        const strum_cable_statics s = statics_of(cable);
        double x, z;
        walk(&l, s.horizontal_end_1, s.vertical_end_1, &x, &z);
        check_absolute(x, 120, 1e-8);
        check_absolute(z, 35, 1e-8);
        if (jumps[i] != 0) {
            strum_cable_joint joint;
            assert_int_equal(
                strum_cable_attachment_get(cable, l.params.attachment_count - 1, &joint),
                STRUM_OK);
            check_relative(joint.tension_right, joint.tension_left + jumps[i], 1e-13);
            check_absolute(joint.kink, 0, 1e-12);
        }
        strum_cable_free(cable);
    }
}

/* ---- shapes and getters ---- */

static void shape_and_joints(void **state)
{
    (void)state;
    static const load loads[] = {{150, 500, 0, 0}, {50, 2000, 0, 0}};
    line l;
    make_line(&l, 100, 10, 1, &(part){220, 50, 1e7}, 2, loads); /* not in order */
    strum_hanging *cable = hang(&l);
    strum_cable_point points[45];
    assert_int_equal(strum_cable_shape(cable, NULL, 45, points), STRUM_OK);
    check_absolute(points[0].x, 0, 1e-12);
    check_absolute(points[44].x, 100, 1e-10);
    check_absolute(points[44].z, 10, 1e-10);
    strum_cable_joint joint[2];
    for (size_t i = 0; i < 2; i++) {
        assert_int_equal(strum_cable_attachment_get(cable, i, joint + i), STRUM_OK);
        check_relative(joint[i].position, loads[i].position, 1e-15);
        strum_cable_point at;
        assert_int_equal(strum_cable_shape(cable, &joint[i].position, 1, &at), STRUM_OK);
        check_absolute(at.x, joint[i].x, 1e-12);
        check_relative(at.tension, joint[i].tension_right, 1e-14);
        /* cosine law of the three forces on the joint */
        const double w = loads[i].weight, l_ = joint[i].tension_left,
                     r = joint[i].tension_right;
        check_absolute(l_ * l_ + r * r - 2 * l_ * r * cos(joint[i].kink), w * w, 1e-9 * w * w);
    }
    assert_int_equal(strum_cable_attachment_get(cable, 2, joint), STRUM_ERR_RANGE);
    strum_cable_contact contact;
    assert_int_equal(strum_cable_contact_get(cable, 0, &contact), STRUM_ERR_RANGE);
    strum_cable_section section;
    assert_int_equal(strum_cable_section_get(cable, 0, &section), STRUM_OK);
    check_relative(section.length, 220, 1e-15);
    assert_int_equal(strum_cable_section_get(cable, 1, &section), STRUM_ERR_RANGE);
    const double outside[] = {-1, 221};
    for (int i = 0; i < 2; i++)
        assert_int_equal(strum_cable_shape(cable, outside + i, 1, points), STRUM_ERR_RANGE);
    assert_int_equal(strum_cable_shape(cable, NULL, 1, points), STRUM_ERR_RANGE);
    strum_cable_free(cable);
    strum_cable_free(NULL);
}

/* Sags and the tension parallel to the chord of a parabola that is nearly one: flat cable, where
 * w X^2/8H (1 + ...) holds to the square of the slope; the exact ones from the level catenary. */
static void sags(void **state)
{
    (void)state;
    line l;
    const double a = 500, span = 300, w = 20; /* H = a w; L = 2 a sinh(X/2a) */
    make_line(&l, span, 0, 1, &(part){2 * a * sinh(span / (2 * a)), w, INFINITY}, 0, NULL);
    strum_hanging *cable = hang(&l);
    const strum_cable_statics s = statics_of(cable);
    const double sag = a * (cosh(span / (2 * a)) - 1);
    check_relative(s.horizontal_end_1, a * w, 1e-12);
    check_relative(s.sag_mid, sag, 1e-12);
    check_relative(s.sag_max, sag, 1e-12);
    check_relative(s.tension_parallel_to_chord, a * w, 1e-12);
    check_relative(s.tension_min, a * w, 1e-12);
    check_relative(s.tension_max, a * w * cosh(span / (2 * a)), 1e-12);
    check_relative(s.angle_end_2, atan(sinh(span / (2 * a))), 1e-12);
    check_relative(s.angle_end_1, -s.angle_end_2, 1e-12);
    strum_cable_free(cable);
}

/* Temperature and what is taken in act after the lengths: as a line of those lengths. */
static void second_state(void **state)
{
    (void)state;
    line l, same;
    make_line(&l, 500, 20, 1, &(part){505, 17.658, 3.6e7}, 0, NULL);
    l.params.temperature_change = 60;
    l.params.expansion = 2.3e-5;
    l.params.taken_in = 0.7;
    const double stretch = 1 + 60 * 2.3e-5;
    make_line(&same, 500, 20, 1, &(part){504.3 * stretch, 17.658 / stretch, 3.6e7}, 0, NULL);
    strum_hanging *cable = hang(&l), *expected = hang(&same);
    check_relative(statics_of(cable).horizontal_end_1, statics_of(expected).horizontal_end_1,
                   1e-12);
    strum_cable_section section;
    assert_int_equal(strum_cable_section_get(cable, 0, &section), STRUM_OK);
    check_relative(section.length, 504.3 * stretch, 1e-15);
    check_relative(section.mass, l.sections[0].mass / stretch, 1e-15);
    strum_cable_free(cable);
    strum_cable_free(expected);
}

/* ---- refusals ---- */

static void expect(const line *l, strum_status status, int argument, const char *word)
{
    strum_hanging *cable;
    strum_error error = {0};
    assert_int_equal(strum_cable_hang(&l->params, NULL, &cable, &error), status);
    assert_null(cable);
    assert_int_equal(error.argument, argument);
    if (strstr(error.reason, word) == NULL)
        fail_msg("'%s' does not say '%s'", error.reason, word);
}

static void refusals(void **state)
{
    (void)state;
    line l;
    make_line(&l, 100, 0, 1, &(part){100, 10, INFINITY}, 0, NULL);
    expect(&l, STRUM_ERR_IMPOSSIBLE, STRUM_CABLE_ARG_SECTIONS, "longer");
    make_line(&l, 100, 0, 1, &(part){101, 0, 1e6}, 0, NULL);
    expect(&l, STRUM_ERR_IMPOSSIBLE, STRUM_CABLE_ARG_SECTIONS, "weightless");
    make_line(&l, 100, 0, 1, &(part){0, 10, INFINITY}, 0, NULL);
    expect(&l, STRUM_ERR_RANGE, STRUM_CABLE_ARG_SECTIONS, "length");
    make_line(&l, -1, 0, 1, &(part){100, 10, INFINITY}, 0, NULL);
    expect(&l, STRUM_ERR_RANGE, STRUM_CABLE_ARG_SPAN, "span");
    make_line(&l, 90, NAN, 1, &(part){100, 10, INFINITY}, 0, NULL);
    expect(&l, STRUM_ERR_RANGE, STRUM_CABLE_ARG_RISE, "rise");
    make_line(&l, 90, 0, 1, &(part){100, 10, INFINITY}, 1, &(load){100, 5, 0, 0});
    expect(&l, STRUM_ERR_RANGE, STRUM_CABLE_ARG_ATTACHMENTS, "position");
    make_line(&l, 90, 0, 1, &(part){100, 10, INFINITY}, 0, NULL);
    l.params.spans = 2;
    expect(&l, STRUM_ERR_RANGE, STRUM_CABLE_ARG_HANGER, "hanger");
    l.params.hanger_length = 2;
    l.params.rise = 1;
    expect(&l, STRUM_ERR_RANGE, STRUM_CABLE_ARG_SPANS, "level");
    make_line(&l, 90, 0, 1, &(part){100, 10, INFINITY}, 0, NULL);
    l.params.temperature_change = -2e5;
    l.params.expansion = 1e-5;
    expect(&l, STRUM_ERR_RANGE, STRUM_CABLE_ARG_TEMPERATURE, "temperature");
    l.params.temperature_change = 0;
    l.params.taken_in = 100;
    expect(&l, STRUM_ERR_IMPOSSIBLE, STRUM_CABLE_ARG_TAKEN_IN, "taken in");
    l.params.end_2.rotation = STRUM_CABLE_SPRUNG;
    l.params.end_2.stiffness = -1;
    expect(&l, STRUM_ERR_RANGE, STRUM_CABLE_ARG_END_2, "end");
}

static bool at_once(void *context)
{
    (void)context;
    return true;
}

static void stops(void **state)
{
    (void)state;
    line l;
    make_line(&l, 90, 0, 1, &(part){100, 10, INFINITY}, 0, NULL);
    strum_options options = STRUM_OPTIONS_INIT;
    strum_hanging *cable;
    options.cancelled = at_once;
    assert_int_equal(strum_cable_hang(&l.params, &options, &cable, NULL), STRUM_ERR_CANCELLED);
    options.cancelled = NULL;
    options.work_max = 0.01;
    assert_int_equal(strum_cable_hang(&l.params, &options, &cable, NULL), STRUM_ERR_WORK);
    options.work_max = 0;
    options.bytes_max = 10;
    assert_int_equal(strum_cable_hang(&l.params, &options, &cable, NULL), STRUM_ERR_BYTES);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reference),
        cmocka_unit_test(nearly_taut),
        cmocka_unit_test(closes_by_quadrature),
        cmocka_unit_test(shape_and_joints),
        cmocka_unit_test(sags),
        cmocka_unit_test(second_state),
        cmocka_unit_test(refusals),
        cmocka_unit_test(stops),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
