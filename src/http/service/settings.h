/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The settings of strumd, from one table (settings.c): defaults < file < environment < flags. A
 * row gives the file's key (`cache_bytes`), the environment's name
 * (STRUM_CACHE_BYTES), the flag (--cache-bytes), range, default and help.
 */
#ifndef HTTP_SERVICE_SETTINGS_H
#define HTTP_SERVICE_SETTINGS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "json/strbuf.h"

typedef enum log_requests { LOG_NONE, LOG_ERRORS, LOG_REFUSALS, LOG_ALL } log_requests;

typedef struct settings {
    char *listen; /* texts are owned */
    bool allow_non_loopback;
    int64_t event_threads, workers, queue_depth;
    double inline_us, cheap_us;
    char *store, *store_secret_file, *store_password_file;
    double store_timeout_ms;
    int64_t store_expiry_s;
    int64_t cache_bytes, memory_bytes, answer_bytes, body_bytes, json_depth, json_values;
    int64_t batches, batch_items, batch_body_bytes;
    int64_t connections, connection_memory_bytes, stream_bytes_per_s;
    double idle_timeout_s, request_timeout_s, solve_timeout_s, drain_timeout_s;
    int64_t retry_after_s;
    char *cors_origins, *allowed_hosts, *token_file;
    int64_t log_requests; /* enum log_requests */
    int64_t log_sample;
} settings;

typedef enum settings_action {
    SETTINGS_RUN,
    SETTINGS_HELP,
    SETTINGS_MAN,
    SETTINGS_VERSION,
    SETTINGS_PRINT,
    SETTINGS_CHECK,
} settings_action;

/* Reads all settings. Writes a line into `faults` for each fault and returns whether there was
 * none; then `s` is complete. End with settings_clear in either case. */
bool settings_read(settings *s, int argc, char *const argv[], char *const environment[],
                   settings_action *action, strbuf *faults);
void settings_clear(settings *s);

/* Writes the text of --help. */
void settings_help(FILE *out);
/* Writes the manual page strumd.8, as roff. */
void settings_man(const char *version, FILE *out);
/* Writes the settings as a file that reads back the same. */
void settings_print(const settings *s, FILE *out);

#endif
