/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * From a question to its answer: known by its bytes -> sent as it is; otherwise read, checked,
 * known by its key -> sent; being solved -> waited for; cheap -> solved here; else by a worker.
 */
#ifndef HTTP_API_SOLVE_HANDLER_H
#define HTTP_API_SOLVE_HANDLER_H

#include "http/api/request.h"

enum MHD_Result handle_endpoint(struct connection *p); /* called again when it was suspended */
enum MHD_Result handle_result(struct connection *p);   /* GET /v1/results/{key} */
/* A peer in CONNECTION_WAITING waits no longer: 503, because of `why`. Under the lock of connections. */
void solve_give_up(struct connection *p, const char *why);

/* Solves, lands the flight and tells all who wait. `given_us`: when it was given to the thread_pool
 * (clock_us), or 0. */
void solve_flight(service *s, const evaluation *a, const cache_key *key, flight *f,
                  double given_us);
/* A refusal as an entry, for all who wait for the same answer. NULL when memory ran out. */
entry *refusal_entry(const cache_key *key, const problem *why);

#endif
