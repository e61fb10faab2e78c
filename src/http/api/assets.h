/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files of the page, in the program's own read-only memory. The table is written at build time
 * by src/dashboard/embed.py; without the dashboard (-Ddashboard=false) it is empty. */
#ifndef HTTP_API_ASSETS_H
#define HTTP_API_ASSETS_H

#include <stddef.h>

typedef struct asset {
    const char *path; /* "/assets/main.js" */
    const char *type;
    const char *hex; /* SHA-256 of the bytes: the ETag */
    const unsigned char *bytes, *bytes_end;
    const unsigned char *gzip, *gzip_end; /* the same, compressed */
} asset;

/* Ended by path NULL. */
extern const asset assets[];

#endif
