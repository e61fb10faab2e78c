/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Damped chains: closed forms, Levesque's systems, branches, exceptional points, a second
 * method. */
#include <stdlib.h>
#include <string.h>

#include "taut/parts.h"

static double zeta_of(const strum_taut_root *r)
{
    return r->decay / hypot(r->frequency, r->decay);
}

static strum_taut *levesque(double mass, double inertia, double damping)
{
    strum_taut_link links[2];
    strum_taut_joint joint;
    levesque_absorber(mass, inertia, damping, links, &joint);
    const strum_taut_component parts[3] = {part_cable(5000, 1, 25, 0),
                                           part_body(5000, 5000, links, &joint, 2),
                                           part_cable(5000, 1, 25, 0)};
    return fixed_chain(parts, 3);
}

static strum_taut *hanging(double stiffness, double damping)
{
    const strum_taut_component parts[3] = {part_cable(5000, 1, 25, 0),
                                           part_hanging(5, stiffness, damping),
                                           part_cable(5000, 1, 25, 0)};
    return fixed_chain(parts, 3);
}

/* ---- closed forms ---- */

/* Distributed drag: rho w^2 - i R w = T (n pi/L)^2. With much of it the first modes are
 * overdamped; at R = 5 seven of them are. */
static void drag_on_a_string(void **state)
{
    (void)state;
    const double rho = 0.2, t = 50.0, length = 20.0;
    for (int i = 0; i < 2; i++) {
        const double r = i == 0 ? 0.3 : 7.0;
        const strum_taut_component part = part_cable(t, rho, length, r);
        strum_taut *chain = fixed_chain(&part, 1);
        long oscillating = 0, overdamped = 0;
        strum_taut_roots *roots = roots_of(chain, 20, 0, 0, 60.0);
        for (long n = 1; n <= 20; n++) {
            const double k = (double)n * M_PI / length, half = 0.5 * r / rho;
            const double disc = t * k * k / rho - half * half;
            if (disc > 0.0) {
                assert_int_equal(roots->roots[oscillating].mode, n);
                check_relative(roots->roots[oscillating].frequency, sqrt(disc), 1e-13);
                check_relative(roots->roots[oscillating].decay, half, 1e-13);
                oscillating++;
                continue;
            }
            for (int side = -1; side <= 1; side += 2) {
                const double want = half + side * sqrt(-disc);
                double nearest = INFINITY;
                for (size_t q = 0; q < roots->overdamped_count; q++)
                    if (roots->overdamped[q].mode == n)
                        nearest = fmin(nearest, fabs(roots->overdamped[q].decay - want));
                check_absolute(nearest, 0.0, 1e-12 * want);
                overdamped++;
            }
        }
        assert_int_equal(roots->count, oscillating);
        assert_int_equal(roots->overdamped_count, overdamped);
        assert_int_equal(overdamped, i == 0 ? 0 : 14);
        assert_int_equal(roots->axis_expected, roots->axis_found);
        strum_taut_roots_free(roots);
        strum_taut_free(chain);
    }
}

/* A viscous damper at mu: sinh(l) + eta sinh(mu l) sinh((1 - mu) l) = 0, l = s L sqrt(m/T),
 * eta = c/sqrt(T m); and its published optima. */
static void a_viscous_damper(void **state)
{
    (void)state;
    const double mu[2] = {0.02, 0.10}, eta[2] = {15.9266140411, 3.25422571325},
                 zeta[2] = {.0102114712735, .0566875866439};
    for (int i = 0; i < 2; i++) {
        const strum_taut_component parts[3] = {part_cable(1, 1, mu[i], 0),
                                               part_ground(0.0, eta[i]),
                                               part_cable(1, 1, 1.0 - mu[i], 0)};
        strum_taut *chain = fixed_chain(parts, 3);
        strum_taut_roots *roots = roots_of(chain, 12, 0, 0, 0);
        /* at an antinode of mode 5 that damper is beyond critical, and the mode is gone */
        const size_t count = i == 0 ? 12 : 11;
        assert_int_equal(roots->count, count);
        assert_int_equal(roots->lost, i);
        check_relative(zeta_of(&roots->roots[0]), zeta[i], 1e-10);
        for (size_t n = 0; n < count; n++) {
            const double _Complex l = CMPLX(-roots->roots[n].decay, roots->roots[n].frequency);
            assert_int_equal(roots->roots[n].mode, n + 1 + (i == 1 && n >= 4));
            check_absolute(cabs(csinh(l) + eta[i] * csinh(mu[i] * l) * csinh((1 - mu[i]) * l)),
                           0.0, 1e-12 * cabs(l) * (1.0 + eta[i]));
        }
        strum_taut_roots_free(roots);
        strum_taut_free(chain);
    }
}

/* At midspan l = -2 artanh(eta/2) + i pi (2j - 1): at eta = 2 the decay is without limit, above
 * it the odd modes are gone and l = -2 arcoth(eta/2) + 2 i pi j, the first one without
 * oscillation. */
static void a_damper_at_midspan(void **state)
{
    (void)state;
    const double eta[4] = {0.2, 1.0, 1.9, 3.0};
    for (int i = 0; i < 4; i++) {
        const strum_taut_component parts[3] = {part_cable(1, 1, 0.5, 0), part_ground(0, eta[i]),
                                               part_cable(1, 1, 0.5, 0)};
        strum_taut *chain = fixed_chain(parts, 3);
        strum_taut_roots *roots = roots_of(chain, 0, 0.5, 17.0, 12.0);
        const double decay =
            eta[i] < 2.0 ? 2.0 * atanh(0.5 * eta[i]) : 2.0 * atanh(2.0 / eta[i]);
        /* pi .. 5 pi by turns, or 2 pi and 4 pi twice */
        assert_int_equal(roots->count, eta[i] < 2.0 ? 5 : 4);
        for (int n = 1; n <= 5; n++) {
            if (n % 2 == 0)
                check_has_root(roots, n * M_PI, 1e-13);
            if ((n % 2 == 1) == (eta[i] < 2.0))
                check_has_root(roots, CMPLX(n * M_PI, decay), 1e-12);
        }
        if (eta[i] == 1.0) /* published: zeta 0.330097420439 */
            check_relative(zeta_of(&roots->roots[0]), .330097420439, 1e-11);
        if (eta[i] > 2.0) {
            assert_int_equal(roots->overdamped_count, 1);
            check_relative(roots->overdamped[0].decay, decay, 1e-12);
            assert_true(roots->lost == 3);
        }
        strum_taut_roots_free(roots);
        strum_taut_free(chain);
    }
}

/* Tuned mass damper, r .02 at midspan, f .96, own damping ratio .12 (c = 2 md zd wd). */
static void a_tuned_mass_damper(void **state)
{
    (void)state;
    const double mass = .02, wd = .96 * M_PI;
    const strum_taut_component parts[3] = {
        part_cable(1, 1, 0.5, 0), part_hanging(mass, mass * wd * wd, 2.0 * mass * .12 * wd),
        part_cable(1, 1, 0.5, 0)};
    strum_taut *chain = fixed_chain(parts, 3);
    strum_taut_roots *roots = roots_of(chain, 3, 0, 0, 0);
    check_has_root(roots, CMPLX(2.82915216997, .176784616438), 1e-11);
    check_has_root(roots, CMPLX(3.32266068876, .192772980267), 1e-11);
    check_has_root(roots, 2.0 * M_PI, 1e-13);
    strum_taut_roots_free(roots);
    strum_taut_free(chain);
}

/* ---- Levesque's systems (values of an independent program in 40 digits) ---- */

static void the_baseline_system(void **state)
{
    (void)state;
    const double _Complex want[9] = {
        CMPLX(114.5525107627685, 1.011109984872859),   116.32059454953026,
        CMPLX(123.34354030184436, 2.1485736173626973), 125.11152465101229,
        CMPLX(128.44937348400984, 5.499798891458214),  133.92390778284863,
        CMPLX(134.67340036199164, 1.9396932597634753), 142.75108278133925,
        CMPLX(143.47651786417822, 1.0411270351890038)};
    strum_taut *chain = levesque(9.0, 0.12, 2240.0);
    strum_taut_roots *roots = roots_of(chain, 0, 110.0, 150.0, 40.0);
    assert_int_equal(roots->expected, 9);
    for (int i = 0; i < 9; i++)
        check_has_root(roots, want[i], 1e-13);
    strum_taut_roots_free(roots);
    /* the independent program counts 47 roots here */
    roots = roots_of(chain, 0, 0.5, 200.3, 40.0);
    assert_int_equal(roots->expected, 47);
    strum_taut_roots_free(roots);
    /* by number: 35 branches, all found; and one of them alone */
    roots = roots_of(chain, 35, 0, 0, 0);
    assert_int_equal(roots->count, 35);
    check_relative(roots->roots[28].decay / roots->roots[28].frequency, 0.0174194255500105,
                   1e-12);
    strum_taut_roots_free(roots);
    strum_taut_free(chain);
}

/* One branch leaves (the joint's own motion, undamped mode 31) and is overdamped from R =
 * 18694.33164 on; the symmetric modes above move down one place. */
static void the_leaving_branch(void **state)
{
    (void)state;
    const double damping[2] = {18694.0, 18695.0};
    for (int i = 0; i < 2; i++) {
        strum_taut *chain = levesque(9.0, 0.12, damping[i]);
        strum_taut_root r;
        const double whole = 1.0;
        assert_int_equal(strum_taut_follow(chain, 31, &whole, 1, NULL, &r, NULL), STRUM_OK);
        assert_true(i == 0 ? r.frequency > 0.0 && r.frequency < 10.0 : r.frequency == 0.0);
        strum_taut_roots *roots = roots_of(chain, 33, 0, 0, 0);
        assert_int_equal(roots->count, i == 0 ? 33 : 32);
        assert_int_equal(roots->overdamped_count, i == 0 ? 0 : 2);
        if (i == 1)
            assert_int_equal(roots->overdamped[0].mode, 31);
        strum_taut_roots_free(roots);
        strum_taut_free(chain);
    }
    /* R -> infinity: one bar (modes 29 and 31 of it), and so is R = 1e12 but for some 1e-5 */
    strum_taut *rigid = levesque(9.0, 0.12, INFINITY), *stiff = levesque(9.0, 0.12, 1e12);
    assert_false(strum_taut_is_damped(rigid));
    const strum_taut_link bar = {0.4, 0.4, 18.0, 2.0 * 0.12 + 18.0 * 0.04};
    const strum_taut_component one[3] = {part_cable(5000, 1, 25, 0),
                                         part_body(5000, 5000, &bar, NULL, 1),
                                         part_cable(5000, 1, 25, 0)};
    strum_taut *single = fixed_chain(one, 3);
    strum_taut_roots *roots = roots_of(stiff, 35, 0, 0, 0);
    assert_int_equal(roots->count, 34);
    for (size_t i = 0; i < 33; i++) {
        const long k = (long)i + 1;
        check_relative(frequency_of(rigid, k), frequency_of(single, k), 1e-13);
        check_has_root(roots, frequency_of(single, k), 1e-6);
    }
    strum_taut_roots_free(roots);
    strum_taut_free(rigid);
    strum_taut_free(stiff);
    strum_taut_free(single);
}

/* Branch A (undamped 3.2147 rad/s) and B (5.0282): loss ratios against R. */
static void branches_of_a_hanging_absorber(void **state)
{
    (void)state;
    const double factors[7] = {5.0 / 30,  9.25 / 30, 12.0 / 30, 15.0 / 30,
                               16.0 / 30, 20.0 / 30, 1};
    const double a[7] = {.07168, .134158, .17608, .224485, .26157, .52337, 1.470};
    const double b[7] = {.06616, .124786, .16506, .211583, .20802, .11322, .06524};
    strum_taut *chain = hanging(68.45, 30.0);
    strum_taut_root r[7];
    assert_int_equal(strum_taut_follow(chain, 1, factors, 7, NULL, r, NULL), STRUM_OK);
    for (int i = 0; i < 7; i++)
        check_relative(r[i].decay / r[i].frequency, a[i], 5e-4);
    assert_int_equal(strum_taut_follow(chain, 2, factors, 7, NULL, r, NULL), STRUM_OK);
    for (int i = 0; i < 7; i++)
        check_relative(r[i].decay / r[i].frequency, b[i], 5e-4);
    strum_taut_free(chain);
    /* A reaches the imaginary axis at R = 34.80882652, as a double root with decay 4.29835518
     */
    chain = hanging(68.45, 34.80882651606836);
    const double near[2] = {1.0 - 1e-9, 1.0 + 1e-9};
    assert_int_equal(strum_taut_follow(chain, 1, near, 2, NULL, r, NULL), STRUM_OK);
    assert_true(r[0].frequency > 0.0 && r[1].frequency == 0.0);
    check_relative(r[0].decay, 4.29835517918709, 1e-6);
    check_relative(r[1].decay, 4.29835517918709, 1e-3);
    strum_taut_free(chain);
}

/* The pole coalescence of the hanging absorber over (k, R), and of modes 29/31 over (MR, R). */
static void exceptional_points_are_recognised(void **state)
{
    (void)state;
    strum_taut *chain = hanging(68.8240822771165, 15.9540795056786);
    strum_taut_roots *roots = roots_of(chain, 0, 0.5, 7.0, 5.0);
    assert_int_equal(roots->count, 2);
    for (int i = 0; i < 2; i++) {
        const double _Complex w = CMPLX(roots->roots[i].frequency, roots->roots[i].decay);
        /* half the digits, as any double root */
        check_absolute(cabs(w - CMPLX(3.95125073976, .921022475352)), 0.0, 1e-5);
        assert_true(roots->roots[i].exceptional < 1e-8);
    }
    strum_taut_roots_free(roots);
    /* by number too: both modes end there */
    const long numbers[2] = {1, 2};
    const strum_taut_query query = {.numbers = numbers, .count = 2};
    assert_int_equal(strum_taut_solve(chain, &query, NULL, &roots, NULL), STRUM_OK);
    assert_int_equal(roots->count, 2);
    assert_int_equal(roots->lost, 0);
    for (int i = 0; i < 2; i++) {
        const double _Complex w = CMPLX(roots->roots[i].frequency, roots->roots[i].decay);
        assert_int_equal(roots->roots[i].mode, numbers[i]);
        check_absolute(cabs(w - CMPLX(3.95125073976, .921022475352)), 0.0, 1e-5);
    }
    strum_taut_roots_free(roots);
    strum_taut_free(chain);
    const double ratio = 23.890639081849, mass = 0.4 * ratio;
    chain = levesque(mass, mass * 0.16 / 12.0, 2328.0254647579);
    roots = roots_of(chain, 0, 122.0, 127.0, 40.0);
    int seen = 0;
    for (size_t i = 0; i < roots->count; i++)
        if (roots->roots[i].exceptional < 1e-6) {
            const double _Complex w = CMPLX(roots->roots[i].frequency, roots->roots[i].decay);
            check_absolute(cabs(w - CMPLX(124.52804978316, 4.0509481423067)), 0.0, 1e-3);
            seen++;
        }
    assert_int_equal(seen, 2);
    strum_taut_roots_free(roots);
    strum_taut_free(chain);
    /* none at the tuning that Levesque uses */
    chain = hanging(68.45, 15.0);
    roots = roots_of(chain, 0, 0.5, 7.0, 5.0);
    for (size_t i = 0; i < roots->count; i++)
        assert_true(roots->roots[i].exceptional > 1e-2);
    strum_taut_roots_free(roots);
    strum_taut_free(chain);
}

/* Muller's method from the undamped frequencies hops near the coalescence; the count shows it.
 */
static void muller_is_watched(void **state)
{
    (void)state;
    long hopped = 0, found = 0;
    for (double r = 5.0; r <= 30.0; r += 1.0) {
        strum_taut *chain = hanging(68.45, r);
        const strum_taut_query query = {
            .lowest = 0.5, .highest = 11.0, .max_decay = 12.0, .method = STRUM_TAUT_MULLER};
        strum_taut_roots *muller, *certain = roots_of(chain, 0, 0.5, 11.0, 12.0);
        assert_int_equal(strum_taut_solve(chain, &query, NULL, &muller, NULL), STRUM_OK);
        assert_int_equal(muller->expected, certain->expected);
        assert_int_equal(muller->found, muller->expected - muller->missed);
        for (size_t i = 0; i < muller->count; i++) { /* what it gives are roots */
            const double _Complex w = CMPLX(muller->roots[i].frequency, muller->roots[i].decay);
            if (muller->missed == 0)
                check_has_root(certain, w, 1e-11);
            long own = 0;
            for (size_t k = 0; k < certain->count; k++)
                if (cabs(CMPLX(certain->roots[k].frequency, certain->roots[k].decay) - w) <
                    1e-9)
                    own = certain->roots[k].mode;
            hopped += own != muller->roots[i].mode;
        }
        found += muller->hopped;
        strum_taut_roots_free(muller);
        strum_taut_roots_free(certain);
        strum_taut_free(chain);
    }
    assert_int_equal(found, hopped);
    assert_true(hopped > 0);
}

/* Roots of a similar chain lead to those of the next one; the count decides whether they do. */
static void guesses_are_certified(void **state)
{
    (void)state;
    strum_taut *before = levesque(9.0, 0.12, 2200.0), *after = levesque(9.0, 0.12, 2240.0);
    strum_taut_roots *guesses = roots_of(before, 0, 110.0, 150.0, 40.0), *roots,
                     *full = roots_of(after, 0, 110.0, 150.0, 40.0);
    strum_taut_query query = {.lowest = 110.0,
                              .highest = 150.0,
                              .max_decay = 40.0,
                              .guesses = guesses->roots,
                              .guess_count = guesses->count};
    for (int i = 0; i < 2; i++) { /* all of them, then too few */
        assert_int_equal(strum_taut_solve(after, &query, NULL, &roots, NULL), STRUM_OK);
        assert_int_equal(roots->expected, 9);
        assert_int_equal(roots->found, 9);
        assert_int_equal(roots->count, full->count);
        for (size_t k = 0; k < full->count; k++) {
            assert_int_equal(roots->roots[k].mode, full->roots[k].mode);
            check_relative(roots->roots[k].frequency, full->roots[k].frequency, 1e-13);
        }
        if (i == 0)
            assert_true(roots->evaluations < full->evaluations);
        strum_taut_roots_free(roots);
        query.guess_count = 5;
    }
    strum_taut_roots_free(guesses);
    strum_taut_roots_free(full);
    strum_taut_free(before);
    strum_taut_free(after);
}

/* A guess that leads to the conjugate of a known root leads to no other one. */
static void a_conjugate_is_no_other_root(void **state)
{
    (void)state;
    const strum_taut_component parts[3] = {
        part_cable(5000, 1, 16.8, 0), part_ground(0.0, 131.0), part_cable(5000, 1, 33.2, 0)};
    strum_taut *chain = fixed_chain(parts, 3);
    strum_taut_roots *full = roots_of(chain, 0, 1.5, 11.0, 22.0), *roots;
    assert_int_equal(full->count, 2);
    const strum_taut_root guesses[2] = {
        full->roots[0], {0, -full->roots[0].frequency, full->roots[0].decay, INFINITY, 0.0}};
    const strum_taut_query query = {.lowest = 1.5,
                                    .highest = 11.0,
                                    .max_decay = 22.0,
                                    .guesses = guesses,
                                    .guess_count = 2};
    assert_int_equal(strum_taut_solve(chain, &query, NULL, &roots, NULL), STRUM_OK);
    assert_int_equal(roots->count, 2);
    for (size_t k = 0; k < 2; k++)
        check_relative(roots->roots[k].frequency, full->roots[k].frequency, 1e-12);
    strum_taut_roots_free(roots);
    strum_taut_roots_free(full);
    strum_taut_free(chain);
}

/* Free at both ends: a rigid motion without frequency; drag makes its velocity die out. */
static void rigid_motions(void **state)
{
    (void)state;
    const strum_taut_component part = part_cable(100.0, 1.0, 10.0, 0.5);
    strum_taut *chain = chain_of(&part, 1, STRUM_TAUT_FREE, STRUM_TAUT_FREE);
    strum_taut_roots *roots = roots_of(chain, 4, 0, 0, 2.0);
    assert_int_equal(roots->count, 4);
    assert_true(roots->roots[0].frequency == 0.0 && roots->roots[0].decay == 0.0);
    for (int n = 1; n < 4; n++) {
        const double w = sqrt(100.0 * pow(n * M_PI / 10.0, 2) - 0.25 * 0.25);
        check_relative(roots->roots[n].frequency, w, 1e-13);
    }
    assert_int_equal(roots->axis_expected, 2); /* s = 0 and s = -R/rho */
    assert_int_equal(roots->overdamped_count, 1);
    check_relative(roots->overdamped[0].decay, 0.5, 1e-13);
    strum_taut_roots_free(roots);
    strum_taut_free(chain);
}

/* ---- random chains against spectral elements ---- */

static strum_taut_component random_part(uint64_t *seed, double tension, strum_taut_link *links,
                                        strum_taut_joint *joints)
{
    const size_t count = (size_t)draw(seed, 2.0, 4.99);
    const double damping = draw(seed, 0.0, 1.0) < 0.3 ? 0.0 : draw_log(seed, 0.1, 1e5);
    for (size_t i = 0; i < count; i++) {
        links[i] = (strum_taut_link){draw_log(seed, 0.05, 0.5), draw_log(seed, 0.05, 0.5),
                                     draw_log(seed, 0.1, 20.0), draw_log(seed, 0.01, 1.0)};
        joints[i] = (strum_taut_joint){0.03, 0.1, draw_log(seed, 1.0, 1e6),
                                       draw_log(seed, 1.0, 1e5), tension};
    }
    if (draw(seed, 0.0, 1.0) < 0.2)
        joints[0].damping = INFINITY;
    switch ((int)draw(seed, 0.0, 6.99)) {
    case 0:
        return part_hanging(draw_log(seed, 0.1, 50.0), draw_log(seed, 1.0, 1e4), damping);
    case 1:
        return part_ground(draw_log(seed, 1.0, 1e5), damping);
    case 2:
        return part_support(tension, 1.0, draw(seed, 0.1, 0.9), draw_log(seed, 0.01, 5.0));
    case 3:
        return part_varying(tension, tension * draw(seed, 0.5, 2.0), draw_log(seed, 0.1, 5.0),
                            draw_log(seed, 0.5, 10.0), draw(seed, 0.0, 1.0) < 0.5);
    case 4:
        return part_body(tension, tension, links, joints, count);
    default:
        return part_cable(tension, draw_log(seed, 0.1, 5.0), draw_log(seed, 0.5, 10.0),
                          draw(seed, 0.0, 1.0) < 0.5 ? 0.0 : draw_log(seed, 0.01, 2.0));
    }
}

static void random_chains_agree_with_a_second_method(void **state)
{
    (void)state;
    uint64_t seed = 4;
    int compared = 0;
    for (int n = 0; n < 60; n++) {
        strum_taut_component parts[6];
        strum_taut_link links[6][8];
        strum_taut_joint joints[6][8];
        const size_t count = (size_t)draw(&seed, 1.0, 5.0);
        const double tension = draw_log(&seed, 100.0, 1e4);
        for (size_t i = 0; i < count; i++)
            parts[i] = random_part(&seed, tension, links[i], joints[i]);
        parts[count] = part_cable(tension, 1.0, 5.0, 0.0);
        strum_taut *chain =
            chain_of(parts, count + 1, (strum_taut_end)(n & 1), (strum_taut_end)((n >> 1) & 1));
        const double low = frequency_of(chain, 3), high = frequency_of(chain, 8);
        strum_taut_roots *roots =
            roots_of(chain, 0, 0.9 * low + 1e-3, 0.5 * (high + frequency_of(chain, 9)), high);
        strum_verification v;
        if (strum_taut_verify(chain, roots, NULL, &v, NULL) == STRUM_OK) {
            assert_int_equal(v.modes_expected, v.modes_found);
            assert_true(v.max_relative_difference < 1e-8);
            assert_true(v.max_residual < 1e-11);
            compared++;
        }
        strum_taut_roots_free(roots);
        strum_taut_free(chain);
    }
    assert_true(compared >= 50);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(drag_on_a_string),
        cmocka_unit_test(a_viscous_damper),
        cmocka_unit_test(a_damper_at_midspan),
        cmocka_unit_test(a_tuned_mass_damper),
        cmocka_unit_test(the_baseline_system),
        cmocka_unit_test(the_leaving_branch),
        cmocka_unit_test(branches_of_a_hanging_absorber),
        cmocka_unit_test(exceptional_points_are_recognised),
        cmocka_unit_test(muller_is_watched),
        cmocka_unit_test(guesses_are_certified),
        cmocka_unit_test(a_conjugate_is_no_other_root),
        cmocka_unit_test(rigid_motions),
        cmocka_unit_test(random_chains_agree_with_a_second_method),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
