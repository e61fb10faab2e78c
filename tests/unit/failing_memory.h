/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Allocations that fail: the linker leads malloc and its kin here (failing_memory_dep of
 * meson.build). The test that includes this says before which of them fail, by its own
 *     static bool refuse_memory(void);
 * which is asked once for each allocation. */
#ifndef TESTS_FAILING_MEMORY_H
#define TESTS_FAILING_MEMORY_H

#include <stddef.h>

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *bytes, size_t size);
char *__real_strdup(const char *string);
char *__real_strndup(const char *string, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *bytes, size_t size);
char *__wrap_strdup(const char *string);
char *__wrap_strndup(const char *string, size_t size);

void *__wrap_malloc(size_t size)
{
    return refuse_memory() ? NULL : __real_malloc(size);
}
void *__wrap_calloc(size_t count, size_t size)
{
    return refuse_memory() ? NULL : __real_calloc(count, size);
}
void *__wrap_realloc(void *bytes, size_t size)
{
    return refuse_memory() ? NULL : __real_realloc(bytes, size);
}
char *__wrap_strdup(const char *string)
{
    return refuse_memory() ? NULL : __real_strdup(string);
}
char *__wrap_strndup(const char *string, size_t size)
{
    return refuse_memory() ? NULL : __real_strndup(string, size);
}

#endif
