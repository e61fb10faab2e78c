/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The length or span for a given figure of the shape with bending stiffness: from that of the
 * cable without, by the secant rule. */
#ifndef CORE_CABLE_ROD_ENDS_H
#define CORE_CABLE_ROD_ENDS_H

#include "core/cable/settle.h"

/* From s as ends_find leaves it. */
strum_status rod_ends_find(cable_settler *s, strum_error *error);

#endif
