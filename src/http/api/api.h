/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The whole daemon: the table of paths, the service behind them, and the server before them. */
#ifndef HTTP_API_API_H
#define HTTP_API_API_H

#include "http/transport/server.h"

typedef struct api {
    service service;
    server server;
} api;

/* Starts all. Returns false with a sentence in `fault`; end with api_free in either case.
 * `settings` must outlive it. */
bool api_start(api *a, const settings *settings, char fault[256]);
void api_free(api *a);

#endif
