/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * From a request's first header to the function that answers it: reads the headers, refuses
 * what can be refused before the body is there, collects the body, and calls the route's
 * function. These are the transport's handlers (connections.h).
 */
#ifndef HTTP_API_DISPATCH_H
#define HTTP_API_DISPATCH_H

#include "http/transport/connections.h"

enum MHD_Result dispatch_begin(connection *p, const char *url, const char *verb,
                               const char *version);
enum MHD_Result dispatch_body(connection *p, const char *bytes, size_t size);
/* Called again when a suspended connection is resumed. */
enum MHD_Result dispatch_finish(connection *p);
void dispatch_end(connection *p);

#endif
