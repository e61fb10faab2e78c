/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * As much of the Redis protocol (RESP2) as a cache needs. Not hiredis: its 0.14 aborts where
 * memory runs out, waits anew for every piece of a reply, and takes a reply of any size.
 */
#ifndef CACHE_REDIS_H
#define CACHE_REDIS_H

#include <sys/socket.h>

#include "cache/key.h"

#define REDIS_WHY 128

/* Where a server is: an address, or the path of a socket. */
typedef struct redis_place {
    struct sockaddr_storage address;
    socklen_t size;
} redis_place;

typedef enum redis_reply {
    REDIS_BROKEN,    /* nothing usable came: close the connection */
    REDIS_TOO_LARGE, /* a value that was not read: close the connection */
    REDIS_REFUSED,   /* the server says why not */
    REDIS_DONE,
    REDIS_NOTHING, /* there is no such value */
    REDIS_VALUE
} redis_reply;

/* Time that only moves forward; what is awaited until then is given up. */
int64_t redis_now_ms(void);

/* A connection to host and port, or where `host` is empty to the socket at path `port`; each
 * address that the name stands for gets `wait_ms`. -1 with `why`. */
int redis_find(const char *host, const char *port, int wait_ms, redis_place *at,
               char why[REDIS_WHY]);
int redis_connect(const redis_place *at, int64_t until, char why[REDIS_WHY]);
/* Sends one command and awaits its reply. `value` (empty before) is that of REDIS_VALUE; it has
 * at most `most` bytes. `why` is set with REDIS_BROKEN and REDIS_REFUSED. */
redis_reply redis_ask(int fd, const key_part *words, size_t count, size_t most, int64_t until,
                      strbuf *value, char why[REDIS_WHY]);

#endif
