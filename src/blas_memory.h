/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The daemon's work buffers of OpenBLAS: blas_memory.c says why it has its own. */
#ifndef BLAS_MEMORY_H
#define BLAS_MEMORY_H

#include <stdbool.h>

/* Makes the buffer that threads share which find no address space for one of their own (128 MB;
 * memory is used only where BLAS writes). Before any thread begins. False: there is none for
 * this one either. */
bool blas_memory_start(void);

#endif
