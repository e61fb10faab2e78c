/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CORE_SUSPENDED_FORCED_MODAL_H
#define CORE_SUSPENDED_FORCED_MODAL_H

#include <stdatomic.h>

#include <strum/forced.h>

#include "core/numerics/work.h"
#include "core/suspended/in_plane.h"

/* One symmetry class of the in-plane problem: A f = mu K f, phi'K phi = 1. */
typedef struct forced_part {
    in_plane_part part;     /* with A */
    double *along, *across; /* K = along/m_t + across/m_n */
    double *mu, *phi;       /* all n pairs, mu descending */
    int modes;              /* pairs whose mu is more than rounding */
    double *share[2];       /* phi.r for unit end motion in each direction of the frame */
    double *rest[2]; /* sum of phi (phi.r) over the other pairs, which all answer alike */
} forced_part;

/* A natural frequency up to the highest one. */
typedef struct forced_natural {
    const forced_part *part; /* NULL: out of plane */
    int pair;                /* of the part, or number out of plane, from 0 */
    int mode;                /* within its plane, from 1 */
    double frequency;
    strum_symmetry symmetry;
} forced_natural;

struct strum_forced {
    atomic_uint references; /* the caller's, and one of each response */
    strum_cable cable;
    mapping coordinate;
    double frequency_max;
    bool in_plane, out_of_plane, proportional;
    int size; /* basis functions */
    int part_count;
    forced_part parts[2];
    double end[2][2];       /* tangent and normal at end 2 in the middle tangent frame */
    double *out_nu, *out_v; /* out of plane: M v = nu K v */
    double *out_inertia, *out_stretch; /* loads of the lifting (1 + x)/2 */
    double *factors;                   /* of the legendre */
    int samples;                       /* equally spaced in x, for the peak */
    double *sample_q, *sample_t; /* q_k(x_i) at [i + k samples]; t: two components a sample */
    forced_natural *naturals;    /* ascending */
    size_t natural_count;
    arena memory; /* owns all the above */
};

/* F = c + scale sum v_k q_k, X = (tt' inverse_t + nn' inverse_n) sum v_k p_k / (mu cosh chi).
 */
struct strum_response {
    strum_forced *forced; /* a counted reference */
    double frequency;
    strum_end_motion motion;
    bool real; /* every coefficient is */
    double _Complex constant[2], scale, inverse_t, inverse_n;
    double *v[2][2];          /* by component and part (re, im) */
    double _Complex *w, lift; /* out of plane: W = lift (1 + x)/2 + sum w_k q_k */
    double *work;             /* factors, unknowns; samples of components */
    double *table; /* p and q at a point, real and imaginary samples, two more samples */
    double _Complex
        *matrix; /* of the damped system, and its right side; NULL where modes serve */
    arena memory;
};

/* Samples of the tension at the forced system's sample points: 2 x samples doubles, (re, im)
 * halves. */
void response_sample(const strum_response *response, double *re, double *im);
/* T and dT/dx at x. */
void response_tension(const strum_response *response, double x, double _Complex *tension,
                      double _Complex *slope);
/* The response of a free mode of a part: for residues. */
void response_of_mode(strum_response *response, const forced_part *part, int mode);

/* The list of natural frequencies, once the rest of `forced` is made. */
strum_status forced_naturals_make(strum_forced *forced);

/* Out of plane: out_of_plane.c. */
strum_status forced_out_of_plane_make(strum_forced *forced);
strum_status forced_out_of_plane_solve(const strum_forced *forced, double frequency,
                                       double _Complex lift, strum_response *response,
                                       strum_resonance *at);
double forced_out_of_plane_frequency(const strum_forced *forced, int j);
double forced_out_of_plane_residue(const strum_forced *forced, int j, double _Complex lift,
                                   double *table);

/* An undamped answer nearer to a natural frequency than this is no answer: linear theory has
 * left its range, and a frequency typed with nine digits is meant to be the natural one. */
#define RESONANCE_WIDTH 1e-8

#endif
