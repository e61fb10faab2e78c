/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Inclined cables. Reference values, unless said otherwise: equations (1)-(5) of Grinfogel's
 * report (errata mended) by Taylor shooting in 26 digits, its determinant and (21) by
 * arbitrary-precision root finding; kL/pi throughout.
 */
#include <strum/strum.h>
#include <complex.h>

#include "inclined/cables.h"

/* ---- statics ---- */

static void statics(void **state)
{
    (void)state;
    static const struct {
        double epsilon, degrees, s_a, tension[2], curvature[2], chord, phase, angle[2];
    } rows[] = {
        {0.18,
         23.46,
         0.494045097665634,
         {0.968040333800854, 1.03961873446507},
         {0.176203728048955, 0.152775531776654},
         0.998867240081999,
         0.999380190440618,
         {18.6259277194268, 28.0692565146414}},
        {0.8,
         80,
         0.435141219851324,
         {0.659949944187534, 1.44715084640233},
         {0.318961469903691, 0.0663334539056757},
         0.999180931261709,
         0.993232739155685,
         {74.7445339021892, 83.108293188711}},
    };
    for (int i = 0; i < COUNT(rows); i++) {
        const strum_inclined_cable cable = taut(rows[i].epsilon, rows[i].degrees, INFINITY, 1);
        strum_inclined_statics s;
        assert_int_equal(strum_inclined_statics_find(&cable, &s, NULL), STRUM_OK);
        check_relative(s.s_a, rows[i].s_a, 1e-13);
        check_relative(s.tension_bottom, rows[i].tension[0], 1e-14);
        check_relative(s.tension_top, rows[i].tension[1], 1e-14);
        check_relative(s.curvature_bottom, rows[i].curvature[0], 1e-13);
        check_relative(s.curvature_top, rows[i].curvature[1], 1e-13);
        check_relative(s.chord, rows[i].chord, 1e-14);
        check_relative(s.phase, rows[i].phase, 1e-14);
        check_relative(s.angle_bottom / degree, rows[i].angle[0], 1e-13);
        check_relative(s.angle_top / degree, rows[i].angle[1], 1e-13);
        assert_true(isinf(s.stiffness));
    }
    strum_inclined_cable elastic = taut(0.8, 60, 100, 0.8);
    strum_inclined_statics s;
    elastic.elastic_statics = true;
    assert_int_equal(strum_inclined_statics_find(&elastic, &s, NULL), STRUM_OK);
    check_relative(s.s_a, 0.443709755011967, 1e-13);
}

/* ---- the full model ---- */

static void full_model(void **state)
{
    (void)state;
    static const struct {
        double epsilon, degrees, lambda_squared, h;
        bool elastic;
        double want[8];
    } rows[] = {
        {0.18, 23.46, 38, 1, false, {1.96019832880428, 2.01145707121288, 3.08821022007557}},
        {0.49, 45, 64, 1, false, {1.95312376665134, 2.37497774072738, 3.22393813774701}},
        {0.1,
         10,
         80,
         0.5,
         false,
         {1.99952020606705, 2.48008510014046, 3.31420444567205, 4.00044515802103,
          5.03831725315327, 6.00096883410938}},
        {0.1,
         80,
         355,
         1,
         false,
         {1.99847334451226, 2.82023305294991, 3.99905519324987, 4.77867674174129,
          5.97213503742753, 6.0357966279343, 7.13763108123289, 8.00133217323238}},
        {0.49,
         0,
         64,
         1,
         false,
         {1.98185069672194, 2.32501175042227, 3.19206923394146, 4.00570498124739,
          5.04170132446924, 6.01995103512289}},
        {0.8,
         45,
         3948,
         1,
         false,
         {1.9391930329138, 2.86212496713699, 3.99889005555719, 4.94721232447669,
          6.03108969519244, 6.99205218834535, 8.05657556590926, 9.02372108441682}},
        {0.02,
         80,
         3948,
         1,
         false,
         {1.99994572689169, 2.85763040644967, 3.99998479034745, 4.9127649206065,
          6.00000301989276, 6.93382506961758}},
        {0.49,
         45,
         INFINITY,
         0.7,
         false,
         {1.97806889334805, 2.86318865274725, 4.00030281578006, 4.9316508749322,
          6.01258489845004, 6.96424634181469}},
        {0.8,
         60,
         100,
         0.8,
         true,
         {1.9018568706243, 2.64871189657649, 3.59218655609079, 4.09041368355595}},
        {0.05,
         0,
         39.4784176043574,
         1,
         false,
         {1.99980342456534, 1.99985721929226, 3.09335976429211, 4.00005792377837,
          5.01543783135753, 6.00021215490614}},
    };
    for (int i = 0; i < COUNT(rows); i++) {
        strum_inclined_cable cable =
            taut(rows[i].epsilon, rows[i].degrees, rows[i].lambda_squared, rows[i].h);
        cable.elastic_statics = rows[i].elastic;
        int count = 0;
        while (count < 8 && rows[i].want[count] > 0)
            count++;
        strum_inclined *modes = solved(&cable, STRUM_INCLINED_FULL, count);
        for (int k = 1; k <= count; k++)
            check_relative(kl(modes, k) / M_PI, rows[i].want[k - 1], 1e-13);
        strum_inclined_free(modes);
    }
}

/* EA/T_a = 12: longitudinal modes stand fourth and eighth; their share of the energy tells. */
static void longitudinal_modes(void **state)
{
    (void)state;
    static const double want[] = {1.00443991760651, 1.99881720994325, 3.00018731598476,
                                  3.46550199964071, 4.00112906380863, 5.00060916686658,
                                  6.00097757266892, 6.92755045540013};
    static const double share[] = {5.02008524411e-05, 0.00172835688002, 0.000256481735466,
                                   0.997200540216,    0.00118786371201, 0.00015973011363,
                                   6.86402906252e-05, 0.977618820041};
    const strum_inclined_cable cable = taut(0.1, 20, 0.105962666587139, 1);
    strum_inclined *modes = solved(&cable, STRUM_INCLINED_FULL, 8);
    for (int k = 1; k <= 8; k++) {
        const strum_inclined_mode mode = mode_at(modes, k - 1);
        check_relative(mode.kl / M_PI, want[k - 1], 1e-13);
        check_relative(mode.longitudinal_energy, share[k - 1], 1e-9);
        assert_int_equal(mode.family, k % 4 == 0 ? STRUM_LONGITUDINAL : STRUM_TRANSVERSE);
    }
    strum_inclined_free(modes);
    /* the determinant has them too, (21) has not */
    strum_inclined *airy = solved(&cable, STRUM_INCLINED_AIRY, 8);
    assert_int_equal(mode_at(airy, 3).family, STRUM_LONGITUDINAL);
    strum_inclined_free(airy);
    strum_inclined *closed = solved(&cable, STRUM_INCLINED_ASYMPTOTIC, 8);
    check_absolute(kl(closed, 4) / M_PI, 4, 1e-3);
    strum_inclined_free(closed);
}

static void mode_shapes(void **state)
{
    (void)state;
    static const struct {
        double epsilon, degrees, lambda_squared, h;
        int mode;
        double w[11], u[11], tension[11];
    } rows[] = {
        {0.18,
         23.46,
         38.0,
         1.0,
         1,
         {0, 0.160950603086568, 0.0965046225787367, -0.164381391266414, -0.520028454805426,
          -0.835586297110503, -0.993574523395169, -0.936380351132345, -0.685513218376738,
          -0.331604516012485, 0},
         {0, 0.00853126053363047, 0.0178992060343604, 0.024353100192458, 0.0254309334396288,
          0.0208124698194586, 0.0123392136308549, 0.00324277867191486, -0.00308893950626749,
          -0.00433258167325694, 0},
         {94.9706637414726, 94.982779092295, 94.9214644276814, 94.7961985933002,
          94.6406708274878, 94.4991528351577, 94.409581024936, 94.3897376970098,
          94.4314032895861, 94.504153546266, 94.5668911113239}},
        {0.8,
         80,
         40.0,
         0.5,
         3,
         {0, 0.821557819889733, 0.926609517308413, 0.26318455920828, -0.440710287124384,
          -0.562784465223975, -0.0915100539695304, 0.513161489571605, 0.773143591789337,
          0.533869129469988, 0},
         {0, 0.00719570818092424, 0.0243759067200915, 0.0318296507711561, 0.0252511047471385,
          0.0128049541758145, 0.00366273810039959, 0.00101176117816129, 0.00224683908075129,
          0.00286885470614102, 0},
         {-99.9732531705162, -99.8181820006452, -99.8771747166128, -100.130511638799,
          -100.382315994436, -100.494570527855, -100.473212390978, -100.410435538976,
          -100.388659833999, -100.427244243889, -100.488697151652}},
    };
    for (int i = 0; i < COUNT(rows); i++) {
        const strum_inclined_cable cable =
            taut(rows[i].epsilon, rows[i].degrees, rows[i].lambda_squared, rows[i].h);
        strum_inclined *modes = solved(&cable, STRUM_INCLINED_FULL, rows[i].mode);
        strum_inclined_point shape[11];
        assert_int_equal(strum_inclined_shape(modes, (size_t)rows[i].mode - 1, NULL, 11, shape),
                         STRUM_OK);
        /* there w'(0) > 0, here the largest value is +1: the sign may differ */
        const double sign = shape[1].transverse * rows[i].w[1] > 0 ? 1 : -1;
        for (int k = 0; k < 11; k++) {
            check_absolute(shape[k].s, k / 10.0, 1e-15);
            check_absolute(sign * shape[k].transverse, rows[i].w[k], 1e-11);
            check_absolute(sign * shape[k].longitudinal, rows[i].u[k], 1e-12);
            check_relative(sign * shape[k].tension, rows[i].tension[k], 1e-11);
        }
        strum_inclined_free(modes);
    }
}

/* Largest dynamic tension per unit displacement, max|T| epsilon cos(phi_a) L/(T_a max|w|), by
 * an independent spectral Galerkin computation to 1e-7. */
static void tension_amplification(void **state)
{
    (void)state;
    static const double lambda_squared[] = {20, 38, 64, 150};
    static const struct {
        double epsilon, degrees, first[4], second[4];
    } rows[] = {
        {0.18,
         23.46,
         {11.4899628, 15.6842589, 2.03055243, 1.13859781},
         {0.885503878, 9.74428179, 24.9445945, 21.6146706}},
        {0.49,
         45,
         {11.0771136, 12.6509962, 7.12173377, 4.72843516},
         {3.7578121, 13.5836664, 23.8191703, 21.2047934}},
    };
    for (int i = 0; i < COUNT(rows); i++)
        for (int k = 0; k < 4; k++) {
            const strum_inclined_cable cable =
                taut(rows[i].epsilon, rows[i].degrees, lambda_squared[k], 1);
            strum_inclined *modes = solved(&cable, STRUM_INCLINED_FULL, 2);
            check_relative(mode_at(modes, 0).tension_amplification, rows[i].first[k], 1e-7);
            check_relative(mode_at(modes, 1).tension_amplification, rows[i].second[k], 1e-7);
            strum_inclined_free(modes);
        }
}

/* ---- products of modes ---- */

#define PANELS 2000 /* Boole's rule: error (kL/PANELS)^6 */

typedef struct products {
    double mass, transverse; /* cosines between modes 1 and 2 */
} products;

static products between(const strum_inclined *modes, double h)
{
    static strum_inclined_point shape[2][PANELS + 1];
    static const double boole[] = {14, 32, 12, 32};
    double mass[2][2] = {{0}}, transverse[2][2] = {{0}};
    for (int i = 0; i < 2; i++)
        assert_int_equal(strum_inclined_shape(modes, (size_t)i, NULL, PANELS + 1, shape[i]),
                         STRUM_OK);
    for (int k = 0; k <= PANELS; k++)
        for (int i = 0; i < 2; i++)
            for (int j = 0; j < 2; j++) {
                const double weight = k == 0 || k == PANELS ? 7 : boole[k % 4];
                const strum_inclined_point *a = &shape[i][k], *b = &shape[j][k];
                transverse[i][j] += weight * a->transverse * b->transverse;
                mass[i][j] += weight * (a->transverse * b->transverse +
                                        h * a->longitudinal * b->longitudinal);
            }
    return (products){fabs(mass[0][1]) / sqrt(mass[0][0] * mass[1][1]),
                      fabs(transverse[0][1]) / sqrt(transverse[0][0] * transverse[1][1])};
}

/* The modes are orthogonal in INT (m u u + M w w) ds, which the report denies; those of its own
 * shapes (34) and (37) are not. */
static void orthogonality(void **state)
{
    (void)state;
    static const struct {
        double epsilon, degrees, w_only, closed_mass, closed_w_only;
    } rows[] = {
        {0.18, 23.46, 0.000778718568, 0.00152452343, 0.000744333354},
        {0.49, 45, 0.00386396777, 0.0129845029, 0.00973128547},
    };
    for (int i = 0; i < COUNT(rows); i++) {
        const strum_inclined_cable cable = taut(rows[i].epsilon, rows[i].degrees, 38, 1);
        strum_inclined *full = solved(&cable, STRUM_INCLINED_FULL, 2);
        strum_inclined *closed = solved(&cable, STRUM_INCLINED_ASYMPTOTIC, 2);
        const products of_full = between(full, 1), of_closed = between(closed, 1);
        assert_true(of_full.mass < 1e-12);
        check_relative(of_full.transverse, rows[i].w_only, 1e-8);
        check_relative(of_closed.mass, rows[i].closed_mass, 1e-8);
        check_relative(of_closed.transverse, rows[i].closed_w_only, 1e-8);
        strum_inclined_free(full);
        strum_inclined_free(closed);
    }
    for (int i = 0; i < 20; i++) {
        const double h = uniform(0.3, 1);
        const strum_inclined_cable cable =
            taut(uniform(0.02, 1), uniform(0, 85), exp(uniform(0, 8)), h);
        strum_inclined *modes = solved(&cable, STRUM_INCLINED_FULL, 2);
        assert_true(between(modes, h).mass < 1e-12);
        strum_inclined_free(modes);
    }
}

/* ---- veering and crossing ---- */

static double gap_at(double epsilon, double degrees, double lambda_squared,
                     strum_inclined_model model)
{
    const strum_inclined_cable cable = taut(epsilon, degrees, lambda_squared, 1);
    strum_inclined *modes = solved(&cable, model, 2);
    const double gap = kl(modes, 2) - kl(modes, 1);
    strum_inclined_free(modes);
    return gap;
}

static double least_gap(double epsilon, double degrees, strum_inclined_model model)
{
    double low = 38.5, high = 40;
    for (int i = 0; i < 32; i++) {
        const double left = low + 0.382 * (high - low), right = high - 0.382 * (high - low);
        if (gap_at(epsilon, degrees, left, model) < gap_at(epsilon, degrees, right, model))
            high = right;
        else
            low = left;
    }
    return gap_at(epsilon, degrees, (low + high) / 2, model);
}

/* The least distance of the first two branches is (7/(2 sqrt 3)) epsilon sin(phi_a) as epsilon
 * goes to 0 (49/64 of (21)); its error falls with epsilon^2. */
static void veering(void **state)
{
    (void)state;
    static const double epsilons[] = {0.1, 0.05};
    static const double coefficients[] = {0.76188163, 0.764688};
    double c[2];
    for (int i = 0; i < 2; i++) {
        const double gap = least_gap(epsilons[i], 30, STRUM_INCLINED_FULL);
        c[i] = 3.0 / 16 * pow(gap / (epsilons[i] * 0.5), 2);
        check_relative(c[i], coefficients[i], 1e-6);
    }
    check_relative((4 * c[1] - c[0]) / 3, 49.0 / 64, 2e-5);
    const strum_inclined_cable cable = taut(0.05, 30, 38, 1);
    strum_crossover crossover;
    assert_int_equal(strum_inclined_crossover(&cable, &crossover), STRUM_OK);
    assert_int_equal(crossover.number, 1);
    check_relative(crossover.gap, least_gap(0.05, 30, STRUM_INCLINED_FULL), 1e-3);
    check_relative(crossover.gap, least_gap(0.05, 30, STRUM_INCLINED_ASYMPTOTIC), 1e-3);
    assert_true(crossover.inside);
    check_relative(crossover.low, 4 * M_PI * M_PI / 1.05, 1e-14);
    check_relative(crossover.high, 4 * M_PI * M_PI / 0.95, 1e-14);
}

/* A level cable's branches cross at lambda^2 = 4 pi^2 (1 - 0.0323 epsilon^2), kL = 2 pi - 0.247
 * epsilon^2, and no mode is lost or doubled on the way, in any model. */
static void crossing(void **state)
{
    (void)state;
    const double epsilon = 0.1, square = 4 * M_PI * M_PI;
    double low = square * 0.99, high = square * 1.01;
    for (int i = 0; i < 50; i++) {
        const double middle = (low + high) / 2;
        const strum_inclined_cable cable = taut(epsilon, 0, middle, 1);
        strum_inclined *modes = solved(&cable, STRUM_INCLINED_FULL, 2);
        const strum_symmetry first = mode_at(modes, 0).symmetry;
        const strum_symmetry second = mode_at(modes, 1).symmetry;
        assert_true(first != second && first != STRUM_NO_SYMMETRY);
        *(first == STRUM_SYMMETRIC ? &low : &high) = middle;
        if (i == 49)
            check_absolute(kl(modes, 1), 2 * M_PI - 0.247 * epsilon * epsilon, 1e-5);
        strum_inclined_free(modes);
    }
    check_relative(low, square * (1 - 0.0323 * epsilon * epsilon), 2e-6);
    check_absolute(gap_at(epsilon, 0, low, STRUM_INCLINED_FULL), 0, 1e-13);
    for (int model = STRUM_INCLINED_FULL; model <= STRUM_INCLINED_IRVINE; model++)
        for (double x = 0.98; x < 1.02; x += 0.001) {
            const strum_inclined_cable cable = taut(epsilon, 0, square * x, 1);
            strum_inclined *modes = solved(&cable, (strum_inclined_model)model, 4);
            assert_int_equal(mode_at(modes, 0).symmetry + mode_at(modes, 1).symmetry,
                             STRUM_SYMMETRIC + STRUM_ANTISYMMETRIC);
            check_absolute(kl(modes, 1), 2 * M_PI, 0.1);
            check_absolute(kl(modes, 2), 2 * M_PI, 0.1);
            check_absolute(kl(modes, 3) / M_PI, 3.09, 0.01);
            check_absolute(kl(modes, 4) / M_PI, 4, 0.01);
            strum_inclined_free(modes);
        }
}

/* ---- limits ---- */

static void limits(void **state)
{
    (void)state;
    /* inextensible and level: tan x = x, and 0.1269 epsilon^2 more */
    const double inextensible = 8.98681891581813;
    const strum_inclined_cable level = taut(0.05, 0, INFINITY, 1);
    strum_inclined *modes = solved(&level, STRUM_INCLINED_FULL, 2);
    check_absolute(kl(modes, 2), inextensible + 0.1269 * 0.05 * 0.05, 1e-6);
    strum_inclined_free(modes);
    modes = solved(&level, STRUM_INCLINED_IRVINE, 2);
    check_relative(kl(modes, 2), inextensible, 1e-14);
    strum_inclined_free(modes);
    /* no weight: a taut string with longitudinal waves, EA/T_a = 8.5, h = 0.9 */
    const double epsilon = 1e-5, stiffness = 8.5;
    const strum_inclined_cable string =
        taut(epsilon, 60, stiffness * pow(epsilon * cos(60 * degree), 2), 0.9);
    modes = solved(&string, STRUM_INCLINED_FULL, 6);
    static const int order[] = {1, 2, 3, 0, 4, 5}; /* 0: the longitudinal one */
    for (int k = 1; k <= 6; k++) {
        const double want =
            order[k - 1] == 0 ? M_PI * sqrt(stiffness / 0.9) : order[k - 1] * M_PI;
        check_relative(kl(modes, k), want, 1e-9);
        assert_int_equal(mode_at(modes, k - 1).family,
                         order[k - 1] == 0 ? STRUM_LONGITUDINAL : STRUM_TRANSVERSE);
    }
    strum_inclined_free(modes);
}

int main(void)
{
    srand(1984);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(statics),
        cmocka_unit_test(full_model),
        cmocka_unit_test(longitudinal_modes),
        cmocka_unit_test(mode_shapes),
        cmocka_unit_test(tension_amplification),
        cmocka_unit_test(orthogonality),
        cmocka_unit_test(veering),
        cmocka_unit_test(crossing),
        cmocka_unit_test(limits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
