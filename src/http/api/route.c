/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/api/route.h"

#include <string.h>

#include "validation/registry.h"

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

static size_t page_count(const page *pages)
{
    size_t count = 0;
    while (pages[count].path)
        count++;
    return count;
}

static route route_of_endpoint(const page *pages, const endpoint *e)
{
    const size_t count = page_count(pages);
    size_t index = 0;
    while (endpoints[index] != e)
        index++;
    return (route){.path = e->path,
                   .methods = METHOD_POST | METHOD_QUERY | METHOD_OPTIONS |
                              (e->query ? METHOD_GET | METHOD_HEAD : 0u),
                   .endpoint = e,
                   .index = count + index,
                   .serve = pages[count].serve};
}

route route_find(const page *pages, const char *url)
{
    const endpoint *e = endpoint_find(url);
    if (e)
        return route_of_endpoint(pages, e);
    for (const page *at = pages; at->path; at++) {
        const size_t size = strlen(at->path);
        if (at->rest ? strncmp(url, at->path, size) == 0 : strcmp(url, at->path) == 0)
            return (route){.path = at->path,
                           .methods = METHOD_OPTIONS | at->methods,
                           .rest = url + size,
                           .open = at->open,
                           .batch = at->batch,
                           .form = at->form,
                           .index = (size_t)(at - pages),
                           .serve = at->serve};
    }
    return (route){.path = "other", .index = route_count(pages) - 1};
}

size_t route_count(const page *pages)
{
    size_t count = page_count(pages) + 1;
    for (const endpoint *const *e = endpoints; *e; e++)
        count++;
    return count;
}

const char *route_path(const page *pages, size_t index)
{
    const size_t count = page_count(pages);
    if (index < count)
        return pages[index].path;
    return index < route_count(pages) - 1 ? endpoints[index - count]->path : "other";
}

const char *route_near(const page *pages, const char *url)
{
    nearest near = {.wanted = url};
    for (size_t i = 0; i < route_count(pages) - 1; i++)
        nearest_try(&near, route_path(pages, i));
    return near.name;
}

void route_list(const page *pages, strbuf *out)
{
    const size_t count = page_count(pages);
    for (size_t i = 0; i < route_count(pages) - 1; i++) {
        const char *rest = i < count ? pages[i].rest : NULL;
        strbuf_format(out, "%s%s%s", i ? ", " : "", route_path(pages, i), rest ? rest : "");
    }
}
