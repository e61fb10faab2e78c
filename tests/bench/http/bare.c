/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What libmicrohttpd itself costs: a server that gives the same bytes (headers too) as strumd
 * and does nothing else. Usage: bare PATH FILE...; a file holds header lines, an empty line and
 * the body. Says its port, and runs until its standard input ends.
 */
#include <microhttpd.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define PAGES_MAX 8
static struct page {
    const char *path;
    struct MHD_Response *response;
} pages[PAGES_MAX];
static int page_count;

static enum MHD_Result answer(void *cls, struct MHD_Connection *connection, const char *url,
                              const char *method, const char *version, const char *upload,
                              size_t *upload_size, void **context)
{
    (void)cls;
    (void)method;
    (void)version;
    (void)upload;
    if (!*context) {
        *context = pages; /* anything: the headers were seen */
        return MHD_YES;
    }
    if (*upload_size) {
        *upload_size = 0;
        return MHD_YES;
    }
    for (int i = 0; i < page_count; i++)
        if (strcmp(url, pages[i].path) == 0)
            return MHD_queue_response(connection, 200, pages[i].response);
    return MHD_NO;
}

static struct MHD_Response *load(const char *name)
{
    static char bytes[1 << 20];
    FILE *file = fopen(name, "re");
    const size_t size = file ? fread(bytes, 1, sizeof bytes - 1, file) : 0;
    bytes[size] = '\0';
    char *body = strstr(bytes, "\n\n");
    if (!body) {
        fprintf(stderr, "bare: %s has no header lines and body\n", name);
        exit(2);
    }
    fclose(file);
    *body = '\0';
    body += 2;
    struct MHD_Response *response = MHD_create_response_from_buffer(
        size - (size_t)(body - bytes), body, MHD_RESPMEM_MUST_COPY);
    for (char *line = strtok(bytes, "\n"); line; line = strtok(NULL, "\n")) {
        char *value = strstr(line, ": ");
        *value = '\0';
        MHD_add_response_header(response, line, value + 2);
    }
    return response;
}

int main(int argc, char *argv[])
{
    for (int i = 1; i + 1 < argc && page_count < PAGES_MAX; i += 2)
        pages[page_count++] = (struct page){argv[i], load(argv[i + 1])};
    struct MHD_Daemon *daemon =
        MHD_start_daemon(MHD_USE_EPOLL_INTERNAL_THREAD, 0, NULL, NULL, answer, NULL,
                         MHD_OPTION_CONNECTION_MEMORY_LIMIT, (size_t)16384,
                         MHD_OPTION_CONNECTION_TIMEOUT, 15u, MHD_OPTION_END);
    if (!daemon)
        return 1;
    printf("%u\n", MHD_get_daemon_info(daemon, MHD_DAEMON_INFO_BIND_PORT)->port);
    fflush(stdout);
    char byte;
    while (read(STDIN_FILENO, &byte, 1) > 0)
        ;
    MHD_stop_daemon(daemon);
    for (int i = 0; i < page_count; i++)
        MHD_destroy_response(pages[i].response);
    return 0;
}
