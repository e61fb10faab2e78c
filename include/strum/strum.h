/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The whole public interface of libstrum.
 *
 *     cc program.c $(pkg-config --cflags --libs strum)
 *
 * Each header has one subject and one order: units, an example, parameters with an initialiser,
 * solve, count, get, shape, verify, free. Each function says what it takes and returns, in which
 * units, which errors it has, who owns what, and which report and equation it rests on.
 *
 * All functions are re-entrant: calls on different objects may run in different threads, and a
 * solved object may be read by many at once. The library calls the BLAS and LAPACK it is linked
 * with, and these must allow it: Debian 12's serial OpenBLAS (libopenblas0-serial 0.3.21, built
 * without USE_LOCKING) gives wrong products when two threads multiply at once. A program with
 * several solving threads takes another flavour or one lock. (strumd replaces that allocator in
 * its own process; the library leaves its host's alone.)
 */
#ifndef STRUM_STRUM_H
#define STRUM_STRUM_H

#include <strum/version.h>
#include <strum/status.h>
#include <strum/options.h>
#include <strum/types.h>
#include <strum/catenary.h>
#include <strum/modes.h>
#include <strum/forced.h>
#include <strum/inclined.h>
#include <strum/series.h>
#include <strum/handbook.h>
#include <strum/taut.h>
#include <strum/absorber.h>
#include <strum/cable.h>
#include <strum/cable_modes.h>
#include <strum/identify.h>

#endif
