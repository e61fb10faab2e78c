/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of the functions on an element. */
#ifndef CORE_CABLE_RULE_H
#define CORE_CABLE_RULE_H

#include "core/cable/motion.h"

#define RULE_SIZES 24

typedef struct {
    motion_rule *rules[RULE_SIZES];
    int count;
} rule_set;

/* The rule for rotations of `degree`, from the set or made for it; NULL: no memory. */
const motion_rule *rule_for(int degree, rule_set *set, arena *memory);

#endif
