/* SPDX-License-Identifier: GPL-3.0-or-later */
/* /v1/identify/tension: from measured frequencies back to the cable. */
#include "endpoints/identify/answer.h"

const endpoint identify_tension = {
    .path = "/v1/identify/tension",
    .title =
        "Tension, bending stiffness, fixity and more from measured frequencies, with intervals",
    .request = &identify_schema,
    .query = true,
    .prepare = identify_prepare,
    .cost_us = identify_cost_us,
    .answer = identify_answer};
