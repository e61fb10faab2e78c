/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Modes of the general cable: frequencies, counts, refusals. */
#include "check.h"

#include <complex.h>
#include <string.h>

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

/* Displacements of mode 1 over the largest of them, and the dynamic tension at the ends per metre
 * of it, by the two methods of modes_table.h. */
static const struct {
    const char *name;
    struct {
        double position, x[2], z[2];
    } points[7];
    double tension[2][2];
} shapes[] = {
    {"buoy-01",
     {{13.5, {0.0932362163037, 0}, {0.0410821210157, 0}},
      {54.0, {0.274859418766, 0}, {0.15887411529, 0}},
      {94.5, {0.529595709226, 0}, {-0.616828592557, 0}},
      {135.0, {0.993654899631, 0}, {-0.926966479572, 0}},
      {167.4, {1.0, 0}, {-0.901362880302, 0}},
      {216.0, {0.514909817373, 0}, {-0.216623259353, 0}},
      {251.1, {0.141263793456, 0}, {-0.0435531198639, 0}}},
     {{510.307869503, 0}, {287.436506566, 0}}},
    {"damp-7",
     {{10.001, {-0.000163816818542, -0.000634519834122}, {0.0555736287031, -0.00964220784621}},
      {40.004, {0.00720462186633, -0.000759312867561}, {0.420603027998, -0.0124854390776}},
      {70.007, {0.00868497145173, -0.000601628648591}, {0.824201862177, -0.00826186673942}},
      {100.01, {-0.000241903602113, -0.000481158732106}, {1.0, -0.0}},
      {124.0124, {-0.00808690282787, -0.000496376797863}, {0.890685622157, 0.00577634186115}},
      {160.016, {-0.00782998866307, -0.000484270174919}, {0.430696920991, 0.00759592835213}},
      {186.0186, {-0.00100206002843, -0.000220769114238}, {0.09885538055, 0.00316250004205}}},
     {{-605392.309732, 1945.46952495}, {-605371.549173, 1986.84723332}}},
};

static void check_shape(size_t k)
{
    const mode_case *c = mode_cases;
    double positions[7];
    strum_cable_motion_point points[7];
    strum_cable_mode mode;
    while (strcmp(c->name, shapes[k].name) != 0)
        c++;
    strum_hanging *cable = hung(c);
    strum_cable_modes *modes = solved(cable, c->plane, c->count);
    double _Complex want = 0, got = 1;
    for (int i = 0; i < 7; i++)
        positions[i] = shapes[k].points[i].position;
    assert_int_equal(strum_cable_modes_shape(modes, 0, positions, 7, points), STRUM_OK);
    assert_int_equal(strum_cable_modes_get(modes, 0, &mode), STRUM_OK);
    for (int i = 0; i < 7; i++) {
        const double _Complex x = CMPLX(shapes[k].points[i].x[0], shapes[k].points[i].x[1]);
        const double _Complex z = CMPLX(shapes[k].points[i].z[0], shapes[k].points[i].z[1]);
        if (cabs(x) > cabs(want)) {
            want = x;
            got = points[i].x;
        }
        if (cabs(z) > cabs(want)) {
            want = z;
            got = points[i].z;
        }
    }
    for (int i = 0; i < 7; i++) {
        const double _Complex x = CMPLX(shapes[k].points[i].x[0], shapes[k].points[i].x[1]);
        const double _Complex z = CMPLX(shapes[k].points[i].z[0], shapes[k].points[i].z[1]);
        check_absolute(cabs(points[i].x * want / got - x), 0, 1e-10);
        check_absolute(cabs(points[i].z * want / got - z), 0, 1e-10);
    }
    for (int i = 0; i < 2; i++) {
        const double _Complex t = CMPLX(shapes[k].tension[i][0], shapes[k].tension[i][1]);
        check_absolute(cabs(mode.end_tension[i] * want / got / t - 1), 0, 1e-9);
    }
    check_absolute(mode.energy_tension + mode.energy_bending + mode.energy_axial +
                       mode.energy_attachments,
                   1, 1e-14);
    strum_cable_modes_free(modes);
    strum_cable_free(cable);
}

static void shapes_and_ends(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof shapes / sizeof *shapes; k++)
        check_shape(k);
}

/* ---- on the bed ---- */

/* The anchor line of the VolturnUS-S floating wind turbine (its report: H 1350.0 kN, fairlead
 * 2436.4 kN), held and sliding; a lazy wave with two hanging parts; a vertical tether. Frequencies
 * in Hz by displacement elements (hp) and by shooting, which agree to 1e-13. */
typedef struct {
    const char *name;
    strum_cable_section sections[3];
    size_t section_count;
    double span, rise;
    bool bed, sliding;
    double in_plane[6], across[6];
    size_t run_in_plane[6], run_across[6];
} bed_case;

#define VOLTURN                                                                                \
    {                                                                                          \
        {                                                                                      \
            .length = 850, .mass = 685, .weight = 5844.117996654215,                           \
            .added_mass = 73.20084023889338, .axial_stiffness = 3.27e9, .bed_friction = NAN    \
        }                                                                                      \
    }
#define LAZY(l, m, w)                                                                          \
    {                                                                                          \
        .length = l, .mass = m, .weight = w, .axial_stiffness = 3.62e8, .bed_friction = NAN    \
    }

/* clang-format off */
static const bed_case bed_cases[] = {
    {"held", VOLTURN, 1, 779.6, 186, true, false,
     {0.126469854417017, 0.192678178666936, 0.268669503235749, 0.334287706639739,
      0.407080901806047, 0.472783643973379},
     {0.0691824297321645, 0.137213719992422, 0.205483658109069, 0.273821315169964,
      0.342185967723921, 0.410564086137435},
     {0}, {0}},
    {"sliding", VOLTURN, 1, 779.6, 186, true, true,
     {0.126318366194718, 0.192016473930271, 0.268310712401957, 0.332649054847785,
      0.406179356767267, 0.467483432569257},
     {0.0268023620559927, 0.0526079307504547, 0.0782026473268802, 0.104205521207523,
      0.130175106173225, 0.156112336649064},
     {0}, {0}},
    {"two hanging parts", {LAZY(150, 25, 140), LAZY(80, 59, -450), LAZY(440, 25, 140)}, 3,
     350, 180, true, false,
     {0.0316745716843599, 0.0343111391699362, 0.0563675653134795, 0.0728239154571545,
      0.0756963760536377, 0.110942663700423},
     {0.019075445369748, 0.0429444099946938, 0.0525165020711763, 0.0754566654717785,
      0.0896887801488593, 0.105303511853817},
     {0, 0, 0, 0, 1, 0}, {0, 0, 1, 0, 0, 1}},
    {"vertical tether",
     {{.length = 1.3, .mass = 0.5, .weight = 4.903325, .axial_stiffness = 1e6,
       .bed_friction = NAN}}, 1, 0, 1.5, false, false,
     {198.614530563287, 397.229061129286, 543.928293220421, 595.843591694683, 794.45812225993,
      993.072652825116},
     {198.614530563286, 397.229061129286, 595.843591694682, 794.458122259928, 993.072652825113,
      1191.68718339027},
     {0}, {0}},
};
/* clang-format on */

static void check_bed(const bed_case *c, strum_plane plane)
{
    strum_cable_params params = STRUM_CABLE_PARAMS_INIT;
    strum_cable_modes_params wanted = STRUM_CABLE_MODES_PARAMS_INIT;
    strum_hanging *cable;
    strum_cable_modes *modes;
    strum_error error;
    params.sections = c->sections;
    params.section_count = c->section_count;
    params.span = c->span;
    params.rise = c->rise;
    params.bed.present = c->bed;
    wanted.plane = plane;
    wanted.contact = c->sliding ? STRUM_CABLE_SLIDING : STRUM_CABLE_HELD;
    if (strum_cable_hang(&params, NULL, &cable, &error) != STRUM_OK ||
        strum_cable_modes_solve(cable, &wanted, NULL, &modes, &error) != STRUM_OK)
        fail_msg("%s: %s", c->name, error.reason);
    for (size_t i = 0; i < 6; i++) {
        strum_cable_mode mode;
        assert_int_equal(strum_cable_modes_get(modes, i, &mode), STRUM_OK);
        check_relative(mode.frequency / (2 * M_PI),
                       plane == STRUM_IN_PLANE ? c->in_plane[i] : c->across[i], 1e-12);
        assert_int_equal(mode.run,
                         plane == STRUM_IN_PLANE ? c->run_in_plane[i] : c->run_across[i]);
    }
    strum_cable_certificate certificate;
    strum_cable_modes_certificate(modes, &certificate);
    assert_int_equal(certificate.expected, certificate.found);
    strum_cable_modes_free(modes);
    strum_cable_free(cable);
}

static void on_the_bed(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof bed_cases / sizeof *bed_cases; i++) {
        check_bed(bed_cases + i, STRUM_IN_PLANE);
        check_bed(bed_cases + i, STRUM_OUT_OF_PLANE);
    }
}

/* ---- spans in a row ---- */

/* Two spans are one cable of twice the span, held up at its middle by the force that the hanger
 * gives, on springs: a rigid one vertically, (P + W/2)/l along and across, with a third of the
 * hanger's mass. */
static void check_two_spans(strum_plane plane, double stiffness)
{
    enum { COUNT = 8 };
    const double weight = 17.658, length = 300.8, hanger = 2.2, mass = 60;
    const strum_cable_section section = {.length = length,
                                         .mass = 1.8,
                                         .weight = weight,
                                         .axial_stiffness = 3.6e7,
                                         .bending_stiffness = stiffness,
                                         .bed_friction = NAN};
    strum_cable_section twice = section;
    const double pull = weight * length, spring = (pull + mass * 9.80665 / 2) / hanger;
    const strum_cable_attachment held[] = {
        {STRUM_CABLE_FORCE, length, STRUM_CABLE_NORMAL, .force_z = pull},
        {STRUM_CABLE_SPRING, length, STRUM_CABLE_VERTICAL, .stiffness = 1e20},
        {STRUM_CABLE_SPRING, length, STRUM_CABLE_HORIZONTAL, .stiffness = spring},
        {STRUM_CABLE_SPRING, length, STRUM_CABLE_ACROSS, .stiffness = spring},
        {STRUM_CABLE_POINT_MASS, length, STRUM_CABLE_NORMAL, .mass = mass / 3},
    };
    strum_cable_params row = STRUM_CABLE_PARAMS_INIT, one = STRUM_CABLE_PARAMS_INIT;
    strum_hanging *cable;
    row.sections = &section;
    row.section_count = one.section_count = 1;
    row.span = 300;
    row.spans = 2;
    row.hanger_length = hanger;
    row.hanger_mass = mass;
    twice.length = 2 * length;
    one.sections = &twice;
    one.span = 600;
    one.attachments = held;
    one.attachment_count = sizeof held / sizeof *held;
    assert_int_equal(strum_cable_hang(&row, NULL, &cable, NULL), STRUM_OK);
    strum_cable_modes *got = solved(cable, plane, COUNT);
    strum_cable_free(cable);
    assert_int_equal(strum_cable_hang(&one, NULL, &cable, NULL), STRUM_OK);
    strum_cable_modes *want = solved(cable, plane, COUNT);
    strum_cable_free(cable);
    for (size_t i = 0; i < COUNT; i++) {
        strum_cable_mode a, b;
        assert_int_equal(strum_cable_modes_get(got, i, &a), STRUM_OK);
        assert_int_equal(strum_cable_modes_get(want, i, &b), STRUM_OK);
        check_relative(a.frequency, b.frequency, 1e-11);
    }
    strum_cable_modes_free(got);
    strum_cable_modes_free(want);
}

static void spans_in_a_row(void **state)
{
    (void)state;
    check_two_spans(STRUM_IN_PLANE, 0);
    check_two_spans(STRUM_OUT_OF_PLANE, 0);
    check_two_spans(STRUM_IN_PLANE, 900);
    check_two_spans(STRUM_OUT_OF_PLANE, 900);
}

/* The second method finds the same modes: bending layers, bodies, drag and loss, stiff statics, an
 * absorber, what slides. */
static void second_method(void **state)
{
    (void)state;
    static const char *const names[] = {"sagei-03-in", "mass-08-in", "damp-1c", "tmd-3",
                                        "loss-8",      "stiff-03",   "beam-11"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        const mode_case *c = mode_cases;
        strum_verification verification;
        while (strcmp(c->name, names[k]) != 0)
            c++;
        strum_hanging *cable = hung(c);
        strum_cable_modes *modes = solved(cable, c->plane, 3);
        assert_int_equal(strum_cable_modes_verify(modes, NULL, &verification, NULL), STRUM_OK);
        if (!(verification.max_relative_difference < 1e-11))
            fail_msg("%s: %.1e", c->name, verification.max_relative_difference);
        assert_int_equal(verification.modes_expected, verification.modes_found);
        strum_cable_modes_free(modes);
        strum_cable_free(cable);
    }
}

/* ---- the limits that other models of the library solve exactly ---- */

/* Bare and inextensible: Gale's suspended cable. */
static void as_suspended(double rise, double length, strum_plane plane)
{
    const double span = 100, g = 9.80665;
    const strum_cable_section section = {.length = length,
                                         .mass = 2,
                                         .weight = 2 * g,
                                         .axial_stiffness = HUGE_VAL,
                                         .bed_friction = NAN};
    strum_cable_params params = STRUM_CABLE_PARAMS_INIT;
    strum_modes_params gale = STRUM_MODES_PARAMS_INIT;
    strum_catenary catenary;
    strum_hanging *cable;
    strum_modes *other;
    params.sections = &section;
    params.section_count = 1;
    params.span = span;
    params.rise = rise;
    assert_int_equal(strum_cable_hang(&params, NULL, &cable, NULL), STRUM_OK);
    strum_cable_modes *modes = solved(cable, plane, 6);
    assert_int_equal(strum_catenary_from_length(span, rise, length, &catenary, NULL), STRUM_OK);
    gale.cable.chi_m = catenary.chi_m;
    gale.cable.mu = catenary.mu;
    gale.plane = plane;
    assert_int_equal(strum_modes_solve(&gale, NULL, &other, NULL), STRUM_OK);
    for (size_t i = 0; i < 6; i++) {
        strum_cable_mode a;
        strum_mode b;
        assert_int_equal(strum_cable_modes_get(modes, i, &a), STRUM_OK);
        assert_int_equal(strum_modes_get(other, i, &b), STRUM_OK);
        check_relative(a.frequency, b.frequency * sqrt(g * catenary.span / span), 1e-12);
    }
    strum_cable_modes_free(modes);
    strum_modes_free(other);
    strum_cable_free(cable);
}

/* Straight, with a mass, a spring and an inerter: the chain of a taut string. */
static void as_taut(void)
{
    enum { PARTS = 5, COUNT = 6 };
    const double tension = 5000, length[] = {11, 24, 15}, mass = 1.5;
    const strum_cable_section section = {
        .length = 50, .mass = mass, .axial_stiffness = HUGE_VAL, .bed_friction = NAN};
    const strum_cable_attachment attached[] = {
        {STRUM_CABLE_POINT_MASS, 11, STRUM_CABLE_NORMAL, .mass = 20},
        {STRUM_CABLE_SPRING, 35, STRUM_CABLE_ACROSS, .stiffness = 700},
        {STRUM_CABLE_INERTER, 35, STRUM_CABLE_ACROSS, .inertance = 4},
    };
    strum_taut_component parts[PARTS] = {{.kind = STRUM_TAUT_CABLE},
                                         {.kind = STRUM_TAUT_GROUND},
                                         {.kind = STRUM_TAUT_CABLE},
                                         {.kind = STRUM_TAUT_GROUND},
                                         {.kind = STRUM_TAUT_CABLE}};
    for (int i = 0; i < PARTS; i += 2) {
        parts[i].tension_left = parts[i].tension_right = tension;
        parts[i].cable.length = length[i / 2];
        parts[i].cable.mass_per_length = mass;
    }
    parts[1].ground.inertance = 20;
    parts[3].ground.stiffness = 700;
    parts[3].ground.inertance = 4;
    const long numbers[COUNT] = {1, 2, 3, 4, 5, 6};
    const strum_taut_query query = {.numbers = numbers, .count = COUNT};
    strum_cable_params params = STRUM_CABLE_PARAMS_INIT;
    strum_hanging *cable;
    strum_taut *chain;
    strum_taut_roots *roots;
    params.sections = &section;
    params.section_count = 1;
    params.attachments = attached;
    params.attachment_count = sizeof attached / sizeof *attached;
    params.given = STRUM_CABLE_HORIZONTAL_TENSION;
    params.value = tension;
    params.span_unknown = true;
    assert_int_equal(strum_cable_hang(&params, NULL, &cable, NULL), STRUM_OK);
    strum_cable_modes *modes = solved(cable, STRUM_OUT_OF_PLANE, COUNT);
    assert_int_equal(
        strum_taut_make(parts, PARTS, STRUM_TAUT_FIXED, STRUM_TAUT_FIXED, &chain, NULL),
        STRUM_OK);
    assert_int_equal(strum_taut_solve(chain, &query, NULL, &roots, NULL), STRUM_OK);
    for (size_t i = 0; i < COUNT; i++) {
        strum_cable_mode mode;
        assert_int_equal(strum_cable_modes_get(modes, i, &mode), STRUM_OK);
        check_relative(mode.frequency, roots->roots[i].frequency, 1e-12);
    }
    strum_cable_modes_free(modes);
    strum_cable_free(cable);
    strum_taut_roots_free(roots);
    strum_taut_free(chain);
}

static void limits(void **state)
{
    (void)state;
    as_suspended(0, 100.5, STRUM_IN_PLANE);
    as_suspended(0, 140, STRUM_IN_PLANE);
    as_suspended(40, 112, STRUM_IN_PLANE);
    as_suspended(40, 112, STRUM_OUT_OF_PLANE);
    as_taut();
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
        cmocka_unit_test(reference),       cmocka_unit_test(many_modes),
        cmocka_unit_test(shapes_and_ends), cmocka_unit_test(on_the_bed),
        cmocka_unit_test(spans_in_a_row),  cmocka_unit_test(second_method),
        cmocka_unit_test(limits),          cmocka_unit_test(refusals),
    };
    return cmocka_run_group_tests_name("cable_modes", tests, NULL, NULL);
}
