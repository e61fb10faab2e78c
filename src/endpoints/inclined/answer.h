/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of the answer share. */
#ifndef ENDPOINTS_INCLINED_ANSWER_H
#define ENDPOINTS_INCLINED_ANSWER_H

#include <strum/modes.h>

#include "endpoints/inclined/request.h"

/* kl_over_pi, and in metres its companions. */
void inclined_write_frequency(json_writer *json, const inclined_request *r, double kl);
/* Members "out_of_plane" and, where asked, "verification_out_of_plane" of the open object. */
strum_status inclined_write_out_of_plane(json_writer *json, const inclined_request *r,
                                         const strum_options *options, strum_error *error);

#endif
