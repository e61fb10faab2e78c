/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "endpoints/common/plausibility.h"

#include <math.h>
#include <string.h>

#include <strum/handbook.h>

/* Strain beyond which an axial stiffness is hardly a constant. */
#define STRAIN_MOST 0.02
/* Slopes beyond it, in degrees, leave the catenary little to say about the end. */
#define ANGLE_MOST 85
/* Of a frequency. */
#define SHIFT_MOST 0.01
/* Of the span: linear dynamics are those of small motion. */
#define MOTION_MOST 0.1
/* The first symmetric mode in plane falls when a cable that cannot stretch becomes one that can:
 * from tan x = x - 4 x^3/lambda^2, x = k L/2  [Irvine and Caughey 1974], with x = 4.4934094579 at
 * infinite lambda^2. It has fallen by 1 % where lambda^2 = 4 x^3/(x - tan x) with 0.99 of that x. */
#define STIFF_LAMBDA_SQUARED 470.916
/* Below it the lowest mode in plane is a symmetric one, which an inextensible cable has not. */
#define CROSSOVER (4 * M_PI * M_PI)

void warn_strain(double strain, answer *a)
{
    if (strain > 1)
        answer_warn(a,
                    "the axial stiffness is below the tension, which is %.3g times as large: "
                    "the cable would stretch to more than twice its length; are the units "
                    "mixed up (kN, MN), or is E given for EA?",
                    strain);
    else if (strain > STRAIN_MOST)
        answer_warn(a,
                    "the tension stretches the cable by %.2g %%: an axial stiffness that does "
                    "not depend on tension is assumed; few materials bear more than 2 %%",
                    100 * strain);
}

void warn_end_angle(int end, double degrees, answer *a)
{
    if (fabs(degrees) > ANGLE_MOST)
        answer_warn(a,
                    "the cable stands at %.3g degrees to the horizontal at end %d, more than "
                    "%d: nearly all its length hangs vertically; are span and length of one "
                    "unit?",
                    fabs(degrees), end, ANGLE_MOST);
}

void warn_inextensible(double lambda_squared, double stiffness_N, answer *a)
{
    if (!(lambda_squared < STIFF_LAMBDA_SQUARED))
        return;
    const double needed = STIFF_LAMBDA_SQUARED / lambda_squared * stiffness_N;
    answer_warn(
        a,
        "the cable cannot stretch here. That holds within 1 %% from an axial_stiffness_N of "
        "%.3g on (Irvine's lambda squared %.0f); steel of this mass has %.3g (lambda squared "
        "%.3g)%s: give axial_stiffness_N",
        needed, STIFF_LAMBDA_SQUARED, stiffness_N, lambda_squared,
        lambda_squared < CROSSOVER ? ", and its lowest mode in plane is a symmetric one that "
                                     "is missing here"
                                   : "");
}

void warn_without_stretch(const cable_input *in, answer *a)
{
    if (in->cable.kappa_t > 0 || !(in->tension_N > 0))
        return;
    strum_cable steel = in->cable;
    strum_handbook handbook;
    const double stiffness = STEEL_SPECIFIC_STIFFNESS * in->mass_kg_per_m;
    steel.kappa_t = in->tension_N / stiffness;
    strum_handbook_of(&in->catenary, &steel, &handbook);
    warn_inextensible(handbook.lambda_squared, stiffness, a);
}

/* A mode in plane moves along the cable by about the slope to its chord, at most `slope`, times its
 * motion across: on average over a parabola a third of slope^2 of its energy. Half of that is the
 * shift of the frequency per part of the mass. */
void warn_added_mass(double added, double mass, double slope, answer *a)
{
    if (added / (mass + added) * slope * slope / 6 > SHIFT_MOST)
        answer_warn(a,
                    "added_mass_kg_per_m acts on motion across the cable only, as in a fluid; "
                    "a program that raises the density by it adds it along the cable too, and "
                    "its modes in plane come out lower (3 to 21 %% where sag matters)");
}

double turn_of(const cable_input *in)
{
    const strum_catenary *c = &in->catenary;
    return (atan(sinh(c->chi_m + c->mu)) - atan(sinh(c->chi_m - c->mu))) / 2;
}

void warn_suspended(const cable_input *in, answer *a)
{
    const double chi[2] = {in->catenary.chi_m - in->catenary.mu,
                           in->catenary.chi_m + in->catenary.mu};
    warn_strain(in->cable.kappa_t * cosh(fmax(fabs(chi[0]), fabs(chi[1]))), a);
    for (int end = 0; end < 2; end++)
        warn_end_angle(end + 1, atan(sinh(chi[end])) * 180 / M_PI, a);
}

/* At sag 1:20 the first crossover has moved by 4 %. */
#define CROSSOVER_SAG 0.05
/* At a tenth of the length the best tuning is 2 % above the formula's. */
#define ANCHOR_PLACE 0.1

void warn_of_crossover(double sag, answer *a)
{
    if (sag > CROSSOVER_SAG)
        answer_warn(
            a,
            "the handbook's shallow cable is compared at a sag of %.3g of the span: with "
            "lambda squared from weight and tension its first crossover, 4 pi squared, lies "
            "at 0.963 of that for a sag of 1:20, 0.864 for 1:10, 0.800 for 1:8",
            sag);
}

void warn_of_tuning(double place, answer *a)
{
    if (place <= ANCHOR_PLACE)
        answer_warn(
            a,
            "closed forms tune an absorber at %.3g of the length from an end to the wrong "
            "side: they leave out how the other modes soften its support; at 0.05 with 30 "
            "%% of the cable's mass they say 0.986 of the mode's frequency, the best is "
            "1.05",
            place);
}

void warn_motion(double amplitude, answer *a)
{
    if (amplitude > MOTION_MOST)
        answer_warn(
            a,
            "the end moves by %.3g of the span, more than %g: linear dynamics are those "
            "of small motion",
            amplitude, MOTION_MOST);
}

static bool at_a_point(const char *type)
{
    static const char *const types[] = {"point_mass", "spring", "damper", "inerter",
                                        "hanging_absorber"};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (strcmp(type, types[i]) == 0)
            return true;
    return false;
}

/* `i` counts from the end at which the chain is held. */
static void warn_held(const chain_input *in, const char *end, bool from_right, answer *a)
{
    const object_item *items = in->components.items;
    for (size_t i = 0; i < in->components.count; i++) {
        const size_t index = from_right ? in->components.count - 1 - i : i;
        const char *type = chain_variants[items[index].variant].type;
        if (!at_a_point(type))
            return;
        answer_warn(
            a,
            "/components/%zu, a %s, stands at the fixed %s end, which does not move: it "
            "does nothing there",
            index, type, end);
    }
}

void warn_chain(const chain_input *in, answer *a)
{
    if (in->left_end == STRUM_TAUT_FIXED)
        warn_held(in, "left", false, a);
    if (in->right_end == STRUM_TAUT_FIXED)
        warn_held(in, "right", true, a);
}
