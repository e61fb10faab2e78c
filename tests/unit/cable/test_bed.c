/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Cables on a sea bed. Reference values: closed catenaries with a march from contact to contact
 * and one Newton iteration of 40 digits, all inequalities met; the forces of a chain of 240 bars
 * with unilateral contact agree with them to 1e-4 and better.
 */
#include "cable/lines.h"

typedef struct {
    double from, to, slack_to;
} stretch;
typedef struct {
    const char *name;
    double span, rise;
    int part_count;
    part parts[PARTS_MAX];
    int load_count;
    load loads[LOADS_MAX];
    double depth, slope_deg, friction;
    double h_1, v_1, h_2, v_2, length, lying, touchdown;
    int contact_count;
    stretch contacts[3];
} row;

/* clang-format off */
static const row rows[] = {
    {"seabed-volturn", 779.6, 186.0, 1, {{850.0, 5844.117996654215, 3270000000.0}}, 0, {{0, 0, 0, 0}}, 0.0, 0.0, 0.0,
     1350008.0655223718, 0.0, 1350008.0655223718, 2028164.2710447335, 850.393963252973, 502.956310566305, 503.1639543203936, 1, {{0.0, 502.956310566305, 0.0}}},
    {"seabed-wd0050", 400.0, 50.0, 1, {{410.0, 3324.385105461581, 1674000000.0}}, 0, {{0, 0, 0, 0}}, 0.0, 0.0, 0.0,
     835867.155111054, 0.0, 835867.155111054, 552558.1515716023, 410.2104223490248, 243.78635926872218, 243.90808747097836, 1, {{0.0, 243.78635926872218, 0.0}}},
    {"seabed-wd0600", 1500.0, 600.0, 1, {{1700.0, 3324.385105461581, 1674000000.0}}, 0, {{0, 0, 0, 0}}, 0.0, 0.0, 0.0,
     3248314.732894974, 0.0, 3248314.732894974, 4109023.8190384796, 1703.8360432163145, 463.9747837012542, 464.8751039674361, 1, {{0.0, 463.9747837012542, 0.0}}},
    {"bed-friction-volturn-0.3", 779.6, 186.0, 1, {{850.0, 5844.117996654215, 3270000000.0}}, 0, {{0, 0, 0, 0}}, 0.0, 0.0, 0.3,
     471845.0752192683, 0.0, 1353142.7437473524, 2029841.4020624687, 850.3270684242872, 502.66933295587756, 502.8096028961853, 1, {{0.0, 502.66933295587756, 0.0}}},
    {"bed-friction-two-pieces", 600.0, 100.0, 2, {{250.0, 3324.385105461581, 1674000000.0}, {400.0, 200.0, 200000000.0}}, 0, {{0, 0, 0, 0}}, 0.0, 0.0, 0.4,
     0.0, 0.0, 12065.822289264484, 29706.756931291242, 650.0194276480204, 501.4662153435438, 501.47076484565366, 1, {{0.0, 501.4662153435438, 350.64343672773776}}},
    {"bed-friction-clump", 360.0, 100.0, 1, {{400.0, 800.0, 1000000000.0}}, 1, {{200.0, 60000.0, 0.0, 0.0}}, 0.0, 0.0, 0.5,
     0.0, 0.0, 87720.51678955085, 142940.0431973299, 400.0258685700244, 221.3249460033376, 221.32975032429076, 1, {{0.0, 221.3249460033376, 77.02365402946047}}},
    {"bed-slope-down", 370.0, 60.0, 1, {{400.0, 800.0, 1000000000.0}}, 0, {{0, 0, 0, 0}}, 0.0, -8.0, 0.0,
     150742.51206534883, -21185.478470799437, 130131.29616425397, 152158.09996502634, 400.0590795053575, 186.94142381393164, 185.1483762028327, 1, {{0.0, 186.94142381393164, 0.0}}},
    {"bed-slope-friction-up", 372.0, 120.0, 1, {{400.0, 800.0, 1000000000.0}}, 0, {{0, 0, 0, 0}}, 0.0, 6.0, 0.4,
     196026.86574783758, 20603.253815953896, 256939.63696928648, 225078.7916306401, 400.1067048301294, 152.4083155280716, 151.60792475969848, 1, {{0.0, 152.4083155280716, 0.0}}},
    {"bed-U", 300.0, 20.0, 1, {{400.0, 800.0, 1000000000.0}}, 0, {{0, 0, 0, 0}}, 50.0, 0.0, 0.0,
     3230.6312338377597, -43108.81767173947, 3230.6312338377597, 59140.70962373031, 400.0042782744468, 272.1880908806628, 285.4573399126487, 1, {{53.886022089674334, 326.0741129703371, 53.886022089674334}}},
    {"bed-clump-lying", 340.0, 100.0, 1, {{400.0, 800.0, 1000000000.0}}, 1, {{250.0, 60000.0, 0.0, 0.0}}, 0.0, 0.0, 0.0,
     27140.51855854208, 0.0, 27140.51855854208, 103640.39833150237, 400.0152235165755, 270.44950208562204, 270.45684222535255, 1, {{0.0, 270.44950208562204, 0.0}}},
    {"bed-clump-point-contact", 368.0, 10.0, 1, {{400.0, 150.0, 1000000000.0}}, 1, {{220.0, 40000.0, 0.0, 0.0}}, 70.0, 0.0, 0.0,
     81406.38624109667, -44319.09553532651, 81406.38624109667, 54327.45909642367, 400.03547060092114, 0.0, 207.32385338721647, 1, {{220.0, 220.0, 220.0}}},
    {"bed-clump-at-liftoff", 362.0, 10.0, 1, {{400.0, 150.0, 1000000000.0}}, 1, {{220.0, 40000.0, 0.0, 0.0}}, 70.0, 0.0, 0.0,
     38052.20281071564, -30154.636635370778, 38052.20281071564, 33308.59964497969, 400.0169319968927, 18.969089097528155, 203.3442658551318, 1, {{201.03091090247185, 220.0, 201.03091090247185}}},
    {"bed-lazy-wave-two-contacts", 350.0, 180.0, 3, {{150.0, 140.0, 362000000.0}, {80.0, -450.0, 362000000.0}, {440.0, 140.0, 362000000.0}}, 0, {{0, 0, 0, 0}}, 0.0, 0.0, 0.0,
     3419.9243840058148, 0.0, 3419.9243840058148, 28413.735435746046, 670.018821377714, 129.9018897446711, 21.42877387081989, 2, {{0.0, 21.42857142857143, 0.0}, {358.57142857142856, 467.0447468875282, 358.57142857142856}}},
    {"bed-both-ends-on-it", 280.0, 0.0, 1, {{300.0, 400.0, 500000000.0}}, 1, {{150.0, -50000.0, 0.0, 0.0}}, 0.0, 0.0, 0.0,
     20172.732621027782, 0.0, 20172.732621027782, 0.0, 300.01319382537554, 175.0, 87.50353022820867, 2, {{0.0, 87.5, 0.0}, {212.5, 300.0, 212.5}}},
    {"bed-buoyant-from-anchor", 260.0, 60.0, 2, {{60.0, -100.0, 100000000.0}, {260.0, 250.0, 300000000.0}}, 0, {{0, 0, 0, 0}}, 0.0, 0.0, 0.0,
     1932.0726877313296, 3325.629416077056, 1932.0726877313296, 16821.00506217162, 320.0047652401324, 182.01849741562177, 237.89306706594206, 1, {{70.69748233569177, 252.71597975131354, 70.69748233569177}}},
    {"bed-case3-float-clump", 800.0, 300.0, 1, {{900.0, 4589.105004699913, 2000000000.0}}, 2, {{400.0, -2011050.0, 0.0, 0.0}, {650.0, 981000.0, 0.0, 0.0}}, 0.0, 0.0, 0.0,
     2214686.9329123846, 0.0, 2214686.9329123846, 2830827.6828365913, 901.1491292518551, 58.68613185305418, 58.751117557733245, 1, {{0.0, 58.68613185305418, 0.0}}},
};
/* clang-format on */

static void lay_bed(line *l, double depth, double slope_deg, double friction)
{
    l->params.bed = (strum_cable_bed){true, depth, slope_deg * M_PI / 180, friction};
}

static void make_row(line *l, const row *r)
{
    make_line(l, r->span, r->rise, r->part_count, r->parts, r->load_count, r->loads);
    lay_bed(l, r->depth, r->slope_deg, r->friction);
}

static void check_contacts(const strum_hanging *cable, const row *r)
{
    const double near = 1e-11 * statics_of(cable).unstretched_length;
    strum_cable_contact c;
    assert_int_equal(statics_of(cable).contacts, r->contact_count);
    for (int i = 0; i < r->contact_count; i++) {
        assert_int_equal(strum_cable_contact_get(cable, (size_t)i, &c), STRUM_OK);
        check_absolute(c.from, r->contacts[i].from, near);
        check_absolute(c.to, r->contacts[i].to, near);
        check_absolute(c.slack_to, r->contacts[i].slack_to, near);
        if (i == 0)
            check_absolute(c.touchdown, r->touchdown, near);
    }
    assert_int_equal(strum_cable_contact_get(cable, (size_t)r->contact_count, &c),
                     STRUM_ERR_RANGE);
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
        const double limit = 1e-11 * fmax(hypot(r->h_1, r->v_1), hypot(r->h_2, r->v_2));
        check_absolute(s.horizontal_end_1, r->h_1, limit);
        check_absolute(s.vertical_end_1, r->v_1, limit);
        check_absolute(s.horizontal_end_2, r->h_2, limit);
        check_absolute(s.vertical_end_2, r->v_2, limit);
        check_absolute(s.length, r->length, 1e-11 * r->length);
        check_absolute(s.lying, r->lying, 1e-11 * r->length);
        check_contacts(cable, r);
        assert_true(s.closure <= 1e-13);
        strum_cable_free(cable);
    }
}

/* ---- what must hold on any bed ---- */

/* Nowhere below the bed, along the bed where it lies, and at every place the tension's change is
 * what weight and friction make of it: dT/dS = w dz/ds of what hangs. */
static void passes(const line *l, const strum_hanging *cable)
{
    enum { N = 4001 };
    static strum_cable_point points[N];
    const strum_cable_statics s = statics_of(cable);
    const double slope = tan(l->params.bed.slope), near = 1e-9 * s.unstretched_length;
    assert_int_equal(strum_cable_shape(cable, NULL, N, points), STRUM_OK);
    for (int i = 0; i < N; i++) {
        const double height = points[i].z + l->params.bed.depth - slope * points[i].x;
        if (!(height >= -near))
            fail_msg("%g m below the bed at %g m", -height, points[i].position);
        bool lies = false;
        for (size_t k = 0; k < s.contacts; k++) {
            strum_cable_contact c;
            assert_int_equal(strum_cable_contact_get(cable, k, &c), STRUM_OK);
            lies |= points[i].position >= c.from && points[i].position <= c.to;
        }
        if (lies)
            check_absolute(height, 0, near);
    }
    check_absolute(points[N - 1].x, l->params.span, near);
    check_absolute(points[N - 1].z, l->params.rise, near);
    assert_true(!(s.lowest_clearance < -near));
    assert_true(!(s.smallest_reaction < 0));
    assert_true(s.closure <= 1e-11);
}

static void inequalities(void **state)
{
    (void)state;
    for (int i = 0; i < COUNT(rows); i++) {
        line l;
        make_row(&l, rows + i);
        strum_hanging *cable = hang(&l);
        passes(&l, cable);
        strum_cable_free(cable);
    }
}

/* Without friction a line and its mirror image are one. */
static void mirrored(void **state)
{
    (void)state;
    for (int i = 0; i < COUNT(rows); i++) {
        const row *r = rows + i;
        line l, m;
        row image = *r;
        double length = 0;
        if (r->friction > 0)
            continue;
        make_row(&l, r);
        for (int k = 0; k < r->part_count; k++) {
            image.parts[k] = r->parts[r->part_count - 1 - k];
            length += r->parts[k].length;
        }
        for (int k = 0; k < r->load_count; k++)
            image.loads[k].position = length - r->loads[k].position;
        image.rise = -r->rise;
        image.slope_deg = -r->slope_deg;
        image.depth = r->depth + r->rise - r->span * tan(r->slope_deg * M_PI / 180);
        make_row(&m, &image);
        strum_hanging *one = hang(&l), *other = hang(&m);
        const strum_cable_statics a = statics_of(one), b = statics_of(other);
        check_relative(a.horizontal_end_1, b.horizontal_end_2, 1e-9);
        check_absolute(a.vertical_end_1, -b.vertical_end_2, 1e-9 * a.tension_max);
        check_relative(a.horizontal_end_2, b.horizontal_end_1, 1e-9);
        check_relative(a.tension_max, b.tension_max, 1e-9);
        check_absolute(a.lying, b.lying, 1e-9 * length);
        strum_cable_free(one);
        strum_cable_free(other);
    }
}

/* A bed that the line does not reach changes nothing. */
static void out_of_reach(void **state)
{
    (void)state;
    line l;
    make_line(&l, 100, 10, 1, &(part){130, 50, 1e7}, 0, NULL);
    strum_hanging *free_line = hang(&l);
    lay_bed(&l, 60, 3, 0.2);
    strum_hanging *cable = hang(&l);
    assert_true(statics_of(cable).horizontal_end_1 == statics_of(free_line).horizontal_end_1);
    assert_int_equal(statics_of(cable).contacts, 0);
    assert_true(statics_of(cable).lowest_clearance > 0);
    assert_true(isnan(statics_of(cable).smallest_reaction));
    strum_cable_free(cable);
    strum_cable_free(free_line);
}

/* Far too long: it hangs straight down to the bed, w^2 l^2/2 of stretch, and lies slack. */
static void slack(void **state)
{
    (void)state;
    const double w = 800, stiffness = 1e7, rise = 100;
    line l;
    make_line(&l, 50, rise, 1, &(part){400, w, stiffness}, 0, NULL);
    lay_bed(&l, 0, 0, 0);
    strum_hanging *cable = hang(&l);
    const strum_cable_statics s = statics_of(cable);
    /* l + w l^2/(2 EA) = rise */
    const double hanging = (sqrt(1 + 2 * w * rise / stiffness) - 1) * stiffness / w;
    check_absolute(s.horizontal_end_2, 0, 1e-9);
    check_relative(s.vertical_end_2, w * hanging, 1e-12);
    check_relative(s.lying, 400 - hanging, 1e-12);
    assert_true(s.slack);
    check_absolute(s.closure, 0, 1e-12);
    strum_cable_free(cable);
}

/* ---- a length or span for a tension ---- */

static void ends(void **state)
{
    (void)state;
    const part chain = {850, 5844.117996654215, 3270000000.0};
    line l;
    make_line(&l, 779.6, 186, 1, &chain, 0, NULL);
    lay_bed(&l, 0, 0, 0);
    l.params.given = STRUM_CABLE_HORIZONTAL_TENSION;
    l.params.value = 1200000;
    strum_hanging *cable = hang(&l);
    check_relative(statics_of(cable).unstretched_length, 853.482469614626, 1e-12);
    check_relative(statics_of(cable).tension_end_2, 2286426.781104694, 1e-11);
    strum_cable_free(cable);
    l.params.given = STRUM_CABLE_TENSION_END_2;
    l.params.value = 2200000;
    cable = hang(&l);
    check_relative(statics_of(cable).unstretched_length, 855.7356105549062, 1e-12);
    check_relative(statics_of(cable).horizontal_end_1, 1113544.514184232, 1e-11);
    assert_int_equal(statics_of(cable).solutions, 1);
    strum_cable_free(cable);
    l.params.given = STRUM_CABLE_HORIZONTAL_TENSION;
    l.params.value = 1200000;
    l.params.span_unknown = true;
    cable = hang(&l);
    check_relative(statics_of(cable).span, 776.1162524148732, 1e-12);
    strum_cable_free(cable);
}

/* ---- refusals ---- */

static void expect(const line *l, strum_status status, int argument, const char *word)
{
    strum_hanging *cable;
    strum_error error = {0};
    assert_int_equal(strum_cable_hang(&l->params, NULL, &cable, &error), status);
    assert_int_equal(error.argument, argument);
    if (strstr(error.reason, word) == NULL)
        fail_msg("'%s' does not say '%s'", error.reason, word);
}

static void refusals(void **state)
{
    (void)state;
    line l;
    make_line(&l, 100, -5, 1, &(part){130, 50, 1e7}, 0, NULL);
    lay_bed(&l, 4, 0, 0);
    expect(&l, STRUM_ERR_IMPOSSIBLE, STRUM_CABLE_ARG_BED, "end 2 lies 1 m below");
    lay_bed(&l, -1, 0, 0);
    expect(&l, STRUM_ERR_RANGE, STRUM_CABLE_ARG_BED, "negative");
    lay_bed(&l, 5, 81, 0);
    expect(&l, STRUM_ERR_RANGE, STRUM_CABLE_ARG_BED, "80 degrees");
    /* slack on a slope: with friction of less than its angle it slides */
    make_line(&l, 300, 60, 1, &(part){420, 800, 1e9}, 0, NULL);
    lay_bed(&l, 0, 8, 0.1);
    expect(&l, STRUM_ERR_IMPOSSIBLE, STRUM_CABLE_ARG_BED, "slide");
    make_line(&l, 370, 120, 1, &(part){400, 800, 1e9}, 0, NULL);
    lay_bed(&l, 0, 8, 0.3);
    strum_hanging *cable = hang(&l);
    passes(&l, cable);
    strum_cable_free(cable);
    make_line(&l, 30, 20, 1, &(part){100, 0, 1e7}, 0, NULL);
    lay_bed(&l, 0, 0, 0);
    expect(&l, STRUM_ERR_IMPOSSIBLE, STRUM_CABLE_ARG_SECTIONS, "weightless");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reference), cmocka_unit_test(inequalities),
        cmocka_unit_test(mirrored),  cmocka_unit_test(out_of_reach),
        cmocka_unit_test(slack),     cmocka_unit_test(ends),
        cmocka_unit_test(refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
