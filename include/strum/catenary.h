/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Suspended cables: equilibrium geometry, and the cable whose motion modes.h and forced.h solve.
 *
 * Units. Everything here is dimensionless: lengths in a = H/w (horizontal tension over weight
 * per length), forces in S0 = H, masses per length in m, times in sqrt(m a^2/H), which is
 * sqrt(a/g) where w = m g. The slope parameter chi (tan alpha = sinh chi; chi = x/a for an
 * inextensible profile) is the coordinate: the tension is S = cosh chi, and nothing special
 * happens at the lowest point (J. G. Gale, Vibrations of Suspended Cables, 1976, uses xi =
 * sgn(chi)(cosh chi - 1) and must treat xi = 0 apart).
 *
 * Linear dynamics, F = Cartesian dynamic force, X = displacement, ' = d/d sigma with sigma =
 * sinh chi (arc length; unstretched where the profile is elastic), t and n the unit tangent and
 * normal:
 *     F' = [ tt' (m_t s^2 + eta_t s) + nn' (m_n s^2 + eta_n s) ] X
 *     X' = [ tt' kappa_t + nn' (1/S + kappa_n) ] F
 *     X = 0 at both ends,  motion ~ e^{s t}.
 * Gale's equations (2.29, 2.35, 2.38) are kappa_n = 0, m_t = m_n = 1; kappa_n = kappa_t
 * linearises about the exact elastic catenary (Grinfogel's equations with N (1/T0 + 1/EA)).
 *
 * Ownership: structs are the caller's. All functions are re-entrant.
 *
 *     strum_catenary c;
 *     strum_error error;
 *     if (strum_catenary_from_length(100, 0, 110, &c, &error) == STRUM_OK)
 *         printf("sag %g m\n", strum_catenary_sag(&c) * 100 / c.span);
 */
#ifndef STRUM_CATENARY_H
#define STRUM_CATENARY_H

#include <strum/types.h>

STRUM_BEGIN_DECLS

/* strum_error.argument of the functions here: the parameter at fault. */
typedef enum strum_catenary_argument {
    STRUM_CATENARY_ARG_RISE = 1, /* also where it alone makes a cable too steep */
    STRUM_CATENARY_ARG_SAG_PARAMETER,
    STRUM_CATENARY_ARG_XI,  /* xi_1 and xi_2 */
    STRUM_CATENARY_ARG_CHI, /* chi_1 and chi_2 */
    STRUM_CATENARY_ARG_SPAN,
    STRUM_CATENARY_ARG_LENGTH, /* also unstretched: where no such cable hangs, or it is too taut,
                                  too deep or too steep */
    STRUM_CATENARY_ARG_WEIGHT_STRAIN,
    STRUM_CATENARY_ARG_EPSILON, /* also where the profile that follows is too steep */
    STRUM_CATENARY_ARG_INCLINATION
} strum_catenary_argument;

/* ---- geometry ---- */

/* Largest |chi| of an end: |xi| about 1.3e5. Towards it the weights of the integrals span so
 * many orders that rounding grows, to some 3e-13 in the frequencies. */
#define STRUM_CHI_MAX 12.5

/* The equilibrium profile between two supports. End 2 is the right end. */
typedef struct strum_catenary {
    double chi_m; /* middle of the slope parameter, (chi_1 + chi_2)/2 */
    double mu; /* half its width, (chi_2 - chi_1)/2 > 0; kept apart: the difference cancels when
                  taut */
    double span;               /* b/a, horizontal distance of the supports */
    double rise;               /* h/a, height of end 2 above end 1 */
    double length;             /* l/a, length of the hanging (stretched) cable */
    double unstretched_length; /* in a; equals length for an inextensible profile */
    double kappa;              /* H/EA of an elastic profile; 0 for an inextensible one */
} strum_catenary;

/* h/b and the sag parameter p = b/sqrt(l^2 - h^2) in (0, 1)  [Gale 2.10, A-1]. */
strum_status strum_catenary_from_sag(double rise_to_span, double sag_parameter,
                                     strum_catenary *catenary, strum_error *error);
/* xi of both ends, xi_1 < xi_2  [Gale 2.33]. */
strum_status strum_catenary_from_xi(double xi_1, double xi_2, strum_catenary *catenary,
                                    strum_error *error);
/* chi = x/a of both ends, chi_1 < chi_2. */
strum_status strum_catenary_from_chi(double chi_1, double chi_2, strum_catenary *catenary,
                                     strum_error *error);
/* Span > 0, rise (any sign) and cable length > chord, in one unit of length. */
strum_status strum_catenary_from_length(double span, double rise, double length,
                                        strum_catenary *catenary, strum_error *error);
/* Exact elastic catenary: span > 0, rise, unstretched length in one unit of length, and
 * weight_strain = (weight per unstretched length) (unstretched length) / EA > 0. The chord may
 * exceed the length. */
strum_status strum_catenary_from_unstretched(double span, double rise,
                                             double unstretched_length, double weight_strain,
                                             strum_catenary *catenary, strum_error *error);

/* Angle of the chord (radians, within +-pi/2), epsilon = (weight)/(tension where the cable is
 * parallel to its chord) > 0, weight_strain as above, 0 for an inextensible profile. */
strum_status strum_catenary_from_chord(double epsilon, double inclination, double weight_strain,
                                       strum_catenary *catenary, strum_error *error);

/* xi = sgn(chi)(cosh chi - 1) and its inverse, without cancellation. */
double strum_xi_of_chi(double chi);
double strum_chi_of_xi(double xi);
/* Length (unstretched) from end 1 to where the cable is parallel to its chord, in a. */
double strum_catenary_parallel(const strum_catenary *catenary);
/* Length (in a) that an inextensible profile's cable has without load if its flexibility is kappa
 * = H/EA >= 0: INT d sigma/(1 + kappa S). Weight and tension are those of the profile, per
 * stretched length. */
double strum_catenary_unstretched(const strum_catenary *catenary, double kappa);
/* Largest vertical distance between chord and cable, in a. */
double strum_catenary_sag(const strum_catenary *catenary);
/* Position (in a) from end 1 of the point with slope parameter chi. */
void strum_catenary_point(const strum_catenary *catenary, double chi, double *x, double *y);

/* ---- what moves ---- */

typedef struct strum_cable {
    double chi_m, mu;        /* of the profile */
    double kappa_t, kappa_n; /* tangential and normal flexibility, >= 0 */
    double mass_t,
        mass_n;          /* mass per length felt tangentially and normally (added mass), > 0 */
    double eta_t, eta_n; /* viscous damping per length, >= 0 (Gale's eta_1, eta_2) */
} strum_cable;

/* Rayleigh's estimate of the first out-of-plane frequency of a level cable  [Gale, Appendix
 * B-5]. */
strum_status strum_rayleigh_out_of_plane(const strum_catenary *catenary, double *frequency,
                                         strum_error *error);

STRUM_END_DECLS
#endif
