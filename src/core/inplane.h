/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Galerkin discretisation of the in-plane motion (include/strum/catenary.h). With x = (chi -
 * chi_m)/mu and the force and displacement expanded as F = c + sum f_k b_k(x),   X = sum x_k
 * b'_k(x),       INT b_j' b'_k... = identity, the weak equations are f = (s^2 M + s D) x, x =
 * -A f, M and D the mass and damping matrices of the b', A the compliance matrix of the b with
 * the zero-frequency constants c projected out. Two choices of b bound the answer from both
 * sides: STRUM_FORCE_FORM   b = q_k (free at the ends, F' in span p_k): the complementary form;
 *     STRUM_CLAMPED_FORM b = p_k (k >= 1), b' = q_k (clamped): its dual (Hellinger-Reissner).
 * Neither locks as the cable becomes inextensible: A merely loses rank.
 */
#ifndef CORE_INPLANE_H
#define CORE_INPLANE_H

#include <complex.h>

#include <strum/catenary.h>

#include "core/arena.h"
#include "core/basis.h"
#include "core/coordinate.h"

typedef enum inplane_form { STRUM_FORCE_FORM, STRUM_CLAMPED_FORM } inplane_form;

/* The unknowns of one symmetry class (or of all, for a cable that is not level), ordered by
 * degree so that a leading block is a smaller discretisation. Components: 0 along the middle
 * tangent, 1 along its normal. */
typedef struct inplane_part {
    strum_symmetry symmetry;
    int count;
    int *component, *index; /* of each unknown: component and k */
    int constants[2];       /* components that have a constant */
    int constant_count;
} inplane_part;

strum_status inplane_part_make(strum_symmetry symmetry, inplane_form form, int size, arena *a,
                               inplane_part *part);

/* Frame and slope at the nodes of a basis: t = (c, s), n = (-s, c). */
typedef struct inplane_frame {
    const basis *b;
    double *slope; /* dchi/dx */
    double *cosh_chi, *c, *s;
} inplane_frame;

strum_status inplane_frame_make(const coordinate *along, const basis *b, arena *a,
                                inplane_frame *frame);
/* The same at one point. */
void inplane_frame_at(const coordinate *along, double x, double *cosh_chi, double *c,
                      double *s);

/* How the constants follow: c = from_unknowns f + from_motion d, d the displacement (in the
 * middle tangent frame) of end 2; 2 x count and 2 x 2, zero for a component without a constant.
 */
typedef struct inplane_constants {
    double *from_unknowns;
    double from_motion[2][2];
} inplane_constants;

/* A = W'W (count x count). `constants` may be NULL, or has room. */
strum_status inplane_compliance(const strum_cable *cable, const inplane_frame *frame,
                                const inplane_part *part, inplane_form form, double *compliance,
                                inplane_constants *constants, arena *scratch);

/* INT b'_i . (tt' weight_t + nn' weight_n) b'_j cosh(chi) dchi (count x count). */
strum_status inplane_inertia(double weight_t, double weight_n, const inplane_frame *frame,
                             const inplane_part *part, inplane_form form, double *matrix,
                             arena *scratch);

/* K of the complementary form, A f = (1/w^2) K f with weights 1/m_t, 1/m_n:
 * INT p_i . (tt' weight_t + nn' weight_n) p_j sech(chi) dx/(dchi/dx). */
strum_status inplane_complementary(double weight_t, double weight_n, const inplane_frame *frame,
                                   const inplane_part *part, double *matrix, arena *scratch);

#endif
