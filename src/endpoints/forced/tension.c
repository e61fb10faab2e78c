/* SPDX-License-Identifier: GPL-3.0-or-later */
/* /v1/forced/tension: dynamic tension of a suspended cable whose end 2 moves (Gale 1976,
 * chapter 2.5). */
#include "endpoints/forced/answer.h"
#include "endpoints/forced/request.h"

const endpoint forced_tension = {
    .path = "/v1/forced/tension",
    .title =
        "Dynamic tension of a suspended cable whose end 2 moves, against forcing frequency",
    .request = &forced_request_schema,
    .query = true,
    .prepare = forced_prepare,
    .answer_bytes = forced_answer_bytes,
    .cost_us = forced_cost_us,
    .solve_bytes = forced_solve_bytes,
    .answer = forced_answer,
};
