/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How many roots lie in a rectangle, by the argument principle. */
#ifndef CORE_CABLE_WINDING_H
#define CORE_CABLE_WINDING_H

#include "core/cable/damped.h"

typedef struct {
    double left, right, low, high; /* right > 0 > left, high > low > 0 */
} winding_box;

/* `*count`: roots in the box; `*sure`: no step along its edge was too long to follow. */
strum_status winding_count(const damped *d, const winding_box *box, work *w, long *count,
                           bool *sure);

#endif
