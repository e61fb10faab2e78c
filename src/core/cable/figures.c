/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/modes.h"
#include "core/numerics/status.h"
strum_status strum_cable_modes_get(const strum_cable_modes *modes, size_t index,
                                   strum_cable_mode *mode)
{
    if (index >= modes->count)
        return STRUM_ERR_RANGE;
    const modes_item *item = modes->items + index;
    *mode = (strum_cable_mode){.frequency = cimag(item->mode->lambda),
                               .decay = -creal(item->mode->lambda),
                               .run = item->run};
    return STRUM_OK;
}
