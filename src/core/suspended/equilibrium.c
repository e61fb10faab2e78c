/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Equilibrium of a suspended cable, inextensible or elastic, from every form of input.
 *
 * With the slope parameter chi (tan alpha = sinh chi), its middle chi_m and half width mu, and
 * e = weight strain w0 L0/EA (0: inextensible), in units of a = H/w:
 *     L0   = 2 cosh(chi_m) sinh(mu)
 *     span = 2 mu + e
 *     rise = L0 tanh(chi_m) (1 + (e/2) coth mu)
 * since, with kappa = H/EA = e/L0,
 *     x = chi + kappa sinh chi
 *     y = cosh chi + kappa sinh^2(chi)/2.
 * Eliminating chi_m leaves one equation for mu, whose left side falls from +inf to 0 (elastic)
 * or from 1 to 0:
 *     (mu + e/2)/sinh mu * sqrt(1 - (rise/L0)^2/(1 + (e/2) coth mu)^2) = span/L0.
 */
#include <strum/catenary.h>

#include <float.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>
#include <math.h>
#include <stddef.h>

#include "core/numerics/gauss.h"
#include "core/numerics/status.h"

/*
 * Who types 0.99999 means that decimal, not the double beside it, which is 5e-12 off in 1 - p:
 * enough to show in the frequencies of a taut cable. So where inputs are subtracted, a double
 * stands for the shortest decimal that reads back to it.
 */
__extension__ typedef __float128 quad; /* so named for clang too */

static quad decimal(double value)
{
    if (value == trunc(value) && fabs(value) < 1e15)
        return value; /* whole: it is its own decimal */
    char digits[40];
    int precision = 14;
    do
        (void)snprintf(digits, sizeof digits, "%.*e", precision, fabs(value));
    while (strtod(digits, NULL) != fabs(value) && ++precision <= 16);
    quad mantissa = 0;
    int exponent = 0;
    for (const char *c = digits; *c != '\0'; c++)
        if (*c >= '0' && *c <= '9')
            mantissa = mantissa * 10 + (*c - '0');
        else if (*c == 'e') {
            exponent = atoi(c + 1);
            break;
        }
    exponent -= precision;
    quad power = 1;
    for (int i = 0; i < abs(exponent); i++)
        power *= 10;
    const quad magnitude = exponent < 0 ? mantissa / power : mantissa * power;
    return value < 0 ? -magnitude : magnitude;
}

/* sinh(mu)/mu - 1 without cancellation. */
static double sinhc_less_one(double mu)
{
    if (mu > 0.5)
        return sinh(mu) / mu - 1;
    const double s = mu * mu;
    double term = 1, sum = 0;
    for (int k = 1; k < 12; k++) {
        term *= s / (2 * k * (2 * k + 1));
        sum += term;
    }
    return sum;
}

/* mu coth(mu) - 1 = (mu cosh(mu) - sinh(mu))/sinh(mu) without cancellation. */
static double cothm_less_one(double mu)
{
    if (mu > 0.5)
        return mu / tanh(mu) - 1;
    const double s = mu * mu;
    double term = 1, sum = 0; /* mu cosh mu - sinh mu = sum 2k mu^{2k+1}/(2k+1)! */
    for (int k = 1; k < 12; k++) {
        term *= s / (2 * k * (2 * k + 1));
        sum += 2 * k * term;
    }
    return sum / (1 + sinhc_less_one(mu));
}

/* Everything in units of the span: D = 1 + rise^2 - L0^2 is handed over, because only its maker
 * can form it without cancellation. */
typedef struct taut_equation {
    double excess; /* D */
    double rise, length, weight_strain;
} taut_equation;

/* The equation above, squared and cleared of its leading ones, in logarithms: a function of
 * log(mu) that rises through 0 at the solution and keeps its digits as the cable gets taut or
 * deep. */
static double equilibrium(double log_mu, void *data)
{
    const taut_equation *t = data;
    const double mu = exp(log_mu);
    const double r = 0.5 * t->weight_strain / mu;
    const double c = r * cothm_less_one(mu);
    /* q^2 - 1 with q = (1 + r)/(1 + r + c) */
    const double q = -c / (1 + r + c), q2 = q * (2 + q);
    const double right =
        -t->excess - t->rise * t->rise * q2 + t->length * t->length * r * (2 + r);
    if (right <= -1)
        return 1e3; /* the rise cannot be reached: mu is too large */
    const double left = mu > 300 ? mu - log(2 * mu) : log1p(sinhc_less_one(mu));
    return left - 0.5 * log1p(right);
}

/* Lays an error at a parameter; returns its status. */
static strum_status lay_at(strum_error *error, int argument, strum_status status)
{
    if (status != STRUM_OK && error != NULL)
        error->argument = argument;
    return status;
}

/* Least mu: a sag of about 1e-9 of the span. */
#define MU_LEAST 1e-9

static strum_status refuse_taut(strum_error *error)
{
    return error_set(error, STRUM_ERR_RANGE,
                     "the cable is too taut: its sag is below 1e-9 of the span");
}

typedef struct rising {
    double (*f)(double, void *);
    void *data;
} rising;

/* What is not finite is large: GSL takes other values for a error, and ends its host. */
static double finite_value(double x, void *data)
{
    const rising *r = data;
    const double value = r->f(x, r->data);
    return isfinite(value) ? value : value < 0 ? -DBL_MAX : DBL_MAX;
}

/* The mu at which `f` of log(mu), rising, passes 0. */
static strum_status solve_mu(double (*f)(double, void *), void *data, double *mu,
                             strum_error *error)
{
    double low = log(MU_LEAST), high = log(2 * STRUM_CHI_MAX);
    /* not a number: lengths beyond 1e150 of the span */
    if (!(f(high, data) > 0))
        return error_set(error, STRUM_ERR_RANGE,
                         "the cable is too deep: the slope parameter |chi| would exceed %g",
                         STRUM_CHI_MAX);
    if (!(f(low, data) < 0)) /* so that GSL finds the signs it asks for */
        return refuse_taut(error);
    /* GSL's steps on a state of ours: its own allocation would abort a host without memory. */
    max_align_t state[16];
    if (gsl_root_fsolver_brent->size > sizeof state)
        return error_set(error, STRUM_ERR_INTERNAL, "another GSL than this was built for");
    rising r = {f, data};
    gsl_function function = {finite_value, &r};
    double left = low, right = high, root = low;
    int status = gsl_root_fsolver_brent->set(state, &function, &root, left, right);
    for (int i = 0; i < 200 && status == GSL_SUCCESS; i++) {
        status = gsl_root_fsolver_brent->iterate(state, &function, &root, &left, &right);
        if (fabs(left - right) < 1e-16)
            break;
    }
    *mu = exp(root);
    return status == GSL_SUCCESS
               ? STRUM_OK
               : error_set(error, STRUM_ERR_INTERNAL, "the equilibrium was not found");
}

/* Fills the rest from chi_m, mu and the weight strain. */
static strum_status complete(double chi_m, double mu, double weight_strain, strum_catenary *c,
                             strum_error *error)
{
    if (!(fabs(chi_m) + mu <= STRUM_CHI_MAX))
        return error_set(error, STRUM_ERR_RANGE,
                         "the cable is too steep: the slope parameter |chi| of an end is %.3g, "
                         "above %g",
                         fabs(chi_m) + mu, STRUM_CHI_MAX);
    if (!(mu >= MU_LEAST))
        return refuse_taut(error);
    const double half = weight_strain / 2;
    const double unstretched = 2 * cosh(chi_m) * sinh(mu);
    const double kappa = weight_strain / unstretched;
    c->chi_m = chi_m;
    c->mu = mu;
    c->kappa = kappa;
    c->unstretched_length = unstretched;
    c->span = 2 * (mu + half);
    c->rise = 2 * sinh(chi_m) * (sinh(mu) + half * cosh(mu));
    c->length = unstretched + kappa * (mu + 0.5 * cosh(2 * chi_m) * sinh(2 * mu));
    return STRUM_OK;
}

/* chi_m from mu: sinh chi_m = tanh chi_m * cosh chi_m keeps its digits where tanh is near 1. */
static double middle(const taut_equation *t, double mu)
{
    const double half = t->weight_strain / 2;
    const double tanh_m = t->rise / t->length / (1 + half / tanh(mu));
    return asinh(tanh_m * t->length * (mu + half) / sinh(mu));
}

static strum_status from_equation(const taut_equation *t, strum_catenary *c, strum_error *error)
{
    double mu = 0;
    const strum_status status = solve_mu(equilibrium, (void *)t, &mu, error);
    return status == STRUM_OK ? complete(middle(t, mu), mu, t->weight_strain, c, error)
                              : status;
}

strum_status strum_catenary_from_sag(double rise_to_span, double sag_parameter,
                                     strum_catenary *catenary, strum_error *error)
{
    const double p = sag_parameter;
    if (!(isfinite(rise_to_span) && p > 0 && p < 1))
        return error_at(error, STRUM_ERR_RANGE, STRUM_CATENARY_ARG_SAG_PARAMETER,
                        STRUM_NO_INDEX, "the sag parameter must lie between 0 and 1");
    const quad exact = decimal(p);
    taut_equation t = {.excess = (double)((exact - 1) * (1 + exact) / (exact * exact)),
                       .rise = rise_to_span,
                       .length = hypot(1 / p, rise_to_span)};
    double mu = 0;
    strum_status status = solve_mu(equilibrium, &t, &mu, error);
    if (status != STRUM_OK)
        return lay_at(error, STRUM_CATENARY_ARG_SAG_PARAMETER, status);
    status = complete(middle(&t, mu), mu, 0, catenary, error);
    /* mu is that of the level cable: only the rise can make it too steep */
    return lay_at(error,
                  mu >= MU_LEAST && mu <= STRUM_CHI_MAX ? STRUM_CATENARY_ARG_RISE
                                                        : STRUM_CATENARY_ARG_SAG_PARAMETER,
                  status);
}

strum_status strum_catenary_from_xi(double xi_1, double xi_2, strum_catenary *catenary,
                                    strum_error *error)
{
    if (!(isfinite(xi_1) && isfinite(xi_2) && xi_1 < xi_2))
        return error_at(error, STRUM_ERR_RANGE, STRUM_CATENARY_ARG_XI, STRUM_NO_INDEX,
                        "xi_1 must be less than xi_2");
    const double chi_1 = strum_chi_of_xi(xi_1), chi_2 = strum_chi_of_xi(xi_2);
    double mu = (chi_2 - chi_1) / 2;
    if (xi_1 * xi_2 > 0) {
        /* chi = 2 asinh sqrt(xi/2); the difference of the two by the addition theorem */
        const double s1 = sqrt(fabs(xi_1) / 2), s2 = sqrt(fabs(xi_2) / 2);
        mu = asinh((double)(decimal(xi_2) - decimal(xi_1)) / 2 /
                   (s2 * hypot(1, s1) + s1 * hypot(1, s2)));
    }
    return lay_at(error, STRUM_CATENARY_ARG_XI,
                  complete((chi_1 + chi_2) / 2, mu, 0, catenary, error));
}

strum_status strum_catenary_from_chi(double chi_1, double chi_2, strum_catenary *catenary,
                                     strum_error *error)
{
    if (!(isfinite(chi_1) && isfinite(chi_2) && chi_1 < chi_2))
        return error_at(error, STRUM_ERR_RANGE, STRUM_CATENARY_ARG_CHI, STRUM_NO_INDEX,
                        "chi_1 must be less than chi_2");
    const quad first = decimal(chi_1), second = decimal(chi_2);
    const strum_status status = complete((double)(first + second) / 2,
                                         (double)(second - first) / 2, 0, catenary, error);
    return lay_at(error, STRUM_CATENARY_ARG_CHI, status);
}

/* 1 + rise^2 - length^2 in units of the span; the products of doubles are exact in quadruple
 * precision. */
static double excess_of(double span, double rise, double length)
{
    const quad b = decimal(span), h = decimal(rise), l = decimal(length);
    return (double)((b * b + h * h - l * l) / (b * b));
}

strum_status strum_catenary_from_length(double span, double rise, double length,
                                        strum_catenary *catenary, strum_error *error)
{
    if (!(isfinite(span) && isfinite(rise) && isfinite(length) && span > 0))
        return error_at(error, STRUM_ERR_RANGE, STRUM_CATENARY_ARG_SPAN, STRUM_NO_INDEX,
                        "the span must be positive");
    taut_equation t = {
        .excess = excess_of(span, rise, length), .rise = rise / span, .length = length / span};
    if (!(length > 0 && t.excess < 0))
        return error_at(error, STRUM_ERR_IMPOSSIBLE, STRUM_CATENARY_ARG_LENGTH, STRUM_NO_INDEX,
                        "the cable, %.15g long, does not reach between supports %.15g apart",
                        length, hypot(span, rise));
    return lay_at(error, STRUM_CATENARY_ARG_LENGTH, from_equation(&t, catenary, error));
}

strum_status strum_catenary_from_unstretched(double span, double rise,
                                             double unstretched_length, double weight_strain,
                                             strum_catenary *catenary, strum_error *error)
{
    if (!(isfinite(span) && isfinite(rise) && isfinite(unstretched_length) && span > 0 &&
          unstretched_length > 0))
        return error_at(error, STRUM_ERR_RANGE, STRUM_CATENARY_ARG_SPAN, STRUM_NO_INDEX,
                        "span and unstretched length must be positive");
    if (!(isfinite(weight_strain) && weight_strain > 0))
        return error_at(error, STRUM_ERR_RANGE, STRUM_CATENARY_ARG_WEIGHT_STRAIN,
                        STRUM_NO_INDEX, "the weight strain must be positive");
    taut_equation t = {.excess = excess_of(span, rise, unstretched_length),
                       .rise = rise / span,
                       .length = unstretched_length / span,
                       .weight_strain = weight_strain};
    return lay_at(error, STRUM_CATENARY_ARG_LENGTH, from_equation(&t, catenary, error));
}

/* A cable by its chord: epsilon = w0 L0/T_a, the angle of the chord, e = weight strain. */
typedef struct chord_equation {
    double epsilon, cosine, sine, weight_strain;
} chord_equation;

/* sinh(chi_m) = tan(chord) times this. */
static double chord_ratio(double mu, double weight_strain)
{
    const double half = weight_strain / 2;
    return (mu + half) / (sinh(mu) + half * cosh(mu));
}

/* L0/a = epsilon/cos(chord) = 2 cosh(chi_m) sinh(mu), in logarithms. */
static double chord_equilibrium(double log_mu, void *data)
{
    const chord_equation *q = data;
    const double mu = exp(log_mu);
    return log(2 * sinh(mu) / q->epsilon *
               hypot(q->cosine, q->sine * chord_ratio(mu, q->weight_strain)));
}

strum_status strum_catenary_from_chord(double epsilon, double inclination, double weight_strain,
                                       strum_catenary *catenary, strum_error *error)
{
    const bool epsilon_good = isfinite(epsilon) && epsilon > 0;
    if (!(epsilon_good && fabs(inclination) < M_PI_2))
        return error_at(
            error, STRUM_ERR_RANGE,
            epsilon_good ? STRUM_CATENARY_ARG_INCLINATION : STRUM_CATENARY_ARG_EPSILON,
            STRUM_NO_INDEX, "epsilon must be positive, the inclination below 90 degrees");
    if (!(isfinite(weight_strain) && weight_strain >= 0))
        return error_at(error, STRUM_ERR_RANGE, STRUM_CATENARY_ARG_WEIGHT_STRAIN,
                        STRUM_NO_INDEX, "the weight strain must not be negative");
    chord_equation q = {epsilon, cos(inclination), sin(inclination), weight_strain};
    double mu = 0;
    strum_status status = solve_mu(chord_equilibrium, &q, &mu, error);
    if (status == STRUM_OK) {
        const double slope = tan(inclination) * chord_ratio(mu, weight_strain);
        status = complete(asinh(slope), mu, weight_strain, catenary, error);
    }
    return lay_at(error, STRUM_CATENARY_ARG_EPSILON, status);
}

double strum_xi_of_chi(double chi)
{
    const double s = sinh(chi / 2);
    return copysign(2 * s * s, chi);
}

double strum_chi_of_xi(double xi)
{
    return copysign(2 * asinh(sqrt(fabs(xi) / 2)), xi);
}

void strum_catenary_point(const strum_catenary *c, double chi, double *x, double *y)
{
    /* Differences to end 1 by products, so that a taut cable keeps its digits. */
    const double half = (chi - (c->chi_m - c->mu)) / 2, middle = chi - half;
    const double ds = 2 * cosh(middle) * sinh(half);
    *x = 2 * half + c->kappa * ds;
    *y = 2 * sinh(middle) * (sinh(half) + c->kappa * cosh(half) * cosh(middle) * sinh(half));
}

/* Vertical distance of the point chi from the tangent at chi_0, in a; never negative. */
static double above_tangent(double kappa, double chi, double chi_0)
{
    const double d = chi - chi_0;
    const double rise = 2 * pow(sinh(d / 2), 2);
    const double excess = d * sinhc_less_one(fabs(d)); /* sinh d - d */
    const double ds = 2 * cosh(chi_0 + d / 2) * sinh(d / 2);
    return cosh(chi_0) * rise + sinh(chi_0) * excess + 0.5 * kappa * ds * ds;
}

double strum_catenary_parallel(const strum_catenary *c)
{
    /* sinh(chi_m) = rise/span chord_ratio: what it lacks of rise/span, without cancellation */
    const double half = c->kappa * c->unstretched_length / 2, mu = c->mu;
    const double beyond = c->rise / c->span *
                          (mu * sinhc_less_one(mu) + half * 2 * pow(sinh(mu / 2), 2)) /
                          (sinh(mu) + half * cosh(mu));
    return 2 * cosh(c->chi_m - mu / 2) * sinh(mu / 2) + beyond;
}

double strum_catenary_unstretched(const strum_catenary *c, double kappa)
{
    double node[128], weight[128], stretch = 0;
    gauss_legendre(128, node, weight);
    for (size_t i = 0; i < 128; i++) {
        const double tension = cosh(c->chi_m + c->mu * node[i]);
        stretch += c->mu * weight[i] * tension * (kappa * tension / (1 + kappa * tension));
    }
    return c->length - stretch;
}

double strum_catenary_sag(const strum_catenary *c)
{
    /* Deepest where the tangent is parallel to the chord; the chord is there as far above the
     * tangent as it is at the upper end, where the two terms of above_tangent have one sign. */
    const double parallel = asinh(c->rise / c->span);
    const double end = c->chi_m + (parallel >= 0 ? c->mu : -c->mu);
    return above_tangent(c->kappa, end, parallel);
}

/*
 * The cable swings as a rigid body about its chord: omega^2 = INT z ds / INT z^2 ds with z the
 * distance to the chord. With a rise the restoring gravity is g cos(atan(h/b)), which the
 * report leaves out; the factor turns both distances into vertical ones, so that one formula
 * holds for any rise.
 */
strum_status strum_rayleigh_out_of_plane(const strum_catenary *c, double *frequency,
                                         strum_error *error)
{
    double node[128], weight[128];
    gauss_legendre(128, node, weight);
    (void)error; /* the formula holds for every equilibrium */
    const double parallel = asinh(c->rise / c->span), sag = strum_catenary_sag(c);
    double first = 0, second = 0;
    for (size_t i = 0; i < 128; i++) {
        const double chi = c->chi_m + c->mu * node[i], w = c->mu * weight[i];
        const double z = sag - above_tangent(c->kappa, chi, parallel);
        first += w * cosh(chi) * z;
        second += w * cosh(chi) * z * z;
    }
    *frequency = sqrt(first / second);
    return STRUM_OK;
}
