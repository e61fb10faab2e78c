/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The complex modes of one stretch of cable. */
#ifndef CORE_CABLE_SPECTRUM_DAMPED_H
#define CORE_CABLE_SPECTRUM_DAMPED_H

#include "core/cable/spectrum.h"

/* Fills the modes, overdamped roots and counts of `s`, whose motion and stiffness are made. */
strum_status spectrum_damped(int want, arena *memory, spectrum *s);

#endif
