/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the function and the methods of a path, in a table passed from above. */
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

typedef enum MHD_Result route_function(struct connection *p);

/* A path served beside the endpoints. A table of them ends with path NULL; the function there
 * serves the endpoints. */
typedef struct page {
    const char *path;
    const char *rest; /* the path ends in "/" and stands for all below, named so; or NULL */
    route_function *serve;
    unsigned methods; /* beside OPTIONS */
    bool open;        /* needs no token */
    bool batch;       /* larger bodies, and lines too */
    bool form;        /* its body is a form of a page */
} page;

typedef struct route {
    const char *path; /* for metrics; "other" where nothing is */
    unsigned methods;
    const endpoint *endpoint; /* of an endpoint */
    bool open;                /* needs no token */
    bool batch;               /* larger bodies, and lines too */
    bool form;                /* its body is a form of a page */
    const char *rest;         /* of the path, where `path` ends in "/" */
    size_t index;             /* of the route's counters */
    route_function *serve;    /* NULL: nothing there */
} route;

/* Methods are case-sensitive (RFC 9110 9.1). */
method method_of(const char *verb);
/* "GET, HEAD, OPTIONS" */
void method_list(unsigned methods, char list[64]);

route route_find(const page *pages, const char *url);
/* All of them: pages, endpoints, and a last one for any other path. */
size_t route_count(const page *pages);
const char *route_path(const page *pages, size_t index);
/* For a 404: the nearest known path or NULL, and all of them. */
const char *route_near(const page *pages, const char *url);
void route_list(const page *pages, strbuf *out);

#endif
