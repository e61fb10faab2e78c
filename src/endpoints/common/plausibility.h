/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Warnings where an assumption bites or a slip of units is likely, each in plain words with the
 * numbers that led to it. doc/misuses.md lists them with the requests that raise them.
 */
#ifndef ENDPOINTS_COMMON_PLAUSIBILITY_H
#define ENDPOINTS_COMMON_PLAUSIBILITY_H

#include "endpoints/common/chain.h"
#include "endpoints/common/suspended_cable.h"

/* Largest strain of a linearly elastic cable: tension over axial stiffness. */
void warn_strain(double strain, answer *a);
/* A slope angle at an end, from the horizontal. */
void warn_end_angle(int end, double degrees, answer *a);
/* What the inextensible cable of this request leaves out, where stretch would move a mode in plane
 * by more than 1 %. */
void warn_without_stretch(const cable_input *in, answer *a);
/* The same where Irvine's lambda squared of the cable, were it of steel, is known. */
void warn_inextensible(double steel_lambda_squared, double steel_stiffness_N, answer *a);
/* What a suspended cable's figures make unlikely. */
void warn_suspended(const cable_input *in, answer *a);
/* Added mass acts on motion across the cable only; `slope` is half the angle (rad) by which the
 * cable turns between its ends. */
void warn_added_mass(double added, double mass, double slope, answer *a);
/* Half the angle by which a suspended cable turns between its ends, rad. */
double turn_of(const cable_input *in);
/* The handbook beside the answer, where it fails: doc/handbook.md. */
void warn_of_crossover(double sag_to_span, answer *a);
/* `place`: of an absorber, from the nearer end, over the length. */
void warn_of_tuning(double place, answer *a);
/* Amplitude of an end's motion over the span. */
void warn_motion(double amplitude_to_span, answer *a);
/* Parts of a chain that do nothing where they stand. */
void warn_chain(const chain_input *in, answer *a);

/* E/rho of steel wire, (m/s)^2: 2.00e11 Pa over 7850 kg/m^3. */
#define STEEL_SPECIFIC_STIFFNESS 2.548e7

#endif
