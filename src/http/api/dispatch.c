/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/api/dispatch.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "http/api/browser.h"
#include "http/api/login.h"
#include "http/api/reply.h"
#include "http/service/clock.h"

/* A body too large is read for this many bytes more, to answer at its end: libmicrohttpd cannot
 * answer in the middle of a chunked upload. */
#define BODY_DRAIN (1 << 20)

/* ---- the headers ---- */

typedef struct headers {
    request *request;
    browser_headers browser;
    const char *authorization, *cookie, *content_type, *transfer_encoding, *content_length,
        *expect, *fault;
    unsigned hosts, lengths, encodings;
} headers;

static bool is_token(const char *name, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        const char c = name[i];
        if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
              c == '-' || c == '_' || (c && strchr("!#$%&'*+.^`|~", c))))
            return false;
    }
    return size > 0;
}

static bool is_id(const char *value, size_t size)
{
    for (size_t i = 0; i < size; i++)
        if (!isalnum((unsigned char)value[i]) && !strchr("-_.:/+=@", value[i]))
            return false;
    return size > 0 && size < REQUEST_ID_SIZE;
}

/* version-trace-parent-flags (W3C Trace Context 3.2), in lower-case hexadecimal digits. */
static bool is_traceparent(const char *value, size_t size)
{
    static const char form[] = "xx-xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx-xxxxxxxxxxxxxxxx-xx";
    for (size_t i = 0; i < size && i < sizeof form; i++)
        if (form[i] == 'x'
                ? !isxdigit((unsigned char)value[i]) || isupper((unsigned char)value[i])
                : form[i] != value[i])
            return false;
    return size == sizeof form - 1;
}

static enum MHD_Result read_header(void *cls, enum MHD_ValueKind kind, const char *name,
                                   size_t name_size, const char *value, size_t value_size)
{
    (void)kind;
    headers *h = cls;
    request *r = h->request;
    if (!value)
        value = "";
    /* libmicrohttpd does not check names. */
    if (!is_token(name, name_size))
        h->fault = "a header's name has a character that no name may have";
#define IS(text) (name_size == sizeof text - 1 && strcasecmp(name, text) == 0)
    else if (IS("Host")) {
        h->browser.host = value;
        h->hosts++;
    } else if (IS("Content-Type"))
        h->content_type = value;
    else if (IS("Content-Length")) {
        h->content_length = value;
        h->lengths++;
    } else if (IS("Transfer-Encoding")) {
        h->transfer_encoding = value;
        h->encodings++;
    } else if (IS("Expect"))
        h->expect = value;
    else if (IS("Authorization"))
        h->authorization = value;
    else if (IS("Cookie"))
        h->cookie = value;
    else if (IS("Accept"))
        r->accept = value;
    else if (IS("Origin"))
        h->browser.origin = r->origin = value;
    else if (IS("Sec-Fetch-Site"))
        h->browser.site = value;
    else if (IS("Sec-Fetch-Mode"))
        h->browser.mode = value;
    else if (IS("Sec-Fetch-Dest"))
        h->browser.dest = value;
    else if (IS("If-None-Match"))
        r->if_none_match = value;
    else if (IS("Access-Control-Request-Method"))
        r->accept_method = value;
    else if (IS("traceparent") && is_traceparent(value, value_size))
        r->traceparent = value;
    else if (IS("X-Request-Id") && is_id(value, value_size)) {
        memcpy(r->id, value, value_size + 1);
        r->given_id = true;
    }
#undef IS
    return MHD_YES;
}

/* Refuses headers that leave it unclear where this request ends (RFC 9112 6.3), and ends the
 * connection. */
static void check_framing(const headers *h, request *r, const char *version)
{
    const bool chunked =
        h->transfer_encoding && strcasecmp(h->transfer_encoding, "chunked") == 0;
    const bool http_1_0 = strcmp(version, "HTTP/1.0") == 0;
    if (h->fault)
        problem_set(&r->refusal, 400, "%s", h->fault);
    else if (h->encodings && h->lengths)
        problem_set(&r->refusal, 400, "Content-Length and Transfer-Encoding together");
    else if (h->lengths > 1)
        problem_set(&r->refusal, 400, "more than one Content-Length");
    else if (h->encodings > 1 || (h->encodings && http_1_0))
        problem_set(&r->refusal, 400, "Transfer-Encoding is not usable");
    else if (h->encodings && !chunked)
        problem_set(&r->refusal, 501, "the only Transfer-Encoding known is chunked");
    else if (h->hosts > 1 || (!h->hosts && !http_1_0))
        problem_set(&r->refusal, 400, "exactly one Host is needed");
    else
        return;
    r->close = true;
}

/* Compares a media type, with or without parameters. */
static bool is_type(const char *type, const char *wanted)
{
    const size_t size = strlen(wanted);
    if (strncasecmp(type, wanted, size) != 0)
        return false;
    type += size + strspn(type + size, " \t");
    return *type == '\0' || *type == ';';
}

static uint64_t body_limit(const connection *p)
{
    const settings *set = p->service->settings;
    return (uint64_t)(p->request->route.batch ? set->batch_body_bytes : set->body_bytes);
}

/* A token stands for its client wherever it asks from. */
static unsigned who_asks(const connection *p, const headers *h)
{
    const union MHD_ConnectionInfo *info =
        MHD_get_connection_info(p->mhd, MHD_CONNECTION_INFO_CLIENT_ADDRESS);
    return client_of(info ? info->client_addr : NULL,
                     p->service->access ? h->authorization : NULL);
}

#define READS (METHOD_GET | METHOD_HEAD)

/* Probes are asked by any name: they say nothing that matters. */
static void check_browser(connection *p, const headers *h)
{
    request *r = p->request;
    const settings *set = p->service->settings;
    if (r->route.open && (r->method & READS))
        return;
    browser_check_host(&h->browser, set, p->service->local, &r->refusal);
    /* What a preflight may be told is in the headers of its answer. */
    if (!r->refusal.status && r->method != METHOD_OPTIONS)
        browser_check_origin(&h->browser, set, !r->route.endpoint && (r->method & READS),
                             &r->refusal);
}

/* The type must be said: a page of any site may have a browser send a form or text unasked, but not
 * JSON. */
static bool has_type(const request *r, const headers *h)
{
    const char *wanted =
        r->route.form ? "application/x-www-form-urlencoded" : "application/json";
    return r->is_lines || (h->content_type && is_type(h->content_type, wanted));
}

/* Preflights carry no token, by the CORS protocol. A cookie holds only where no token is given. */
static bool may_ask(const connection *p, const headers *h)
{
    const request *r = p->request;
    access_list *access = p->service->access;
    return !access || r->route.open || r->method == METHOD_OPTIONS ||
           (h->authorization ? access_allows(access, h->authorization)
                             : access_allows_cookie(access, h->cookie));
}

/* Refuses everything that can be refused before the body has come. */
static void check(connection *p, const headers *h)
{
    request *r = p->request;
    const bool takes_body = r->method == METHOD_POST || r->method == METHOD_QUERY;
    const uint64_t limit = body_limit(p);
    const bool has_body = h->encodings || (h->content_length && strcmp(h->content_length, "0"));
    if (!may_ask(p, h)) {
        problem_set(
            &r->refusal, 401, "%s",
            h->authorization
                ? "this token is not known"
                : "a token is needed: Authorization: Bearer TOKEN; in a browser, log in at "
                  "/login");
    } else if (h->content_length && strtoull(h->content_length, NULL, 10) > limit) {
        problem_set(&r->refusal, 413, "the body is larger than %llu bytes",
                    (unsigned long long)limit);
        r->close = true;
    } else if (r->method == METHOD_UNKNOWN) {
        problem_set(&r->refusal, 501, "no such method is known; methods are case-sensitive");
    } else if (!r->route.serve) {
        if (strcmp(r->url, "*") == 0 && r->method == METHOD_OPTIONS)
            return;
        strbuf known = {0};
        route_list(p->service->pages, &known);
        const char *near = route_near(p->service->pages, r->url);
        problem_set(&r->refusal, 404, "nothing is at %s%s%s; known paths: %s", r->url,
                    near ? "; did you mean " : "", near ? near : "",
                    known.data ? known.data : "");
        strbuf_clear(&known);
    } else if (!(r->route.methods & r->method)) {
        char allowed[64];
        method_list(r->route.methods, allowed);
        problem_set(&r->refusal, 405, "this path is asked by %s", allowed);
    } else if (has_body && (r->method == METHOD_GET || r->method == METHOD_HEAD)) {
        problem_set(&r->refusal, 400, "GET takes no body; send it by POST or QUERY");
    } else if (takes_body && !has_type(r, h)) {
        problem_set(
            &r->refusal, 415,
            "the body must be application/json%s, and Content-Type must say so; with curl: "
            "--json BODY, or -d BODY -H 'Content-Type: application/json'",
            r->route.batch ? " or application/x-ndjson" : "");
    } else if (takes_body && r->route.endpoint &&
               MHD_get_connection_values(p->mhd, MHD_GET_ARGUMENT_KIND, NULL, NULL)) {
        problem_set(&r->refusal, 400, "the fields of %s stand in its body, not in the URL",
                    r->method == METHOD_POST ? "POST" : "QUERY");
    }
}

/* Keeps the URL, printable and short, for messages and the log. */
static void note_url(request *r, const char *url)
{
    size_t i = 0;
    for (; url[i] && i < sizeof r->url - 1; i++)
        r->url[i] = url[i] > ' ' && url[i] < 127 ? url[i] : '?';
    r->url[i] = '\0';
}

/* ---- the three calls ---- */

enum MHD_Result dispatch_begin(connection *p, const char *url, const char *verb,
                               const char *version)
{
    request *r = p->request;
    request_reset(r);
    r->began_us = clock_us();
    connection_enter(p, CONNECTION_READING, p->service->settings->request_timeout_s);
    r->method = method_of(verb);
    const bool is_target = target_split(url, r->method == METHOD_OPTIONS, &r->target);
    note_url(r, r->target.path);
    r->route = route_find(p->service->pages, r->target.path);
    headers h = {.request = r};
    MHD_get_connection_values_n(p->mhd, MHD_HEADER_KIND, read_header, &h);
    /* Where the target names a host, that is what was meant, whatever Host says (RFC 9112 3.2.2). */
    if (*r->target.authority)
        h.browser.host = r->target.authority;
    r->is_lines =
        r->route.batch && h.content_type && is_type(h.content_type, "application/x-ndjson");
    r->client = who_asks(p, &h);
    check_framing(&h, r, version);
    if (!r->refusal.status && !is_target)
        problem_set(&r->refusal, 400,
                    "a URL as the target names a host of up to %d characters, and no user",
                    AUTHORITY_SIZE - 1);
    if (!r->refusal.status)
        check_browser(p, &h);
    if (!r->refusal.status)
        check(p, &h);
    /* An answer now ends the connection (the body is not read); other refusals wait for it. */
    if (r->refusal.status && (r->close || h.expect)) {
        r->close = true;
        connection_linger(p);
        return reply_problem(p, &r->refusal);
    }
    return MHD_YES;
}

enum MHD_Result dispatch_body(connection *p, const char *bytes, size_t size)
{
    request *r = p->request;
    const uint64_t limit = body_limit(p);
    r->body_seen += size;
    if (r->body_seen > limit && !r->refusal.status) {
        problem_set(&r->refusal, 413, "the body is larger than %llu bytes",
                    (unsigned long long)limit);
        r->close = true;
    }
    if (r->body_seen > limit + BODY_DRAIN)
        return MHD_NO;
    if (!r->refusal.status && !memory_take_body(&p->service->memory, r->body_counted, size)) {
        problem_set(&r->refusal, 503, "no memory is free for this body; try again later");
        r->close = true;
    }
    if (!r->refusal.status) {
        r->body_counted += size;
        strbuf_add(&r->body, bytes, size);
    }
    return MHD_YES;
}

enum MHD_Result dispatch_finish(connection *p)
{
    request *r = p->request;
    if (r->refusal.status == 401 && login_is_wanted(r))
        return login_ask(p);
    if (r->refusal.status)
        return reply_problem(p, &r->refusal);
    if (r->method == METHOD_OPTIONS)
        return reply_options(p, r->route.serve ? r->route.methods : METHOD_ALL);
    if (r->body.failed)
        return reply_entry(p, NULL, REPLY_HIT);
    return r->route.serve(p);
}

void dispatch_end(connection *p)
{
    request *r = p->request;
    const settings *set = p->service->settings;
    /* First: from here on the reaper leaves the request alone. */
    connection_enter(p, CONNECTION_IDLE, set->idle_timeout_s + set->request_timeout_s);
    request_release(r);
    memory_give_body(&p->service->memory, r->body_counted);
    r->body_counted = 0;
    if (r->counted) {
        atomic_fetch_sub(&p->service->batches, 1);
        atomic_fetch_sub(&p->service->batches_of[r->client], 1);
    }
    r->counted = false;
}
