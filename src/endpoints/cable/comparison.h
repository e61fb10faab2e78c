/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The simpler theories beside the modes of a general cable. */
#ifndef ENDPOINTS_CABLE_COMPARISON_H
#define ENDPOINTS_CABLE_COMPARISON_H

#include "endpoints/cable/motion.h"

/* The member "comparison"; `count` modes of each plane. */
strum_status comparison_write(const hung_input *in, const strum_hanging *cable,
                              const motion planes[2], size_t count,
                              const strum_options *options, json_writer *json,
                              strum_error *error);

#endif
