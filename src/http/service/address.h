/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Network addresses as text. */
#ifndef HTTP_SERVICE_ADDRESS_H
#define HTTP_SERVICE_ADDRESS_H

#include <stdbool.h>

/* Splits "[host]:port" or "host:port"; returns false for anything else. */
bool address_split(const char *address, char host[256], char port[16]);

#endif
