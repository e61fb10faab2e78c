/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Answers on their way out. Every function queues exactly one; a refusal is
 * application/problem+json. */
#ifndef HTTP_API_REPLY_H
#define HTTP_API_REPLY_H

#include "http/api/request.h"

struct asset;

typedef enum reply_source { REPLY_HIT, REPLY_SOLVED, REPLY_COLLAPSED } reply_source;

/* Sends an answer or refusal that may be shared; takes over the caller's reference. */
enum MHD_Result reply_entry(struct connection *p, entry *e, reply_source source);
/* Takes over the bytes of `body`. */
enum MHD_Result reply_text(struct connection *p, int status, const char *type, strbuf *body);
/* Sends a page with a form, which takes over the bytes of `body`. */
enum MHD_Result reply_page(struct connection *p, int status, strbuf *body);
/* Sends a browser to another page of ours, with a cookie or NULL. */
enum MHD_Result reply_go(struct connection *p, const char *path, const char *cookie);
/* Takes over what `why` holds. */
enum MHD_Result reply_problem(struct connection *p, problem *why);
enum MHD_Result reply_refusal(struct connection *p, int status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* Sends an answer that comes in pieces. */
enum MHD_Result reply_stream(struct connection *p, stream *s, const char *type);
/* Sends a file of the dashboard. */
enum MHD_Result reply_asset(struct connection *p, const struct asset *a);
/* Answers OPTIONS: the methods allowed, and what pages of other origins may do. */
enum MHD_Result reply_options(struct connection *p, unsigned methods);

/* The response that is sent unchanged for every plain hit of a stored answer, made when it is first
 * needed and kept with the entry: `address` 0 from a question's own, 1 from the answer's. NULL
 * when memory ran out. */
struct MHD_Response *reply_prebuilt(const service *s, entry *e, int address);

/* Returns the response sent when no other can be made (503, out of memory), or NULL. */
struct MHD_Response *reply_no_memory(void);

#endif
