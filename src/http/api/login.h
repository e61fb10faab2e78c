/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A browser cannot add a token to the address it opens. Where tokens are needed it gets a form; the
 * answer to a token that is known is a cookie, which stands for the token from then on. The cookie
 * is of no use to scripts (HttpOnly) nor to pages of other sites (SameSite), and ends with its
 * token.
 */
#ifndef HTTP_API_LOGIN_H
#define HTTP_API_LOGIN_H

#include "http/api/request.h"

/* Whether a request without a token is better answered by the form than by a problem. */
bool login_is_wanted(const request *r);
/* Sends the form, with status 401. */
enum MHD_Result login_ask(struct connection *p);
/* /login: GET sends the form, POST takes it; one without a token takes the cookie away. */
enum MHD_Result login_page(struct connection *p);

#endif
