/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/api/login.h"

#include <openssl/crypto.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "http/api/assets.h"
#include "http/api/reply.h"
#include "json/hex.h"

/* A token may be longer than its place here; it is then not known. */
#define FIELD_SIZE 1024
#define KEPT_S     2592000

static const char page_begin[] =
    "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    "<title>strum - log in</title>\n<link rel=\"icon\" href=\"/assets/icon.svg\">\n"
    "<link rel=\"stylesheet\" href=\"/assets/style.css\">\n</head>\n<body>\n"
    "<main class=\"login\">\n<h1>strum</h1>\n";

static const char page_form[] =
    "<form method=\"post\" action=\"/login\">\n"
    "<label>Token <input name=\"token\" type=\"password\" autocomplete=\"current-password\" "
    "required autofocus></label>\n"
    "<input name=\"to\" type=\"hidden\" value=\"%s\">\n<button>Log in</button>\n</form>\n";

static const char page_end[] =
    "<form method=\"post\" action=\"/login\"><button>Log out</button></form>\n"
    "</main>\n</body>\n</html>\n";

/* A page of ours at `path`, or "/": nothing from outside is written into a page or an address. */
static const char *known_page(const char *path)
{
    for (const asset *a = assets; a->path; a++)
        if (strcmp(a->path, path) == 0 && strncmp(a->type, "text/html", 9) == 0)
            return a->path;
    return "/";
}

static enum MHD_Result send_form(connection *p, int status, const char *note, const char *to)
{
    strbuf body = {0};
    strbuf_add_string(&body, page_begin);
    strbuf_format(&body, "<p>%s</p>\n", note);
    strbuf_format(&body, page_form, known_page(to));
    strbuf_add_string(&body, page_end);
    return reply_page(p, status, &body);
}

bool login_is_wanted(const request *r)
{
    return r->method == METHOD_GET && r->accept && strstr(r->accept, "text/html");
}

enum MHD_Result login_ask(connection *p)
{
    problem_clear(&p->request->refusal);
    return send_form(p, 401, "A token is needed here.", p->request->url);
}

/* Decodes the value at `at`, up to "&" or the end (application/x-www-form-urlencoded). */
static void decode(const char *at, const char *end, char value[FIELD_SIZE])
{
    size_t size = 0;
    while (at < end && *at != '&' && size < FIELD_SIZE - 1) {
        const int high = *at == '%' && end - at > 2 ? hex_digit(at[1]) : -1;
        const int low = high >= 0 ? hex_digit(at[2]) : -1;
        value[size++] = (char)(low >= 0 ? high << 4 | low : *at == '+' ? ' ' : *at);
        at += low >= 0 ? 3 : 1;
    }
    value[size] = '\0';
}

/* Reads a field of the form; empty if it has none of that name. */
static void read_field(const strbuf *form, const char *name, char value[FIELD_SIZE])
{
    const size_t size = strlen(name);
    const char *end = form->data + form->size;
    value[0] = '\0';
    for (const char *at = form->data; at && at < end;) {
        if ((size_t)(end - at) > size && memcmp(at, name, size) == 0 && at[size] == '=') {
            decode(at + size + 1, end, value);
            return;
        }
        at = memchr(at, '&', (size_t)(end - at));
        at = at ? at + 1 : NULL;
    }
}

static enum MHD_Result take_form(connection *p)
{
    request *r = p->request;
    char token[FIELD_SIZE], to[FIELD_SIZE], value[ACCESS_COOKIE_SIZE], cookie[256];
    read_field(&r->body, "token", token);
    read_field(&r->body, "to", to);
    const bool leaves = !*token;
    const bool known = !leaves && access_cookie(p->service->access, token, value);
    OPENSSL_cleanse(token, sizeof token);
    OPENSSL_cleanse(r->body.data, r->body.size);
    if (!leaves && !known)
        return send_form(p, 401, "This token is not known.", to);
    /* Only a page that came by TLS may ask that the cookie goes by TLS alone. */
    const bool tls = r->origin && strncasecmp(r->origin, "https://", 8) == 0;
    snprintf(cookie, sizeof cookie,
             ACCESS_COOKIE "=%s; Path=/; Max-Age=%d; HttpOnly; SameSite=Strict%s",
             leaves ? "" : value, leaves ? 0 : KEPT_S, tls ? "; Secure" : "");
    return reply_go(p, leaves ? "/login" : known_page(to), cookie);
}

enum MHD_Result login_page(connection *p)
{
    if (!p->service->access)
        return reply_go(p, "/", NULL);
    if (p->request->method == METHOD_POST)
        return take_form(p);
    return send_form(p, 200, "A token opens this page.", "/");
}
