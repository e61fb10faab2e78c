/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef ENDPOINTS_ABSORBER_ANSWER_H
#define ENDPOINTS_ABSORBER_ANSWER_H

#include "endpoints/absorber/solving.h"

/* The result; false with a->problem set. */
bool absorber_write(absorber_solving *s, const strum_absorber_optimum *best,
                    const strum_taut_roots *roots);

/* The damping ratio that `required` asks for at values of the variables; NAN without it or without
 * a cable's mass. */
double absorber_required_ratio(const absorber_request *r, const double *values);

#endif
