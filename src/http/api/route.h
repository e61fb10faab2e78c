/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which path is served by whom, and by which methods. */
#ifndef HTTP_API_ROUTE_H
#define HTTP_API_ROUTE_H

#include <microhttpd.h>

#include "endpoints/endpoint.h"

typedef enum method {
    METHOD_GET = 1 << 0,
    METHOD_HEAD = 1 << 1,
    METHOD_POST = 1 << 2,
    METHOD_QUERY = 1 << 3,
    METHOD_OPTIONS = 1 << 4,
    METHOD_OTHER = 1 << 5, /* HTTP's, but served nowhere: PUT, PATCH, DELETE, TRACE, CONNECT */
    METHOD_UNKNOWN = 1 << 6,
    METHOD_ALL = METHOD_OTHER - 1
} method;

struct connection;

typedef struct route {
    const char *path; /* for metrics; "other" where nothing is */
    unsigned methods;
    const endpoint *endpoint;                       /* of an endpoint */
    bool open;                                      /* needs no token */
    bool batch;                                     /* larger bodies, and lines too */
    const char *rest;                               /* of the path, where `path` ends in "/" */
    size_t index;                                   /* of the route's counters */
    enum MHD_Result (*serve)(struct connection *p); /* NULL: nothing there */
} route;

/* Methods are case-sensitive (RFC 9110 9.1). */
method method_of(const char *verb);
/* "GET, HEAD, OPTIONS" */
void method_list(unsigned methods, char list[64]);

route route_find(const char *url);
size_t route_count(void);
const char *route_path(size_t index);
/* For a 404: the nearest known path or NULL, and all of them. */
const char *route_near(const char *url);
void route_list(strbuf *out);

#endif
