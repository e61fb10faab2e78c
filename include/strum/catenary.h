/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Suspended cables: equilibrium geometry, natural frequencies and modes.
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
 * Ownership: structs are the caller's; a strum_spectrum is made by strum_modes_solve and ended
 * by strum_spectrum_free. All functions are re-entrant; an object may be read by many threads
 * at once.
 */
#ifndef STRUM_CATENARY_H
#define STRUM_CATENARY_H

#include <strum/types.h>

STRUM_BEGIN_DECLS

/* ---- geometry ---- */

/* Largest |chi| of an end: |xi| about 1.3e5. Towards it the weights of the integrals span so
 * many orders that rounding grows, to some 3e-13 in the frequencies. */
#define STRUM_CHI_MAX 12.5
/* Largest number of modes of one call. */
#define STRUM_MODES_MAX 200

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
                                     strum_catenary *catenary, strum_error *fault);
/* xi of both ends, xi_1 < xi_2  [Gale 2.33]. */
strum_status strum_catenary_from_xi(double xi_1, double xi_2, strum_catenary *catenary,
                                    strum_error *fault);
/* chi = x/a of both ends, chi_1 < chi_2. */
strum_status strum_catenary_from_chi(double chi_1, double chi_2, strum_catenary *catenary,
                                     strum_error *fault);
/* Span > 0, rise (any sign) and cable length > chord, in one unit of length. */
strum_status strum_catenary_from_length(double span, double rise, double length,
                                        strum_catenary *catenary, strum_error *fault);
/* Exact elastic catenary: span > 0, rise, unstretched length in one unit of length, and
 * weight_strain = (weight per unstretched length) (unstretched length) / EA > 0. The chord may
 * exceed the length. */
strum_status strum_catenary_from_unstretched(double span, double rise,
                                             double unstretched_length, double weight_strain,
                                             strum_catenary *catenary, strum_error *fault);

/* Angle of the chord (radians, within +-pi/2), epsilon = (weight)/(tension where the cable is
 * parallel to its chord) > 0, weight_strain as above, 0 for an inextensible profile. */
strum_status strum_catenary_from_chord(double epsilon, double inclination, double weight_strain,
                                       strum_catenary *catenary, strum_error *fault);

/* xi = sgn(chi)(cosh chi - 1) and its inverse, without cancellation. */
double strum_xi_of_chi(double chi);
double strum_chi_of_xi(double xi);
/* Length (unstretched) from end 1 to where the cable is parallel to its chord, in a. */
double strum_catenary_parallel(const strum_catenary *catenary);
/* Largest vertical distance between chord and cable, in a. */
double strum_catenary_sag(const strum_catenary *catenary);
/* Position (in a) from end 1 of the point with slope parameter chi. */
void strum_catenary_point(const strum_catenary *catenary, double chi, double *x, double *y);

/* ---- modes ---- */

typedef struct strum_cable {
    double chi_m, mu;        /* of the profile */
    double kappa_t, kappa_n; /* tangential and normal flexibility, >= 0 */
    double mass_t,
        mass_n;          /* mass per length felt tangentially and normally (added mass), > 0 */
    double eta_t, eta_n; /* viscous damping per length, >= 0 (Gale's eta_1, eta_2) */
} strum_cable;

typedef struct strum_mode {
    double frequency; /* Im s > 0; the natural frequency where undamped */
    double decay;     /* -Re s; 0 where undamped */
    strum_symmetry symmetry;
} strum_mode;

/* A point of a mode shape; imaginary parts are 0 where undamped. The largest value of the
 * dominant displacement component (the one with the largest magnitude anywhere on the cable) is
 * +1. */
typedef struct strum_shape_point {
    double chi;
    strum_complex tangential, normal; /* in plane; `normal` is the displacement out of plane */
    strum_complex tension;            /* dynamic tension in S0 per unit displacement in a */
} strum_shape_point;

typedef struct strum_spectrum strum_spectrum;

/* The first `count` (1..STRUM_MODES_MAX) modes that oscillate, by frequency, and every
 * overdamped root. In plane: complementary (force) Galerkin method, but for frequencies alone
 * of an inextensible cable of moderate depth the displacement form, which is half as large; out
 * of plane: displacement Galerkin method. Natural frequencies agree between two sizes to 1e-12
 * (damped: 1e-10) or STRUM_ERR_ACCURACY is returned. `shapes` keeps what strum_spectrum_shape
 * needs. */
strum_status strum_modes_solve(const strum_cable *cable, strum_plane plane, int count,
                               bool shapes, strum_spectrum **spectrum, strum_error *fault);
/* Estimated time of strum_modes_solve in microseconds on a present-day core, without solving
 * anything. */
double strum_modes_work(const strum_cable *cable, strum_plane plane, int count, bool shapes);
void strum_spectrum_free(strum_spectrum **spectrum);

int strum_spectrum_count(const strum_spectrum *spectrum);
/* Mode `index` in 0..count-1; owned by the spectrum. */
const strum_mode *strum_spectrum_mode(const strum_spectrum *spectrum, int index);
/* Overdamped roots s < 0: their decay rates -s, ascending; owned by the spectrum. */
int strum_spectrum_overdamped(const strum_spectrum *spectrum, const double **decays);
/* Largest relative difference between the two sizes, over all modes. */
double strum_spectrum_difference(const strum_spectrum *spectrum);
/* Size of the discretisation that gave the answer (unknowns a component). */
int strum_spectrum_size(const strum_spectrum *spectrum);

/* The shape of mode `index` at `points` values of chi: those handed in (within the ends), or,
 * where `chi` is NULL, points >= 2 equally spaced ones, ends included. STRUM_ERR_METHOD when
 * the spectrum was solved without shapes. */
strum_status strum_spectrum_shape(const strum_spectrum *spectrum, int index, const double *chi,
                                  int points, strum_shape_point *shape);

/* A second, independent method: in plane the displacement Galerkin
 * method (Gale's equation 2.35 in weak form; with elasticity its Hellinger-Reissner form, which
 * does not lock), out of plane the force form. The spectrum must have been solved with shapes
 * (STRUM_ERR_METHOD otherwise). Residuals are those of the eigenpairs in the second method\'s
 * pencil. */
strum_status strum_modes_verify(const strum_spectrum *spectrum,
                                strum_verification *verification, strum_error *fault);

/* How many in-plane natural frequencies of the undamped cable lie below `frequency`: an exact
 * count by integration along the cable, independent of every Galerkin method. */
strum_status strum_modes_count(const strum_cable *cable, double frequency, int *count,
                               strum_error *fault);

/* Rayleigh's estimate of the first out-of-plane frequency of a level cable  [Gale, Appendix
 * B-5]. */
strum_status strum_rayleigh_out_of_plane(const strum_catenary *catenary, double *frequency,
                                         strum_error *fault);

STRUM_END_DECLS
#endif
