/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The target of a request: a path, or a whole URL as proxies are sent it. */
#ifndef HTTP_API_TARGET_H
#define HTTP_API_TARGET_H

#include <stdbool.h>

#define AUTHORITY_SIZE 256

typedef struct target {
    const char *path;               /* points into what was split, or is a constant */
    char authority[AUTHORITY_SIZE]; /* "name:port"; empty: a path alone was given */
} target;

/* Splits "http://name:port/path" (absolute-form, RFC 9112 3.2.2), which every server must take; what
 * is no such URL is its own path. `options`: a URL without a path then means the server, "*"
 * (3.2.4). Returns false for a URL without a host, with a user (RFC 9110 4.2.4), or with an
 * authority too long to be a name. */
bool target_split(const char *url, bool options, target *t);

#endif
