/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "http/service/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define LEAST_LIMIT (64U << 20)
/* Shares of the limit, so that what one kind holds never keeps out the others: bodies an eighth,
 * solves and answers that are not sent yet five eighths, and one more for solves that are small.
 * The last eighth is for what cannot be refused: small bodies, and answers that outgrow their
 * estimate. */
#define SHARES 8
#define BODIES 1
#define SOLVES 5
#define SMALL  6
/* One solve alone may begin with this much free, and hold up to memory_solve_most. */
#define ALONE       3
#define SMALL_SOLVE ((size_t)1 << 20)
/* A request's first bytes are never refused: 16 MiB of 4096 connections. */
#define SMALL_BODY 4096

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

size_t memory_solve_most(size_t limit)
{
    return limit / 2;
}

/* Solves, and answers that nobody keeps but those they are sent to. */
static size_t solves_and_answers(const memory_account *m)
{
    const size_t answers = entry_bytes(), stored = cache_body_bytes(m->cache);
    return m->solves + (answers > stored ? answers - stored : 0);
}

size_t memory_used(const memory_account *m)
{
    return m->bodies + solves_and_answers(m);
}

bool memory_take_body(memory_account *m, size_t before, size_t bytes)
{
    if (before + bytes > SMALL_BODY && m->bodies + bytes > m->limit / SHARES * BODIES)
        return false;
    atomic_fetch_add(&m->bodies, bytes);
    return true;
}

void memory_give_body(memory_account *m, size_t bytes)
{
    atomic_fetch_sub(&m->bodies, bytes);
}

bool memory_for_small(const memory_account *m)
{
    return solves_and_answers(m) <= m->limit / SHARES * SMALL;
}

bool memory_begin_solve(void *account, size_t bytes)
{
    memory_account *m = account;
    const size_t share = m->limit / SHARES, alone = share * ALONE;
    const size_t room = share * (bytes <= SMALL_SOLVE ? SMALL : SOLVES);
    /* One alone may need more than is free, but it waits while answers are not read. */
    const size_t needed = m->solves > 0 || bytes < alone ? bytes : alone;
    if (solves_and_answers(m) + needed > room)
        return false;
    atomic_fetch_add(&m->solves, bytes);
    return true;
}

void memory_end_solve(void *account, size_t bytes)
{
    memory_account *m = account;
    atomic_fetch_sub(&m->solves, bytes);
}
