/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/service/log.h"

#include <stdarg.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

json_writer *log_open(log_line *line, const char *level, const char *event)
{
    *line = (log_line){0};
    line->json.out = &line->out;
    struct timespec now;
    struct tm utc;
    char stamp[64] = "";
    clock_gettime(CLOCK_REALTIME, &now);
    if (gmtime_r(&now.tv_sec, &utc)) {
        const size_t size = strftime(stamp, sizeof stamp, "%Y-%m-%dT%H:%M:%S", &utc);
        snprintf(stamp + size, sizeof stamp - size, ".%03ldZ", now.tv_nsec / 1000000);
    }
    json_open_object(&line->json);
    json_put_string(&line->json, "time", stamp);
    json_put_string(&line->json, "level", level);
    json_put_string(&line->json, "event", event);
    return &line->json;
}

void log_close(log_line *line)
{
    json_close_object(&line->json);
    strbuf_add_string(&line->out, "\n");
    /* One write, so that lines of several threads do not mix. */
    if (!line->out.failed && write(STDERR_FILENO, line->out.data, line->out.size) < 0) {
        /* There is nowhere else to say it. */
    }
    strbuf_clear(&line->out);
}

void log_say(const char *level, const char *event, const char *format, ...)
{
    char detail[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(detail, sizeof detail, format, arguments);
    va_end(arguments);
    log_line line;
    json_put_string(log_open(&line, level, event), "detail", detail);
    log_close(&line);
}
