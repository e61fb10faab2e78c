/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rows of settings: what settings.c reads and settings_text.c prints. */
#ifndef HTTP_SERVICE_SETTINGS_TABLE_H
#define HTTP_SERVICE_SETTINGS_TABLE_H

#include <stddef.h>

typedef enum setting_kind {
    SETTING_TEXT,
    SETTING_FLAG,
    SETTING_COUNT,
    SETTING_BYTES, /* a count that takes K, M or G (KiB, MiB, GiB) */
    SETTING_NUMBER,
    SETTING_CHOICE,
} setting_kind;

typedef struct setting {
    const char *name;
    setting_kind kind;
    size_t offset;
    double min, max;
    const char *fallback, *help;
} setting;

extern const setting settings_table[];
extern const size_t settings_rows;
/* Ends with NULL. */
extern const char *const settings_log_choices[];

#endif
