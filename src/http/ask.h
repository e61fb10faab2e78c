/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * From a question to its answer: known by its bytes -> sent as it is; otherwise read, checked,
 * known by its key -> sent; being solved -> waited for; cheap -> solved here; else by a worker.
 */
#ifndef HTTP_ASK_H
#define HTTP_ASK_H

#include "http/peers.h"

enum MHD_Result ask_endpoint(struct peer *p); /* called again when it was suspended */
enum MHD_Result ask_result(struct peer *p);   /* GET /v1/results/{key} */
/* A peer in PEER_WAITING waits no longer: 503, because of `why`. Under the lock of peers. */
void ask_give_up(struct peer *p, const char *why);

/* Solves, lands the flight and tells all who wait. `given_us`: when it was given to the crew
 * (clock_us), or 0. */
void ask_fly(struct server *s, const asking *a, const cache_key *key, flight *f,
             double given_us);
/* A refusal as an entry, for all who wait for the same answer. NULL when memory ran out. */
entry *ask_refusal(const cache_key *key, const problem *why);

#endif
