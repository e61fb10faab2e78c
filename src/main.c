/* SPDX-License-Identifier: GPL-3.0-or-later */
/* strumd: settings, start, wait for a signal, drain, stop. */
#include <fcntl.h>
#include <malloc.h>
#include <signal.h>
#include <stdio.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include "blas_memory.h"
#include "http/api/api.h"
#include "http/service/log.h"
#include "http/service/settings.h"

extern char **environ;

/* A reader of the log that is stuck does not keep the process from ending. */
#define LAST_LINES_MS 1000

/* Without them, the log would be written into the first connection or file that gets their
 * number. */
static void open_standard_descriptors(void)
{
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++)
        if (fcntl(fd, F_GETFD) < 0 && open("/dev/null", O_RDWR) < 0)
            _exit(1);
}

/* Returns a descriptor for those that mean something here. The others that would end the process
 * without a fault of its own are ignored: a stray one is no reason to stop. SIGQUIT is left as it
 * is, for a core. */
static int take_signals(void)
{
    static const int ours[] = {SIGTERM, SIGINT, SIGHUP};
    static const int strays[] = {SIGPIPE, SIGUSR1, SIGUSR2,   SIGALRM, SIGVTALRM,
                                 SIGPROF, SIGIO,   SIGSTKFLT, SIGPWR,  SIGXFSZ};
    sigset_t taken;
    sigemptyset(&taken);
    for (size_t i = 0; i < sizeof ours / sizeof *ours; i++)
        sigaddset(&taken, ours[i]);
    /* Before any thread begins: they inherit it, and the signals come to the descriptor only. */
    pthread_sigmask(SIG_BLOCK, &taken, NULL);
    for (size_t i = 0; i < sizeof strays / sizeof *strays; i++)
        signal(strays[i], SIG_IGN);
    for (int number = SIGRTMIN; number <= SIGRTMAX; number++)
        signal(number, SIG_IGN);
    return signalfd(-1, &taken, SFD_CLOEXEC | SFD_NONBLOCK);
}

/* Opens what the settings name, and lets go of it again. Returns the exit status. */
static int check(const settings *set)
{
    strbuf faults = {0}, notes = {0};
    char fault[256];
    service_check(set, &faults, &notes);
    if (!listen_check(set->listen, set->allow_non_loopback || *set->token_file, fault))
        strbuf_format(&faults, "%s\n", fault);
    const bool good = faults.size == 0 && !faults.failed;
    if (notes.data)
        fputs(notes.data, stdout);
    if (good)
        puts("settings are good");
    else
        fputs(faults.data ? faults.data : "out of memory\n", stderr);
    strbuf_clear(&faults);
    strbuf_clear(&notes);
    return good ? 0 : 2;
}
/* Answers and arrays larger than this come from the system and go back to it at once. Left to itself
 * glibc raises the limit with each that is freed, and holes among stored answers add up. */
#define LARGE_BLOCK (64 << 10)

static int serve(const settings *set)
{
    api daemon;
    char fault[256];
    const int signals = take_signals();
    bool clean = false;
    log_start();
    daemon = (api){.server.at.fd = -1};
    if (!blas_memory_start()) {
        log_say("error", "start",
                "no address space for a buffer of BLAS (128 MB): raise the limit");
    } else if (api_start(&daemon, set, fault)) {
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
        if (!clean && service_solving(&daemon.service)) {
            log_flush(LAST_LINES_MS);
            _exit(1);
        }
    } else {
        log_say("error", "start", "%s", fault);
    }
    api_free(&daemon);
    close(signals);
    log_flush(LAST_LINES_MS);
    return clean ? 0 : 1;
}

int main(int argc, char *argv[])
{
    (void)mallopt(M_MMAP_THRESHOLD, LARGE_BLOCK);
    settings set;
    settings_action action;
    strbuf faults = {0};
    int code = 0;
    open_standard_descriptors();
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
        code = check(&set);
    } else {
        code = serve(&set);
    }
    strbuf_clear(&faults);
    settings_clear(&set);
    return code;
}
