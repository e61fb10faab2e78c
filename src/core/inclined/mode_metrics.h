/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CORE_INCLINED_MODE_METRICS_H
#define CORE_INCLINED_MODE_METRICS_H

#include "core/inclined/model.h"

/* Energies, shares, maxima and units of all modes. */
strum_status inclined_measure(strum_inclined *m, work *w);

#endif
