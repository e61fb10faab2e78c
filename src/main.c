/* SPDX-License-Identifier: GPL-3.0-or-later */
/* strumd: settings, start, wait for a signal, drain, stop. */
#include <malloc.h>
#include <signal.h>
#include <stdio.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include "http/api/api.h"
#include "http/service/log.h"
#include "http/service/settings.h"

extern char **environ;

/* Answers and arrays larger than this come from the system and go back to it at once. Left to itself
 * glibc raises the limit with each that is freed, and holes among stored answers add up. */
#define LARGE_BLOCK (64 << 10)

static int serve(const settings *set)
{
    api daemon;
    char fault[256];
    sigset_t ends;
    sigemptyset(&ends);
    sigaddset(&ends, SIGTERM);
    sigaddset(&ends, SIGINT);
    /* Before any thread begins: they inherit it, and the signals come to the descriptor only.
     */
    pthread_sigmask(SIG_BLOCK, &ends, NULL);
    signal(SIGPIPE, SIG_IGN);
    const int signals = signalfd(-1, &ends, SFD_CLOEXEC | SFD_NONBLOCK);
    bool clean = false;
    if (api_start(&daemon, set, fault)) {
        log_line line;
        json_writer *json = log_open(&line, "info", "listening");
        json_put_string(json, "address", daemon.server.at.name);
        json_put_integer(json, "port", daemon.server.at.port);
        json_put_string(json, "version", STRUM_DAEMON_VERSION);
        log_close(&line);
        clean = server_run(&daemon.server, signals);
        log_say(clean ? "info" : "warning", "stopped", "%s",
                clean ? "all requests were finished" : "requests were cut short");
        /* Nobody waits for what a worker still solves, and it may take long: the process ends
         * with it instead of waiting for it to be freed. */
        if (!clean && service_solving(&daemon.service))
            _exit(1);
    } else {
        log_say("error", "start", "%s", fault);
    }
    api_free(&daemon);
    close(signals);
    return clean ? 0 : 1;
}

int main(int argc, char *argv[])
{
    (void)mallopt(M_MMAP_THRESHOLD, LARGE_BLOCK);
    settings set;
    settings_action action;
    strbuf faults = {0};
    int code = 0;
    if (!settings_read(&set, argc, argv, environ, &action, &faults)) {
        fputs(faults.data ? faults.data : "out of memory\n", stderr);
        code = 2;
    } else if (action == SETTINGS_HELP) {
        settings_help(stdout);
    } else if (action == SETTINGS_MAN) {
        settings_man(STRUM_DAEMON_VERSION, stdout);
    } else if (action == SETTINGS_VERSION) {
        puts("strumd " STRUM_DAEMON_VERSION);
    } else if (action == SETTINGS_PRINT) {
        settings_print(&set, stdout);
    } else if (action == SETTINGS_CHECK) {
        puts("settings are good");
    } else {
        code = serve(&set);
    }
    strbuf_clear(&faults);
    settings_clear(&set);
    return code;
}
