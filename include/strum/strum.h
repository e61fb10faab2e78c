/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The whole public interface of libstrum. */
#ifndef STRUM_STRUM_H
#define STRUM_STRUM_H

#include <strum/status.h>
#include <strum/catenary.h>
#include <strum/forced.h>
#include <strum/inclined.h>
#include <strum/series.h>
#include <strum/shallow.h>
#include <strum/taut.h>
#include <strum/absorber.h>

#endif
