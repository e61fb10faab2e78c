/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/api/browser.h"

#include <arpa/inet.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

bool list_has(const char *list, const char *item)
{
    const size_t size = strlen(item);
    for (const char *at = list; *at;) {
        at += strspn(at, ", ");
        const size_t span = strcspn(at, ", ");
        if ((span == 1 && *at == '*') || (span == size && strncasecmp(at, item, size) == 0))
            return true;
        at += span;
    }
    return false;
}

/* Copies the name of "name:port" or "name"; returns false if it is neither. */
static bool name_of(const char *host, char name[256])
{
    const char *end = *host == '[' ? strchr(host, ']') : NULL;
    const size_t size = end ? (size_t)(end + 1 - host) : strcspn(host, ":");
    const char *port = host + size;
    if (size == 0 || size > 255 || (*port && *port != ':') ||
        (*port && strspn(port + 1, "0123456789") != strlen(port + 1)))
        return false;
    memcpy(name, host, size);
    name[size] = '\0';
    return true;
}

bool host_is_loopback(const char *host)
{
    char name[256];
    struct in_addr address;
    if (!name_of(host, name))
        return false;
    if (strcasecmp(name, "localhost") == 0 || strcmp(name, "[::1]") == 0)
        return true;
    return inet_pton(AF_INET, name, &address) == 1 && ntohl(address.s_addr) >> 24 == 127;
}

/* Returns the size of `authority` without a port that goes without saying. */
static size_t without_port(const char *authority, const char *port)
{
    const size_t size = strlen(authority), ending = strlen(port);
    return size > ending && strcmp(authority + size - ending, port) == 0 ? size - ending : size;
}

bool origin_is_own(const char *origin, const char *host)
{
    const bool tls = strncasecmp(origin, "https://", 8) == 0;
    if (!tls && strncasecmp(origin, "http://", 7) != 0)
        return false; /* "null" among others */
    const char *authority = origin + (tls ? 8 : 7), *port = tls ? ":443" : ":80";
    const size_t size = without_port(authority, port);
    return size == without_port(host, port) && strncasecmp(authority, host, size) == 0;
}

void browser_check_host(const browser_headers *h, const settings *set, bool local, problem *why)
{
    char name[256];
    if ((!local && !*set->allowed_hosts) || !h->host || host_is_loopback(h->host))
        return;
    if (!name_of(h->host, name) || !list_has(set->allowed_hosts, name))
        problem_set(
            why, 403,
            "Host is \"%.80s\", which is not a name of this daemon; if it is meant, add "
            "it to the setting allowed_hosts",
            h->host);
}

/* A link that somebody followed. */
static bool is_followed(const browser_headers *h)
{
    return h->mode && strcmp(h->mode, "navigate") == 0 && h->dest &&
           strcmp(h->dest, "document") == 0;
}

void browser_check_origin(const browser_headers *h, const settings *set, bool is_page,
                          problem *why)
{
    const char *allowed = set->cors_origins;
    /* A page that hides where it is from has a browser hide its origin too; no page can forge the
     * other header. */
    const bool hidden = h->origin && strcmp(h->origin, "null") == 0 && h->site &&
                        strcmp(h->site, "same-origin") == 0;
    if (h->origin && !hidden && !origin_is_own(h->origin, h->host ? h->host : "") &&
        !list_has(allowed, h->origin)) {
        problem_set(why, 403,
                    "pages of %.80s may not ask; if they are meant, add it to the setting "
                    "cors_origins",
                    h->origin);
    } else if (!h->origin && h->site && strcmp(h->site, "cross-site") == 0 &&
               !list_has(allowed, "*") && !(is_page && is_followed(h))) {
        problem_set(why, 403, "a page of another site may not ask");
    }
}
