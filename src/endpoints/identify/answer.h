/* SPDX-License-Identifier: GPL-3.0-or-later */
/* /v1/identify/tension, the answer. */
#ifndef ENDPOINTS_IDENTIFY_ANSWER_H
#define ENDPOINTS_IDENTIFY_ANSWER_H

#include "endpoints/identify/request.h"

bool identify_answer(const void *data, answer *a);
/* What the client should know beside the figures. */
void identify_warn(const identify_request *r, const strum_identify *found, answer *a);

/* The usual formulas beside the answer. */
void identify_write_comparison(json_writer *json, const strum_identify *found);

#endif
