/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The small pages about the state of the daemon, and the files of the dashboard. */
#ifndef HTTP_API_PAGES_H
#define HTTP_API_PAGES_H

#include "http/api/route.h"

enum MHD_Result page_livez(struct connection *p);  /* its event loop turns: it answers */
enum MHD_Result page_readyz(struct connection *p); /* 503 while draining or overloaded */
enum MHD_Result page_version(struct connection *p);
enum MHD_Result page_metrics(struct connection *p);
enum MHD_Result
page_asset(struct connection *p); /* the dashboard, the reference, the contract */

#endif
