/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints what the field tables say, for api/update and the tests: {path: {"title", "query",
 * "name", "request"}}, the request as JSON Schema. Built, not installed. */
#include <stdio.h>

#include "validation/registry.h"

int main(void)
{
    strbuf out = {0};
    json_writer json = {.out = &out};
    json_open_object(&json);
    for (int i = 0; endpoints[i] != NULL; i++) {
        const endpoint *e = endpoints[i];
        json_key(&json, e->path);
        json_open_object(&json);
        json_put_string(&json, "title", e->title);
        json_put_flag(&json, "query", e->query);
        json_put_string(&json, "name", e->request->name);
        json_key(&json, "request");
        schema_describe(e->request, e->variables, &json);
        json_close_object(&json);
    }
    json_close_object(&json);
    const bool good = !out.failed && puts(out.data) >= 0;
    strbuf_clear(&out);
    return good ? 0 : 1;
}
