/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/service/log.h"

#include <errno.h>
#include <inttypes.h>
#include <poll.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
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

/* ---- the way to stderr ---- */

/* The event threads must not wait for whoever reads the log: lines go through this buffer to a
 * thread of their own, which may. One that does not fit is dropped and counted. */
#define ROOM (1 << 18)

static struct {
    pthread_mutex_t lock;
    pthread_cond_t change;
    bool started, ending, writing;
    char bytes[ROOM];
    size_t size;
    uint64_t dropped, told; /* lines; told: those that a line has confessed */
} queue = {.lock = PTHREAD_MUTEX_INITIALIZER, .change = PTHREAD_COND_INITIALIZER};

static void write_all(const char *bytes, size_t size)
{
    while (size > 0) {
        const ssize_t done = write(STDERR_FILENO, bytes, size);
        if (done > 0) {
            bytes += done;
            size -= (size_t)done;
        } else if (done < 0 && errno == EAGAIN) {
            (void)poll(&(struct pollfd){.fd = STDERR_FILENO, .events = POLLOUT}, 1, -1);
        } else if (done == 0 || errno != EINTR) {
            return; /* there is nowhere else to say it */
        }
    }
}

/* Adds a line, under the lock. Returns whether there was room. */
static bool add(const char *bytes, size_t size)
{
    if (size > ROOM - queue.size)
        return false;
    memcpy(queue.bytes + queue.size, bytes, size);
    queue.size += size;
    pthread_cond_broadcast(&queue.change);
    return true;
}

/* Says how many lines are missing, where they are. Under the lock. */
static void confess(void)
{
    char text[64];
    const uint64_t missing = queue.dropped - queue.told;
    if (!missing)
        return;
    log_line line;
    snprintf(text, sizeof text, "%" PRIu64 " lines were not read in time", missing);
    json_put_string(log_open(&line, "warning", "log lines dropped"), "detail", text);
    json_put_integer(&line.json, "count", (int64_t)missing);
    json_close_object(&line.json);
    strbuf_add_string(&line.out, "\n");
    if (!line.out.failed && add(line.out.data, line.out.size))
        queue.told = queue.dropped;
    strbuf_clear(&line.out);
}

static void *write_lines(void *unused)
{
    static char taken[ROOM];
    (void)unused;
    pthread_mutex_lock(&queue.lock);
    for (;;) {
        while (!queue.size)
            pthread_cond_wait(&queue.change, &queue.lock);
        const size_t size = queue.size;
        memcpy(taken, queue.bytes, size);
        queue.size = 0;
        confess(); /* the next line, after what was taken */
        queue.writing = true;
        pthread_mutex_unlock(&queue.lock);
        write_all(taken, size);
        pthread_mutex_lock(&queue.lock);
        queue.writing = false;
        pthread_cond_broadcast(&queue.change);
    }
    return NULL;
}

void log_start(void)
{
    pthread_t thread;
    pthread_attr_t detached;
    if (queue.started || pthread_attr_init(&detached) != 0)
        return;
    pthread_attr_setdetachstate(&detached, PTHREAD_CREATE_DETACHED);
    queue.started = pthread_create(&thread, &detached, write_lines, NULL) == 0;
    pthread_attr_destroy(&detached);
}

void log_flush(int wait_ms)
{
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_sec += wait_ms / 1000;
    pthread_mutex_lock(&queue.lock);
    while (queue.started && (queue.size || queue.writing) &&
           pthread_cond_timedwait(&queue.change, &queue.lock, &until) == 0) {
    }
    pthread_mutex_unlock(&queue.lock);
}

uint64_t log_dropped(void)
{
    pthread_mutex_lock(&queue.lock);
    const uint64_t dropped = queue.dropped;
    pthread_mutex_unlock(&queue.lock);
    return dropped;
}

void log_close(log_line *line)
{
    json_close_object(&line->json);
    strbuf_add_string(&line->out, "\n");
    pthread_mutex_lock(&queue.lock);
    if (line->out.failed || (queue.started && !add(line->out.data, line->out.size)))
        queue.dropped++;
    else if (!queue.started) /* before there are threads that must not wait */
        write_all(line->out.data, line->out.size);
    pthread_mutex_unlock(&queue.lock);
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
