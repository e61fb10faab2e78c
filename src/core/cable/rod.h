/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The static shape with bending stiffness: a rod that is straight when unstressed, extensible and
 * unshearable. With the angle th of its tangent t, F the force, N = F.t, Q = F.n, e = N/EA, it
 * makes stationary
 *     W = INT EI th'^2/2 - N - N^2/(2 EA) dS + F0.R + k (th - angle)^2/2 at sprung ends
 * over th and the force F0 at end 1: by th   (EI th')' = -(1 + e) Q,  by F0 the place of end 2.
 */
#ifndef CORE_CABLE_ROD_H
#define CORE_CABLE_ROD_H

#include "core/cable/cable.h"
#include "core/numerics/status.h"
#include "core/numerics/work.h"

#define ROD_DEGREE_MAX 32

/* Of a stretch of one piece: th = hats of the angles at its ends, and bubbles, the integrals of
 * the orthonormal Legendre polynomials 1, 2, .. on [-1, 1]. */
typedef struct {
    size_t piece;
    double from, half; /* from the start of the piece; half its length */
    int degree;
    size_t first; /* of its degree - 1 bubbles among all */
    size_t node;  /* its left one; the right one is the next */
    double x, z;  /* of its start */
    double stretched;
} rod_element;

struct cable_rod {
    rod_element *elements;
    size_t count;
    double *angle; /* at nodes; pieces without bending stiffness part them */
    size_t nodes;
    double *bubble; /* coefficients */
    size_t bubbles;
    double moment[2]; /* at the ends of the cable */
    size_t *first;    /* element of each piece; count + 1 entries, equal where it has none */
};

typedef struct {
    double angle, turn;            /* th, dth/dS */
    double normal, shear, stretch; /* N, Q, 1 + e */
    double x, z;
} rod_point;

/* At `s` from the start of a piece that bends. x and z cost an integral: only if `place`. */
rod_point rod_at(const strum_hanging *cable, size_t piece, double s, bool place);
/* Whether a piece bends in the static shape. */
static inline bool rod_bends(const strum_hanging *cable, size_t piece)
{
    return cable->rod != NULL && cable->pieces[piece].section->bending_stiffness > 0;
}

/* Orthonormal Legendre polynomials 0 .. degree at x. */
void rod_legendre(int degree, double x, double *p);
/* Bubbles 2 .. degree at x. */
void rod_bubbles(int degree, double x, double *bubble);

/* Divides the pieces into elements for the rod, and begins with the angles of the cable without
 * bending stiffness. `halvings`: of every element. STRUM_ERR_MEMORY. */
strum_status rod_divide(strum_hanging *cable, int halvings, arena *memory, cable_rod **rod);

/* From the cable as it hangs without bending stiffness, of given lengths between given ends, to
 * the rod: cable->rod, forces and places of pieces. STRUM_ERR_IMPOSSIBLE where it is not stable. */
strum_status rod_settle(strum_hanging *cable, double span, work *w, strum_error *error);
/* All figures of the rod. */
void rod_measure(strum_hanging *cable, double span);

#endif
