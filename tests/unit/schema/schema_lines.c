/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * For schema_agrees.py: the test tables by name. `schema_lines describe NAME` prints the JSON
 * Schema of one; `schema_lines read NAME` reads a document a line and says for each whether it
 * is taken (1) or refused (0).
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tables.h"

static bool taken(const schema *s, bool variables, const char *line, size_t size)
{
    const json_limits limits = {.depth = 16, .values = 10000};
    problem p = {0};
    cJSON *document;
    schema_arena *arena = NULL;
    bool good = json_read(line, size, &limits, &document, &p);
    if (good)
        good = schema_read(s, document, variables, &arena, &p) != NULL;
    cJSON_Delete(document);
    schema_free(arena);
    problem_clear(&p);
    return good;
}

int main(int count, char **arguments)
{
    if (count != 3)
        return 2;
    const bool chain = strncmp(arguments[2], "chain", 5) == 0;
    const bool variables = strcmp(arguments[2], "chain_variables") == 0;
    const schema *s = chain ? &chain_schema : &cable_schema;
    if (strcmp(arguments[1], "describe") == 0) {
        strbuf out = {0};
        schema_describe(s, variables, &(json_writer){.out = &out});
        const bool good = !out.failed && puts(out.data) >= 0;
        strbuf_clear(&out);
        return good ? 0 : 1;
    }
    char *line = NULL;
    size_t room = 0;
    ssize_t size;
    while ((size = getline(&line, &room, stdin)) > 0)
        puts(taken(s, variables, line, (size_t)size) ? "1" : "0");
    free(line);
    return 0;
}
