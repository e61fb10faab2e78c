/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One search under way: what the library is asked, and how long it may take. */
#ifndef ENDPOINTS_ABSORBER_SOLVING_H
#define ENDPOINTS_ABSORBER_SOLVING_H

#include "endpoints/absorber/request.h"

/* `params` and `options` refer to it: it stays where it was begun. */
typedef struct absorber_solving {
    const absorber_request *r;
    answer *a;
    strum_absorber_params params;
    strum_options options;
    double deadline;
    bool late;
} absorber_solving;

/* Fills `s`; it may take the time limit of the request. */
void absorber_begin(absorber_solving *s, const absorber_request *r, answer *a);
/* From now on the search may take so many seconds; `late` says whether it took more. */
void absorber_allow(absorber_solving *s, double seconds);

#endif
