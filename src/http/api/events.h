/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * An answer as Server-Sent Events, for clients that ask with `Accept: text/event-stream`:
 * `progress` while it is computed, then `result` with the whole answer, or `problem`.
 */
#ifndef HTTP_API_EVENTS_H
#define HTTP_API_EVENTS_H

#include "http/api/request.h"

/* Makes p->request->stream and returns its waiter, to be passed to cache_acquire, or NULL when
 * memory ran out. Call events_free_waiter if the cache did not keep the waiter. */
waiter *events_open(struct connection *p);
void events_free_waiter(struct connection *p);
/* Sends the events so far and those to come. `known` (may be NULL) is the answer if it is known
 * already; its reference is taken over. */
enum MHD_Result events_reply(struct connection *p, entry *known);

#endif
