/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "endpoints/common/round.h"

#include <math.h>

#define SAME 1e-9

static void differ(double given, double found, const char *pointer, const char *from,
                   problem *p)
{
    if (fabs(given - found) > SAME * fabs(found))
        problem_add(p, pointer, "is %.12g by %s, found %.12g: give one of them", found, from,
                    given);
}

static void check_diameter(const round_input *in, problem *p)
{
    if (in->material_density > 0)
        problem_add(p, "/material_density_kg_per_m3", "needs diameter_m");
    if (in->fluid_density > 0)
        problem_add(p, "/fluid_density_kg_per_m3", "needs diameter_m");
    if (in->added_mass_coefficient > 0)
        problem_add(p, "/added_mass_coefficient",
                    "needs diameter_m; or give added_mass_kg_per_m");
}

/* Of mass_kg_per_m wherever it is a field. */
#define ROUND_MASS_LEAST 1e-9
#define ROUND_MASS_MOST  1e6

static void find_mass(const round_input *in, const round_masses *m, double area, problem *p)
{
    const double mass = in->material_density * area;
    if (m->mass_given && mass > 0)
        differ(*m->mass, mass, "/mass_kg_per_m", "diameter_m and material_density_kg_per_m3",
               p);
    else if (!m->mass_given && !(mass > 0))
        problem_add(p, "/mass_kg_per_m",
                    "missing: diameter_m needs it, or material_density_kg_per_m3");
    else if (!m->mass_given && !(mass >= ROUND_MASS_LEAST && mass <= ROUND_MASS_MOST))
        problem_add(p, "/material_density_kg_per_m3",
                    "makes a mass of %.4g kg/m with diameter_m; it must be at least %g and at "
                    "most %g",
                    mass, ROUND_MASS_LEAST, ROUND_MASS_MOST);
    else if (!m->mass_given)
        *m->mass = mass;
}

bool round_complete(const round_input *in, const round_masses *m, problem *p)
{
    if (!(in->diameter_m > 0)) {
        check_diameter(in, p);
        return false;
    }
    const double area = M_PI / 4 * in->diameter_m * in->diameter_m;
    const double displaced = in->fluid_density * area;
    const double added = in->added_mass_coefficient * displaced;
    find_mass(in, m, area, p);
    const double weight = m->gravity * (*m->mass - displaced);
    if (*m->mass > 0 && !(weight > 0))
        problem_add(
            p, "/fluid_density_kg_per_m3",
            "the cable weighs %.4g N/m in this fluid; /v1/cable/modes answers buoyant and "
            "neutral cables",
            weight);
    else if (m->weight_given)
        differ(*m->weight, weight, "/weight_N_per_m", "diameter_m and fluid_density_kg_per_m3",
               p);
    else
        *m->weight = weight;
    if (*m->added > 0)
        differ(*m->added, added, "/added_mass_kg_per_m",
               "diameter_m, fluid_density_kg_per_m3 and added_mass_coefficient", p);
    else
        *m->added = added;
    return true;
}
