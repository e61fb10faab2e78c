/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * From a request to its answer:
 *
 *   1. its raw bytes are in the cache: send the stored answer;
 *   2. parse and validate it;
 *   3. its canonical key is in the cache: send the stored answer;
 *   4. an equal request is being solved: wait for its answer;
 *   5. it is cheap: solve it on this thread;
 *   6. otherwise queue it for a worker.
 */
#ifndef HTTP_API_SOLVE_HANDLER_H
#define HTTP_API_SOLVE_HANDLER_H

#include "http/api/request.h"

enum MHD_Result handle_endpoint(struct connection *p); /* called again when it was suspended */
enum MHD_Result handle_result(struct connection *p);   /* GET /v1/results/{key} */
/* Answers a connection in CONNECTION_WAITING with 503 now, because of `why`. On the event thread,
 * or on another under the lock of connections. */
void solve_give_up(struct connection *p, const char *why);
/* Wakes a stream that has asked to be woken by now. In the same places. */
void solve_look_in(struct connection *p, int64_t now_ms);

/* Solves, completes the flight and wakes all requests that wait for it. `given_us`: when it was
 * queued (clock_us), or 0. */
void solve_flight(service *s, const evaluation *a, const cache_key *key, flight *f,
                  double given_us);
/* Queues the flight of a batch's long item for a worker; takes over `a`. */
void solve_item_later(service *s, evaluation *a, const cache_key *key, flight *f,
                      unsigned client);
/* Returns a refusal as an entry, for all requests that wait for the same answer; NULL when memory
 * ran out. */
entry *refusal_entry(const cache_key *key, const problem *why);

#endif
