/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef ENDPOINTS_ABSORBER_ASSESS_H
#define ENDPOINTS_ABSORBER_ASSESS_H

#include "endpoints/absorber/solving.h"

/* The result for a chain without variables; false with a->problem set. */
bool absorber_assess(absorber_solving *s);
/* Why nothing within the bounds damps every mode that was asked for, laid at what asks for them. */
void absorber_explain(absorber_solving *s);

#endif
