/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ranges of what a cable is made from. */
#ifndef CORE_CABLE_CHECK_H
#define CORE_CABLE_CHECK_H

#include <strum/cable.h>

/* STRUM_ERR_RANGE with the argument and, of a list, the item. */
strum_status cable_check(const strum_cable_params *p, strum_error *error);

#endif
