/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which clients may ask: bearer tokens (RFC 6750) from a file, one a line. Only their digests
 * are kept. */
#ifndef HTTP_SERVICE_ACCESS_H
#define HTTP_SERVICE_ACCESS_H

#include <stdbool.h>

typedef struct access_list access_list;

/* Skips lines that are empty or begin with #. Returns NULL with a sentence in `fault`. */
access_list *access_read(const char *path, char fault[256]);
/* Reads the file again. Returns false with a sentence in `fault`; the tokens read before then still
 * hold. While other threads ask access_allows. */
bool access_reload(access_list *a, char fault[256]);
void access_free(access_list *a);
/* Decides by the value of Authorization (NULL: there was none). Without a list (NULL `a`) every
 * client may ask. */
bool access_allows(access_list *a, const char *authorization);

/* The name and the size of a cookie that stands for a token without being it. It is the same on all
 * daemons with that token, and holds as long as the token is in the file. */
#define ACCESS_COOKIE      "strum"
#define ACCESS_COOKIE_SIZE 65
/* Writes the cookie's value; returns false if the token is not known. */
bool access_cookie(access_list *a, const char *token, char value[ACCESS_COOKIE_SIZE]);
/* Decides by the value of Cookie (NULL: there was none). */
bool access_allows_cookie(access_list *a, const char *cookies);

#endif
