/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a service manager is told, by systemd's protocol (sd_notify(3)). */
#ifndef HTTP_SERVICE_NOTIFY_H
#define HTTP_SERVICE_NOTIFY_H

#include <stdint.h>

/* Sends "READY=1" and the like to the socket of NOTIFY_SOCKET, if there is one. Never waits. */
void notify_manager(const char *state);
/* The time within which the manager wants "WATCHDOG=1" again and again; 0: it does not. */
int64_t notify_watchdog_ms(void);

#endif
