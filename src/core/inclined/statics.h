/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cable at rest, and its coordinates: under all models. */
#ifndef CORE_INCLINED_STATICS_H
#define CORE_INCLINED_STATICS_H

#include "core/inclined/model.h"

/* The cable as the core's mechanics sees it, masses in M. */
strum_cable inclined_mechanics(const strum_inclined_cable *cable,
                               const strum_inclined_statics *statics);
/* INT T0^(-1/2) ds from the lower support to where chi - chi_m is `offset`; `rule`:
 * legendre_make(1, ..). */
double inclined_phase(const strum_inclined_cable *cable, const strum_catenary *profile,
                      const legendre *rule, double offset);
double inclined_s_of_x(const strum_inclined *m, double x);
double inclined_x_of_s(const strum_inclined *m, double s);
/* Length in kL that holds few roots of the model: 1, less where it has longitudinal waves and
 * they are slow. */
double inclined_spacing(const strum_inclined *m);

#endif
