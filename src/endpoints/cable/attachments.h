/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies, links and forces along a general cable, and their repetitions. */
#ifndef ENDPOINTS_CABLE_ATTACHMENTS_H
#define ENDPOINTS_CABLE_ATTACHMENTS_H

#include "endpoints/cable/fields.h"

/* Fills the weights that follow from masses, adds faults across fields, and leaves in `in` the
 * attachments of the core and where each is from. */
void attachments_prepare(hung_input *in, schema_arena *arena, problem *p);

#endif
