/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The small pages that say how the daemon is, and the files of the dashboard. */
#ifndef HTTP_PAGES_H
#define HTTP_PAGES_H

#include "http/route.h"

enum MHD_Result page_livez(struct peer *p);  /* its event loop turns: it answers */
enum MHD_Result page_readyz(struct peer *p); /* 503 while draining or overloaded */
enum MHD_Result page_version(struct peer *p);
enum MHD_Result page_metrics(struct peer *p);
enum MHD_Result page_asset(struct peer *p); /* the dashboard, the reference, the contract */

#endif
