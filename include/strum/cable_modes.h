/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Small motion of a cable about its static shape (cable.h): natural frequencies, decay rates and
 * mode shapes, in the plane of the cable and out of it.
 *
 * Model. The exact linearisation of the rod of cable.h with rotary inertia of bodies only, under
 * e^{lambda t}, lambda = -decay + i frequency. Links act from ground and are unstressed in the
 * static shape. What lies on the bed is held, and the hanging parts are then pinned at its edges
 * and move independently; or it slides without friction.
 *
 * Spans in a row: each has the static shape of one; between them the cable hangs from rigid rods,
 * whose feet move along and across the row against (P + W/2)/l with a third of their mass (P the
 * cable's pull, W the weight under standard gravity, l the length). It is continuous there; places
 * count on from span to span.
 *
 * Units: SI; frequencies in rad/s.
 *
 *     strum_cable_modes_params params = STRUM_CABLE_MODES_PARAMS_INIT;
 *     strum_cable_modes *modes = NULL;
 *     strum_cable_mode mode;
 *     if (strum_cable_modes_solve(hanging, &params, NULL, &modes, NULL) == STRUM_OK)
 *         for (size_t i = 0; i < strum_cable_modes_count(modes); i++)
 *             if (strum_cable_modes_get(modes, i, &mode) == STRUM_OK)
 *                 printf("%g\n", mode.frequency);
 *     strum_cable_modes_free(modes);
 *
 * Ownership: a strum_cable_modes holds its cable, which the caller may free first; it is
 * read-only, so many threads may read it at once.
 */
#ifndef STRUM_CABLE_MODES_H
#define STRUM_CABLE_MODES_H

#include <strum/cable.h>

STRUM_BEGIN_DECLS

/* Largest number of modes of one call. */
#define STRUM_CABLE_MODES_MAX 200

typedef enum strum_cable_contact_motion {
    STRUM_CABLE_HELD,   /* what lies does not move: any friction does that in small motion */
    STRUM_CABLE_SLIDING /* it moves along the bed, or sideways on it, without friction */
} strum_cable_contact_motion;

typedef struct strum_cable_modes_params {
    strum_plane plane;
    int count; /* 1 .. STRUM_CABLE_MODES_MAX */
    strum_cable_contact_motion contact;
} strum_cable_modes_params;

#define STRUM_CABLE_MODES_PARAMS_INIT                                                          \
    {                                                                                          \
        STRUM_IN_PLANE, 6, STRUM_CABLE_HELD                                                    \
    }

typedef struct strum_cable_modes strum_cable_modes;

/* The first `count` modes that oscillate, by frequency, and the overdamped roots up to the last of
 * them; fewer where the cable has not more. Galerkin's method in strains (Legendre, with elements
 * for the layers at ends and joints), block Lanczos; what is attached and damps is added to the
 * reduced model. Counted as strum_cable_modes_certificate says: STRUM_ERR_ACCURACY where the count
 * or the error estimate (1e-12 undamped, 1e-10 damped) is not met. STRUM_ERR_RANGE with
 * STRUM_CABLE_ARG_COUNT; STRUM_ERR_IMPOSSIBLE: the static shape is slack at a point, or unstable;
 * STRUM_ERR_METHOD: several spans with stiff statics;
 * STRUM_ERR_MEMORY, and what `options` ends. *modes is NULL after an error. */
strum_status strum_cable_modes_solve(const strum_hanging *cable,
                                     const strum_cable_modes_params *params,
                                     const strum_options *options, strum_cable_modes **modes,
                                     strum_error *error);

size_t strum_cable_modes_count(const strum_cable_modes *modes);

typedef struct strum_cable_mode {
    double frequency, decay;
    /* Shares of the stiffness energy (largest in a cycle where damped); their sum is 1. Of springs
     * and absorbers' springs: attachments. */
    double energy_tension, energy_bending, energy_axial, energy_attachments;
    double attachment_share; /* of the kinetic energy: bodies and absorbers */
    double symmetric_share;  /* of the cable's kinetic energy: of the motion that mirrors itself
                                about the middle of the unstretched length, seen along the chord */
    /* At ends 1 and 2, per unit of the largest displacement component of the cable. 0 where a
     * mode's part does not reach the end. */
    strum_complex end_tension[2], end_moment[2];
    size_t run; /* the hanging part that moves, from 0; 0 where what lies slides */
    bool damped;
} strum_cable_mode;

/* Mode `index` in 0 .. count - 1, else STRUM_ERR_RANGE; STRUM_ERR_MEMORY. */
strum_status strum_cable_modes_get(const strum_cable_modes *modes, size_t index,
                                   strum_cable_mode *mode);

/* Overdamped roots lambda < 0: their number and decay rates -lambda, ascending; owned by `modes`.
 */
size_t strum_cable_modes_overdamped(const strum_cable_modes *modes, const double **decays);

typedef struct strum_cable_certificate {
    const char *method; /* static text: "inertia", or "inertia and argument principle" */
    long expected, found;
    double error; /* estimate of the relative error of the frequencies */
} strum_cable_certificate;

/* How many modes there are up to the last of them, by an independent count: the negative pivots of
 * K - s^2 M with what is held; where damped, of the undamped cable, and the winding number of the
 * characteristic function round the roots. */
void strum_cable_modes_certificate(const strum_cable_modes *modes,
                                   strum_cable_certificate *certificate);

/* Of a mode; imaginary parts are 0 where undamped. The largest component of displacement at the
 * points of the discretisation is +1. */
typedef struct strum_cable_motion_point {
    double position;         /* unstretched */
    strum_complex x, z, y;   /* in plane x and z, out of plane y */
    strum_complex tension;   /* increment, N per m of that component; 0 out of plane */
    strum_complex curvature; /* increment of the angle's derivative, per unstretched metre; with
                                bending stiffness */
} strum_cable_motion_point;

/* Mode `index` at `n` unstretched places, or, where `positions` is NULL, at n >= 2 equally spaced
 * ones, ends included. `points`: room for n. STRUM_ERR_RANGE, STRUM_ERR_MEMORY. */
strum_status strum_cable_modes_shape(const strum_cable_modes *modes, size_t index,
                                     const double *positions, size_t n,
                                     strum_cable_motion_point *points);

/* A second method: collocation of the first-order system at Gauss points, each mode's lambda
 * corrected by inverse iteration. The difference is that correction over |lambda|; counts are those
 * of the certificate. STRUM_ERR_ACCURACY where the cable needs too many elements; and what `options`
 * ends, STRUM_ERR_MEMORY. */
strum_status strum_cable_modes_verify(const strum_cable_modes *modes,
                                      const strum_options *options,
                                      strum_verification *verification, strum_error *error);

/* NULL is fine. */
void strum_cable_modes_free(strum_cable_modes *modes);

STRUM_END_DECLS
#endif
