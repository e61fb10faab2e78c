/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Undamped chains: closed forms, published cases, counts, shapes, and a second method. */
#include <gsl/gsl_sf_bessel.h>
#include <stdlib.h>

#include "taut/parts.h"

/* ---- closed forms ---- */

static void a_string_has_its_harmonics(void **state)
{
    (void)state;
    const strum_taut_component part = part_cable(5000.0, 1.0, 50.8, 0.0);
    const strum_taut_end ends[2] = {STRUM_TAUT_FIXED, STRUM_TAUT_FREE};
    const double unit = M_PI / 50.8 * sqrt(5000.0);
    for (int l = 0; l < 2; l++)
        for (int r = 0; r < 2; r++) {
            strum_taut *chain = chain_of(&part, 1, ends[l], ends[r]);
            const long numbers[] = {1, 2, 3, 29, 162, 1000, 20000};
            double w[7];
            assert_int_equal(strum_taut_frequencies(chain, numbers, 7, NULL, w, NULL),
                             STRUM_OK);
            for (int i = 0; i < 7; i++) { /* a free cable's first mode is a rigid motion */
                const double k = (double)numbers[i] - 0.5 * l - 0.5 * r;
                check_absolute(w[i], k * unit, 1e-14 * k * unit);
            }
            strum_taut_free(chain);
        }
}

/* code_aster SDNL138: rho 7800 kg/m3, A 5.026e-5 m2, L 1 m. */
static void code_aster_sdnl138(void **state)
{
    (void)state;
    const double tension[2] = {6171.050459855, 12345.2954376},
                 hertz[2] = {62.73227096292042, 88.72830898253936};
    for (int i = 0; i < 2; i++) {
        const strum_taut_component part = part_cable(tension[i], 7800.0 * 5.026e-5, 1.0, 0.0);
        strum_taut *chain = fixed_chain(&part, 1);
        const double periods = hertz[i] * 2.0 * M_PI;
        /* the published values are good to about 9 digits: the tension comes from a strain */
        check_relative(frequency_of(chain, 1), periods, 1e-8);
        strum_taut_free(chain);
    }
}

/* Vertical cable, T = 20 kN + 100 N/m x, 15 kg/m, 1000 m (Bessel, published to 12 digits). */
static void a_vertical_cable(void **state)
{
    (void)state;
    const double want[4] = {.195938043756, .394670718722, .592856679033, .790882598216};
    const strum_taut_component part = part_varying(20e3, 120e3, 15.0, 1000.0, false);
    strum_taut *chain = fixed_chain(&part, 1);
    for (int k = 0; k < 4; k++)
        check_relative(frequency_of(chain, k + 1), want[k], 5e-12);
    strum_taut_free(chain);
}

/* WKB is high by (1/(8 u0) - 1/(8 u1))/(n pi), u = 2 w sqrt(rho T)/T', at leading order. */
static void wkb_errs_as_predicted(void **state)
{
    (void)state;
    const strum_taut_component exact = part_varying(10e3, 20e3, 2.0, 100.0, false);
    const strum_taut_component wkb = part_varying(10e3, 20e3, 2.0, 100.0, true);
    strum_taut *a = fixed_chain(&exact, 1), *b = fixed_chain(&wkb, 1);
    for (long n = 20; n <= 60; n += 20) {
        const double w = frequency_of(a, n), error = frequency_of(b, n) / w - 1.0;
        const double u0 = 2.0 * w * sqrt(2.0 * 10e3) / 100.0, u1 = u0 * sqrt(2.0);
        const double lead = (0.125 / u0 - 0.125 / u1) / ((double)n * M_PI);
        check_relative(error, lead, 0.02);
    }
    strum_taut_free(a);
    strum_taut_free(b);
}

/* cot(b/2) = r b/2, beta = w L sqrt(m/T) [closed forms]; antisymmetric modes see no mass. */
static void a_mass_at_midspan(void **state)
{
    (void)state;
    const double ratio[3] = {0.1, 1.0, 10.0};
    const double want[3][3] = {{2.85774002243, 8.61160282624, 14.4562195433},
                               {1.72066717804, 6.85123691896, 12.8745963583},
                               {.622105696401, 6.34619435339, 0.0}};
    for (int i = 0; i < 3; i++) {
        const strum_taut_component parts[3] = {part_cable(1.0, 1.0, 0.5, 0.0),
                                               part_mass(ratio[i]),
                                               part_cable(1.0, 1.0, 0.5, 0.0)};
        strum_taut *chain = fixed_chain(parts, 3);
        for (int k = 0; k < 3 && want[i][k] > 0.0; k++)
            check_relative(frequency_of(chain, 2 * k + 1), want[i][k], 1e-11);
        check_relative(frequency_of(chain, 2), 2.0 * M_PI, 1e-14);
        check_relative(frequency_of(chain, 4), 4.0 * M_PI, 1e-14);
        strum_taut_free(chain);
    }
}

/* N equal spans, N - 1 equal masses, q = mass/span mass: cos(p pi/N) = cos b - (q b/2) sin b,
 * beta = N b. */
static void equal_masses(void **state)
{
    (void)state;
    const double want[3] = {2.55742796572, 5.05836628515, 7.35154878907};
    strum_taut_component parts[7];
    for (int i = 0; i < 7; i++)
        parts[i] = i % 2 ? part_mass(0.5 * 0.25) : part_cable(1.0, 1.0, 0.25, 0.0);
    strum_taut *chain = fixed_chain(parts, 7);
    for (int k = 0; k < 3; k++)
        check_relative(frequency_of(chain, k + 1), want[k], 1e-11);
    strum_taut_free(chain);
}

static void properties_of_masses(void **state)
{
    (void)state;
    const double mu = 0.3;
    const strum_taut_component bare = part_cable(1.0, 1.0, 1.0, 0.0);
    const strum_taut_component with[3] = {part_cable(1.0, 1.0, mu, 0.0), part_mass(0.7),
                                          part_cable(1.0, 1.0, 1.0 - mu, 0.0)};
    const strum_taut_component mirrored[3] = {with[2], with[1], with[0]};
    const strum_taut_component zero[3] = {with[0], part_mass(0.0), with[2]};
    const strum_taut_component heavy[3] = {with[0], part_mass(1e13), with[2]};
    strum_taut *a = fixed_chain(&bare, 1), *b = fixed_chain(with, 3),
               *c = fixed_chain(mirrored, 3), *d = fixed_chain(zero, 3),
               *e = fixed_chain(heavy, 3);
    for (long k = 1; k < 30; k++) {
        const double w = frequency_of(b, k);
        check_relative(frequency_of(c, k), w, 1e-14);
        check_relative(frequency_of(d, k), frequency_of(a, k), 1e-14);
        /* adding a mass: interlacing */
        assert_true(w <= frequency_of(a, k) * (1.0 + 1e-14));
        assert_true(frequency_of(b, k + 1) >= frequency_of(a, k) * (1.0 - 1e-14));
    }
    /* a very heavy mass splits the string in two, and is itself slow */
    assert_true(frequency_of(e, 1) < 1e-5);
    check_relative(frequency_of(e, 2), M_PI / (1.0 - mu), 1e-11);
    check_relative(frequency_of(e, 4), M_PI / mu, 1e-11);
    strum_taut_free(a);
    strum_taut_free(b);
    strum_taut_free(c);
    strum_taut_free(d);
    strum_taut_free(e);
}

/* A spring to ground at midspan: cot(b/2) = -kappa/(2 b), kappa = k L/T; rigid: the half
 * string. */
static void a_spring_at_midspan(void **state)
{
    (void)state;
    const double stiffness[4] = {0.0, 1.0, 50.0, 1e15};
    for (int i = 0; i < 4; i++) {
        const strum_taut_component parts[3] = {part_cable(1.0, 1.0, 0.5, 0.0),
                                               part_ground(stiffness[i], 0.0),
                                               part_cable(1.0, 1.0, 0.5, 0.0)};
        strum_taut *chain = fixed_chain(parts, 3);
        for (long k = 1; k <= 9; k += 2) {
            const double b = frequency_of(chain, k);
            if (stiffness[i] > 1e10)
                check_relative(b, (double)(k + 1) * M_PI, 1e-13);
            else /* as zero of an entire function: cos(b/2) + kappa sin(b/2)/(2 b) = 0 */
                check_absolute(cos(0.5 * b) + stiffness[i] / (2.0 * b) * sin(0.5 * b), 0.0,
                               1e-13);
            /* a rigid spring leaves even modes in pairs */
            check_relative(frequency_of(chain, k + 1), (double)(k + 1) * M_PI, 1e-13);
        }
        strum_taut_free(chain);
    }
}

/* Two hinged bars alone: sqrt(12 T/(M l)) in phase with the ends held (one degree of freedom).
 */
static void bodies_without_cable(void **state)
{
    (void)state;
    const strum_taut_link bar = strum_taut_bar(1.0, 2.0);
    const strum_taut_component parts[2] = {part_body(50.0, 50.0, &bar, NULL, 1),
                                           part_body(50.0, 50.0, &bar, NULL, 1)};
    strum_taut *chain = fixed_chain(parts, 2);
    /* energy: each bar turns about its held end, M l^2/3; T l th^2/2 each */
    check_relative(frequency_of(chain, 1), sqrt(50.0 / (2.0 / 3.0)), 1e-14);
    const long second = 2;
    double w;
    strum_error fault;
    assert_int_equal(strum_taut_frequencies(chain, &second, 1, NULL, &w, &fault),
                     STRUM_ERR_IMPOSSIBLE);
    assert_string_equal(fault.reason, "the chain has only 1 modes");
    strum_taut_free(chain);
    const strum_taut_component still[2] = {part_mass(1.0), part_hanging(1.0, 1.0, 0.0)};
    chain = fixed_chain(still, 2);
    assert_int_equal(strum_taut_frequencies(chain, &second, 1, NULL, &w, &fault),
                     STRUM_ERR_IMPOSSIBLE);
    strum_taut_free(chain);
}

/* ---- published and independent values ---- */

/* Levesque's systems without damping, and lumps, by an independent program in 40 digits
 * (Wittrick-Williams count, Newton's method). */
static void independent_values(void **state)
{
    (void)state;
    strum_taut_link links[2];
    strum_taut_joint joint;
    levesque_absorber(9.0, 0.12, 0.0, links, &joint);
    const strum_taut_component baseline[3] = {part_cable(5000, 1, 25, 0),
                                              part_body(5000, 5000, links, &joint, 2),
                                              part_cable(5000, 1, 25, 0)};
    const long k_baseline[6] = {1, 3, 29, 30, 31, 33};
    const double w_baseline[6] = {3.312379263307163,  10.654886529810577, 121.64761766923411,
                                  125.11152465101229, 128.8933058550616,  136.25969034640366};
    const strum_taut_link lump = {0.8, 0.2, 25.0, 25.0 * 0.09};
    const strum_taut_link sphere = strum_taut_sphere(0.6, 40.0);
    const strum_taut_component lumps[5] = {
        part_cable(5000, 1, 12, 0), part_body(5000, 5000, &lump, NULL, 1),
        part_cable(5000, 1, 7.5, 0), part_body(5000, 5000, &sphere, NULL, 1),
        part_cable(5000, 1, 18, 0)};
    const long k_lumps[5] = {1, 2, 3, 10, 20};
    const double w_lumps[5] = {2.797758861727949, 6.726246872839087, 12.811539654903186,
                               46.69431783876498, 99.02660560279725};
    const strum_taut_component hanging[3] = {
        part_cable(5000, 1, 25, 0), part_hanging(5, 68.45, 0), part_cable(5000, 1, 25, 0)};
    const double w_hanging[5] = {3.2147491558467656, 5.028175765049601, 8.885765876316732,
                                 13.43881738660626, 17.771531752633464};
    strum_taut *chain = fixed_chain(baseline, 3);
    for (int i = 0; i < 6; i++)
        check_relative(frequency_of(chain, k_baseline[i]), w_baseline[i], 1e-13);
    strum_taut_free(chain);
    chain = fixed_chain(lumps, 5);
    for (int i = 0; i < 5; i++)
        check_relative(frequency_of(chain, k_lumps[i]), w_lumps[i], 1e-13);
    strum_taut_free(chain);
    chain = fixed_chain(hanging, 3);
    for (int i = 0; i < 5; i++)
        check_relative(frequency_of(chain, i + 1), w_hanging[i], 1e-13);
    strum_taut_free(chain);
}

/* N = 380: L 2000 m, T 20 kN, 2 kg/m; x_i = round(L (i + .35 sin 2.1 i)/(N + 1), mm),
 * M_i = round(3 + 2 sin(1.3 i + .4), g). */
static strum_taut *many_masses(int count)
{
    strum_taut_component *parts = calloc(2 * (size_t)count + 1, sizeof *parts);
    double before = 0.0;
    for (int i = 1; i <= count; i++) {
        const double x =
            round(1000.0 * 2000.0 * (i + 0.35 * sin(2.1 * i)) / (count + 1)) / 1000.0;
        parts[2 * i - 2] = part_cable(20000.0, 2.0, x - before, 0.0);
        parts[2 * i - 1] = part_mass(round(1000.0 * (3.0 + 2.0 * sin(1.3 * i + 0.4))) / 1000.0);
        before = x;
    }
    parts[2 * count] = part_cable(20000.0, 2.0, 2000.0 - before, 0.0);
    strum_taut *chain = fixed_chain(parts, 2 * (size_t)count + 1);
    free(parts);
    return chain;
}

static void three_hundred_and_eighty_masses(void **state)
{
    (void)state;
    strum_taut *chain = many_masses(380);
    long numbers[1000];
    double w[1000];
    for (long k = 0; k < 1000; k++)
        numbers[k] = k + 1;
    assert_int_equal(strum_taut_frequencies(chain, numbers, 1000, NULL, w, NULL), STRUM_OK);
    /* independent values, the one of mode 162 to 25 digits */
    check_relative(w[0], .1385290547799, 1e-12);
    check_relative(w[161], 22.37212128812053347530539, 1e-13);
    check_relative(w[379], 51.309094995, 1e-10);
    check_relative(w[380], 53.436894524, 1e-10);
    check_relative(w[499], 66.478145876, 1e-10);
    check_relative(w[412] / w[411] - 1.0, 1.16e-5,
                   0.01); /* the closest pair of the first 500 */
    for (long k = 0; k < 1000; k++) {
        assert_int_equal(strum_taut_count(chain, w[k] * (1.0 - 1e-11)), k);
        assert_int_equal(strum_taut_count(chain, w[k] * (1.0 + 1e-11)), k + 1);
        /* mode k has k - 1 nodes and, masses drawing y to the axis, k antinodes */
        strum_taut_shape *shape;
        const double *nodes;
        const strum_taut_antinode *antinodes;
        const strum_taut_root root = {k + 1, w[k], 0.0, INFINITY, 0.0};
        assert_int_equal(strum_taut_shape_make(chain, &root, NULL, &shape, NULL), STRUM_OK);
        assert_int_equal(strum_taut_shape_nodes(shape, &nodes), k);
        assert_int_equal(strum_taut_shape_antinodes(shape, &antinodes), k + 1);
        strum_taut_shape_free(shape);
    }
    strum_taut_free(chain);
}

static void a_thousand_components(void **state)
{
    (void)state;
    strum_taut *chain = many_masses(1000);
    strum_taut_roots *roots = roots_of(chain, 1000, 0, 0, 0);
    strum_verification v;
    assert_int_equal(strum_taut_verify(chain, roots, NULL, &v, NULL), STRUM_OK);
    assert_int_equal(v.modes_expected, 1000);
    assert_int_equal(v.modes_found, 1000);
    assert_true(v.max_relative_difference < 1e-11);
    assert_true(v.max_residual < 1e-13);
    strum_taut_roots_free(roots);
    strum_taut_free(chain);
}

/* Two weakly coupled halves: 11.10686489/11.10811975 rad/s (independent); much weaker still. */
static void near_degenerate_pairs(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        const double heavy = i == 0 ? 2000.0 : 2e12;
        const strum_taut_component parts[3] = {part_cable(5000, 1, 20, 0), part_mass(heavy),
                                               part_cable(5000, 1, 20, 0)};
        strum_taut *chain = fixed_chain(parts, 3);
        const double odd = frequency_of(chain, 2), even = frequency_of(chain, 3);
        const double half = M_PI / 20.0 * sqrt(5000.0);
        /* sin(kL/2) = 0, and the symmetric one: 2 k T cos(kL/2) = M w^2 sin(kL/2) */
        check_relative(fmin(odd, even), half, 1e-14);
        const double w = fmax(odd, even), k = w / sqrt(5000.0);
        const double split = 2.0 * 5000.0 / (20.0 * heavy * half * half); /* (w - half)/half */
        check_relative(w / half - 1.0, split, i == 0 ? 0.01 : 0.2);       /* to leading order */
        check_absolute(2.0 * k * 5000.0 * cos(20.0 * k) / (heavy * w * w) - sin(20.0 * k), 0.0,
                       1e-13);
        assert_int_equal(strum_taut_count(chain, half * (1.0 - 1e-10)), 1);
        strum_taut_free(chain);
    }
}

/* An absorber tuned to the frequency of both halves hangs at the node: three motions, two of
 * them of one frequency exactly. */
static void an_exactly_double_mode(void **state)
{
    (void)state;
    const strum_taut_component parts[3] = {part_cable(M_PI * M_PI, 1.0, M_PI * M_PI, 0.0),
                                           part_hanging(3.0, 3.0, 0.0),
                                           part_cable(M_PI * M_PI, 1.0, M_PI * M_PI, 0.0)};
    strum_taut *chain = fixed_chain(parts, 3); /* halves and absorber: 1 rad/s */
    assert_int_equal(strum_taut_count(chain, 1.0 - 1e-9), 1);
    assert_int_equal(strum_taut_count(chain, 1.0 + 1e-9), 3);
    check_relative(frequency_of(chain, 2), 1.0, 1e-12);
    check_relative(frequency_of(chain, 3), 1.0, 1e-12);
    strum_taut_free(chain);
}

/* ---- shapes ---- */

/* Sergev and Iwan, case 1: four masses on a piano wire, at fifths of its length. */
#define INCH 0.0254
static strum_taut *sergev_case_1(void)
{
    strum_taut_component parts[9];
    for (int i = 0; i < 9; i++)
        parts[i] = i % 2
                       ? part_mass(0.00267068423802)
                       : part_cable(26.466918610799972, 0.0041703705579855645, 34.5 * INCH, 0);
    return fixed_chain(parts, 9);
}

static void check_shape(const strum_taut *chain, long mode, const double *nodes,
                        size_t node_count, const strum_taut_antinode *antinodes,
                        size_t antinode_count)
{
    const strum_taut_root root = {mode, frequency_of(chain, mode), 0.0, INFINITY, 0.0};
    strum_taut_shape *shape;
    const double *got;
    const strum_taut_antinode *tops;
    assert_int_equal(strum_taut_shape_make(chain, &root, NULL, &shape, NULL), STRUM_OK);
    assert_int_equal(strum_taut_shape_nodes(shape, &got), node_count);
    for (size_t i = 0; i < node_count; i++)
        check_absolute(got[i], nodes[i], 1e-9);
    assert_int_equal(strum_taut_shape_antinodes(shape, &tops), antinode_count);
    for (size_t i = 0; i < antinode_count; i++) {
        check_absolute(tops[i].x, antinodes[i].x, 1e-8);
        check_absolute(tops[i].amplitude, antinodes[i].amplitude, 1e-9);
    }
    strum_taut_shape_free(shape);
}

static void nodes_and_antinodes_of_case_1(void **state)
{
    (void)state;
    strum_taut *chain = sergev_case_1();
    /* mode 3: cusps at the outer masses are the largest (the report's computed .92 .69 1 are
     * read off a grid); independent values */
    const double nodes_3[2] = {1.4367212888303342, 2.9447787111696653};
    const strum_taut_antinode tops_3[3] = {
        {0.8763, 1.0}, {2.19075, 0.8021660926641552}, {3.5052, 1.0}};
    check_shape(chain, 3, nodes_3, 2, tops_3, 3);
    const double nodes_7[6] = {0.7640459197933778, 1.1228709642570245, 1.8087270401033109,
                               2.572772959896689,  3.258629035742975,  3.617454080206622};
    const strum_taut_antinode tops_7[7] = {
        {0.3820229598966889, 0.831050005170122},  {0.8763, 0.37010776970638315},
        {1.5048939241537136, 0.4359997341997106}, {2.19075, 1.0},
        {2.8766060758462864, 0.4359997341997105}, {3.5052, 0.37010776970638315},
        {3.9994770401033106, 0.8310500051701223}};
    check_shape(chain, 7, nodes_7, 6, tops_7, 7);
    /* modes 5 and 10 have their nodes exactly at the masses: those of the bare wire, each once
     */
    for (long mode = 5; mode <= 10; mode += 5) {
        double nodes[9];
        strum_taut_antinode tops[10];
        const double wave = 5.0 * 34.5 * INCH / (double)mode;
        for (long i = 0; i < mode; i++) {
            nodes[i < 9 ? i : 8] = wave * (double)(i < 9 ? i + 1 : 9);
            tops[i] = (strum_taut_antinode){wave * ((double)i + 0.5), 1.0};
        }
        check_shape(chain, mode, nodes, (size_t)mode - 1, tops, (size_t)mode);
    }
    strum_taut_free(chain);
}

static void shapes_satisfy_the_equations(void **state)
{
    (void)state;
    strum_taut_link links[2];
    strum_taut_joint joint;
    levesque_absorber(2.5, 1.0 / 30.0, 0.0, links, &joint);
    const strum_taut_component parts[5] = {
        part_cable(5000, 1, 10, 0), part_body(5000, 5000, links, &joint, 2),
        part_cable(5000, 1, 12, 0), part_hanging(3.0, 500.0, 0.0), part_cable(5000, 1, 7, 0)};
    strum_taut *chain = chain_of(parts, 5, STRUM_TAUT_FIXED, STRUM_TAUT_FREE);
    assert_true(strum_taut_length(chain) == 29.8);
    for (long mode = 1; mode <= 12; mode++) {
        const strum_taut_root root = {mode, frequency_of(chain, mode), 0.0, INFINITY, 0.0};
        strum_taut_shape *shape;
        strum_taut_point p[2981];
        assert_int_equal(strum_taut_shape_make(chain, &root, NULL, &shape, NULL), STRUM_OK);
        assert_int_equal(strum_taut_shape_sample(shape, 2981, p, NULL), STRUM_OK);
        const double k2 = root.frequency * root.frequency / 5000.0, h = 0.01;
        double largest = 0.0;
        for (int i = 0; i <= 2980; i++) {
            largest = fmax(largest, cabs(p[i].displacement));
            check_absolute(cimag(p[i].displacement), 0.0, 1e-12);
        }
        for (int i = 100; i < 2900; i++) { /* y'' = -k^2 y and V = T y' on the cables */
            const bool cable = i < 995 || (i > 1085 && i < 2275) || i > 2285;
            if (!cable)
                continue;
            const double before = creal(p[i - 1].displacement), y = creal(p[i].displacement),
                         after = creal(p[i + 1].displacement);
            const double c = 2.0 * cos(sqrt(k2) * h); /* exact for a sine */
            check_absolute(after + before - c * y, 0.0, 1e-12);
            check_absolute(creal(p[i].force),
                           5000.0 * sqrt(k2) * (after - before) / (2.0 * sin(sqrt(k2) * h)),
                           1e-6 * 5000.0 * sqrt(k2));
        }
        check_relative(largest, 1.0, 1e-4); /* the largest of samples 1 cm apart */
        assert_true(largest <= 1.0 + 1e-12);
        assert_true(p[0].displacement == 0.0);
        check_absolute(creal(p[2980].force), 0.0, 1e-9 * 5000.0);
        strum_taut_shape_free(shape);
    }
    strum_taut_free(chain);
}

/* ---- random chains against Wittrick and Williams' count ---- */

static strum_taut_component random_part(uint64_t *seed, double tension, strum_taut_link *links,
                                        strum_taut_joint *joints)
{
    const double other = tension * draw(seed, 0.3, 3.0);
    const size_t count = (size_t)draw(seed, 1.0, 5.99);
    for (size_t i = 0; i < count; i++) {
        links[i] = (strum_taut_link){draw_log(seed, 0.05, 0.5), draw_log(seed, 0.05, 0.5),
                                     draw(seed, -5.0, 20.0), draw(seed, -0.3, 1.0)};
        links[i].mass = fmax(links[i].mass, 0.0); /* a quarter of them have none */
        links[i].inertia = fmax(links[i].inertia, 0.0);
        joints[i] = (strum_taut_joint){0.03, 0.03, draw_log(seed, 1.0, 1e8), 0.0,
                                       tension * draw(seed, 0.9, 1.1)};
    }
    switch ((int)draw(seed, 0.0, 8.99)) {
    case 0:
        return part_mass(draw_log(seed, 0.01, 50.0));
    case 1:
        return part_hanging(draw_log(seed, 0.1, 50.0), draw_log(seed, 1.0, 1e5), 0.0);
    case 2:
        return part_ground(draw_log(seed, 1.0, 1e6), 0.0);
    case 3:
        return part_support(tension, 1.0, draw(seed, 0.1, 0.9), draw_log(seed, 0.01, 5.0));
    case 4:
        return part_varying(tension, other, draw_log(seed, 0.1, 5.0), draw_log(seed, 0.5, 30.0),
                            draw(seed, 0.0, 1.0) < 0.5);
    case 5:
    case 6:
        return part_body(tension, tension, links, joints, count);
    default:
        return part_cable(tension, draw_log(seed, 0.1, 5.0), draw_log(seed, 0.5, 30.0), 0.0);
    }
}

static void random_chains_agree_with_a_second_method(void **state)
{
    (void)state;
    uint64_t seed = 2;
    for (int n = 0; n < 400; n++) {
        strum_taut_component parts[8];
        strum_taut_link links[8][8];
        strum_taut_joint joints[8][8];
        const size_t count = (size_t)draw(&seed, 1.0, 7.0);
        const double tension = draw_log(&seed, 100.0, 1e5);
        for (size_t i = 0; i < count; i++)
            parts[i] = random_part(&seed, tension, links[i], joints[i]);
        parts[count] = part_cable(tension, 1.0, 10.0, 0.0);
        strum_taut *chain =
            chain_of(parts, count + 1, (strum_taut_end)(n & 1), (strum_taut_end)((n >> 1) & 1));
        strum_taut_roots *roots = roots_of(chain, 20, 0, 0, 0);
        strum_verification v;
        assert_int_equal(strum_taut_verify(chain, roots, NULL, &v, NULL), STRUM_OK);
        assert_int_equal(v.modes_expected, 20);
        /* what short bodies leave of the second method's digits */
        assert_true(v.max_relative_difference < 1e-6);
        for (size_t i = 1; i < roots->count; i++)
            assert_true(roots->roots[i].frequency >= roots->roots[i - 1].frequency);
        strum_taut_roots_free(roots);
        strum_taut_free(chain);
    }
}

static void bands_and_bad_queries(void **state)
{
    (void)state;
    strum_taut *chain = sergev_case_1();
    strum_taut_roots *roots = roots_of(chain, 0, 100.0, 400.0, 1.0);
    assert_int_equal(roots->count, 7); /* modes 3 to 9 */
    assert_int_equal(roots->roots[0].mode, 3);
    assert_int_equal(roots->overdamped_count, 0);
    strum_taut_roots_free(roots);
    strum_error fault;
    const long twice[2] = {2, 2};
    const strum_taut_query bad[4] = {{.numbers = twice, .count = 2},
                                     {.lowest = 2.0, .highest = 1.0, .max_decay = 1.0},
                                     {.lowest = 0.0, .highest = 1.0, .max_decay = 1.0},
                                     {.lowest = 1.0, .highest = 2.0, .max_decay = NAN}};
    for (int i = 0; i < 4; i++) {
        assert_int_equal(strum_taut_solve(chain, &bad[i], NULL, &roots, &fault),
                         STRUM_ERR_RANGE);
        assert_null(roots);
    }
    strum_taut_free(chain);
}

/* A shape keeps what it needs of its chain, whichever is freed first (seen by
 * AddressSanitizer): half a sine of a uniform string. */
static void a_shape_outlives_its_chain(void **state)
{
    (void)state;
    const strum_taut_component string = part_cable(100.0, 1.0, 10.0, 0.0);
    const strum_taut_root first = {.mode = 1, .frequency = M_PI};
    strum_taut *chain;
    strum_taut_shape *shape;
    strum_taut_point points[5];
    assert_int_equal(
        strum_taut_make(&string, 1, STRUM_TAUT_FIXED, STRUM_TAUT_FIXED, &chain, NULL),
        STRUM_OK);
    assert_int_equal(strum_taut_shape_make(chain, &first, NULL, &shape, NULL), STRUM_OK);
    strum_taut_free(chain);
    assert_int_equal(strum_taut_shape_sample(shape, 5, points, NULL), STRUM_OK);
    for (int k = 0; k < 5; k++)
        check_absolute(creal(points[k].displacement), sin(M_PI * k / 4), 1e-12);
    strum_taut_shape_free(shape);
}

/* An error names the component by its number, not only in its text. */
static void an_error_names_its_component(void **state)
{
    (void)state;
    const strum_taut_component parts[] = {part_cable(100.0, 1.0, 10.0, 0.0), part_mass(1.0),
                                          part_cable(100.0, 1.0, -1.0, 0.0)};
    strum_taut *chain;
    strum_error error = {0};
    assert_int_equal(
        strum_taut_make(parts, 3, STRUM_TAUT_FIXED, STRUM_TAUT_FIXED, &chain, &error),
        STRUM_ERR_RANGE);
    assert_int_equal(error.argument, STRUM_TAUT_ARG_COMPONENTS);
    assert_int_equal(error.index, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_string_has_its_harmonics),
        cmocka_unit_test(code_aster_sdnl138),
        cmocka_unit_test(a_vertical_cable),
        cmocka_unit_test(wkb_errs_as_predicted),
        cmocka_unit_test(a_mass_at_midspan),
        cmocka_unit_test(equal_masses),
        cmocka_unit_test(properties_of_masses),
        cmocka_unit_test(a_spring_at_midspan),
        cmocka_unit_test(bodies_without_cable),
        cmocka_unit_test(independent_values),
        cmocka_unit_test(three_hundred_and_eighty_masses),
        cmocka_unit_test(a_thousand_components),
        cmocka_unit_test(near_degenerate_pairs),
        cmocka_unit_test(an_exactly_double_mode),
        cmocka_unit_test(nodes_and_antinodes_of_case_1),
        cmocka_unit_test(shapes_satisfy_the_equations),
        cmocka_unit_test(random_chains_agree_with_a_second_method),
        cmocka_unit_test(bands_and_bad_queries),
        cmocka_unit_test(a_shape_outlives_its_chain),
        cmocka_unit_test(an_error_names_its_component),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
