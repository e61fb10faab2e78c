/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The server in this process, so that memory can run out beneath it: whatever allocation fails,
 * a request is answered rightly, refused as a problem, or its connection is closed. */
#include <arpa/inet.h>
#include <cjson/cJSON.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include "http/api/api.h"

#include "check.h"

/* ---- allocations: counted, and refused from the one chosen on ---- */

#define NEVER 1000000
static atomic_long allocations, fails_from = NEVER;
static atomic_bool only_once;

static bool refuse_memory(void)
{
    const long number = atomic_fetch_add(&allocations, 1);
    return only_once ? number == fails_from : number >= fails_from;
}

#include "failing_memory.h"

/* ---- a server ---- */

typedef struct running {
    settings settings;
    api api;
    int signals;
    pthread_t thread;
    bool clean;
} running;

static void *run(void *argument)
{
    running *r = argument;
    r->clean = server_run(&r->api.server, r->signals);
    return NULL;
}

static int start(void **state)
{
    running *r = calloc(1, sizeof *r);
    strbuf faults = {0};
    char fault[256];
    settings_action action;
    char *argv[] = {(char[]){"strumd"},
                    (char[]){"--listen=127.0.0.1:0"},
                    (char[]){"--workers=1"},
                    (char[]){"--log-requests=none"},
                    (char[]){"--store=unix:/nowhere/socket"},
                    NULL};
    char *environment[] = {NULL};
    sigset_t ends;
    sigemptyset(&ends);
    sigaddset(&ends, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &ends, NULL);
    *state = r;
    if (!r || !settings_read(&r->settings, 5, argv, environment, &action, &faults))
        return -1;
    r->signals = signalfd(-1, &ends, SFD_NONBLOCK | SFD_CLOEXEC);
    if (!api_start(&r->api, &r->settings, fault)) {
        print_error("%s\n", fault);
        return -1;
    }
    /* cJSON takes its memory through the same gate. */
    cJSON_Hooks hooks = {.malloc_fn = __wrap_malloc, .free_fn = free};
    cJSON_InitHooks(&hooks);
    return pthread_create(&r->thread, NULL, run, r);
}

static int stop(void **state)
{
    running *r = *state;
    kill(getpid(), SIGTERM);
    pthread_join(r->thread, NULL);
    api_free(&r->api);
    close(r->signals);
    settings_clear(&r->settings);
    const bool clean = r->clean;
    free(r);
    return clean ? 0 : -1;
}

static int dial(const running *r)
{
    const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const struct sockaddr_in address = {.sin_family = AF_INET,
                                        .sin_port = htons((uint16_t)r->api.server.at.port),
                                        .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    assert_int_equal(connect(fd, (const struct sockaddr *)&address, sizeof address), 0);
    return fd;
}

/* The status of an answer that is whole and says what it must; 0: the connection was closed. */
static int exchange(int fd, const char *question)
{
    char got[65536];
    size_t size = 0;
    assert_int_equal(send(fd, question, strlen(question), MSG_NOSIGNAL),
                     (ssize_t)strlen(question));
    for (;;) {
        const ssize_t more = recv(fd, got + size, sizeof got - 1 - size, 0);
        if (more <= 0)
            break;
        size += (size_t)more;
        got[size] = '\0';
        const char *body = strstr(got, "\r\n\r\n"),
                   *length = strstr(got, "\r\nContent-Length: ");
        if (body && length && size >= (size_t)(body + 4 - got) + strtoul(length + 18, NULL, 10))
            break;
    }
    if (size == 0)
        return 0;
    const int status = atoi(got + 9);
    if (status == 200)
        assert_non_null(strstr(got, "\"frequency_ratio\":"));
    else
        assert_non_null(strstr(got, "\r\nContent-Type: application/problem+json\r\n"));
    return status;
}

/* ---- memory that runs out ---- */

/* Asks with a body of `begin`, a number not asked before and `end`, while each allocation in
 * turn fails. */
static void survives(running *r, const char *begin, const char *end, int wanted)
{
    static int fresh = 10000;
    int answered = 0;
    for (long n = 0; answered < 3; n++) {
        assert_true(n < 2000);
        char question[1024];
        snprintf(question, sizeof question,
                 "POST /v1/catenary/frequencies HTTP/1.1\r\nHost: localhost\r\n"
                 "Content-Type: application/json\r\nContent-Length: %zu\r\n\r\n%s%d%s",
                 strlen(begin) + 5 + strlen(end), begin, ++fresh, end);
        const int fd = dial(r);
        /* The connection is there: what fails now is the request's. */
        assert_int_equal(exchange(fd, "GET /nothing HTTP/1.1\r\nHost: localhost\r\n\r\n"), 404);
        allocations = 0;
        fails_from = n;
        const int status = exchange(fd, question);
        fails_from = NEVER;
        if (status != wanted && status != 500 && status != 503 && status != 0)
            fail_msg("status %d where allocation %ld fails", status, n);
        close(fd);
        answered = status == wanted ? answered + 1 : 0;
        /* And all is well again. */
        const int again = dial(r);
        assert_int_equal(exchange(again, question), wanted);
        close(again);
    }
}

static void answers(running *r)
{
    for (int at_once = 0; at_once < 2; at_once++) {
        r->settings.inline_us = at_once ? 1e6 : 0;
        survives(r, "{\"modes\":2,\"sag_parameter\":0.9", "}", 200);
    }
}

static void an_answer_without_memory(void **state)
{
    only_once = false;
    answers(*state);
}

static void an_answer_with_one_failure(void **state)
{
    only_once = true;
    answers(*state);
}

static void a_refusal_without_memory(void **state)
{
    only_once = false;
    survives(*state, "{\"rise_to_spam\":", ",\"sag_parameter\":7}", 400);
    survives(*state, "{\"span_m\":1e6,\"length_m\":", "}", 422);
    only_once = true;
    survives(*state, "{\"rise_to_spam\":", ",\"sag_parameter\":7}", 400);
}

/* A worker looks for it in the shared store. */
static void a_key_without_memory(void **state)
{
    const running *r = *state;
    char question[256];
    snprintf(question, sizeof question, "GET /v1/results/%064d HTTP/1.1\r\nHost: localhost\r\n\r\n", 0);
    for (int once = 0; once < 2; once++) {
        only_once = once;
        int answered = 0;
        for (long n = 0; answered < 3; n++) {
            assert_true(n < 200);
            const int fd = dial(r);
            assert_int_equal(exchange(fd, question), 404);
            allocations = 0;
            fails_from = n;
            const int status = exchange(fd, question);
            fails_from = NEVER;
            if (status != 404 && status != 500 && status != 503 && status != 0)
                fail_msg("status %d where allocation %ld fails", status, n);
            close(fd);
            answered = status == 404 ? answered + 1 : 0;
        }
    }
}

/* A server that cannot begin says so. */
static void a_start_without_memory(void **state)
{
    const running *r = *state;
    bool started = false;
    for (long n = 0; !started; n++) {
        assert_true(n < 100);
        api a;
        char fault[256] = "";
        only_once = true;
        allocations = 0;
        fails_from = n;
        started = api_start(&a, &r->settings, fault);
        fails_from = NEVER;
        if (!started)
            assert_true(fault[0] != '\0');
        api_free(&a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_start_without_memory),
        cmocka_unit_test(an_answer_without_memory),
        cmocka_unit_test(an_answer_with_one_failure),
        cmocka_unit_test(a_refusal_without_memory),
        cmocka_unit_test(a_key_without_memory),
    };
    return cmocka_run_group_tests(tests, start, stop);
}
