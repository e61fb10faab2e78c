/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The modes of one stretch of cable that moves by itself. */
#ifndef CORE_CABLE_SPECTRUM_H
#define CORE_CABLE_SPECTRUM_H

#include <complex.h>

#include "core/cable/reduced.h"

typedef struct {
    double _Complex lambda;
    double *re, *im; /* the unknowns; im NULL: undamped */
    double error;    /* estimate, relative */
} spectrum_mode;

typedef struct spectrum {
    motion motion;
    stiffness stiffness;
    spectrum_mode *modes;
    int count;
    bool damped;
    double *decays; /* overdamped */
    int overdamped;
    long expected, found;
    double error;
} spectrum;

#endif
