/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equal level spans in a row, each with the static shape of one. */
#ifndef CORE_CABLE_SPANS_H
#define CORE_CABLE_SPANS_H

#include "core/cable/cable.h"

/* The row as one cable: pieces and stations of `one`, repeated. It is not to be freed: its memory
 * is the arena's, and what it points at beside is that of `one`. */
strum_status spans_repeat(const strum_hanging *one, arena *memory, strum_hanging *row);

/* A hanger between two spans is a rigid rod from a fixed point above, loaded by the cable's pull
 * P at its foot and its own weight W: small motion of the foot is along and across the row,
 *     stiffness (P + W/2)/l,   mass m/3. */
typedef struct {
    double stiffness, mass;
} spans_hanger;

/* Whether station i of the row has one, and which. */
bool spans_hanger_at(const strum_hanging *row, size_t station, spans_hanger *hanger);

#endif
