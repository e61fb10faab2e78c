/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Counters, and their text for Prometheus (format 0.0.4). */
#ifndef HTTP_SERVICE_METRICS_H
#define HTTP_SERVICE_METRICS_H

#include <stdint.h>

#include "json/strbuf.h"

typedef struct metrics metrics;
struct server;

metrics *metrics_new(void); /* NULL when memory ran out */
void metrics_free(metrics *m);
/* One answer: its route, status, bytes, and the time from its headers to its first byte. */
void metrics_request(metrics *m, size_t index, int status, size_t bytes, double us);
/* One computation: its status, time, and how many steps it told of (progress.evaluations). */
void metrics_solve(metrics *m, int status, double us, int64_t steps);
void metrics_write(struct server *s, strbuf *out);

#endif
