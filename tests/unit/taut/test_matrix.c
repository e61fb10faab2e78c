/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Transfer matrices against the formulas as Li prints them (in Levesque's Appendix B, by w),
 * the values of an independent program in 40 digits, limits, and what holds for any component.
 */
#include <gsl/gsl_sf_bessel.h>
#include <string.h>

#include "taut/parts.h"

static const double _Complex at[] = {CMPLX(7.3, 0.2), CMPLX(41.0, 0.0), CMPLX(120.0, 3.0)};

static void matrix_of(const strum_taut_component *part, double _Complex w, double _Complex f[4])
{
    strum_taut *chain = fixed_chain(part, 1);
    strum_error fault = {0};
    if (strum_taut_component_matrix(chain, 0, creal(w), cimag(w), f, &fault) != STRUM_OK)
        fail_msg("matrix: %s", fault.reason);
    strum_taut_free(chain);
}

static void check_matrix(const double _Complex got[4], const double _Complex want[4],
                         double tolerance)
{
    for (int k = 0; k < 4; k++)
        if (!(cabs(got[k] - want[k]) <= tolerance * cabs(want[k]) + 1e-300))
            fail_msg("entry %d: got %.17g%+.17gi, want %.17g%+.17gi", k, creal(got[k]),
                     cimag(got[k]), creal(want[k]), cimag(want[k]));
}

/* ---- printed formulas ---- */

static void cable_is_a3(void **state)
{
    (void)state;
    const double t = 5000.0, rho = 1.0, r = 0.4, length = 25.0;
    const strum_taut_component part = part_cable(t, rho, length, r);
    for (int i = 0; i < 3; i++) {
        const double _Complex w = at[i], k = csqrt((rho * w * w - I * r * w) / t);
        const double _Complex want[4] = {ccos(k * length), csin(k * length) / (k * t),
                                         -k * t * csin(k * length), ccos(k * length)};
        double _Complex f[4];
        matrix_of(&part, w, f);
        check_matrix(f, want, 1e-13);
    }
}

static void wkb_is_a2(void **state)
{
    (void)state;
    const double t0 = 10000.0, t1 = 20000.0, rho = 2.0, length = 100.0;
    const double slope = (t1 - t0) / length, z = pow(rho * rho * t0 * t1, 0.25);
    const double q = pow(t0 / t1, 0.25);
    const strum_taut_component part = part_varying(t0, t1, rho, length, true);
    for (int i = 0; i < 3; i++) {
        const double _Complex w = at[i];
        const double _Complex p = 2.0 * w * sqrt(rho) / slope * (sqrt(t1) - sqrt(t0));
        const double _Complex want[4] = {q * ccos(p) + slope / (4.0 * w * z) * csin(p),
                                         csin(p) / (w * z),
                                         (slope / (4.0 * q) - slope * q / 4.0) * ccos(p) -
                                             (w * z + slope * slope / (16.0 * w * z)) * csin(p),
                                         ccos(p) / q - slope / (4.0 * w * z) * csin(p)};
        double _Complex f[4];
        matrix_of(&part, w, f);
        check_matrix(f, want, 1e-11);
    }
}

static void bar_and_sphere_are_a5_and_a6(void **state)
{
    (void)state;
    const double t = 5000.0, mass = 18.0, size = 0.8;
    const strum_taut_link links[2] = {strum_taut_bar(size, mass),
                                      strum_taut_sphere(size, mass)};
    for (int i = 0; i < 3; i++) {
        const double _Complex m = mass * at[i] * at[i], n = m * size / t;
        const double _Complex bar[4] = {2.0 * (3.0 - n) / (6.0 + n), 6.0 * size / t / (6.0 + n),
                                        -m * (12.0 - n) / (12.0 + 2.0 * n),
                                        2.0 * (3.0 - n) / (6.0 + n)};
        const double _Complex d = 20.0 + 3.0 * n;
        const double _Complex sphere[4] = {(20.0 - 7.0 * n) / d, 20.0 * size / t / d,
                                           -m * (20.0 - 2.0 * n) / d, (20.0 - 7.0 * n) / d};
        double _Complex f[4];
        strum_taut_component part = part_body(t, t, &links[0], NULL, 1);
        matrix_of(&part, at[i], f);
        check_matrix(f, bar, 1e-13);
        part = part_body(t, t, &links[1], NULL, 1);
        matrix_of(&part, at[i], f);
        check_matrix(f, sphere, 1e-13);
    }
}

/* A.7 with L_c = h (the report prints D), apex at the left. */
static void cone_is_a7(void **state)
{
    (void)state;
    const double t0 = 4100.0, t1 = 4000.0, mass = 6.7, h = 0.5, rb = 0.21;
    const strum_taut_link link = strum_taut_cone(h, rb, mass, true);
    const strum_taut_component part = part_body(t0, t1, &link, NULL, 1);
    for (int i = 0; i < 3; i++) {
        const double _Complex m = mass * at[i] * at[i],
                              n = 3.0 * m / (5.0 * (t1 + 3.0 * t0) * h);
        const double _Complex d = 1.0 - n * (rb * rb - h * h);
        const double _Complex want[4] = {(1.0 - n * (rb * rb + 2.0 / 3.0 * h * h)) / d,
                                         4.0 * h / (t1 + 3.0 * t0) / d,
                                         -m * (1.0 - n * (rb * rb + 0.25 * h * h)) / d,
                                         (1.0 - n * (rb * rb + 4.0 * h * h)) / d};
        double _Complex f[4];
        matrix_of(&part, at[i], f);
        check_matrix(f, want, 1e-12);
    }
}

static void points_are_as_printed(void **state)
{
    (void)state;
    const strum_taut_component hanging = part_hanging(5.0, 68.45, 15.0);
    const strum_taut_component support = part_support(5000.0, 0.6, 0.25, 0.9);
    const strum_taut_component mass = part_mass(18.0), ground = part_ground(700.0, 30.0);
    for (int i = 0; i < 3; i++) {
        const double _Complex w = at[i], g = 68.45 + I * w * 15.0;
        /* (4-5), (A.26), (A.8); a spring and a damper to ground */
        const double _Complex want[4][4] = {
            {1.0, 0.0, -w * w * 5.0 * g / (g - w * w * 5.0), 1.0},
            {-0.35 / 0.25, 0.0, (0.9 * w * w - 5000.0 * 0.6) / (0.35 * 0.25), -0.25 / 0.35},
            {1.0, 0.0, -18.0 * w * w, 1.0},
            {1.0, 0.0, 700.0 + I * w * 30.0, 1.0}};
        const strum_taut_component *parts[4] = {&hanging, &support, &mass, &ground};
        for (int k = 0; k < 4; k++) {
            double _Complex f[4];
            matrix_of(parts[k], w, f);
            check_matrix(f, want[k], 1e-13);
        }
    }
}

/* y = a J0(u) + b Y0(u), u = 2 w sqrt(rho T)/|T'|, by GSL. */
static void varying_tension_is_bessel(void **state)
{
    (void)state;
    const double pairs[][2] = {{10000, 20000}, {20000, 10000}, {100, 20000}, {20000, 300}};
    const double w[] = {0.003, 0.7, 2.0, 9.5, 60.0};
    for (int p = 0; p < 4; p++)
        for (int i = 0; i < 5; i++) {
            const double t0 = pairs[p][0], t1 = pairs[p][1], rho = 2.0, length = 100.0;
            const double slope = (t1 - t0) / length;
            const double u0 = 2.0 * w[i] * sqrt(rho * t0) / fabs(slope);
            const double u1 = 2.0 * w[i] * sqrt(rho * t1) / fabs(slope);
            /* V = T y' = -(T'/2) u Z1(u); Wronskian J0 Y1 - J1 Y0 = -2/(pi u) */
            const double j0 = gsl_sf_bessel_J0(u0), y0 = gsl_sf_bessel_Y0(u0),
                         dj0 = -0.5 * slope * u0 * gsl_sf_bessel_J1(u0),
                         dy0 = -0.5 * slope * u0 * gsl_sf_bessel_Y1(u0);
            const double j1 = gsl_sf_bessel_J0(u1), y1 = gsl_sf_bessel_Y0(u1),
                         dj1 = -0.5 * slope * u1 * gsl_sf_bessel_J1(u1),
                         dy1 = -0.5 * slope * u1 * gsl_sf_bessel_Y1(u1);
            const double det = j0 * dy0 - dj0 * y0;
            const double want[4] = {(j1 * dy0 - y1 * dj0) / det, (y1 * j0 - j1 * y0) / det,
                                    (dj1 * dy0 - dy1 * dj0) / det, (dy1 * j0 - dj1 * y0) / det};
            const strum_taut_component part = part_varying(t0, t1, rho, length, false);
            double _Complex f[4];
            matrix_of(&part, w[i], f);
            const double scale[4] = {1.0, 1.0 / (w[i] * sqrt(rho * sqrt(t0 * t1))),
                                     w[i] * sqrt(rho * sqrt(t0 * t1)), 1.0};
            for (int k = 0; k < 4; k++) {
                check_absolute(creal(f[k]), want[k], 1e-11 * fmax(scale[k], fabs(want[k])));
                check_absolute(cimag(f[k]), 0.0, 1e-12 * fmax(scale[k], fabs(want[k])));
            }
        }
}

/* Asymmetric bodies, by an independent derivation in 40 digits. */
static void bodies_agree_with_rigid_body_mechanics(void **state)
{
    (void)state;
    const strum_taut_link lump = {0.4, 0.22, 11.5, 11.5 * 0.031};
    const strum_taut_link two[2] = {{0.23, 0.17, 9.0, 0.12}, {0.11, 0.31, 5.0, 0.07}};
    const strum_taut_joint one_joint = {0.03, 0.04, 10.0, 4000.0, 5000.0};
    const strum_taut_link three[3] = {
        {0.21, 0.17, 4.0, 0.06}, {0.15, 0.25, 6.0, 0.1}, {0.13, 0.3, 3.0, 0.05}};
    const strum_taut_joint two_joints[2] = {{0.03, 0.03, 10.0, 4000.0, 5000.0},
                                            {0.05, 0.04, 40.0, 2500.0, 5000.0}};
    const struct {
        strum_taut_component part;
        double _Complex w, want[4];
    } cases[] = {
        {part_body(5200, 4900, &lump, NULL, 1),
         CMPLX(7.3, 0.2),
         {CMPLX(0.9738386654335641, -0.0014188449402324577),
          CMPLX(0.00012039187408086556, -7.217165666966298e-08),
          CMPLX(-602.0699016503044, -32.45266917095757),
          CMPLX(0.9524339371519348, -0.002579718073149923)}},
        {part_body(5200, 4900, &lump, NULL, 1),
         CMPLX(120.0, 3.0),
         {CMPLX(-0.7936451575331798, -0.02246497345136354),
          CMPLX(3.048618246988518e-05, -1.1427142635891352e-06),
          CMPLX(25894.458602266193, 3700.1654084956867),
          CMPLX(-2.2611730136966903, -0.040845406275206435)}},
        {part_body(5000, 5000, two, &one_joint, 2),
         CMPLX(41.0, 0.0),
         {CMPLX(-0.5612716860866881, 0.08355106640103444),
          CMPLX(6.99946476681057e-05, 8.278205994951593e-06),
          CMPLX(-13340.45205776854, 800.7194314554858),
          CMPLX(-0.11801728133673321, 0.0793349586459254)}},
        {part_body(5000, 5000, two, &one_joint, 2),
         CMPLX(120.0, 3.0),
         {CMPLX(-0.6054059615606924, -1.1272533297446825),
          CMPLX(-3.0785407009992066e-05, 6.483928846611592e-05),
          CMPLX(13931.608118173102, 2085.1343249897654),
          CMPLX(-0.738942222205184, -0.010156438202579823)}},
        {part_body(5000, 5000, three, two_joints, 3),
         CMPLX(41.0, 0.0),
         {CMPLX(-0.8852776417571028, 0.04368717600378867),
          CMPLX(6.148082763464886e-05, 6.363909818631958e-06),
          CMPLX(-9519.480426226015, 147.30747870324188),
          CMPLX(-0.46915025779469455, 0.03504965888351168)}},
        {part_body(5000, 5000, three, two_joints, 3),
         CMPLX(120.0, 3.0),
         {CMPLX(0.972459085863669, -0.47944622717577295),
          CMPLX(-7.905368030891148e-05, -5.9385085425376084e-05),
          CMPLX(14255.746306678082, 4132.9949735404325),
          CMPLX(0.5765358149482103, -0.9222899629509745)}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double _Complex f[4];
        matrix_of(&cases[i].part, cases[i].w, f);
        check_matrix(f, cases[i].want, 1e-12);
    }
}

/* ---- what holds for any component ---- */

static strum_taut_component random_part(uint64_t *seed, int kind, strum_taut_link *links,
                                        strum_taut_joint *joints)
{
    const double t0 = draw_log(seed, 1e3, 1e4), t1 = t0 * draw(seed, 0.7, 1.4);
    const size_t count = (size_t)draw(seed, 1.0, 6.0);
    for (size_t i = 0; i < count; i++) {
        links[i] = (strum_taut_link){draw(seed, 0.05, 0.4), draw(seed, 0.05, 0.4),
                                     draw_log(seed, 0.1, 20.0), draw_log(seed, 1e-3, 1.0)};
        joints[i] = (strum_taut_joint){0.03, 0.04, draw_log(seed, 1.0, 1e7),
                                       draw_log(seed, 1.0, 1e6), t0 * draw(seed, 0.8, 1.2)};
    }
    switch (kind) {
    case 0:
        return part_cable(t0, draw(seed, 0.1, 3.0), draw(seed, 1.0, 30.0),
                          draw(seed, 0.0, 2.0));
    case 1:
        return part_varying(t0, t1, draw(seed, 0.1, 3.0), draw(seed, 1.0, 30.0), true);
    case 2:
        return part_varying(t0, t1, draw(seed, 0.1, 3.0), draw(seed, 1.0, 30.0), false);
    case 3:
        return part_hanging(draw(seed, 0.1, 20.0), draw_log(seed, 1.0, 1e4),
                            draw_log(seed, 0.1, 1e3));
    case 4:
        return part_support(t0, 1.0, draw(seed, 0.1, 0.9), draw(seed, 0.01, 3.0));
    default:
        return part_body(t0, t1, links, joints, count);
    }
}

/* The same component seen from its other end. */
static strum_taut_component turned(strum_taut_component part, strum_taut_link *links,
                                   strum_taut_joint *joints)
{
    const double kept = part.tension_left;
    part.tension_left = part.tension_right;
    part.tension_right = kept;
    if (part.kind == STRUM_TAUT_SUPPORT)
        part.support.pivot = part.support.length - part.support.pivot;
    if (part.kind != STRUM_TAUT_BODY)
        return part;
    const size_t n = part.body.count;
    for (size_t i = 0; i < n; i++) {
        const strum_taut_link *l = &part.body.links[n - 1 - i];
        links[i] = (strum_taut_link){l->right, l->left, l->mass, l->inertia};
        if (i + 1 < n)
            joints[i] = part.body.joints[n - 2 - i];
    }
    part.body.links = links;
    part.body.joints = joints;
    return part;
}

static void every_component_is_reciprocal_and_can_be_turned(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int n = 0; n < 600; n++) {
        strum_taut_link links[2][16];
        strum_taut_joint joints[2][16];
        const strum_taut_component part = random_part(&seed, n % 6, links[0], joints[0]);
        const strum_taut_component back = turned(part, links[1], joints[1]);
        const double _Complex w = CMPLX(draw_log(&seed, 0.1, 200.0), draw(&seed, 0.0, 3.0));
        double _Complex f[4], b[4];
        matrix_of(&part, w, f);
        matrix_of(&back, w, b);
        const double size = cabs(f[0] * f[3]) + cabs(f[1] * f[2]) + 1.0;
        check_absolute(cabs(f[0] * f[3] - f[1] * f[2] - 1.0), 0.0, 1e-12 * size);
        const double _Complex want[4] = {f[3], f[1], f[2], f[0]};
        for (int k = 0; k < 4; k++) { /* small entries are differences of larger ones */
            const double scale = k == 1   ? cabs(f[1])
                                 : k == 2 ? cabs(f[2])
                                          : cabs(f[0]) + cabs(f[3]);
            check_absolute(cabs(b[k] - want[k]), 0.0, 1e-10 * scale);
        }
    }
}

static void pieces_make_the_whole(void **state)
{
    (void)state;
    for (int wkb = 0; wkb < 2; wkb++)
        for (int i = 0; i < 3; i++) {
            const strum_taut_component whole = part_varying(3000, 9000, 0.8, 30.0, wkb);
            const strum_taut_component pieces[3] = {part_varying(3000, 4000, 0.8, 5.0, wkb),
                                                    part_varying(4000, 6500, 0.8, 12.5, wkb),
                                                    part_varying(6500, 9000, 0.8, 12.5, wkb)};
            double _Complex want[4], f[4];
            matrix_of(&whole, at[i], want);
            strum_taut *chain = fixed_chain(pieces, 3);
            assert_int_equal(strum_taut_matrix(chain, creal(at[i]), cimag(at[i]), f, NULL),
                             STRUM_OK);
            strum_taut_free(chain);
            check_matrix(f, want, 1e-11);
        }
}

/* Right = F_n ... F_1 left: not Levesque's order, which is another system where parts are not
 * symmetric. */
static void a_chain_multiplies_from_the_right(void **state)
{
    (void)state;
    const strum_taut_link lump = {0.4, 0.22, 11.5, 0.3565};
    const strum_taut_component parts[2] = {part_cable(5200, 1.0, 3.0, 0.0),
                                           part_body(5200, 4900, &lump, NULL, 1)};
    const double w = 31.0;
    double _Complex a[4], b[4], f[4];
    matrix_of(&parts[0], w, a);
    matrix_of(&parts[1], w, b);
    const double _Complex want[4] = {b[0] * a[0] + b[1] * a[2], b[0] * a[1] + b[1] * a[3],
                                     b[2] * a[0] + b[3] * a[2], b[2] * a[1] + b[3] * a[3]};
    strum_taut *chain = fixed_chain(parts, 2);
    assert_int_equal(strum_taut_matrix(chain, w, 0.0, f, NULL), STRUM_OK);
    strum_taut_free(chain);
    check_matrix(f, want, 1e-13);
    assert_true(cabs(a[0] * b[1] + a[1] * b[3] - f[1]) > 1e-3 * cabs(f[1]));
}

/* ---- limits ---- */

/* Energy goes to and fro alike: t11 t22 - t12 t21 = 1 of any chain, damped or not. */
static void every_chain_is_reciprocal(void **state)
{
    (void)state;
    uint64_t seed = 7;
    for (int n = 0; n < 200; n++) {
        strum_taut_link links[2];
        strum_taut_joint joint;
        levesque_absorber(draw_log(&seed, 0.1, 50.0), draw_log(&seed, 0.01, 1.0),
                          draw_log(&seed, 1.0, 1e4), links, &joint);
        const strum_taut_component parts[6] = {
            part_cable(LEVESQUE_TENSION, draw_log(&seed, 0.1, 10.0), 3.0,
                       draw(&seed, 0.0, 5.0)),
            part_body(LEVESQUE_TENSION, LEVESQUE_TENSION, links, &joint, 2),
            part_varying(LEVESQUE_TENSION, 6000.0, draw_log(&seed, 0.1, 10.0), 4.0, n & 1),
            part_support(6000.0, 0.5, 0.2, draw_log(&seed, 0.01, 1.0)),
            part_hanging(draw_log(&seed, 0.1, 50.0), 2000.0, draw_log(&seed, 1.0, 1e3)),
            part_ground(draw_log(&seed, 1.0, 1e4), draw_log(&seed, 1.0, 1e3))};
        strum_taut *chain = fixed_chain(parts, 6);
        double _Complex f[4];
        assert_int_equal(strum_taut_matrix(chain, draw_log(&seed, 1.0, 100.0),
                                           draw(&seed, -3.0, 3.0), f, NULL),
                         STRUM_OK);
        const double size = cabs(f[0] * f[3]) + cabs(f[1] * f[2]);
        assert_true(cabs(f[0] * f[3] - f[1] * f[2] - 1.0) < 1e-13 * (1.0 + size));
        strum_taut_free(chain);
    }
}

static void limits_are_reached(void **state)
{
    (void)state;
    strum_taut_link links[2], point = {0.0, 0.0, 18.0, 0.0}, massless = {0.4, 0.4, 0.0, 0.0};
    strum_taut_joint joint;
    for (int i = 0; i < 3; i++) {
        const double _Complex w = at[i];
        double _Complex f[4], g[4];
        strum_taut_component part, other;
        /* R -> infinity: two links are one bar; and 1e17 N s/m is as good as infinity */
        levesque_absorber(9.0, 0.12, INFINITY, links, &joint);
        part = part_body(5000, 5000, links, &joint, 2);
        const strum_taut_link bar = {0.4, 0.4, 18.0, 2.0 * 0.12 + 18.0 * 0.2 * 0.2};
        other = part_body(5000, 5000, &bar, NULL, 1);
        matrix_of(&part, w, f);
        matrix_of(&other, w, g);
        check_matrix(f, g, 1e-13);
        joint.damping = 1e17;
        matrix_of(&part, w, f);
        check_matrix(f, g, 1e-12);
        /* K = R = 0: two hinged bars in a chain */
        levesque_absorber(9.0, 0.12, 0.0, links, &joint);
        joint.stiffness = 0.0;
        matrix_of(&part, w, f);
        const strum_taut_component hinged[2] = {part_body(5000, 5000, &links[0], NULL, 1),
                                                part_body(5000, 5000, &links[1], NULL, 1)};
        strum_taut *chain = fixed_chain(hinged, 2);
        assert_int_equal(strum_taut_matrix(chain, creal(w), cimag(w), g, NULL), STRUM_OK);
        strum_taut_free(chain);
        check_matrix(f, g, 1e-12);
        /* without mass: a piece of cable without mass, L_c/T */
        const double _Complex straight[4] = {1.0, 0.8 / 5000.0, 0.0, 1.0};
        part = part_body(5000, 5000, &massless, NULL, 1);
        matrix_of(&part, w, f);
        check_matrix(f, straight, 1e-15);
        part = part_cable(5000, 0.0, 0.8, 0.0);
        matrix_of(&part, w, f);
        check_matrix(f, straight, 1e-15);
        /* size -> 0, and R -> infinity of a hanging absorber: a point mass */
        const double _Complex mass[4] = {1.0, 0.0, -18.0 * w * w, 1.0};
        part = part_body(5000, 5000, &point, NULL, 1);
        matrix_of(&part, w, f);
        check_matrix(f, mass, 1e-15);
        part = part_hanging(18.0, 70.0, INFINITY);
        matrix_of(&part, w, f);
        check_matrix(f, mass, 1e-15);
        const strum_taut_link tiny = strum_taut_sphere(1e-9, 18.0);
        part = part_body(5000, 5000, &tiny, NULL, 1);
        matrix_of(&part, w, f);
        check_absolute(cabs(f[2] - mass[2]), 0.0, 1e-6 * cabs(mass[2]));
        /* one tension: a uniform cable; almost one: almost that */
        part = part_cable(5000, 1.0, 25.0, 0.0);
        matrix_of(&part, w, g);
        other = part_varying(5000, 5000, 1.0, 25.0, false);
        matrix_of(&other, w, f);
        check_matrix(f, g, 1e-14);
        other = part_varying(5000, 5000 * (1.0 + 1e-12), 1.0, 25.0, false);
        matrix_of(&other, w, f);
        check_matrix(f, g, 1e-9);
    }
}

static void faults_are_told(void **state)
{
    (void)state;
    strum_error fault;
    double _Complex f[4];
    strum_taut *chain = NULL;
    /* the absorber's own resonance with its point held is a pole */
    const strum_taut_component pole = part_hanging(4.0, 64.0, 0.0);
    chain = fixed_chain(&pole, 1);
    assert_int_equal(strum_taut_matrix(chain, 4.0, 0.0, f, &fault), STRUM_ERR_IMPOSSIBLE);
    assert_non_null(strstr(fault.reason, "component 1"));
    strum_taut_free(chain);
    const strum_taut_component far = part_cable(100.0, 1.0, 1e4, 0.0);
    chain = fixed_chain(&far, 1);
    assert_int_equal(strum_taut_matrix(chain, 1.0, 100.0, f, &fault), STRUM_ERR_RANGE);
    assert_int_equal(strum_taut_component_matrix(chain, 1, 1.0, 0.0, f, &fault),
                     STRUM_ERR_RANGE);
    strum_taut_free(chain);
    const strum_taut_link bad = {-0.1, 0.2, 1.0, 0.0};
    const strum_taut_component wrong[] = {
        part_cable(0.0, 1.0, 1.0, 0.0),     part_cable(1.0, -1.0, 1.0, 0.0),
        part_cable(1.0, 1.0, NAN, 0.0),     part_varying(1.0, -1.0, 1.0, 1.0, false),
        part_body(1.0, 1.0, &bad, NULL, 1), part_hanging(1.0, 1.0, -1.0),
        part_ground(1.0, INFINITY),         part_support(1.0, 1.0, 1.0, 0.0)};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        const strum_taut_component two[2] = {part_mass(1.0), wrong[i]};
        assert_int_equal(
            strum_taut_make(two, 2, STRUM_TAUT_FIXED, STRUM_TAUT_FIXED, &chain, &fault),
            STRUM_ERR_RANGE);
        assert_non_null(strstr(fault.reason, "component 2"));
        assert_null(chain);
    }
    assert_int_equal(strum_taut_make(NULL, 0, STRUM_TAUT_FIXED, STRUM_TAUT_FIXED, &chain, NULL),
                     STRUM_ERR_RANGE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cable_is_a3),
        cmocka_unit_test(wkb_is_a2),
        cmocka_unit_test(bar_and_sphere_are_a5_and_a6),
        cmocka_unit_test(cone_is_a7),
        cmocka_unit_test(points_are_as_printed),
        cmocka_unit_test(varying_tension_is_bessel),
        cmocka_unit_test(bodies_agree_with_rigid_body_mechanics),
        cmocka_unit_test(every_component_is_reciprocal_and_can_be_turned),
        cmocka_unit_test(pieces_make_the_whole),
        cmocka_unit_test(a_chain_multiplies_from_the_right),
        cmocka_unit_test(every_chain_is_reciprocal),
        cmocka_unit_test(limits_are_reached),
        cmocka_unit_test(faults_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
