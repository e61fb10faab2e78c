/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The modes of a cable: its stretches' in one row. */
#ifndef CORE_CABLE_MODES_H
#define CORE_CABLE_MODES_H

#include <strum/cable_modes.h>

#include "core/cable/spectrum.h"

typedef struct {
    const spectrum *stretch;
    const spectrum_mode *mode;
    size_t run;
} modes_item;

struct strum_cable_modes {
    const strum_hanging *cable; /* shared */
    strum_hanging row;          /* of several spans; else without pieces */
    const strum_hanging *line;  /* whichever of the two moves */
    arena memory;
    spectrum *stretches;
    size_t stretch_count;
    modes_item *items;
    size_t count;
    double *decays;
    size_t overdamped;
    strum_cable_certificate certificate;
};

#endif
