/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gale's series method against his tables, an oracle in 220 bit arithmetic, published values
 * and the Galerkin methods. */
#include <strum/strum.h>

#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "suspended/modes.h"
#include "suspended/gale_tables.h"

#define MOST 60

static strum_cable plain(const strum_catenary *c)
{
    return (strum_cable){.chi_m = c->chi_m, .mu = c->mu, .mass_t = 1, .mass_n = 1};
}

static strum_cable of_sag(double rise_to_span, double sag_parameter)
{
    strum_catenary c;
    assert_int_equal(strum_catenary_from_sag(rise_to_span, sag_parameter, &c, NULL), STRUM_OK);
    return plain(&c);
}

static strum_cable of_xi(double xi_1, double xi_2)
{
    strum_catenary c;
    assert_int_equal(strum_catenary_from_xi(xi_1, xi_2, &c, NULL), STRUM_OK);
    return plain(&c);
}

static strum_series_report solved(const strum_cable *cable, strum_plane plane, int count,
                                  strum_mode *modes)
{
    strum_series_report report;
    strum_error fault = {0};
    const strum_series_params params = {*cable, plane, count, true};
    if (strum_series_solve(&params, NULL, modes, &report, &fault) != STRUM_OK)
        fail_msg("chi_m %.17g mu %.17g plane %d, %d modes: %s", cable->chi_m, cable->mu, plane,
                 count, fault.reason);
    assert_true(report.error <= 1e-12 && report.terms > 10 && report.evaluations > 0);
    assert_true(report.mantissa_bits == 64 || report.mantissa_bits == 113);
    return report;
}

/* Mode by mode against the Galerkin method, which is right to about 1e-15 here. */
static void check_modes(const strum_cable *cable, strum_plane plane, int count)
{
    strum_mode modes[MOST];
    const strum_series_report report = solved(cable, plane, count, modes);
    strum_modes *exact;
    assert_int_equal(strum_modes_solve(&(strum_modes_params){*cable, plane, count, false}, NULL,
                                       &exact, NULL),
                     STRUM_OK);
    for (int i = 0; i < count; i++) {
        const strum_mode want_at = mode_at(exact, i), *want = &want_at;
        /* its own estimate is no flattery */
        check_relative(modes[i].frequency, want->frequency, report.error + 3e-15);
        assert_int_equal(modes[i].symmetry, want->symmetry);
        assert_true(modes[i].decay == 0);
    }
    strum_modes_free(exact);
}

/* Shooting by Taylor series in 220 bit arithmetic, 10 modes each: h/b, sag parameter. */
static void reference_frequencies(void **state)
{
    (void)state;
    static const struct {
        strum_plane plane;
        double rise_to_span, sag_parameter, omega[10];
    } rows[] = {
        {STRUM_IN_PLANE,
         0,
         0.85,
         {2.44502434675986, 4.02438937772397, 5.5882526820269, 7.04752960530333,
          8.54845960341368, 9.99417139390152, 11.4745509038428, 12.91662427121,
          14.3872223607861, 15.8282738777359}},
        {STRUM_OUT_OF_PLANE,
         0,
         0.85,
         {1.51452371249028, 2.91955468054289, 4.35736029046619, 5.79935091364898,
          7.24317649280255, 8.68790239019934, 10.1331400758134, 11.5786965039312,
          13.0244649451652, 14.4703815645256}},
        {STRUM_IN_PLANE,
         0,
         0.7,
         {1.33593302107273, 2.35341359523753, 3.30720054685474, 4.21626402578459,
          5.12329424502722, 6.01513409573896, 6.90860389337844, 7.79297592782175,
          8.68028966896125, 9.56133132594715}},
        {STRUM_OUT_OF_PLANE,
         0,
         0.7,
         {0.961653313796466, 1.7760942062276, 2.64713359159412, 3.51777102046214,
          4.39094805894625, 5.26499185225747, 6.1395843533756, 7.01451205132351,
          7.8896639254049, 8.76497249191385}},
        {STRUM_IN_PLANE,
         0,
         0.5,
         {0.740664168913395, 1.33059808683777, 1.91551940465519, 2.47014686148913,
          3.01928447505945, 3.56198672253296, 4.10078063794157, 4.63570805596361,
          5.16921117312504, 5.70079879113097}},
        {STRUM_OUT_OF_PLANE,
         0,
         0.5,
         {0.61641193543914, 1.06243638328968, 1.59583115624551, 2.11108401839672,
          2.63456939794799, 3.15712949125769, 3.68071738889825, 4.20447497532311,
          4.72848510123494, 5.25263059507014}},
        {STRUM_IN_PLANE,
         0.25,
         0.9,
         {3.24604898310321, 5.15251016535772, 7.15189145526706, 8.97159679562662,
          10.8890663509371, 12.7034508002459, 14.5925956372977, 16.4081053319554,
          18.2831765093855, 20.1006315666422}},
        {STRUM_OUT_OF_PLANE,
         0.25,
         0.9,
         {1.88940663322093, 3.69539725900286, 5.52308530638146, 7.35494456949447,
          9.18840740352744, 11.02266175321, 12.8573652422967, 14.692348299864, 16.5275172529816,
          18.3628161045477}},
        {STRUM_IN_PLANE,
         0.25,
         0.6,
         {0.974493464818622, 1.75203550316145, 2.49003115024266, 3.19475591378498,
          3.89209509811778, 4.58028083112656, 5.26589565503419, 5.94645554273337,
          6.62651355152837, 7.30348430686092}},
        {STRUM_OUT_OF_PLANE,
         0.25,
         0.6,
         {0.758444295211071, 1.36241758731498, 2.03072887549036, 2.69578598035238,
          3.36356902804053, 4.03227501856645, 4.70147306224732, 5.37101226646643,
          6.04076657156935, 6.71067454440633}},
        {STRUM_IN_PLANE,
         0.5,
         0.95,
         {4.87962273246451, 7.39955406791963, 10.2975970062978, 12.8174777151797,
          15.58597138518, 18.1254557883801, 20.8455073711559, 23.3990265014139,
          26.0938413090991, 28.657268705898}},
        {STRUM_OUT_OF_PLANE,
         0.5,
         0.95,
         {2.64697038150409, 5.24726242174289, 7.85799481556242, 10.4713504476629,
          13.0857395606107, 15.7006423851209, 18.3158378914457, 20.9312160101583,
          23.5467157380077, 26.1623005296922}},
        {STRUM_IN_PLANE,
         0.5,
         0.7,
         {1.29284075700437, 2.2890971118333, 3.22390953653669, 4.11677085821843,
          5.00435111846982, 5.87612277668884, 6.74991997772083, 7.61470892495768,
          8.48237182138124, 9.34374472028466}},
        {STRUM_OUT_OF_PLANE,
         0.5,
         0.7,
         {0.929148457502737, 1.7416162115252, 2.58657944872478, 3.43871463182673,
          4.29207346259191, 5.14643195144425, 6.0013219397751, 6.85654150977346,
          7.71198128488856, 8.56757483755769}},
        {STRUM_IN_PLANE,
         1,
         0.98,
         {7.31481413805984, 10.7333082316669, 14.98773605686, 18.5316714185496,
          22.5794456085413, 26.1853979567985, 30.1514083423476, 33.7934329079626,
          37.7155344316792, 41.3810633747887}},
        {STRUM_OUT_OF_PLANE,
         1,
         0.98,
         {3.78520870747802, 7.557172367509, 11.3318379701898, 15.1072667834693,
          18.8830084092523, 22.6589079199182, 26.4348980762652, 30.2109450401515,
          33.987029940714, 37.7631414276287}},
        {STRUM_IN_PLANE,
         1,
         0.8,
         {1.695815455861, 2.8969194546297, 4.07179210695227, 5.17495994495333, 6.29077394699072,
          7.37276557541346, 8.47012097824202, 9.54557762930912, 10.6347540314795,
          11.7075664987567}},
        {STRUM_OUT_OF_PLANE,
         1,
         0.8,
         {1.10794419209714, 2.16740231270951, 3.2303973210099, 4.29817467350617,
          5.3676929254492, 6.43799131404187, 7.50872119551452, 8.57971753969347,
          9.65089026818412, 10.7221858790162}},
        {STRUM_IN_PLANE,
         2,
         0.98,
         {5.8289320026262, 8.55817372535066, 11.9649277794984, 14.7949805427409,
          18.0328892818043, 20.9125897719208, 24.083767916021, 26.9924157815133,
          30.1278071597395, 33.0553505345037}},
        {STRUM_OUT_OF_PLANE,
         2,
         0.98,
         {3.01706369182651, 6.03401031510988, 9.05083907769874, 12.0676875169953,
          15.084549257246, 18.1014187904407, 21.1182931152021, 24.135170558932, 27.152050134864,
          30.1689312284479}},
        {STRUM_IN_PLANE,
         2,
         0.9,
         {2.26773741468648, 3.62133953115178, 5.08309749823082, 6.39179858933453,
          7.78161155845216, 9.08475462747957, 10.4490483462443, 11.7521722112879,
          13.103893533746, 14.4080661442991}},
        {STRUM_OUT_OF_PLANE,
         2,
         0.9,
         {1.32012825987981, 2.63885123306101, 3.95614293632666, 5.27361256573899,
          6.591241262927, 7.90896806941363, 9.22675619000281, 10.5445844846624,
          11.8624403289745, 13.180315815141}},
        {STRUM_IN_PLANE,
         3,
         0.96,
         {3.34319084461216, 5.02884105487758, 7.03918405763003, 8.7481562366575,
          10.6587916787693, 12.3860618995219, 14.2586421213134, 15.9978638071875,
          17.8505050076815, 19.5979489278152}},
        {STRUM_OUT_OF_PLANE,
         3,
         0.96,
         {1.78738636502194, 3.57872142867166, 5.36900405273563, 7.15907852453673,
          8.94907768530969, 10.7390409943368, 12.528984368003, 14.3189154877392,
          16.1088385265733, 17.8987559509922}},
        {STRUM_IN_PLANE,
         0,
         0.99,
         {12.5375339613147, 18.158901863663, 25.3452057428147, 31.2531428469128,
          38.0912623036598, 44.1256094984069, 50.8224814916171, 56.927808986502,
          63.5478177526413, 69.6985973409305}},
        {STRUM_OUT_OF_PLANE,
         0,
         0.99,
         {6.37764313637901, 12.7261010819146, 19.0811875152196, 25.4378797127899,
          31.7952096147879, 38.1528574416394, 44.5106866696944, 50.8686291751829,
          57.2266471573143, 63.5847179533862}},
        {STRUM_IN_PLANE,
         0,
         0.99999,
         {405.56856454474, 580.090802034431, 811.145912609847, 997.316703275369,
          1216.72130872694, 1407.70370270449, 1622.29621687622, 1815.92209188584,
          2027.87092984028, 2223.17080516581}},
        {STRUM_OUT_OF_PLANE,
         0,
         0.99999,
         {202.787826494353, 405.574728383707, 608.361835745349, 811.148994473478,
          1013.93617374804, 1216.7233632958, 1419.51055871394, 1622.29775780106,
          1825.08495933417, 2027.87216257947}},
        {STRUM_IN_PLANE,
         0.35,
         0.77,
         {1.68268798123572, 2.89734092656235, 4.05096705463914, 5.14527526256289,
          6.24587832076772, 7.32093417594389, 8.40589132914971, 9.47453719976815,
          10.5523773267659, 11.6181693910056}},
        {STRUM_OUT_OF_PLANE,
         0.35,
         0.77,
         {1.13512921042219, 2.15429858127409, 3.20789125280512, 4.2665777683246,
          5.32699905274209, 6.38836397888147, 7.45025660881531, 8.51247830578344,
          9.57491889296189, 10.6375124557072}},
        {STRUM_IN_PLANE,
         1.3,
         0.88,
         {2.32299732610928, 3.76656773080613, 5.27854154874927, 6.65318659927859,
          8.09170378908756, 9.45527527048136, 10.8689266309298, 12.2303598569661,
          13.6321047361592, 14.9934734363185}},
        {STRUM_OUT_OF_PLANE,
         1.3,
         0.88,
         {1.38698075041397, 2.75397215767555, 4.12180056433618, 5.4912044399861, 6.861357544265,
          8.23189727965034, 9.60266003121012, 10.9735627617064, 12.3445590365372,
          13.7156208927126}},
        {STRUM_IN_PLANE,
         3.2,
         0.97,
         {3.81810099489854, 5.67640983683996, 7.94248555227254, 9.84681759225795,
          12.000157283331, 13.9311094462597, 16.0407043603652, 17.9879307432738,
          20.0743461932276, 22.0324435877655}},
        {STRUM_OUT_OF_PLANE,
         3.2,
         0.97,
         {2.00917954495788, 4.0221066926091, 6.03410706494712, 8.04590591277217,
          10.0576282384695, 12.0693132155919, 14.0809771279538, 16.0926279779944,
          18.1042701640846, 20.1159063065331}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const strum_cable cable = of_sag(rows[i].rise_to_span, rows[i].sag_parameter);
        /* 1 - p is all that tells how taut a cable is, and p came in decimals */
        const double given = rows[i].sag_parameter > 0.999 ? 1e-11 : 2e-12;
        strum_mode modes[10];
        (void)solved(&cable, rows[i].plane, 10, modes);
        for (int k = 0; k < 10; k++)
            check_relative(modes[k].frequency, rows[i].omega[k], given);
    }
}

/* Published table of exact level catenaries: Omega = omega sqrt(S/g), S the arc length. */
static void published_level_catenaries(void **state)
{
    (void)state;
    static const struct {
        double degrees, in_plane[5], out_of_plane[3];
    } rows[] = {
        {5,
         {15.00271816, 21.49326647, 30.04671951, 36.95710637, 45.08151442},
         {7.51801401, 15.03166810, 22.54629377}},
        {30,
         {5.62244991, 8.50591071, 11.81810598, 14.70344230, 17.87324593},
         {3.04265425, 6.01671054, 9.00766469}},
        {60,
         {3.07741345, 5.30992641, 7.41872246, 9.42183917, 11.43614457},
         {2.09678767, 3.94303740, 5.87677824}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const double chi = asinh(tan(rows[i].degrees * M_PI / 180)),
                     scale = sqrt(2 * sinh(chi));
        const strum_cable cable = {.mu = chi, .mass_t = 1, .mass_n = 1};
        strum_mode modes[5];
        (void)solved(&cable, STRUM_IN_PLANE, 5, modes);
        for (int k = 0; k < 5; k++)
            check_absolute(modes[k].frequency * scale, rows[i].in_plane[k], 6e-9);
        (void)solved(&cable, STRUM_OUT_OF_PLANE, 3, modes);
        for (int k = 0; k < 3; k++)
            check_absolute(modes[k].frequency * scale, rows[i].out_of_plane[k], 6e-9);
    }
}

/* A printed value that is right was rounded or truncated, within about the 0.025 % at which
 * Gale's iteration stopped. */
static bool agrees(double printed, double right)
{
    const double stop = 3e-4 * right;
    return printed <= right + 0.005 + stop && printed >= right - 0.01 - stop;
}

static int check_table(strum_plane plane, const gale_row *rows, size_t count,
                       const gale_misprint *misprints, size_t misprint_count)
{
    int values = 0;
    size_t met = 0;
    for (size_t i = 0; i < count; i++) {
        const gale_row *row = &rows[i];
        const strum_cable cable = row->from_xi ? of_xi(row->xi_1, row->xi_2)
                                               : of_sag(row->rise_to_span, row->sag_parameter);
        check_absolute(strum_xi_of_chi(cable.chi_m - cable.mu), row->xi_1, 1.1e-3);
        check_absolute(strum_xi_of_chi(cable.chi_m + cable.mu), row->xi_2, 1.1e-3);
        strum_mode modes[6];
        (void)solved(&cable, plane, row->count, modes);
        for (int k = 0; k < row->count; k++, values++) {
            const gale_misprint *wrong = NULL;
            for (size_t j = 0; j < misprint_count; j++)
                if (misprints[j].rise_to_span == row->rise_to_span &&
                    misprints[j].sag_parameter == row->sag_parameter &&
                    misprints[j].mode == k + 1)
                    wrong = &misprints[j];
            met += wrong != NULL;
            if (wrong != NULL)
                check_relative(modes[k].frequency, wrong->right, 1e-9);
            else if (!agrees(row->omega[k], modes[k].frequency))
                fail_msg("h/b %g p %g mode %d: printed %g, computed %.10g", row->rise_to_span,
                         row->sag_parameter, k + 1, row->omega[k], modes[k].frequency);
        }
    }
    assert_int_equal(met, misprint_count);
    return values;
}

static void printed_tables(void **state)
{
    (void)state;
#define ROWS(table) table, sizeof table / sizeof *table
    assert_int_equal(
        check_table(STRUM_IN_PLANE, ROWS(gale_in_plane), ROWS(gale_misprints_in_plane)), 270);
    assert_int_equal(check_table(STRUM_OUT_OF_PLANE, ROWS(gale_out_of_plane),
                                 ROWS(gale_misprints_out_of_plane)),
                     234);
#undef ROWS
}

/* Every way the two series can share a cable: about xi = 0 alone, matched on one side or both,
 * about xi = 2 alone; ends at the lowest point and where the choice changes. */
static void every_share_of_the_series(void **state)
{
    (void)state;
    static const struct {
        double xi_1, xi_2;
        bool matched;
    } rows[] = {
        {-0.3, 0.5, false},  {0, 0.4, false},      {0.05, 0.599, false}, {0, 0.61, true},
        {-0.4, 1.5, true},   {-1.5, 0.4, true},    {-3.1, 2.2, true},    {-2.8, -0.1, true},
        {0.3499, 1.2, true}, {0.3501, 1.2, false}, {1.4, 3.7, false},    {-3.7, -1.4, false},
        {-0.2, 0, false},    {-1.7, 0, true},      {-0.6, 0.601, true},  {0.1, 0.4, false},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const strum_cable cable = of_xi(rows[i].xi_1, rows[i].xi_2);
        strum_mode modes[4];
        for (strum_plane plane = STRUM_IN_PLANE; plane <= STRUM_OUT_OF_PLANE; plane++) {
            check_modes(&cable, plane, 4);
            assert_true((solved(&cable, plane, 4, modes).matching_xi > 0) == rows[i].matched);
        }
    }
}

static double uniform(double low, double high)
{
    return low + (high - low) * (rand() / (double)RAND_MAX);
}

static void random_cables(void **state)
{
    (void)state;
    srand(31);
    for (int i = 0; i < 60; i++) {
        const double xi_1 = uniform(-3.6, 2.5), xi_2 = uniform(xi_1 + 0.6, 3.7);
        strum_cable cable = of_xi(xi_1, xi_2);
        if (i % 3 == 0)
            cable.chi_m = 0;
        check_modes(&cable, STRUM_IN_PLANE, 1 + i % 7);
        check_modes(&cable, STRUM_OUT_OF_PLANE, 1 + i % 9);
    }
}

/* As many modes as quadruple precision carries, none missed; masses only scale. */
static void many_modes(void **state)
{
    (void)state;
    strum_cable cable = of_sag(0, 0.99);
    check_modes(&cable, STRUM_IN_PLANE, 30);
    cable = of_sag(0, 0.5);
    check_modes(&cable, STRUM_IN_PLANE, 40);
    check_modes(&cable, STRUM_OUT_OF_PLANE, 60);
    cable = of_sag(0.25, 0.6);
    cable.mass_n = 2.5;
    check_modes(&cable, STRUM_OUT_OF_PLANE, 20);
    cable.mass_t = 2.5;
    check_modes(&cable, STRUM_IN_PLANE, 10);
    cable.mass_t = cable.mass_n = 1;
    cable.kappa_t = 0.3; /* does not touch motion out of plane */
    check_modes(&cable, STRUM_OUT_OF_PLANE, 5);
}

static void refused(const strum_cable *cable, strum_plane plane, int count, bool thorough,
                    strum_status status, const char *word)
{
    strum_mode modes[STRUM_MODES_MAX];
    strum_series_report report;
    strum_error fault = {0};
    const strum_series_params params = {*cable, plane, count, thorough};
    assert_int_equal(strum_series_solve(&params, NULL, modes, &report, &fault), status);
    if (strstr(fault.reason, word) == NULL)
        fail_msg("\"%s\" is not in: %s", word, fault.reason);
    if (status == STRUM_ERR_METHOD) {
        assert_int_equal(strum_series_applies(cable, plane, &fault), status);
        assert_true(strum_series_work(&params) == 0);
    }
}

static void refusals(void **state)
{
    (void)state;
    strum_cable cable = of_sag(0, 0.85);
    cable.eta_n = 0.1;
    refused(&cable, STRUM_IN_PLANE, 3, true, STRUM_ERR_METHOD, "damping");
    cable.eta_n = 0;
    cable.kappa_t = 1e-9;
    refused(&cable, STRUM_IN_PLANE, 3, true, STRUM_ERR_METHOD, "inextensible");
    cable.kappa_n = 1e-9;
    refused(&cable, STRUM_OUT_OF_PLANE, 3, true, STRUM_ERR_METHOD, "inextensible");
    cable = of_sag(0, 0.85);
    cable.mass_n = 1.5;
    refused(&cable, STRUM_IN_PLANE, 3, true, STRUM_ERR_METHOD, "added mass");
    cable = of_sag(0, 0.85);
    refused(&cable, STRUM_IN_PLANE, 0, true, STRUM_ERR_RANGE, "modes");
    refused(&cable, STRUM_IN_PLANE, STRUM_MODES_MAX + 1, true, STRUM_ERR_RANGE, "modes");
    refused(&cable, STRUM_IN_PLANE, STRUM_MODES_MAX, true, STRUM_ERR_ACCURACY, "cancel");
    refused(&cable, STRUM_IN_PLANE, 20, false, STRUM_ERR_ACCURACY, "cancel");
    /* Gale's limit, and the last of the way to it, where convergence is too slow */
    cable = of_xi(-1, 4.0000001);
    refused(&cable, STRUM_IN_PLANE, 3, true, STRUM_ERR_METHOD, "|xi| = 4");
    cable = of_xi(-7, 1);
    refused(&cable, STRUM_OUT_OF_PLANE, 3, true, STRUM_ERR_METHOD, "|xi| = 7");
    cable = of_xi(-1, 3.999);
    refused(&cable, STRUM_IN_PLANE, 3, true, STRUM_ERR_ACCURACY, "terms");
    assert_true(strum_series_work(&(strum_series_params){cable, STRUM_IN_PLANE, 6, true}) >
                strum_series_work(&(strum_series_params){cable, STRUM_OUT_OF_PLANE, 6, true}));
}

static bool after_some(void *left)
{
    return (*(int *)left)-- <= 0;
}

/* Stopped at many places in turn; and what is at fault is named. */
static void a_solve_can_be_stopped(void **state)
{
    (void)state;
    strum_series_params params = STRUM_SERIES_PARAMS_INIT;
    params.cable = of_xi(-1, 3);
    strum_mode modes[6];
    strum_series_report report;
    strum_error error = {0};
    int stopped = 0;
    strum_status status = STRUM_ERR_CANCELLED;
    for (int polls = 0; status != STRUM_OK; polls += 1 + polls / 4, stopped++) {
        int left = polls;
        const strum_options options = {.cancelled = after_some, .context = &left};
        status = strum_series_solve(&params, &options, modes, &report, &error);
        assert_true(status == STRUM_OK || status == STRUM_ERR_CANCELLED);
    }
    assert_true(stopped > 10);
    const strum_options little = {.bytes_max = 1000};
    assert_int_equal(strum_series_solve(&params, &little, modes, &report, &error),
                     STRUM_ERR_BYTES);
    params.count = 0;
    assert_int_equal(strum_series_solve(&params, NULL, modes, &report, &error),
                     STRUM_ERR_RANGE);
    assert_int_equal(error.argument, STRUM_SERIES_ARG_COUNT);
    params.cable.eta_n = 1;
    assert_int_equal(strum_series_solve(&params, NULL, modes, &report, &error),
                     STRUM_ERR_METHOD);
    assert_int_equal(error.argument, STRUM_SERIES_ARG_CABLE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reference_frequencies),
        cmocka_unit_test(published_level_catenaries),
        cmocka_unit_test(printed_tables),
        cmocka_unit_test(every_share_of_the_series),
        cmocka_unit_test(random_cables),
        cmocka_unit_test(many_modes),
        cmocka_unit_test(refusals),
        cmocka_unit_test(a_solve_can_be_stopped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
