/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/service/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define LEAST_LIMIT (64U << 20)
/* The largest solves measured hold 75 bytes for each microsecond they take (200 modes of a cable of
 * chi from -12.5 to 12.5: 776 MB, 10.6 s). */
#define BYTES_PER_US 75.0
#define SOLVE_LEAST  (256U << 10)
#define SOLVE_MOST   (1U << 30)

/* The value of memory.max in a folder; SIZE_MAX: none is set. */
static size_t limit_in(const char *folder)
{
    char path[4200], value[32] = "";
    snprintf(path, sizeof path, "/sys/fs/cgroup%s/memory.max", folder);
    FILE *file = fopen(path, "re");
    if (!file)
        return SIZE_MAX;
    const bool got = fgets(value, sizeof value, file);
    fclose(file);
    return got && strncmp(value, "max", 3) != 0 ? (size_t)strtoull(value, NULL, 10) : SIZE_MAX;
}

static size_t group_limit(void)
{
    char line[4096] = "";
    FILE *file = fopen("/proc/self/cgroup", "re");
    const bool got = file && fgets(line, sizeof line, file) && strncmp(line, "0::", 3) == 0;
    if (file)
        fclose(file);
    if (!got)
        return SIZE_MAX;
    char *folder = line + 3;
    folder[strcspn(folder, "\n")] = '\0';
    size_t least = SIZE_MAX;
    for (char *end = folder + strlen(folder); end; end = strrchr(folder, '/')) {
        *end = '\0'; /* the group, then each above it */
        const size_t limit = limit_in(folder);
        least = limit < least ? limit : least;
    }
    return least;
}

size_t memory_default(void)
{
    const size_t machine = (size_t)sysconf(_SC_PHYS_PAGES) * (size_t)sysconf(_SC_PAGESIZE);
    const size_t group = group_limit();
    const size_t half = (group < machine ? group : machine) / 2;
    return half > LEAST_LIMIT ? half : LEAST_LIMIT;
}

size_t memory_used(const memory_account *m)
{
    const size_t answers = entry_bytes(), stored = cache_body_bytes(m->cache);
    return m->bodies + m->solves + (answers > stored ? answers - stored : 0);
}

bool memory_take_body(memory_account *m, size_t bytes)
{
    if (memory_used(m) + bytes > m->limit)
        return false;
    atomic_fetch_add(&m->bodies, bytes);
    return true;
}

void memory_give_body(memory_account *m, size_t bytes)
{
    atomic_fetch_sub(&m->bodies, bytes);
}

bool memory_begin_solve(void *account, size_t bytes)
{
    memory_account *m = account;
    const size_t half = m->limit / 2;
    /* One alone may need more than there is, but it waits while answers are not read. */
    const size_t needed = m->solves > 0 || bytes < half ? bytes : half;
    if (memory_used(m) + needed > m->limit)
        return false;
    atomic_fetch_add(&m->solves, bytes);
    return true;
}

void memory_end_solve(void *account, size_t bytes)
{
    memory_account *m = account;
    atomic_fetch_sub(&m->solves, bytes);
}

size_t memory_of_solve(double cost_us)
{
    return (size_t)fmin(SOLVE_LEAST + BYTES_PER_US * cost_us, SOLVE_MOST);
}
