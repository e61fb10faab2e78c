/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/api/route.h"

#include <string.h>

#include "http/api/solve_handler.h"
#include "http/api/batch.h"
#include "http/api/pages.h"
#include "validation/registry.h"

#define READ (METHOD_GET | METHOD_HEAD)

/* A path that ends in "/" stands for all below it, and `rest` says what; "/" is itself only. */
static const struct {
    const char *path, *rest;
    enum MHD_Result (*serve)(struct connection *p);
    unsigned methods; /* beside OPTIONS */
} pages[] = {
    {"/v1/batch", "", batch_answer, METHOD_POST},
    {"/v1/results/", "{key}", handle_result, READ},
    {"/livez", "", page_livez, READ},
    {"/readyz", "", page_readyz, READ},
    {"/version", "", page_version, READ},
    {"/metrics", "", page_metrics, READ},
    {"/", "", page_asset, READ},
    {"/docs", "", page_asset, READ},
    {"/openapi.json", "", page_asset, READ},
    {"/docs/", "{endpoint}", page_asset, READ},
    {"/assets/", "{file}", page_asset, READ},
};
#define PAGES (sizeof pages / sizeof *pages)

static const struct {
    const char *verb;
    method method;
} methods[] = {
    {"GET", METHOD_GET},       {"HEAD", METHOD_HEAD},       {"POST", METHOD_POST},
    {"QUERY", METHOD_QUERY},   {"OPTIONS", METHOD_OPTIONS}, {"PUT", METHOD_OTHER},
    {"PATCH", METHOD_OTHER},   {"DELETE", METHOD_OTHER},    {"TRACE", METHOD_OTHER},
    {"CONNECT", METHOD_OTHER},
};

method method_of(const char *verb)
{
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++)
        if (strcmp(methods[i].verb, verb) == 0)
            return methods[i].method;
    return METHOD_UNKNOWN;
}

void method_list(unsigned allowed, char list[64])
{
    list[0] = '\0';
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        if (methods[i].method == METHOD_OTHER || !(allowed & methods[i].method))
            continue;
        if (list[0])
            strcat(list, ", ");
        strcat(list, methods[i].verb);
    }
}

route route_find(const char *url)
{
    const endpoint *e = endpoint_find(url);
    if (e) {
        size_t index = PAGES;
        while (endpoints[index - PAGES] != e)
            index++;
        return (route){.path = e->path,
                       .methods = METHOD_POST | METHOD_QUERY | METHOD_OPTIONS |
                                  (e->query ? METHOD_GET | METHOD_HEAD : 0u),
                       .endpoint = e,
                       .index = index,
                       .serve = handle_endpoint};
    }
    for (size_t i = 0; i < PAGES; i++) {
        const size_t size = strlen(pages[i].path);
        const bool below = pages[i].path[size - 1] == '/' && size > 1;
        if (below ? strncmp(url, pages[i].path, size) == 0 : strcmp(url, pages[i].path) == 0)
            return (route){.path = pages[i].path,
                           .methods = METHOD_OPTIONS | pages[i].methods,
                           .rest = url + size,
                           .open =
                               pages[i].serve == page_livez || pages[i].serve == page_readyz,
                           .batch = pages[i].serve == batch_answer,
                           .index = i,
                           .serve = pages[i].serve};
    }
    return (route){.path = "other", .index = route_count() - 1};
}

size_t route_count(void)
{
    size_t count = PAGES + 1;
    for (const endpoint *const *e = endpoints; *e; e++)
        count++;
    return count;
}

const char *route_path(size_t index)
{
    if (index < PAGES)
        return pages[index].path;
    return index < route_count() - 1 ? endpoints[index - PAGES]->path : "other";
}

const char *route_near(const char *url)
{
    nearest near = {.wanted = url};
    for (size_t i = 0; i < route_count() - 1; i++)
        nearest_try(&near, route_path(i));
    return near.name;
}

void route_list(strbuf *out)
{
    for (size_t i = 0; i < route_count() - 1; i++) {
        strbuf_format(out, "%s%s%s", i ? ", " : "", route_path(i),
                      i < PAGES ? pages[i].rest : "");
    }
}
