/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cache/redis.h"

#include <ctype.h>
#include <errno.h>
#include <netdb.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/un.h>
#include <time.h>
#include <unistd.h>

/* So long a reply's first line may be. */
#define LINE_MOST 512
#define BLOCK     16384
#define LATE      "it did not answer in time"

int64_t redis_now_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

static bool say(char why[REDIS_WHY], const char *what)
{
    snprintf(why, REDIS_WHY, "%s", what);
    return false;
}

static bool await(int fd, short events, int64_t until, char why[REDIS_WHY])
{
    struct pollfd ready = {.fd = fd, .events = events};
    for (;;) {
        const int64_t left = until - redis_now_ms();
        const int got = poll(&ready, 1, left > 0 ? (int)left : 0);
        if (got > 0)
            return true;
        if (got < 0 && errno != EINTR)
            return say(why, strerror(errno));
        if (got == 0)
            return say(why, LATE);
    }
}

/* ---- connecting ---- */

static bool finish_connect(int fd, int64_t until, char why[REDIS_WHY])
{
    int error = errno;
    socklen_t size = sizeof error;
    if (error == EINPROGRESS) {
        if (!await(fd, POLLOUT, until, why))
            return false;
        if (getsockopt(fd, SOL_SOCKET, SO_ERROR, &error, &size) != 0)
            error = errno;
    }
    return error == 0 || say(why, strerror(error));
}

int redis_connect(const redis_place *at, int64_t until, char why[REDIS_WHY])
{
    const int fd = socket(at->address.ss_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (fd < 0) {
        say(why, strerror(errno));
        return -1;
    }
    const int on = 1; /* refused by a local socket, which needs none */
    setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    if (connect(fd, (const struct sockaddr *)&at->address, at->size) == 0 ||
        finish_connect(fd, until, why))
        return fd;
    close(fd);
    return -1;
}

int redis_find(const char *host, const char *port, int wait_ms, redis_place *at,
               char why[REDIS_WHY])
{
    int fd = -1;
    *at = (redis_place){0};
    if (!*host) {
        struct sockaddr_un *local = (struct sockaddr_un *)(void *)&at->address;
        local->sun_family = AF_UNIX;
        snprintf(local->sun_path, sizeof local->sun_path, "%s", port);
        at->size = sizeof *local;
        return redis_connect(at, redis_now_ms() + wait_ms, why);
    }
    struct addrinfo hints = {.ai_socktype = SOCK_STREAM}, *found = NULL;
    const int error = getaddrinfo(host, port, &hints, &found);
    if (error)
        say(why, gai_strerror(error));
    for (struct addrinfo *one = found; one && fd < 0; one = one->ai_next) {
        memcpy(&at->address, one->ai_addr, one->ai_addrlen);
        at->size = one->ai_addrlen;
        fd = redis_connect(at, redis_now_ms() + wait_ms, why);
    }
    if (found)
        freeaddrinfo(found);
    return fd;
}

/* ---- asking ---- */

static bool send_all(int fd, const strbuf *command, int64_t until, char why[REDIS_WHY])
{
    for (size_t sent = 0; sent < command->size;) {
        const ssize_t more = send(fd, command->data + sent, command->size - sent, MSG_NOSIGNAL);
        if (more > 0)
            sent += (size_t)more;
        else if (errno != EAGAIN && errno != EINTR)
            return say(why, strerror(errno));
        else if (!await(fd, POLLOUT, until, why))
            return false;
    }
    return true;
}

/* A command is a list of strings, each after its length. */
static bool send_words(int fd, const key_part *words, size_t count, int64_t until,
                       char why[REDIS_WHY])
{
    strbuf command = {0};
    strbuf_format(&command, "*%zu\r\n", count);
    for (size_t i = 0; i < count; i++) {
        strbuf_format(&command, "$%zu\r\n", words[i].size);
        strbuf_add(&command, words[i].bytes, words[i].size);
        strbuf_add(&command, "\r\n", 2);
    }
    const bool good =
        command.failed ? say(why, "out of memory") : send_all(fd, &command, until, why);
    strbuf_clear(&command);
    return good;
}

static bool receive(int fd, strbuf *got, int64_t until, char why[REDIS_WHY])
{
    char block[BLOCK];
    /* Checked here too: what drips fast enough is never waited for. */
    while (redis_now_ms() <= until) {
        const ssize_t more = recv(fd, block, sizeof block, 0);
        if (more > 0) {
            strbuf_add(got, block, (size_t)more);
            return !got->failed || say(why, "out of memory");
        }
        if (more == 0)
            return say(why, "it closed the connection");
        if (errno != EAGAIN && errno != EINTR)
            return say(why, strerror(errno));
        if (!await(fd, POLLIN, until, why))
            return false;
    }
    return say(why, LATE);
}

/* What follows "$": digits, or -1. False: neither. */
static bool read_length(const char *line, size_t size, long *length)
{
    char digits[16] = "", *end;
    if (size == 0 || size >= sizeof digits || (!isdigit((unsigned char)*line) && *line != '-'))
        return false;
    memcpy(digits, line, size);
    *length = strtol(digits, &end, 10);
    return *end == '\0' && *length >= -1;
}

/* Only a line's worth of what the server said, and printable: it goes into the log. */
static void quote(const char *line, size_t size, char why[REDIS_WHY])
{
    size_t i = 0;
    for (; i < size && i < REDIS_WHY - 1; i++)
        why[i] = line[i] >= ' ' && line[i] < 127 ? line[i] : '?';
    why[i] = '\0';
}

/* Takes the value out of a reply that is there as far as its first line, of `line` bytes. */
static redis_reply read_value(int fd, size_t line, size_t length, int64_t until, strbuf *got,
                              char why[REDIS_WHY])
{
    while (got->size < line + length + 2)
        if (!receive(fd, got, until, why))
            return REDIS_BROKEN;
    if (got->size > line + length + 2 || memcmp(got->data + line + length, "\r\n", 2) != 0) {
        say(why, "the reply is not as long as it says");
        return REDIS_BROKEN;
    }
    memmove(got->data, got->data + line, length);
    got->data[got->size = length] = '\0';
    return REDIS_VALUE;
}

redis_reply redis_ask(int fd, const key_part *words, size_t count, size_t most, int64_t until,
                      strbuf *value, char why[REDIS_WHY])
{
    const char *end = NULL;
    if (!send_words(fd, words, count, until, why))
        return REDIS_BROKEN;
    while (!end && value->size <= LINE_MOST) {
        if (!receive(fd, value, until, why))
            return REDIS_BROKEN;
        end = memchr(value->data, '\n', value->size);
    }
    const size_t line = end ? (size_t)(end + 1 - value->data) : 0;
    const bool whole = line >= 3 && end[-1] == '\r', alone = line == value->size;
    long length;
    if (whole && alone && value->data[0] == '+')
        return REDIS_DONE;
    if (whole && alone && value->data[0] == '-') {
        quote(value->data + 1, line - 3, why);
        return REDIS_REFUSED;
    }
    if (whole && value->data[0] == '$' && read_length(value->data + 1, line - 3, &length)) {
        if (length >= 0 && (size_t)length > most)
            return REDIS_TOO_LARGE;
        if (length >= 0)
            return read_value(fd, line, (size_t)length, until, value, why);
        if (alone)
            return REDIS_NOTHING;
    }
    say(why, "what it sends is not the Redis protocol");
    return REDIS_BROKEN;
}
