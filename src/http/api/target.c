/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/api/target.h"

#include <string.h>
#include <strings.h>

bool target_split(const char *url, bool options, target *t)
{
    t->path = url;
    t->authority[0] = '\0';
    const size_t scheme = strncasecmp(url, "http://", 7) == 0    ? 7
                          : strncasecmp(url, "https://", 8) == 0 ? 8
                                                                 : 0;
    if (scheme == 0)
        return true;
    const char *authority = url + scheme;
    const size_t size = strcspn(authority, "/");
    if (size == 0 || size >= sizeof t->authority || *authority == ':' ||
        memchr(authority, '@', size) != NULL)
        return false;
    memcpy(t->authority, authority, size);
    t->authority[size] = '\0';
    t->path = authority[size] == '/' ? authority + size : options ? "*" : "/";
    return true;
}
