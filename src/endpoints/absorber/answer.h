/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef ENDPOINTS_ABSORBER_ANSWER_H
#define ENDPOINTS_ABSORBER_ANSWER_H

#include "endpoints/absorber/solving.h"

/* The result; false with a->problem set. */
bool absorber_write(absorber_solving *s, const strum_absorber_optimum *best,
                    const strum_taut_roots *roots);

#endif
