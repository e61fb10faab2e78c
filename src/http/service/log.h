/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One JSON line on stderr for each event. No bodies, no tokens. No caller waits for the reader of
 * stderr: lines that it does not take in time are dropped, counted, and confessed by a line. */
#ifndef HTTP_SERVICE_LOG_H
#define HTTP_SERVICE_LOG_H

#include <stdint.h>

#include "json/write.h"

typedef struct log_line {
    strbuf out;
    json_writer json;
} log_line;

/* Starts the thread that writes; before, and where it cannot start, each line is written at once.
 */
void log_start(void);
/* Waits until all lines are written, for whole seconds at most. */
void log_flush(int wait_ms);
/* Returns the number of lines dropped. */
uint64_t log_dropped(void);

/* Begins a line {"time", "level", "event"; add members with json_put_...; log_close writes it. */
json_writer *log_open(log_line *line, const char *level, const char *event);
void log_close(log_line *line);
/* Writes a line with one more member, "detail". */
void log_say(const char *level, const char *event, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
