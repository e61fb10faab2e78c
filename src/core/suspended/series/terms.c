/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gale's series in double, extended and quadruple precision. The last is the compiler's own: as
 * slow as it is, it costs nothing to keep and carries the report's tables. */
#include <float.h>
#include <math.h>

#include "core/suspended/series/series.h"

#define ARITHMETIC SERIES_DOUBLE
#define REAL       double
#define EPSILON    DBL_EPSILON
#define NAME(x)    x##_double
#include "core/suspended/series/terms.h"
#undef ARITHMETIC
#undef REAL
#undef EPSILON
#undef NAME

#define ARITHMETIC SERIES_EXTENDED
#define REAL       long double
#define EPSILON    LDBL_EPSILON
#define NAME(x)    x##_extended
#include "core/suspended/series/terms.h"
#undef ARITHMETIC
#undef REAL
#undef EPSILON
#undef NAME

__extension__ typedef __float128 quadruple;
#define ARITHMETIC SERIES_QUADRUPLE
#define REAL       quadruple
#define EPSILON    1.9e-34 /* 2^-112 */
#define NAME(x)    x##_quadruple
#include "core/suspended/series/terms.h"

const series_arithmetic series_arithmetics[SERIES_ARITHMETICS] = {
    {DBL_MANT_DIG, determinant_double, count_double},
    {LDBL_MANT_DIG, determinant_extended, count_extended},
    {113, determinant_quadruple, count_quadruple},
};
