/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Galerkin discretisation of the in-plane motion (include/strum/catenary.h). With
 * x = (chi - chi_m)/mu, force and displacement are expanded in functions b_k and their duals b'_k
 * (INT of the products of b_j's derivative and b'_k: the identity):
 *     F = c + sum f_k b_k(x)
 *     X = sum x_k b'_k(x).
 * The weak equations are
 *     f = (s^2 M + s D) x
 *     x = -A f
 * with M and D the mass and damping matrices of the b', A the compliance matrix of the b with the
 * zero-frequency constants c projected out. Two choices of b bound the answer from both sides:
 *     IN_PLANE_FORCE_FORM    b = q_k (free at the ends, F' in span p_k): the complementary form
 *     IN_PLANE_CLAMPED_FORM  b = p_k (k >= 1), b' = q_k (clamped): its dual (Hellinger-Reissner).
 * Neither locks as the cable becomes inextensible: A merely loses rank.
 */
#ifndef CORE_SUSPENDED_IN_PLANE_H
#define CORE_SUSPENDED_IN_PLANE_H

#include <complex.h>

#include <strum/catenary.h>

#include "core/numerics/arena.h"
#include "core/numerics/legendre.h"
#include "core/numerics/mapping.h"

typedef enum in_plane_form { IN_PLANE_FORCE_FORM, IN_PLANE_CLAMPED_FORM } in_plane_form;

/* How the constants follow: c = from_unknowns f + from_motion d, d the displacement (in the
 * middle tangent frame) of end 2; 2 x count and 2 x 2, zero for a component without a constant.
 */
typedef struct in_plane_rule {
    double *from_unknowns;
    double from_motion[2][2];
} in_plane_rule;

/* The unknowns of one symmetry class (or of all, for a cable that is not level), ordered by
 * degree so that a leading block is a smaller discretisation. Components: 0 along the middle
 * tangent, 1 along its normal. */
typedef struct in_plane_part {
    strum_symmetry symmetry;
    int count;
    int *component, *index; /* of each unknown: component and k */
    int constants[2];       /* components that have a constant */
    int constant_count;
    double *compliance; /* A = W'W (count x count) */
    in_plane_rule rule;
} in_plane_part;

strum_status in_plane_part_make(strum_symmetry symmetry, in_plane_form form, int size, arena *a,
                                in_plane_part *part);

/* Frame and slope at the nodes of a basis: t = (c, s), n = (-s, c). */
typedef struct in_plane_frame {
    const legendre *b;
    double *slope; /* dchi/dx */
    double *cosh_chi, *c, *s;
} in_plane_frame;

strum_status in_plane_frame_make(const mapping *along, const legendre *b, arena *a,
                                 in_plane_frame *frame);
/* The same at one point. */
void in_plane_frame_at(const mapping *along, double x, double *cosh_chi, double *c, double *s);

/* The part's compliance and rule. */
strum_status in_plane_compliance(const strum_cable *cable, const in_plane_frame *frame,
                                 in_plane_form form, in_plane_part *part, arena *a);

/* INT b'_i . (tt' weight_t + nn' weight_n) b'_j cosh(chi) dchi (count x count). */
strum_status in_plane_inertia(double weight_t, double weight_n, const in_plane_frame *frame,
                              const in_plane_part *part, in_plane_form form, double *matrix,
                              arena *scratch);

/* K of the complementary form, A f = (1/w^2) K f with weights 1/m_t, 1/m_n:
 * INT p_i . (tt' weight_t + nn' weight_n) p_j sech(chi) dx/(dchi/dx). */
strum_status in_plane_complementary(double weight_t, double weight_n,
                                    const in_plane_frame *frame, const in_plane_part *part,
                                    double *matrix, arena *scratch);

#endif
