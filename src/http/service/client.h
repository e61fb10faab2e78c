/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Who asks, for shares of workers and places. */
#ifndef HTTP_SERVICE_CLIENT_H
#define HTTP_SERVICE_CLIENT_H

#include <sys/socket.h>

/* Clients are told apart by so many numbers; those that meet in one have a share together. */
#define CLIENTS 256

/* By the value of Authorization (NULL: there is none), or else by the address: of IPv6 the first 64
 * bits, which one site has. */
unsigned client_of(const struct sockaddr *address, const char *authorization);

#endif
