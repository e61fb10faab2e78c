/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A query string: name=value pairs joined by "&", as libmicrohttpd hands them over decoded. */

#include "evaluation_check.h"
#include "mutate.h"

#define PAIRS_MAX 64

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argc;
    (void)argv;
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const endpoint *e = take_endpoint(&data, &size);
    char *query = malloc(size + 1);
    if (query == NULL)
        return 0;
    memcpy(query, data, size);
    query[size] = '\0';
    query_pair pairs[PAIRS_MAX];
    size_t count = 0;
    char *rest = query;
    for (char *pair; count < PAIRS_MAX && (pair = strsep(&rest, "&")) != NULL;) {
        char *value = strchr(pair, '=');
        if (value != NULL)
            *value++ = '\0';
        pairs[count++] = (query_pair){.name = pair, .value = value != NULL ? value : ""};
    }
    problem p = {0};
    check_asking(e, evaluation_read_query(e, pairs, count, &p), &p);
    free(query);
    return 0;
}
