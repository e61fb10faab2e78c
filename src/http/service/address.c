/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/service/address.h"

#include <stdio.h>
#include <string.h>

bool address_split(const char *address, char host[256], char port[16])
{
    const char *colon = strrchr(address, ':');
    if (!colon || colon == address || !colon[1] || strlen(colon + 1) > 5 ||
        strspn(colon + 1, "0123456789") != strlen(colon + 1))
        return false;
    size_t size = (size_t)(colon - address);
    const bool bracketed = address[0] == '[' && colon[-1] == ']';
    if (bracketed) {
        address++;
        size -= 2;
    }
    if (size == 0 || size > 255 || (!bracketed && memchr(address, ':', size)))
        return false;
    snprintf(host, 256, "%.*s", (int)size, address);
    snprintf(port, 16, "%s", colon + 1);
    return true;
}
