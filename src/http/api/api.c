/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/api/api.h"

#include <stdio.h>

#include "http/api/batch.h"
#include "http/api/dispatch.h"
#include "http/api/login.h"
#include "http/api/pages.h"
#include "http/api/reply.h"
#include "http/api/solve_handler.h"

#define READ (METHOD_GET | METHOD_HEAD)

static const page pages[] = {
    {.path = "/v1/batch", .serve = batch_answer, .methods = METHOD_POST, .batch = true},
    {.path = "/v1/results/", .rest = "{key}", .serve = handle_result, .methods = READ},
    {.path = "/livez", .serve = page_livez, .methods = READ, .open = true},
    {.path = "/readyz", .serve = page_readyz, .methods = READ, .open = true},
    {.path = "/login",
     .serve = login_page,
     .methods = READ | METHOD_POST,
     .open = true,
     .form = true},
    {.path = "/version", .serve = page_version, .methods = READ},
    {.path = "/metrics", .serve = page_metrics, .methods = READ},
    {.path = "/", .serve = page_asset, .methods = READ},
    {.path = "/docs", .serve = page_asset, .methods = READ},
    {.path = "/openapi.json", .serve = page_asset, .methods = READ},
    {.path = "/openapi-3.2.json", .serve = page_asset, .methods = READ},
    {.path = "/docs/", .rest = "{endpoint}", .serve = page_asset, .methods = READ},
    {.path = "/assets/", .rest = "{file}", .serve = page_asset, .methods = READ, .open = true},
    {.path = NULL, .serve = handle_endpoint},
};

static const handlers served = {
    .open = request_open,
    .close = request_close,
    .begin = dispatch_begin,
    .body = dispatch_body,
    .finish = dispatch_finish,
    .end = dispatch_end,
    .give_up = solve_give_up,
    .look_in = solve_look_in,
};

static const char *path_of(size_t index)
{
    return route_path(pages, index);
}

bool api_start(api *a, const settings *set, char fault[256])
{
    *a = (api){.server.at.fd = -1};
    service *s = &a->service;
    if (!service_start(s, set, route_count(pages), path_of, fault))
        return false;
    s->pages = pages;
    if (evaluation_numerics() == NULL || !(s->no_memory = reply_no_memory())) {
        snprintf(fault, 256, "out of memory");
        return false;
    }
    return server_start(&a->server, s, &served, fault);
}

void api_free(api *a)
{
    server_free(&a->server);
    service_free(&a->service);
    if (a->service.no_memory)
        MHD_destroy_response(a->service.no_memory);
}
