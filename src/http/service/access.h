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

#endif
