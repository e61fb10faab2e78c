/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the modes of one stretch of cable that moves by itself. */
#ifndef CORE_CABLE_STRETCH_H
#define CORE_CABLE_STRETCH_H

#include "core/cable/spectrum.h"

/* Memory is the arena's, whose work is asked. */
strum_status stretch_solve(const strum_hanging *cable, const motion_choice *choice,
                           arena *memory, spectrum *s);

#endif
