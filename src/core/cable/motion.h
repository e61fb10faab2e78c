/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Small motion of a cable about its static shape, in one plane, as an operator.
 *
 * Unknowns are strains, not displacements: the rotation th of the tangent, continuous where the
 * cable has bending stiffness, and the increment e of the axial strain, free of any continuity:
 *     u' = e t + (1 + e0) th n,   u = 0 at end 1,
 *     2V = INT EA e^2 + N0 (1 + e0) th^2 + EI th'^2 - 2 Q0 e th dS,
 *     2K = INT m |u|^2 + m_a (n.u)^2 + m_t (t.u)^2 dS.
 * Out of plane th is the slope of y, and there is no e:
 *     2V = INT [N0 (1 + e0) - EI th0'^2] th^2 + EI th'^2 dS.
 * So no stiffness, however large, makes another one lose digits, and an inextensible cable is one
 * without e. The stiffness is banded; the mass is applied as cumulative integrals, never formed.
 */
#ifndef CORE_CABLE_MOTION_H
#define CORE_CABLE_MOTION_H

#include "core/cable/cable.h"
#include "core/numerics/work.h"

/* Functions on [-1, 1] at Gauss points. Rotations: (1 - x)/2, (1 + x)/2, then the integrals of
 * the orthonormal Legendre polynomials 1, 2, ..; strains: those polynomials from 0 on. */
typedef struct motion_rule {
    int points; /* also how many functions of each kind */
    double *x, *w;
    double *rotation, *strain;       /* [function * points + point] */
    double *rotation_at, *strain_at; /* [point * points + function] */
    double *integral; /* [point k * points + point q]: from -1 to q of what is 1 at k alone */
    double *integral_to; /* [q * points + k] */
} motion_rule;

typedef struct motion_element {
    const motion_rule *rule;
    size_t piece;
    double from, half; /* unstretched; half its length */
    int rotations;     /* functions of th; 0: what lies cannot turn */
    int strains;       /* functions of e; 0: inextensible, or out of plane */
    /* Columns of the unknowns; -1: held at 0. Rotation function 0 has `left`, 1 `right`, the
     * others follow each other from `inner`. */
    int left, right, inner, strain;
    int point;           /* its first in the tables of motion */
    double bending;      /* EI */
    double strain_scale; /* makes the axial energy of a strain function 1 */
} motion_element;

/* A body, spring or link at the node before element `node`. */
typedef struct motion_row {
    int node;
    double x, z;       /* its direction; out of plane x alone: 1 */
    double compliance; /* of a spring; 0: what is held */
    bool held;         /* not a spring */
} motion_row;

typedef struct motion_body {
    int node;
    double mass[3]; /* xx, xz, zz; out of plane the first alone */
    int turning[2]; /* columns of the rotation on its sides, -1: none */
    double inertia;
} motion_body;

/* A damper to ground, or an absorber: what goes on at the end (damped.h). */
typedef struct motion_link {
    int node;
    double x, z;
    double stiffness, damping, mass; /* mass 0: a damper */
} motion_link;

typedef struct motion {
    const strum_hanging *cable;
    strum_plane plane;
    int components; /* of the displacement: 2 in plane, else 1 */
    size_t first_piece, last_piece;
    motion_element *elements;
    int element_count;
    int columns, rotation_columns;
    int points;
    /* Static state at each point. */
    double *normal_x, *normal_z; /* t = (normal_z, -normal_x) */
    double *stretch;             /* 1 + e0 */
    double *tension;             /* weight of th^2 in the energy, per unstretched metre */
    double *shear;               /* Q0; NULL where it is 0 or has no part */
    double *mass_normal, *mass_tangential; /* times the weight of the point */
    double *drag_normal, *drag_tangential; /* likewise; NULL: none */
    double loss_axial_max, loss_bending_max;
    double end_springs[2]; /* rotation columns' extra stiffness */
    motion_row *rows;      /* held displacements first */
    int row_count, held_count;
    motion_body *bodies;
    int body_count;
    motion_link *links;
    int link_count;
    arena *memory;
} motion;

/* What `params` of modes choose. */
typedef struct motion_choice {
    strum_plane plane;
    bool sliding;
    int modes; /* how many shall be resolved */
    int more;  /* degrees beyond those of the rule */
    size_t first_piece, last_piece;
} motion_choice;

strum_status motion_make(const strum_hanging *cable, const motion_choice *choice, arena *memory,
                         motion *m);

/* Degrees are bounded by the mesh. */
#define POINTS_MAX 96

/* Static state at `s` from the start of a piece: N0, Q0, t and dth0/dS. */
typedef struct motion_state {
    double tension, shear, tangent_x, tangent_z, turn;
} motion_state;
motion_state motion_state_at(const strum_hanging *cable, size_t piece, double s);

/* u' at the points of an element; z in plane alone. */
void motion_slopes(const motion *m, const motion_element *e, const double *v, double *x,
                   double *z);
/* The displacement of the unknowns `v`: at points u[component * points + point], and at nodes
 * 0 .. element_count: nodes[2 node + component]. */
void motion_displace(const motion *m, const double *v, double *u, double *nodes);
/* The transpose: unknowns' loads y of forces f at points (which hold their weights) and at nodes.
 */
void motion_load(const motion *m, const double *f, const double *nodes, double *y);
/* Forces of inertia per unit of squared frequency: u and nodes become m u. `v`: the unknowns;
 * what turns adds to `turning`, of the unknowns' size. */
void motion_inertia(const motion *m, const double *v, double *u, double *nodes,
                    double *turning);
/* y = M v; `room`: motion_room(m) doubles. */
void motion_mass(const motion *m, const double *v, double *room, double *y);
/* y = C v, of the drag. */
void motion_drag(const motion *m, const double *v, double *room, double *y);
size_t motion_room(const motion *m);

/* Loads of a unit force at a node in direction (x, z). */
void motion_row_load(const motion *m, int node, double x, double z, double *room, double *y);

/* The unknowns of one element, one after the other: rotations, strains. */
void motion_gather(const motion_element *e, const double *v, double *rotations,
                   double *strains);

static inline int motion_column(const motion_element *e, int function)
{
    return function == 0 ? e->left : function == 1 ? e->right : e->inner + function - 2;
}

static inline double motion_dot(size_t n, const double *a, const double *b)
{
    double sum[8] = {0}, rest = 0;
    size_t i = 0;
    for (; i + 8 <= n; i += 8)
        for (size_t k = 0; k < 8; k++)
            sum[k] += a[i + k] * b[i + k];
    for (; i < n; i++)
        rest += a[i] * b[i];
    return ((sum[0] + sum[4]) + (sum[1] + sum[5])) + ((sum[2] + sum[6]) + (sum[3] + sum[7])) +
           rest;
}

static inline void motion_add(size_t n, double factor, const double *a, double *b)
{
    for (size_t i = 0; i < n; i++)
        b[i] += factor * a[i];
}

#endif
