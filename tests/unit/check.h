/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What every unit test includes: cmocka in the order it wants, and comparisons of doubles that
 * print. */
#ifndef TESTS_CHECK_H
#define TESTS_CHECK_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

/* |got - want| <= tolerance * |want| */
#define check_relative(got, want, tolerance)                                                   \
    do {                                                                                       \
        const double got_ = (got), want_ = (want), tolerance_ = (tolerance);                   \
        if (!(fabs(got_ - want_) <= tolerance_ * fabs(want_)))                                 \
            fail_msg("%s: got %.17g, want %.17g, relative error %.2e > %.1e", #got, got_,      \
                     want_, fabs(got_ - want_) / fabs(want_), tolerance_);                     \
    } while (0)

/* |got - want| <= tolerance */
#define check_absolute(got, want, tolerance)                                                   \
    do {                                                                                       \
        const double got_ = (got), want_ = (want), tolerance_ = (tolerance);                   \
        if (!(fabs(got_ - want_) <= tolerance_))                                               \
            fail_msg("%s: got %.17g, want %.17g, error %.2e > %.1e", #got, got_, want_,        \
                     fabs(got_ - want_), tolerance_);                                          \
    } while (0)

#endif
