/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A mode by its index, which must be there. */
#ifndef TESTS_SUSPENDED_MODES_H
#define TESTS_SUSPENDED_MODES_H

#include <strum/modes.h>

#include "check.h"

static inline strum_mode mode_at(const strum_modes *modes, long index)
{
    strum_mode mode = {0};
    assert_int_equal(strum_modes_get(modes, (size_t)index, &mode), STRUM_OK);
    return mode;
}

#endif
