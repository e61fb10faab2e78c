/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Ends as people have them: one figure of the shape is given, and one length, or the span,
 * follows from it.
 *
 * Of a single piece every figure but the tension at an end is monotone in the length, and that
 * tension has one minimum (proved for the inextensible cable, true of every elastic one tried).
 * Nothing is known of several pieces, so that the range is looked through by steps of half a
 * decade in |length/chord - 1|, on both sides of the chord, and all crossings are counted.
 */
#ifndef CORE_CABLE_ENDS_H
#define CORE_CABLE_ENDS_H

#include "core/cable/settle.h"

/* Sets the adjusted length or s->span, s->form, and `solutions` and `other_length`.
 * STRUM_ERR_IMPOSSIBLE where no shape has the figure: with the least possible end tension. */
strum_status ends_find(cable_settler *s, strum_cable_statics *statics, strum_error *error);

#endif
