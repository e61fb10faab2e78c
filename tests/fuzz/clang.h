/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Included before every file of a fuzzing build: glibc gives CMPLX to gcc only. */
#ifndef FUZZ_CLANG_H
#define FUZZ_CLANG_H

#define CMPLX(re, im) __builtin_complex((double)(re), (double)(im))

#endif
