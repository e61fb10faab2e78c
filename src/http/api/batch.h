/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * POST /v1/batch: many askings in one request; their answers stream, a line each and in order.
 * Workers read, find and solve the items, a window of them at a time; the event thread only
 * sends what is ready. Batches are background work: they give way to other clients.
 */
#ifndef HTTP_API_BATCH_H
#define HTTP_API_BATCH_H

#include "http/api/request.h"

enum MHD_Result batch_answer(struct connection *p);

#endif
