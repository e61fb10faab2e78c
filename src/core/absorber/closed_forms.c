/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What textbooks say of one tuned mass or damper on a uniform taut cable. */
#include <math.h>

#include <strum/absorber.h>

static double tuned_stiffness(double mass, double ratio, double frequency)
{
    return mass * pow(frequency / (1 + ratio), 2);
}

strum_absorber_form strum_absorber_den_hartog(double mass, double ratio, double frequency)
{
    return (strum_absorber_form){
        tuned_stiffness(mass, ratio, frequency),
        2 * mass * frequency * sqrt(3 * ratio / (8 * pow(1 + ratio, 3))), NAN};
}

strum_absorber_form strum_absorber_coalescence(double mass, double ratio, double frequency)
{
    return (strum_absorber_form){tuned_stiffness(mass, ratio, frequency),
                                 2 * mass * frequency * sqrt(ratio) / pow(1 + ratio, 1.5),
                                 sqrt(ratio) / 2};
}

strum_absorber_form strum_absorber_universal_curve(double length, double mass_per_length,
                                                   double tension, double position, long mode)
{
    const double share = fmin(position, length - position) / length;
    const double first = M_PI / length * sqrt(tension / mass_per_length);
    return (strum_absorber_form){
        0, 0.10 * mass_per_length * length * first / ((double)mode * share), 0.52 * share};
}
