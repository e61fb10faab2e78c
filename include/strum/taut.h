/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Taut chains: cable segments, masses, rigid bodies, absorbers and supports in a row, after
 * C. R. Levesque, Vibration Suppression in Finite Length Marine Cable Systems (1997), with the
 * transfer matrix library of Li that it reproduces, and S. Sergev and W. D. Iwan, Natural
 * Frequencies and Mode Shapes of Cables with Attached Masses (1980).
 *
 * Units: SI. Motion ~ e^{i w t}; w = `frequency` + i `decay`, decaying roots have Im w > 0. The
 * state at a station is (y, V), V = T y', and a component takes the state at its left to the
 * one at its right: right = F left. F of a chain is F_n ... F_2 F_1 (Levesque's equation 2-4
 * multiplies in the other order, which is right only where every component is symmetric).
 *
 *     strum_taut_component part = {.kind = STRUM_TAUT_CABLE};
 *     strum_taut *chain = NULL;
 *     strum_taut_roots *roots = NULL;
 *     strum_error error;
 *     const long numbers[] = {1, 2, 3};
 *     const strum_taut_query query = {.numbers = numbers, .count = 3};
 *     part.tension_left = part.tension_right = 5000.0;
 *     part.cable.length = 50.0;
 *     part.cable.mass_per_length = 1.0;
 *     if (strum_taut_make(&part, 1, STRUM_TAUT_FIXED, STRUM_TAUT_FIXED, &chain, &error) == STRUM_OK &&
 *         strum_taut_solve(chain, &query, NULL, &roots, &error) == STRUM_OK)
 *         for (size_t i = 0; i < roots->count; i++)
 *             printf("%g rad/s\n", roots->roots[i].frequency);
 *     strum_taut_roots_free(roots);
 *     strum_taut_free(chain);
 *
 * Every frequency is certain by a count: the undamped modes by the number of modes below a
 * frequency (a signed shooting count), the damped ones by the argument principle on the entire
 * characteristic function.
 *
 * Ownership: structs are the caller's; a chain is made by strum_taut_make and ended by
 * strum_taut_free, and keeps copies of all it was given. Roots need their chain no longer. A
 * shape holds a counted reference to its chain: either may be freed first. All functions are
 * re-entrant; a chain, roots and a shape may be read by many threads at once.
 */
#ifndef STRUM_TAUT_H
#define STRUM_TAUT_H

#include <strum/types.h>

STRUM_BEGIN_DECLS

#define STRUM_TAUT_COMPONENTS_MAX 10000
/* Links of one body. */
#define STRUM_TAUT_LINKS_MAX 16
/* Largest mode number, and largest number of modes or roots of one call. */
#define STRUM_TAUT_MODE_MAX 100000
/* Largest factor between the tensions at the ends of a varying cable: its solution is built of
 * stretches over which the tension changes by a fixed factor. */
#define STRUM_TAUT_TENSION_FACTOR_MAX 1e9
#define STRUM_TAUT_ROOTS_MAX          5000
/* Nodes of one shape. */
#define STRUM_TAUT_NODES_MAX 1000000

/* Components passed by all evaluations of one solve (some 0.1 us each); beyond it a solve gives
 * up with STRUM_ERR_ACCURACY. */
#define STRUM_TAUT_WORK_MAX 3e8

/* `argument` of an error of this header. */
typedef enum strum_taut_argument {
    STRUM_TAUT_ARG_COMPONENTS = 1 /* `index`: which */
} strum_taut_argument;

/* ---- the chain ---- */

typedef enum strum_taut_kind {
    STRUM_TAUT_CABLE,   /* uniform tension (tension_left = tension_right) */
    STRUM_TAUT_VARYING, /* tension linear from left to right */
    STRUM_TAUT_BODY,    /* rigid links in a row: a lump (one link) or an in-line absorber */
    STRUM_TAUT_HANGING, /* a mass on a spring and a damper, hung to the chain */
    STRUM_TAUT_GROUND,  /* spring, damper and inerter to ground; a point mass is an inerter */
    STRUM_TAUT_SUPPORT  /* a rigid lever through which the chain passes, pinned to ground */
} strum_taut_kind;

/* A rigid link: its centre of mass lies `left` after its left end and `right` before its right
 * end; inertia about the centre of mass. */
typedef struct strum_taut_link {
    double left, right;   /* m, >= 0 */
    double mass, inertia; /* kg, kg m^2, >= 0 */
} strum_taut_link;

/* Between two links: a hinge that carries the axial force `force` (> 0), with a spring at lever
 * arm `spring_arm` and a damper at `damper_arm`: rotational stiffness stiffness * spring_arm^2,
 * rotational damping damping * damper_arm^2. Damping INFINITY (with an arm > 0) locks it. */
typedef struct strum_taut_joint {
    double spring_arm, damper_arm; /* m, >= 0 */
    double stiffness, damping;     /* N/m, N s/m, >= 0 */
    double force;                  /* N, > 0 */
} strum_taut_joint;

/* What each kind of component is made of. Types of their own: standard C++ allows none to be
 * declared within a union without a name. */
typedef struct strum_taut_cable {
    double length, mass_per_length, drag; /* m > 0, kg/m >= 0, N s/m^2 >= 0 */
} strum_taut_cable;

typedef struct strum_taut_varying {
    double length, mass_per_length; /* m > 0, kg/m > 0 */
    bool wkb;                       /* Li's WKB matrix (A.2) instead of the exact solution */
} strum_taut_varying;

typedef struct strum_taut_body {
    const strum_taut_link *links;   /* `count` of them, left to right */
    const strum_taut_joint *joints; /* count - 1 */
    size_t count;                   /* 1 .. STRUM_TAUT_LINKS_MAX */
} strum_taut_body;

typedef struct strum_taut_hanging {
    double mass, stiffness, damping; /* damping may be INFINITY: a mass held fast */
} strum_taut_hanging;

typedef struct strum_taut_ground {
    double stiffness, damping, inertance; /* N/m, N s/m, kg, >= 0 */
} strum_taut_ground;

typedef struct strum_taut_support {
    double length, pivot, inertia; /* 0 < pivot < length from the left; about the pivot */
} strum_taut_support;

typedef struct strum_taut_component {
    strum_taut_kind kind;
    /* N, > 0 (of a support one may be 0); not read for HANGING and GROUND */
    double tension_left, tension_right;
    union {
        strum_taut_cable cable;
        strum_taut_varying varying;
        strum_taut_body body;
        strum_taut_hanging hanging;
        strum_taut_ground ground;
        strum_taut_support support;
    };
} strum_taut_component;

/* Links of the shapes that Li's library names. The apex of a cone carries its smaller end. */
strum_taut_link strum_taut_bar(double length, double mass);
strum_taut_link strum_taut_sphere(double diameter, double mass);
strum_taut_link strum_taut_cone(double height, double base_radius, double mass, bool apex_left);

typedef enum strum_taut_end { STRUM_TAUT_FIXED, STRUM_TAUT_FREE } strum_taut_end;

typedef struct strum_taut strum_taut;

/* A chain of `count` components from left to right. */
strum_status strum_taut_make(const strum_taut_component *components, size_t count,
                             strum_taut_end left, strum_taut_end right, strum_taut **chain,
                             strum_error *error);
/* Gives back the caller's reference; NULL is fine. */
void strum_taut_free(strum_taut *chain);
/* Sum of the lengths of the components, m. */
double strum_taut_length(const strum_taut *chain);
/* Does any component dissipate (finite, positive damping)? */
bool strum_taut_is_damped(const strum_taut *chain);

/* ---- transfer matrices ---- */

/* [t11, t12, t21, t22] of component `index`, or of the whole chain, at w = frequency + i decay.
 * STRUM_ERR_IMPOSSIBLE at a pole of a component (a body or an absorber that resonates with both
 * ends held), STRUM_ERR_RANGE where an entry is beyond a double. */
strum_status strum_taut_component_matrix(const strum_taut *chain, size_t index,
                                         double frequency, double decay,
                                         strum_complex matrix[4], strum_error *error);
strum_status strum_taut_matrix(const strum_taut *chain, double frequency, double decay,
                               strum_complex matrix[4], strum_error *error);

/* ---- modes without damping ---- */

/* The number of modes below w > 0 of the chain with every finite damping taken as zero: exact,
 * multiple modes counted as often as they occur. */
long strum_taut_count(const strum_taut *chain, double frequency);

/* Frequencies (rad/s) of the modes `numbers` (strictly ascending, from 1) with every finite
 * damping taken as zero. A mode that is a rigid motion has frequency 0. STRUM_ERR_IMPOSSIBLE
 * when the chain (without any cable) has fewer modes. */
strum_status strum_taut_frequencies(const strum_taut *chain, const long *numbers, size_t count,
                                    const strum_options *options, double *frequencies,
                                    strum_error *error);

/* ---- modes with damping ---- */

typedef struct strum_taut_root {
    long mode; /* its number at zero damping; 0 for a root on no branch that starts there */
    double frequency, decay; /* rad/s >= 0 (0: overdamped), 1/s >= 0 */
    /* Relative change of all damping at which this root would meet another one (the modulus of
     * a complex number, from their distance and speeds); INFINITY when far or unknown. About 0
     * at an exceptional point, where a frequency has only half its digits. */
    double exceptional;
    /* Estimated relative error of frequency + i decay, from what rounding does to the
     * characteristic function there and from how the root moves with the damping; 0: unknown. */
    double error;
} strum_taut_root;

typedef enum strum_taut_method {
    STRUM_TAUT_CERTIFIED, /* branches followed from zero damping, certified by a count */
    STRUM_TAUT_MULLER     /* Muller's method with deflation, from each undamped frequency */
} strum_taut_method;

/* What is asked: the modes `numbers` (ascending); or, where `count` is 0, by place: the
 * `wanted` roots from place `first` on (from 1) of all that oscillate, by frequency, then decay,
 * those without a number too (rigid motions come first, with frequency 0); or, where both are 0,
 * all roots with lowest <= Re w <= highest and Im w <= max_decay. Without damping places are
 * mode numbers. */
typedef struct strum_taut_query {
    const long *numbers;
    size_t count;
    long first;
    size_t wanted;
    double lowest, highest; /* rad/s, 0 < lowest < highest */
    double max_decay; /* 1/s, > 0; 0 with `numbers`: what their roots need; 0 by place: any */
    strum_taut_method method;
    /* Roots of a similar chain (may be NULL): where they lead to every root that the count
     * expects, no branch is followed, no overdamped root sought, and `exceptional` left
     * unknown. Only for a band. */
    const strum_taut_root *guesses;
    size_t guess_count;
} strum_taut_query;

/* What became of a mode that no oscillating root has the number of. */
typedef enum strum_taut_fate {
    STRUM_TAUT_OVERDAMPED, /* it no longer oscillates */
    STRUM_TAUT_UNBOUNDED,  /* its decay grew without bound before the full damping */
    STRUM_TAUT_COALESCED   /* its branch met another root and cannot be told from it beyond */
} strum_taut_fate;

typedef struct strum_taut_missing {
    long mode;
    strum_taut_fate fate;
    double factor; /* of all damping, to which its branch was followed */
} strum_taut_missing;

typedef struct strum_taut_roots {
    strum_taut_root *roots; /* oscillating; by frequency, or as numbers were asked */
    size_t count;
    strum_taut_root *overdamped; /* frequency 0, by decay, up to the decay searched */
    size_t overdamped_count;
    /* How the roots were counted (static text), in [lowest, highest] x [0, max_decay]. */
    const char *count_method;
    double lowest, highest, max_decay;
    long expected, found; /* oscillating roots there: by the count, and known */
    /* By the count and known, on the axis Re w = 0 up to max_decay: overdamped roots and rigid
     * motions. */
    long axis_expected, axis_found;
    /* Modes (of those asked, in the band, or between those answered) without an oscillating
     * root; `lost`: how many of their branches end before the full damping is reached. */
    strum_taut_missing *missing;
    size_t missing_count;
    long lost;
    /* Beyond max_decay, though more was asked, rounding hides the roots: a damper matches its
     * cable. */
    bool hidden_beyond;
    /* Roots that Muller's method missed, and those it found from another mode's guess. */
    long missed, hopped;
    double max_residual; /* largest distance to the next Newton iterate, relative */
    long evaluations;    /* of the characteristic function */
} strum_taut_roots;

/* STRUM_ERR_RANGE also where a mode lies beyond 1e-120 and 1e120 rad/s. */
strum_status strum_taut_solve(const strum_taut *chain, const strum_taut_query *query,
                              const strum_options *options, strum_taut_roots **roots,
                              strum_error *error);
void strum_taut_roots_free(strum_taut_roots *roots);

/* One branch, followed from mode `mode` at zero damping through `count` ascending factors > 0
 * by which every finite damping is multiplied; frequency 0 from where it is overdamped (then
 * `decay` is that of the slower of its two roots). STRUM_ERR_ACCURACY where it cannot be
 * followed. */
strum_status strum_taut_follow(const strum_taut *chain, long mode, const double *factors,
                               size_t count, const strum_options *options,
                               strum_taut_root *roots, strum_error *error);

/* ---- shapes ---- */

typedef struct strum_taut_point {
    double x;                   /* m from the left end */
    strum_complex displacement; /* largest magnitude along the chain: +1 (the leftmost one) */
    strum_complex force;        /* V = T y' per unit of displacement, N/m */
} strum_taut_point;

typedef struct strum_taut_antinode {
    double x, amplitude; /* m; |y|, largest 1 */
} strum_taut_antinode;

typedef struct strum_taut_shape strum_taut_shape;

/* The shape of a root of the chain: shooting from both ends, joined where the motion is
 * largest. `root->frequency` > 0. STRUM_ERR_METHOD above STRUM_TAUT_NODES_MAX nodes, STRUM_ERR_RANGE
 * beyond 1e-120 and 1e120 rad/s. */
strum_status strum_taut_shape_make(const strum_taut *chain, const strum_taut_root *root,
                                   const strum_options *options, strum_taut_shape **shape,
                                   strum_error *error);
void strum_taut_shape_free(strum_taut_shape *shape);
/* At `count` >= 2 equally spaced points, ends included. */
strum_status strum_taut_shape_sample(const strum_taut_shape *shape, size_t count,
                                     strum_taut_point *points, strum_error *error);
/* Nodes (ends and whatever rests with them excluded; the pin of a support included) and
 * antinodes (local largest |y|, cusps at masses included) of a root without decay, ascending;
 * owned by the shape. A decaying root has none: no point of it stays at rest. */
size_t strum_taut_shape_nodes(const strum_taut_shape *shape, const double **nodes);
size_t strum_taut_shape_antinodes(const strum_taut_shape *shape,
                                  const strum_taut_antinode **antinodes);

/* ---- verification ---- */

/* Roots found, by a second, independent method: without damping an assembled dynamic stiffness
 * with Wittrick and Williams' count, bisected; with damping the quadratic eigenproblem of
 * spectral finite elements. Residuals are those of the roots, as in strum_taut_roots.
 * STRUM_ERR_METHOD where the second method would need too large a problem. */
strum_status strum_taut_verify(const strum_taut *chain, const strum_taut_roots *roots,
                               const strum_options *options, strum_verification *verification,
                               strum_error *error);

STRUM_END_DECLS
#endif
