/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * POST /v1/batch: many requests in one; their answers are streamed, one a line and in order.
 * Workers parse, look up and solve the items, a window of them at a time; the event thread only
 * sends what is ready. Batches are background work: other requests go first.
 */
#ifndef HTTP_API_BATCH_H
#define HTTP_API_BATCH_H

#include "http/api/request.h"

enum MHD_Result batch_answer(struct connection *p);

#endif
