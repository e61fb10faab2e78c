/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Settings: their sources in order, every fault at once, and that what is printed reads back.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "http/service/settings.h"

#include "check.h"

typedef struct told {
    settings settings;
    settings_action action;
    strbuf faults;
    bool good;
} told;

static told tell(const char *const *flags, const char *const *environment)
{
    told t = {0};
    char *argv[16] = {(char *)(uintptr_t) "strumd"}, *env[16] = {NULL};
    int argc = 1;
    for (; flags && flags[argc - 1]; argc++)
        argv[argc] = (char *)(uintptr_t)flags[argc - 1];
    for (int i = 0; environment && environment[i]; i++)
        env[i] = (char *)(uintptr_t)environment[i];
    t.good = settings_read(&t.settings, argc, argv, env, &t.action, &t.faults);
    if (t.good)
        assert_null(t.faults.data);
    else
        assert_non_null(t.faults.data);
    return t;
}

static void told_clear(told *t)
{
    settings_clear(&t->settings);
    strbuf_clear(&t->faults);
}

#define FLAGS(...) ((const char *const[]){__VA_ARGS__, NULL})

/* A file with `content`; the caller removes it. */
static void write_file(char path[64], const char *content)
{
    snprintf(path, 64, "/tmp/strum-settings-XXXXXX");
    const int fd = mkstemp(path);
    assert_true(fd >= 0);
    assert_int_equal(write(fd, content, strlen(content)), (ssize_t)strlen(content));
    close(fd);
}

static void defaults_are_safe(void **state)
{
    (void)state;
    told t = tell(NULL, NULL);
    assert_true(t.good);
    assert_int_equal(t.action, SETTINGS_RUN);
    assert_string_equal(t.settings.listen, "127.0.0.1:8080");
    assert_false(t.settings.allow_non_loopback);
    assert_string_equal(t.settings.cors_origins, "");
    assert_int_equal(t.settings.cache_bytes, 64 << 20);
    assert_int_equal(t.settings.body_bytes, 64 << 10);
    check_relative(t.settings.inline_us, 250, 0);
    assert_int_equal(t.settings.log_requests, LOG_ERRORS);
    told_clear(&t);
}

static void later_sources_win(void **state)
{
    (void)state;
    char path[64];
    write_file(path, "# a comment\n\n  workers = 3\nevent-threads=4\nretry_after_s = 5\n");
    char config[80];
    snprintf(config, sizeof config, "STRUM_CONFIG=%s", path);
    const char *const environment[] = {config, "STRUM_EVENT_THREADS=6", "STRUM_RETRY_AFTER_S=7",
                                       "HOME=/", NULL};
    told t = tell(FLAGS("--retry-after-s", "8"), environment);
    assert_true(t.good);
    assert_int_equal(t.settings.workers, 3);
    assert_int_equal(t.settings.event_threads, 6);
    assert_int_equal(t.settings.retry_after_s, 8);
    told_clear(&t);
    /* --config wins over STRUM_CONFIG */
    const char *const elsewhere[] = {"STRUM_CONFIG=/nowhere", NULL};
    t = tell(FLAGS("--config", path), elsewhere);
    assert_true(t.good);
    assert_int_equal(t.settings.workers, 3);
    told_clear(&t);
    unlink(path);
}

static void every_kind_is_read(void **state)
{
    (void)state;
    told t = tell(FLAGS("--listen=[::1]:0", "--allow-non-loopback", "--cache-bytes", "2MiB",
                        "--body_bytes=1k", "--idle-timeout-s", "0.5", "--log-requests=all"),
                  NULL);
    assert_true(t.good);
    assert_string_equal(t.settings.listen, "[::1]:0");
    assert_true(t.settings.allow_non_loopback);
    assert_int_equal(t.settings.cache_bytes, 2 << 20);
    assert_int_equal(t.settings.body_bytes, 1024);
    check_relative(t.settings.idle_timeout_s, 0.5, 0);
    assert_int_equal(t.settings.log_requests, LOG_ALL);
    told_clear(&t);
    t = tell(FLAGS("--allow-non-loopback=no"), NULL);
    assert_false(t.settings.allow_non_loopback);
    told_clear(&t);
}

static void every_fault_is_named_at_once(void **state)
{
    (void)state;
    char path[64];
    write_file(path, "cach_bytes = 5\nworkers = -1\nno equals sign\n");
    const char *const environment[] = {"STRUM_LISTN=x", "STRUM_WORKERS=many", NULL};
    told t = tell(FLAGS("--config", path, "--event-threads", "0", "--log-requests=some",
                        "stray", "--retry-after-s"),
                  environment);
    assert_false(t.good);
    static const char *const wanted[] = {
        ":1: unknown setting \"cach_bytes\"; did you mean cache_bytes?\n",
        ":2: workers must be a whole number from 0 to 1024, not \"-1\"\n",
        ":3: expected \"key = value\", not \"no equals sign\"\n",
        "environment: unknown setting \"STRUM_LISTN\"; did you mean listen?\n",
        "STRUM_WORKERS: workers must be a whole number from 0 to 1024, not \"many\"\n",
        "--event-threads: event_threads must be a whole number from 1 to 64, not \"0\"\n",
        "--log-requests: log_requests must be one of none, errors, refusals, all, not "
        "\"some\"\n",
        "flags: unexpected \"stray\"\n",
        "flags: --retry-after-s needs a value\n",
    };
    size_t lines = 0;
    for (const char *c = t.faults.data; *c; c++)
        lines += *c == '\n';
    assert_int_equal(lines, sizeof wanted / sizeof *wanted);
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++)
        if (!strstr(t.faults.data, wanted[i]))
            fail_msg("not said: %s in:\n%s", wanted[i], t.faults.data);
    told_clear(&t);
    unlink(path);
}

static void numbers_that_are_none_are_refused(void **state)
{
    (void)state;
    static const char *const values[] = {"",    " 1",  "1 ",  "0x10",  "1.5",
                                         "nan", "inf", "1e9", "1K",    "1KK",
                                         "+1",  "--1", "1,5", "99999", "-0"};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        told t = tell(FLAGS("--workers", values[i]), NULL);
        if (t.good)
            fail_msg("workers = \"%s\" was taken", values[i]);
        told_clear(&t);
    }
}

static void a_file_that_is_not_there_is_a_fault(void **state)
{
    (void)state;
    told t = tell(FLAGS("--config", "/nowhere/strum.conf"), NULL);
    assert_false(t.good);
    assert_non_null(strstr(t.faults.data, "/nowhere/strum.conf: No such file"));
    told_clear(&t);
}

static void what_kubernetes_sets_is_no_fault(void **state)
{
    (void)state;
    const char *const environment[] = {"STRUM_PORT=tcp://10.0.0.1:80",
                                       "STRUM_PORT_80_TCP_ADDR=10.0.0.1",
                                       "STRUM_SERVICE_HOST=10.0.0.1", NULL};
    told t = tell(NULL, environment);
    assert_true(t.good);
    told_clear(&t);
}

static void actions_are_known(void **state)
{
    (void)state;
    static const struct {
        const char *flag;
        settings_action action;
    } rows[] = {{"--help", SETTINGS_HELP},
                {"--version", SETTINGS_VERSION},
                {"--print-config", SETTINGS_PRINT},
                {"--check-config", SETTINGS_CHECK}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        told t = tell(FLAGS(rows[i].flag, "--workers", "2"), NULL);
        assert_true(t.good);
        assert_int_equal(t.action, rows[i].action);
        assert_int_equal(t.settings.workers, 2);
        told_clear(&t);
    }
}

static char *printed(const settings *s)
{
    char *bytes = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&bytes, &size);
    assert_non_null(out);
    if (s)
        settings_print(s, out);
    else
        settings_help(out);
    fclose(out);
    return bytes;
}

static void what_is_printed_reads_back(void **state)
{
    (void)state;
    told t = tell(FLAGS("--listen", "[::1]:9", "--inline-us", "0.1", "--cache-bytes=3G",
                        "--cors-origins", "https://a.example, https://b.example",
                        "--allow-non-loopback"),
                  NULL);
    assert_true(t.good);
    char *first = printed(&t.settings), path[64];
    told_clear(&t);
    write_file(path, first);
    t = tell(FLAGS("--config", path), NULL);
    assert_true(t.good);
    char *second = printed(&t.settings);
    assert_string_equal(first, second);
    assert_non_null(strstr(second, "cache_bytes = 3221225472\n"));
    told_clear(&t);
    unlink(path);

    /* --help names every key of the file, as a flag. */
    char *help = printed(NULL);
    for (char *line = strtok(first, "\n"); line; line = strtok(NULL, "\n")) {
        char flag[80];
        snprintf(flag, sizeof flag, "--%.*s (", (int)strcspn(line, " "), line);
        for (char *c = flag; *c; c++)
            *c = *c == '_' ? '-' : *c;
        if (!strstr(help, flag))
            fail_msg("%s is not in --help", flag);
    }
    free(help);
    free(first);
    free(second);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_safe),
        cmocka_unit_test(later_sources_win),
        cmocka_unit_test(every_kind_is_read),
        cmocka_unit_test(every_fault_is_named_at_once),
        cmocka_unit_test(numbers_that_are_none_are_refused),
        cmocka_unit_test(a_file_that_is_not_there_is_a_fault),
        cmocka_unit_test(what_kubernetes_sets_is_no_fault),
        cmocka_unit_test(actions_are_known),
        cmocka_unit_test(what_is_printed_reads_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
