/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The stiffness of small motion, its inverse, and what holds the cable: ends, bed, springs.
 *
 * With K the stiffness of the strains and R the rows of what is held (compliance a = 0) and of
 * springs (a = 1/k), the motion under loads y solves
 *     K x = y - R'nu,   R x = a nu,   so   (R K^-1 R' + diag a) nu = R K^-1 y:
 * springs of any stiffness, up to rigid, cost no digits. With the normal force Q0 of a static
 * shape that has bending stiffness, strains and rotations are coupled on each element,
 *     K = [1 -E; -E' K_th],   and K_th - E'E is the band.
 */
#ifndef CORE_CABLE_STIFFNESS_H
#define CORE_CABLE_STIFFNESS_H

#include "core/cable/motion.h"

typedef struct stiffness {
    const motion *motion;
    int n;             /* columns of rotations: the strains' part is the identity */
    double **coupling; /* E of each element, strains x rotations, row after row; NULL: none */
    int *last;         /* row up to which column j reaches */
    double **column;   /* column[j][i], i = j .. last[j], of Cholesky's factor */
    int rows, held;    /* those of the motion */
    int rank;          /* of what is held: the rest holds already */
    bool *dropped;
    double *row, *solved; /* R and K^-1 R', each row after row, of all columns */
    double *factor;       /* of the scaled R K^-1 R' + a, rows x rows */
    double *scale;
    double *nu; /* of the last call of stiffness_solve: forces of what holds, on the cable */
} stiffness;

/* STRUM_ERR_IMPOSSIBLE: the static shape is not stable. */
strum_status stiffness_make(const motion *m, arena *memory, stiffness *k);
/* x, and z = K x + R_s' R_s x / a of what is held alone left out: the part of y that it balances.
 */
void stiffness_solve(stiffness *k, const double *y, double *x, double *z);
/* y = K_loss x: EA and EI times their loss factors. */
void stiffness_loss(const motion *m, const double *x, double *y);
/* E of an element. */
void stiffness_coupling(const motion *m, const motion_element *e, double *coupling);
/* The stiffness of an element's rotations without its springs: e->rotations squared. */
void stiffness_element(const motion *m, const motion_element *e, double *weighted, double *k);

#endif
