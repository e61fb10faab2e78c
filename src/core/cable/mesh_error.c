/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/mesh_error.h"

/* Squares of what the last two functions of each kind carry, over all elements; the stiffness
 * energy of the mode is 1. */
double mesh_error(const motion *m, const double *v)
{
    double sum = 0;
    for (int i = 0; i < m->element_count; i++) {
        const motion_element *e = m->elements + i;
        const double tension = m->tension[e->point + e->rule->points / 2];
        for (int k = 1; k <= 2 && k < e->strains; k++) {
            const double last = v[e->strain + e->strains - k];
            sum += last * last;
        }
        for (int k = 1; k <= 2 && k + 2 < e->rotations; k++) {
            const int degree = e->rotations - k;
            const double last = v[e->inner + e->rotations - 2 - k];
            /* the integral of the orthonormal polynomial has the norm 1/degree */
            sum += last * last *
                   (e->bending / e->half + e->half * tension / ((double)degree * degree));
        }
    }
    return sum;
}
