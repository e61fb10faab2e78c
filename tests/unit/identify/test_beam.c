/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tensioned beam between springs and its sag term: closed forms, derivatives by differences. */
#include "check.h"
#include "core/identify/sag.h"

static void pinned_beams_have_closed_forms(void **state)
{
    (void)state;
    for (int n = 1; n <= 1000; n += 37)
        for (double u = 1e-6; u < 100; u *= 7) {
            const beam_end ends[2] = {beam_end_by_fixity(0, u), beam_end_by_fixity(0, u)};
            const double b = n * M_PI;
            check_relative(beam_solve(n, u, ends).om, b * sqrt(1 + u * u * b * b), 1e-15);
        }
}

/* Without tension: zeros of cos b cosh b = 1, and of tan b = tanh b with one end pinned (40 digits). */
static void beams_without_tension(void **state)
{
    (void)state;
    const double clamped[3] = {4.730040744862704026, 7.853204624095837557,
                               10.995607838001670907};
    const double propped[3] = {3.926602312047918778, 7.068582745628732089,
                               10.210176122813030692};
    const double u = 1e9;
    const beam_end ends[2] = {beam_end_by_fixity(1, u), beam_end_by_fixity(1, u)};
    const beam_end one[2] = {beam_end_by_fixity(1, u), beam_end_by_fixity(0, u)};
    for (int i = 0; i < 3; i++) {
        check_relative(beam_solve(i + 1, u, ends).b, clamped[i], 4e-16);
        check_relative(beam_solve(i + 1, u, one).b, propped[i], 4e-16);
    }
}

/* A thin layer shortens the cable by sqrt(EI/T) at a clamped end: an error of order u^2. */
static void thin_layers_shorten_the_cable(void **state)
{
    (void)state;
    for (double u = 1e-3; u > 1e-8; u /= 10) {
        const beam_end ends[2] = {beam_end_by_fixity(1, u), beam_end_by_fixity(1, u)};
        const double length = 1 - 2 * u, ideal = M_PI / length * sqrt(1 + u * u * M_PI * M_PI);
        check_relative(beam_solve(1, u, ends).om, ideal, 20 * u * u * u + 1e-15);
    }
}

/* tan(b/2) = b/2 - 4/lambda^2 (b/2)^3 (Irvine and Caughey 1974), and the modes that stay. */
static void a_string_with_sag_follows_irvine(void **state)
{
    (void)state;
    const beam_end ends[2] = {{0, 1, 0, 0}, {0, 1, 0, 0}};
    for (double lambda2 = 0.1; lambda2 < 400; lambda2 *= 2.3) {
        int still = 0;
        double before = 0;
        for (int n = 1; n <= 8; n++) {
            const double b = sag_solve(n, 0, ends, lambda2).om, half = b / 2;
            assert_true(b > before);
            before = b;
            if (fabs(b / (2 * M_PI) - round(b / (2 * M_PI))) < 1e-14)
                still++;
            else
                check_absolute(sin(half) -
                                   (half - 4 / lambda2 * half * half * half) * cos(half),
                               0, 1e-12 * (1 + 4 / lambda2 * half * half * half));
        }
        assert_int_equal(still, 4);
    }
}

/* Shares add up to 1, and are derivatives. */
static void check_shares(int n, double u, double rho_1, double rho_2, double lambda2)
{
    const beam_end ends[2] = {beam_end_by_fixity(rho_1, u), beam_end_by_fixity(rho_2, u)};
    const beam_mode m = lambda2 > 0 ? sag_solve(n, u, ends, lambda2) : beam_solve(n, u, ends);
    check_absolute(m.tension + m.bending + m.ends[0] + m.ends[1] + m.sag, 1, 1e-12);
    const double h = 1e-4;
    double at[2][2];
    for (int side = 0; side < 2; side++) {
        const double x = side ? h : -h;
        /* EI (1 + x): u by its root, kappa against it */
        const double more = u * sqrt(1 + x);
        beam_end bent[2], fixed[2] = {beam_end_by_fixity(rho_1 + x, u), ends[1]};
        for (int i = 0; i < 2; i++)
            bent[i] = beam_end_by_stiffness(ends[i].a / ends[i].b / (1 + x));
        at[side][0] =
            lambda2 > 0 ? sag_solve(n, more, bent, lambda2).om : beam_solve(n, more, bent).om;
        at[side][1] =
            lambda2 > 0 ? sag_solve(n, u, fixed, lambda2).om : beam_solve(n, u, fixed).om;
    }
    check_absolute(m.bending, 2 * log(at[1][0] / at[0][0]) / log((1 + h) / (1 - h)), 1e-7);
    check_absolute(m.by_rho[0], log(at[1][1] / at[0][1]) / h, 1e-6);
}

static void shares_are_derivatives(void **state)
{
    (void)state;
    const double us[] = {0.4, 0.05, 0.004, 1e-4};
    for (int i = 0; i < 4; i++)
        for (int n = 1; n <= 5; n++) {
            check_shares(n, us[i], 0.3, 0.7, 0);
            check_shares(n, us[i], 0.5, 0.5, 0);
            check_shares(n, us[i], 0.2, 0.9, 6);
            check_shares(n, us[i], 0.2, 0.9, 70);
            check_shares(n, us[i], 0.6, 0.6, 20);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pinned_beams_have_closed_forms),
        cmocka_unit_test(beams_without_tension),
        cmocka_unit_test(thin_layers_shorten_the_cable),
        cmocka_unit_test(a_string_with_sag_follows_irvine),
        cmocka_unit_test(shares_are_derivatives),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
