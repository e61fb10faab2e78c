/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef ENDPOINTS_FORCED_ANSWER_H
#define ENDPOINTS_FORCED_ANSWER_H

#include "endpoints/forced/request.h"

/* The result; false with a->problem set. */
bool forced_answer(const void *request, answer *a);

#endif
