/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * An answer as Server-Sent Events, for who asked with `Accept: text/event-stream`: `progress`
 * while it is computed, then `result` with the whole answer, or `problem`.
 */
#ifndef HTTP_API_EVENTS_H
#define HTTP_API_EVENTS_H

#include "http/api/request.h"

/* Makes p->request.stream; NULL when memory ran out. Its waiter is to be given to cache_acquire;
 * events_free_waiter says that it was not taken. */
waiter *events_open(struct connection *p);
void events_free_waiter(struct connection *p);
/* Sends what there is and what will come; `known` (may be NULL) is the answer already, and its
 * reference is taken over. */
enum MHD_Result events_reply(struct connection *p, entry *known);

#endif
