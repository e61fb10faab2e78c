/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The cable as it hangs: sections of any weight and stiffness between two ends, with bodies,
 * springs, dampers and absorbers on it, on a sea bed or free; its static shape, and small motion
 * about it. The reports' cables are its exact limits.
 *
 * Model. A geometrically exact, extensible, unshearable rod, straight when unstressed. End 1 is
 * at (0, 0), end 2 at (span, rise), z up. Everything is per unstretched metre, and places along
 * the cable are unstretched lengths S from end 1. The force F(S) = (h, v) points along the cable
 * towards end 2: the cable pulls end 1 by +F, end 2 by -F.
 *
 * Units: SI; angles in radians.
 *
 *     strum_cable_section rope = STRUM_CABLE_SECTION_INIT;
 *     rope.length = 850;
 *     rope.mass = 685;
 *     rope.weight = 5844.118;
 *     rope.axial_stiffness = 3.27e9;
 *     strum_cable_params line = STRUM_CABLE_PARAMS_INIT;
 *     line.sections = &rope;
 *     line.section_count = 1;
 *     line.span = 779.6;
 *     line.rise = 186;
 *     strum_hanging *hanging;
 *     strum_error error;
 *     if (strum_cable_hang(&line, NULL, &hanging, &error) == STRUM_OK) {
 *         strum_cable_statics statics;
 *         strum_cable_statics_get(hanging, &statics);
 *         printf("%.10g N\n", statics.tension_end_2);
 *         strum_cable_free(hanging);
 *     }
 *
 * Ownership: structs are the caller's; a strum_hanging keeps copies of all that it was made from.
 * All functions are re-entrant; an object may be read by many threads at once.
 */
#ifndef STRUM_CABLE_H
#define STRUM_CABLE_H

#include <math.h>

#include <strum/types.h>

STRUM_BEGIN_DECLS

#define STRUM_CABLE_SECTIONS_MAX    1000
#define STRUM_CABLE_ATTACHMENTS_MAX 1000
#define STRUM_CABLE_SPANS_MAX       100
/* Largest size of any number; what must be above 0 is at least 1 over it. */
#define STRUM_CABLE_SIZE_MAX 1e30
/* 80 degrees either way. */
#define STRUM_CABLE_BED_SLOPE_MAX 1.3962634015954636

/* A stretch of cable of one kind, per unstretched metre. */
typedef struct strum_cable_section {
    double length;                   /* m, > 0; not read where it is the unknown (`adjusted`) */
    double mass;                     /* kg/m, >= 0: of the cable itself and what it carries */
    double weight;                   /* N/m: in the fluid; < 0 buoyant, 0 neutral */
    double added_mass;               /* kg/m, >= 0: for motion across the cable */
    double added_mass_tangential;    /* kg/m, >= 0: for motion along it */
    double axial_stiffness;          /* EA, N, > 0; INFINITY: inextensible */
    double bending_stiffness;        /* EI, N m^2, >= 0 */
    double axial_loss, bending_loss; /* EA (1 + i loss), EI (1 + i loss), >= 0 */
    double drag_normal, drag_tangential; /* N s/m^2, >= 0 */
    double bed_friction;                 /* in place of the bed's, >= 0; NAN: the bed's */
} strum_cable_section;

#define STRUM_CABLE_SECTION_INIT                                                               \
    {                                                                                          \
        0.0, 0.0, 0.0, 0.0, 0.0, HUGE_VAL, 0.0, 0.0, 0.0, 0.0, 0.0, NAN                        \
    }

typedef enum strum_cable_attachment_kind {
    STRUM_CABLE_POINT_MASS,  /* mass, weight, added_mass, rotary_inertia */
    STRUM_CABLE_SPRING,      /* stiffness: to ground, unstressed in the static shape */
    STRUM_CABLE_DAMPER,      /* damping */
    STRUM_CABLE_INERTER,     /* inertance */
    STRUM_CABLE_ABSORBER,    /* mass, weight, stiffness, damping: a mass hung on a spring and a
                               damper; it rides with the cable across its line of action */
    STRUM_CABLE_FORCE,       /* force_x, force_z: dead force from outside */
    STRUM_CABLE_TENSION_JUMP /* jump: dead force along the static tangent, towards end 1: the
                                tension behind it is larger by it */
} strum_cable_attachment_kind;

/* Line of action of a spring, damper, inerter or absorber. */
typedef enum strum_cable_direction {
    STRUM_CABLE_NORMAL, /* in the plane, normal to the bisector of the static tangents */
    STRUM_CABLE_TANGENTIAL,
    STRUM_CABLE_VERTICAL,
    STRUM_CABLE_HORIZONTAL,   /* along x */
    STRUM_CABLE_ALL_IN_PLANE, /* two of them: x and z */
    STRUM_CABLE_ACROSS,       /* along y */
    STRUM_CABLE_ALL,          /* x, y and z */
    STRUM_CABLE_ANGLE         /* in the plane, at `angle` from x */
} strum_cable_direction;

typedef struct strum_cable_attachment {
    strum_cable_attachment_kind kind;
    double position; /* m, 0 < position < length of the cable */
    strum_cable_direction direction;
    double angle;
    double mass, weight, added_mass, rotary_inertia; /* kg, N (net, < 0: a float), kg, kg m^2 */
    double stiffness, damping, inertance;            /* N/m, N s/m, kg, >= 0 */
    double force_x, force_z, jump;                   /* N */
} strum_cable_attachment;

typedef enum strum_cable_rotation {
    STRUM_CABLE_PINNED,
    STRUM_CABLE_CLAMPED,
    STRUM_CABLE_SPRUNG
} strum_cable_rotation;

typedef struct strum_cable_end {
    strum_cable_rotation rotation;
    double stiffness; /* of a sprung end, N m/rad, >= 0 */
    double angle;     /* of the clamp, from x; NAN: the tangent of the cable without bending
                         stiffness */
} strum_cable_end;

/* What is given beside span and rise; all but LENGTHS determine one length (`adjusted`), or with
 * `span_unknown` the span. */
typedef enum strum_cable_given {
    STRUM_CABLE_LENGTHS,            /* every section's own length */
    STRUM_CABLE_HORIZONTAL_TENSION, /* at end 1 */
    STRUM_CABLE_TENSION_END_1,
    STRUM_CABLE_TENSION_END_2,
    STRUM_CABLE_TENSION_PARALLEL_TO_CHORD,
    STRUM_CABLE_CATENARY_PARAMETER, /* H/|w| of the adjusted section */
    STRUM_CABLE_SAG_MID,            /* vertically from the chord at half the span */
    STRUM_CABLE_SAG_MAX,            /* largest such */
    STRUM_CABLE_DEPTH_BELOW_END_1,  /* of the lowest point */
    STRUM_CABLE_STRETCHED_LENGTH,
    STRUM_CABLE_ANGLE_END_1,
    STRUM_CABLE_ANGLE_END_2
} strum_cable_given;

/* A rigid plane z = -depth + x tan(slope). Friction acts on what lies from end 1 on, against the
 * pull of end 2; other contacts are without friction. */
typedef struct strum_cable_bed {
    bool present;
    double depth;    /* below end 1, m, >= 0 */
    double slope;    /* within +-STRUM_CABLE_BED_SLOPE_MAX */
    double friction; /* >= 0 */
} strum_cable_bed;

typedef struct strum_cable_params {
    const strum_cable_section *sections;       /* end 1 to end 2; read during the call only */
    size_t section_count;                      /* 1 .. STRUM_CABLE_SECTIONS_MAX */
    const strum_cable_attachment *attachments; /* in any order; read during the call only */
    size_t attachment_count;                   /* 0 .. STRUM_CABLE_ATTACHMENTS_MAX */
    double span, rise;                         /* m; span >= 0 */
    strum_cable_given given;
    double value;      /* of the given quantity: N, m or rad */
    size_t adjusted;   /* the section whose length is unknown, from 0 */
    bool span_unknown; /* all lengths are given, and the span follows */
    bool slack_branch; /* of two shapes with one end tension, the longer */
    strum_cable_end end_1, end_2;
    bool stiff;   /* bending stiffness counts in the static shape; not on a bed */
    size_t spans; /* so many equal level spans in a row: 1 .. STRUM_CABLE_SPANS_MAX */
    double hanger_length, hanger_mass; /* between them: a rigid rod from a fixed point above */
    strum_cable_bed bed;
    double temperature_change, expansion; /* K, 1/K: every length by 1 + expansion * change,
                                             masses and weights kept */
    double taken_in; /* m taken off the adjusted section after the shape was found */
} strum_cable_params;

/* One level span without bed; sections and geometry remain to be set. */
#define STRUM_CABLE_PARAMS_INIT                                                                \
    {                                                                                          \
        .given = STRUM_CABLE_LENGTHS, .end_1 = {STRUM_CABLE_PINNED, 0.0, NAN},                 \
        .end_2 = {STRUM_CABLE_PINNED, 0.0, NAN}, .spans = 1                                    \
    }

/* strum_error.argument of the functions here. `index`: the section or attachment. */
typedef enum strum_cable_argument {
    STRUM_CABLE_ARG_SECTIONS = 1,
    STRUM_CABLE_ARG_ATTACHMENTS,
    STRUM_CABLE_ARG_SPAN,
    STRUM_CABLE_ARG_RISE,
    STRUM_CABLE_ARG_VALUE, /* of the given quantity */
    STRUM_CABLE_ARG_ADJUSTED,
    STRUM_CABLE_ARG_END_1,
    STRUM_CABLE_ARG_END_2,
    STRUM_CABLE_ARG_SPANS,
    STRUM_CABLE_ARG_HANGER,
    STRUM_CABLE_ARG_BED,
    STRUM_CABLE_ARG_TEMPERATURE,
    STRUM_CABLE_ARG_TAKEN_IN,
    STRUM_CABLE_ARG_COUNT, /* of modes */
    STRUM_CABLE_ARG_PLACES
} strum_cable_argument;

/* A cable in its static shape. */
typedef struct strum_hanging strum_hanging;

/* The static shape. Where several shapes have the figure that is given, the shortest is found, or
 * with `slack_branch` the longest; the tension parallel to the chord is that of the first place
 * where the cable is so. `*cable` is the caller's, NULL after an error: STRUM_ERR_RANGE with the
 * argument; STRUM_ERR_IMPOSSIBLE where no such cable hangs (the reason says why, and names the
 * least possible value where there is one). */
strum_status strum_cable_hang(const strum_cable_params *params, const strum_options *options,
                              strum_hanging **cable, strum_error *error);

typedef struct strum_cable_place {
    double x, z;
} strum_cable_place;

typedef struct strum_cable_statics {
    double horizontal_end_1, vertical_end_1, tension_end_1; /* F at end 1; N */
    double horizontal_end_2, vertical_end_2, tension_end_2;
    double tension_min, tension_max, tension_parallel_to_chord; /* the last NAN where none is */
    double span, rise, unstretched_length, length;
    double sag_mid, sag_max;
    double angle_end_1, angle_end_2;
    strum_cable_place lowest, highest;
    double lying;        /* unstretched length on the bed */
    bool slack;          /* lies without tension somewhere */
    size_t contacts;     /* stretches on the bed: strum_cable_contact_get */
    int solutions;       /* shapes that fit what was given: 1 or 2 */
    double other_length; /* unstretched length of the other one; NAN where there is none */
    double moment_end_1, moment_end_2; /* EI times curvature, N m; 0 with flexible statics */
    double closure;                    /* largest error of end 2's place over the length */
    double lowest_clearance;  /* smallest height above the bed of what hangs; NAN without */
    double smallest_reaction; /* of the bed, N/m or N; NAN where nothing lies */
} strum_cable_statics;

void strum_cable_statics_get(const strum_hanging *cable, strum_cable_statics *statics);

typedef struct strum_cable_contact {
    double from, to; /* unstretched */
    double x_from, x_to;
    double slack_to;  /* no tension up to there; `from` where there is tension everywhere */
    double touchdown; /* x_to: on a level bed the stretched length from below end 1 */
} strum_cable_contact;

/* Contact `i` from end 1; STRUM_ERR_RANGE where there is none. */
strum_status strum_cable_contact_get(const strum_hanging *cable, size_t i,
                                     strum_cable_contact *contact);

/* A section as it hangs: with its length found and the temperature applied. */
strum_status strum_cable_section_get(const strum_hanging *cable, size_t i,
                                     strum_cable_section *section);

typedef struct strum_cable_joint {
    double position, x, z;
    double tension_left, tension_right;
    double kink; /* angle between the static tangents */
} strum_cable_joint;

/* Where attachment `i` (as handed in) hangs. */
strum_status strum_cable_attachment_get(const strum_hanging *cable, size_t i,
                                        strum_cable_joint *joint);

/* tension: with bending stiffness in the shape the normal force, not the size of the force. */
typedef struct strum_cable_point {
    double position, x, z, tension, angle;
} strum_cable_point;

/* The shape at `n` unstretched places (within 0 .. unstretched length), or, where `positions` is
 * NULL, at n >= 2 equally spaced ones, ends included. `points`: room for n. */
strum_status strum_cable_shape(const strum_hanging *cable, const double *positions, size_t n,
                               strum_cable_point *points);

/* NULL is fine. */
void strum_cable_free(strum_hanging *cable);

STRUM_END_DECLS
#endif
