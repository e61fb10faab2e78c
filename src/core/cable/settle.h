/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One shape of a cable of given lengths between given ends, free or on its bed, found as often as
 * its lengths or its span change. */
#ifndef CORE_CABLE_SETTLE_H
#define CORE_CABLE_SETTLE_H

#include "core/cable/form.h"
#include "core/cable/touch.h"
#include "core/numerics/status.h"
#include "core/numerics/work.h"

typedef struct {
    strum_hanging *cable; /* sections and attachments are read anew each time */
    work *work;
    double span;
    cable_line line;
    cable_form form; /* memory of the cable */
    bed_contact *touching;
    bool warm; /* the form is a neighbour's: begin from its force */
} cable_settler;

/* Room for all shapes; STRUM_ERR_MEMORY. */
strum_status settle_begin(strum_hanging *cable, work *w, cable_settler *s);
/* Cuts the sections, as they are, into s->line. */
void settle_cut(cable_settler *s);
/* Finds s->form for the lengths and s->span as they are. */
strum_status settle(cable_settler *s, strum_error *error);
/* Whether bending stiffness counts in the shape. */
bool settle_bends(const strum_hanging *cable);
/* Gives the cable its form, with bending stiffness where that counts, and its figures. */
strum_status settle_keep(cable_settler *s, strum_error *error);

#endif
