/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Types that several headers of the library share. */
#ifndef STRUM_TYPES_H
#define STRUM_TYPES_H

#include <stdbool.h>
#include <stddef.h>

#include <strum/export.h>
#include <strum/options.h>
#include <strum/status.h>

STRUM_BEGIN_DECLS

/* A complex number. C sees its own complex type. C++ has none that C knows, and sees a struct
 * of the same layout (C17 6.2.5: an array of two, real part first), from which
 * std::complex<double>(z.re, z.im) is one step. The library never takes or returns one by
 * value, where the two would differ. */
#ifdef __cplusplus
typedef struct strum_complex {
    double re, im;
} strum_complex;
#else
typedef double _Complex strum_complex;
#endif

typedef enum strum_plane { STRUM_IN_PLANE, STRUM_OUT_OF_PLANE } strum_plane;

/* Of the displacement normal to the chord (in plane) or of the displacement (out of plane)
 * about the middle of a level cable. */
typedef enum strum_symmetry {
    STRUM_NO_SYMMETRY,
    STRUM_SYMMETRIC,
    STRUM_ANTISYMMETRIC
} strum_symmetry;

/* What a second, independent method says of modes that were solved. */
typedef struct strum_verification {
    const char *method; /* static text */
    double max_relative_difference;
    long modes_expected; /* counted by the second method up to the last frequency */
    long modes_found;
    double max_residual; /* relative; the header of the modes says of what */
} strum_verification;

STRUM_END_DECLS
#endif
