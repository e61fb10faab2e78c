/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/transport/listen.h"

#include <errno.h>
#include <netdb.h>      /* getaddrinfo */
#include <netinet/in.h> /* in6addr_loopback */
#include <netinet/tcp.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "http/service/address.h"

/* A burst of new connections waits here; the kernel's limit may be lower. */
#define LISTEN_BACKLOG 1024

/* Bytes that the kernel takes of an answer beyond what is on its way. Without a limit it takes
 * megabytes, holds them for who does not read, and asks for more only when a third is gone: from
 * a client that reads steadily but slowly nothing is heard for longer than request_timeout_s. */
#define UNSENT_MOST 65536

/* Accepted sockets inherit it. */
static void limit_unsent(int fd)
{
    const int most = UNSENT_MOST;
    setsockopt(fd, IPPROTO_TCP, TCP_NOTSENT_LOWAT, &most, sizeof most);
}

static bool is_loopback(const struct sockaddr *address)
{
    if (address->sa_family == AF_INET)
        return ntohl(((const struct sockaddr_in *)(const void *)address)->sin_addr.s_addr) >>
                   24 ==
               127;
    return address->sa_family == AF_INET6 &&
           IN6_IS_ADDR_LOOPBACK(
               &((const struct sockaddr_in6 *)(const void *)address)->sin6_addr);
}

static void name_of(int fd, listen_at *at)
{
    struct sockaddr_storage address = {0};
    socklen_t size = sizeof address;
    char host[64] = "?", port[16] = "0";
    if (getsockname(fd, (struct sockaddr *)&address, &size) == 0)
        getnameinfo((struct sockaddr *)&address, size, host, sizeof host, port, sizeof port,
                    NI_NUMERICHOST | NI_NUMERICSERV);
    at->loopback = is_loopback((struct sockaddr *)&address);
    sscanf(port, "%d", &at->port);
    snprintf(at->name, sizeof at->name, address.ss_family == AF_INET6 ? "[%s]:%s" : "%s:%s",
             host, port);
}

static int bind_to(const struct addrinfo *address)
{
    const int fd = socket(address->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (fd < 0)
        return -1;
    const int on = 1;
    /* A restart must not wait for old connections to time out. */
    setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    if (address->ai_family == AF_INET6)
        setsockopt(fd, IPPROTO_IPV6, IPV6_V6ONLY, &on, sizeof on);
    if (bind(fd, address->ai_addr, address->ai_addrlen) == 0)
        return fd;
    const int why = errno;
    close(fd);
    errno = why;
    return -1;
}

/* The first descriptor passed, by sd_listen_fds(3). */
#define PASSED_FD 3

/* Returns whether sockets are passed; *number is how many. */
static bool is_passed(long *number)
{
    const char *pid = getenv("LISTEN_PID"), *count = getenv("LISTEN_FDS");
    *number = count ? strtol(count, NULL, 10) : 0;
    return pid && strtol(pid, NULL, 10) == (long)getpid() && *number > 0;
}

static bool take_passed(long number, bool allow_any, listen_at *at, char fault[256])
{
    struct sockaddr_storage address = {0};
    socklen_t size = sizeof address, flag_size = sizeof(int);
    int accepts = 0;
    const int flags = fcntl(PASSED_FD, F_GETFL);
    const bool good =
        number == 1 && flags >= 0 &&
        getsockopt(PASSED_FD, SOL_SOCKET, SO_ACCEPTCONN, &accepts, &flag_size) == 0 &&
        accepts && getsockname(PASSED_FD, (struct sockaddr *)&address, &size) == 0 &&
        (address.ss_family == AF_INET || address.ss_family == AF_INET6);
    if (!good) {
        snprintf(fault, 256, "LISTEN_FDS: one listening TCP socket is taken, as descriptor %d",
                 PASSED_FD);
    } else if (!allow_any && !is_loopback((struct sockaddr *)&address)) {
        snprintf(fault, 256,
                 "LISTEN_FDS: the socket can be reached from other machines; set "
                 "token_file, or allow_non_loopback if anybody may ask");
    } else if (fcntl(PASSED_FD, F_SETFL, flags | O_NONBLOCK) < 0 ||
               fcntl(PASSED_FD, F_SETFD, FD_CLOEXEC) < 0) {
        snprintf(fault, 256, "LISTEN_FDS: %s", strerror(errno));
    } else {
        *at = (listen_at){.fd = PASSED_FD, .inherited = true};
        limit_unsent(at->fd);
        name_of(at->fd, at);
    }
    return at->fd >= 0;
}

/* Returns the addresses of `where`, for freeaddrinfo, or NULL with a sentence in `fault`. */
static struct addrinfo *resolve(const char *where, bool allow_any, char fault[256])
{
    char host[256], port[16];
    if (!address_split(where, host, port)) {
        snprintf(fault, 256, "listen must be address:port or [address]:port, not \"%.100s\"",
                 where);
        return NULL;
    }
    struct addrinfo hints = {.ai_socktype = SOCK_STREAM, .ai_flags = AI_PASSIVE};
    struct addrinfo *found = NULL;
    const int error = getaddrinfo(host, port, &hints, &found);
    if (error) {
        snprintf(fault, 256, "listen: %.100s: %s", host, gai_strerror(error));
        return NULL;
    }
    if (allow_any || is_loopback(found->ai_addr))
        return found;
    snprintf(fault, 256,
             "listen: %.100s can be reached from other machines; set token_file, or "
             "allow_non_loopback if anybody may ask",
             where);
    freeaddrinfo(found);
    return NULL;
}

static void note_error(const char *where, char fault[256])
{
    snprintf(fault, 256, "listen: %.100s: %s", where, strerror(errno));
}

bool listen_open(const char *where, bool allow_any, listen_at *at, char fault[256])
{
    long passed;
    *at = (listen_at){.fd = -1};
    if (is_passed(&passed))
        return take_passed(passed, allow_any, at, fault);
    struct addrinfo *found = resolve(where, allow_any, fault);
    if (!found)
        return false;
    at->fd = bind_to(found);
    freeaddrinfo(found);
    if (at->fd >= 0 && listen(at->fd, LISTEN_BACKLOG) == 0) {
        name_of(at->fd, at);
        limit_unsent(at->fd);
        return true;
    }
    note_error(where, fault);
    if (at->fd >= 0)
        close(at->fd);
    at->fd = -1;
    return false;
}

bool listen_check(const char *where, bool allow_any, char fault[256])
{
    struct addrinfo *found = resolve(where, allow_any, fault);
    if (!found)
        return false;
    const int fd = bind_to(found);
    const bool good = fd >= 0 || errno == EADDRINUSE;
    if (!good)
        note_error(where, fault);
    freeaddrinfo(found);
    if (fd >= 0)
        close(fd);
    return good;
}
