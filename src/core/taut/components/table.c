/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kinds of component that a chain may hold: a row each. */
#include "core/taut/components/component.h"

const taut_kind *taut_kind_of(strum_taut_kind kind)
{
    static const taut_kind *const kinds[] = {
        [STRUM_TAUT_CABLE] = &taut_cable_kind,   [STRUM_TAUT_VARYING] = &taut_varying_kind,
        [STRUM_TAUT_BODY] = &taut_body_kind,     [STRUM_TAUT_HANGING] = &taut_hanging_kind,
        [STRUM_TAUT_GROUND] = &taut_ground_kind, [STRUM_TAUT_SUPPORT] = &taut_support_kind,
    };
    const size_t known = sizeof kinds / sizeof *kinds;
    return (size_t)kind < known ? kinds[kind] : NULL;
}
