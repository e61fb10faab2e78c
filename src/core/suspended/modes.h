/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CORE_SUSPENDED_MODES_H
#define CORE_SUSPENDED_MODES_H

#include <strum/modes.h>

#include "core/numerics/work.h"
#include "core/suspended/roots.h"

struct strum_modes {
    strum_cable cable;
    strum_plane plane;
    mapping coordinate;
    int size;
    double difference; /* of two sizes */
    double tail;       /* of the shapes' coefficients */
    bool shapes;
    bool unscaled; /* shapes without `factors` and `units` */
    int count, overdamped;
    strum_mode *modes;
    root *roots; /* of the modes; vectors NULL without shapes */
    double *decays;
    in_plane_part *parts[3]; /* by symmetry: what the vectors' unknowns are */
    double *factors;         /* of the basis; with shapes only, as the next */
    double _Complex *units;  /* the largest displacement of each mode */
    arena memory;            /* owns all the above */
};

/* Most unknowns a component; beyond it an answer is refused rather than waited for. A quadratic
 * eigenproblem (damping not proportional to mass) costs about a hundred times a symmetric one.
 */
#define SPECTRUM_SIZE_MAX           1400
#define SPECTRUM_SIZE_MAX_QUADRATIC 500

/* STRUM_ERR_RANGE with the reason where a property of the cable is out of its range. */
strum_status spectrum_check_cable(const strum_cable *cable, strum_error *fault);

/* All roots of a search, and of its leading block where `inner` is not NULL. Memory is the
 * arena's. */
strum_status spectrum_roots(const root_search *q, arena *a, root_list *list, root_list *inner,
                            in_plane_part *parts[3]);

/* strum_modes_solve in plane, for a caller that makes shapes of the vectors by itself: what
 * strum_spectrum_shape and strum_modes_verify need beside them is not found. */
strum_status spectrum_unscaled(const strum_cable *cable, int count, work *w,
                               strum_modes **modes, strum_error *error);

/* strum_modes_below within a solve. */
strum_status modes_count_below(const strum_cable *cable, double frequency, work *w, int *count,
                               strum_error *error);

/* Number of modes to expect below `frequency` from the phase of a travelling wave; an estimate
 * for sizes. */
double spectrum_phase_count(const strum_cable *cable, strum_plane plane, double frequency);
/* Size at which the first `count` modes should be right to 1e-12. */
int spectrum_first_size(const strum_cable *cable, const mapping *x, strum_plane plane,
                        int count);
/* The coordinate in which they need fewer functions, and that size in it. */
mapping spectrum_mapping(const strum_cable *cable, strum_plane plane, int count, int *size);

/* Force F, F' = dF/dsigma and displacement X of a mode at x, in the middle tangent frame. */
typedef struct in_plane_state {
    double cosh_chi, c, s;
    double _Complex force[2], displacement[2];
} in_plane_state;
/* `table`: p and q of every k at x. */
void spectrum_in_plane_at(const strum_modes *spectrum, int index, double x, const double *table,
                          in_plane_state *state);
/* Fills `units`. */
strum_status spectrum_normalise(strum_modes *spectrum);

#endif
