/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/service/client.h"

#include <netinet/in.h>
#include <stdint.h>
#include <string.h>

/* FNV-1a. Who chooses addresses or tokens so that they meet takes a share only from himself and
 * those he meets. */
static unsigned number_of(const void *bytes, size_t size)
{
    uint32_t hash = 2166136261U;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ ((const unsigned char *)bytes)[i]) * 16777619U;
    return (hash ^ hash >> 16) % CLIENTS;
}

unsigned client_of(const struct sockaddr *address, const char *authorization)
{
    if (authorization)
        return number_of(authorization, strlen(authorization));
    if (address && address->sa_family == AF_INET) {
        struct sockaddr_in four;
        memcpy(&four, address, sizeof four);
        return number_of(&four.sin_addr, sizeof four.sin_addr);
    }
    if (address && address->sa_family == AF_INET6) {
        struct sockaddr_in6 six;
        memcpy(&six, address, sizeof six);
        return number_of(&six.sin6_addr, 8);
    }
    return 0;
}
