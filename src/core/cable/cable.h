/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A cable in its static shape, as its modes see it: pieces in a row, stations between them.
 */
#ifndef STRUM_CORE_CABLE_CABLE_H
#define STRUM_CORE_CABLE_CABLE_H

#include <stdatomic.h>

#include <strum/cable.h>

#include "core/numerics/arena.h"

/* Uniform cable between two neighbouring stations (ends, attachments, changes of section, edges
 * of a contact). At s from its start the force is (h, v + section->weight s) where it hangs. */
typedef struct {
    const strum_cable_section *section;
    double start, length; /* unstretched */
    double h, v;          /* N, just behind the station at its start */
    double x, z;          /* of its start */
    double rate;          /* of what lies: dT/dS, of the tension along the bed */
    double bed_x, bed_z;  /* and its direction */
    bool lies;            /* on the bed; its force then is along the bed, and not as above */
    size_t run;           /* which hanging part it belongs to, from 0 */
} cable_piece;

/* Before piece i stands station i; station piece_count is end 2. */
typedef struct {
    double position, x, z;
    size_t first, count; /* its attachments: in strum_hanging.attachments, sorted by position */
} cable_station;

/* With bending stiffness in the static shape: angle, its derivative, normal force along the
 * rod, by the file that finds the shape. */
typedef struct cable_rod cable_rod;

struct strum_hanging {
    atomic_size_t references;
    arena memory;              /* owns all that is pointed at below */
    strum_cable_params params; /* sections and attachments point into the copies below */
    strum_cable_section *sections;
    strum_cable_attachment *attachments; /* sorted by position */
    size_t *order;                       /* place of attachment i as handed in among them */
    cable_piece *pieces;
    size_t piece_count;
    cable_station *stations; /* piece_count + 1 */
    strum_cable_contact *contacts;
    strum_cable_statics statics;
    cable_rod *rod; /* NULL: flexible */
};

/* One more holder of the cable: the last strum_cable_free frees it. */
strum_hanging *cable_share(const strum_hanging *cable);

#endif
