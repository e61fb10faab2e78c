/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pages of other sites in a browser must not use a daemon that only this machine can reach. */
#ifndef HTTP_API_BROWSER_H
#define HTTP_API_BROWSER_H

#include <stdbool.h>

#include "http/service/settings.h"
#include "json/problem.h"

/* What a browser says by itself, whatever the page; NULL: not said. */
typedef struct browser_headers {
    const char *host, *origin;
    const char *site, *mode, *dest; /* Sec-Fetch-... (W3C Fetch Metadata) */
} browser_headers;

/* Whether a comma-separated list has the item, or "*". Letters of either case are the same. */
bool list_has(const char *list, const char *item);
/* Whether `host` (a value of Host) is this machine's loopback: localhost, 127.0.0.0/8 or [::1]. */
bool host_is_loopback(const char *host);
/* Whether `origin` is where a page from `host` would come from. The scheme is not compared: a proxy
 * before us may speak TLS. */
bool origin_is_own(const char *origin, const char *host);

/* Refuses (403 in `why`) a name that is not ours: another site may have its name resolved to
 * 127.0.0.1. `local`: the daemon listens on loopback only. */
void browser_check_host(const browser_headers *h, const settings *set, bool local,
                        problem *why);
/* Refuses what a page of another site asks for. `is_page`: it only reads what anybody may follow a
 * link to. */
void browser_check_origin(const browser_headers *h, const settings *set, bool is_page,
                          problem *why);

#endif
