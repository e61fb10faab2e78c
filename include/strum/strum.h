/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The whole public interface of libstrum. */
#ifndef STRUM_STRUM_H
#define STRUM_STRUM_H

#include <strum/version.h>
#include <strum/status.h>
#include <strum/options.h>
#include <strum/types.h>
#include <strum/catenary.h>
#include <strum/forced.h>
#include <strum/inclined.h>
#include <strum/series.h>
#include <strum/handbook.h>
#include <strum/taut.h>
#include <strum/absorber.h>

#endif
