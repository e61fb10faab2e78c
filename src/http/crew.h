/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Worker threads and the bounded queue before them. */
#ifndef HTTP_CREW_H
#define HTTP_CREW_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A piece of work, embedded in what it is about; the giver keeps it until `work` is called. */
typedef struct job {
    void (*work)(struct job *j);
    struct job *next;
} job;

typedef struct crew crew;

/* NULL when a thread cannot be had. */
crew *crew_new(int workers, size_t depth);
/* Finishes all that was given, then ends the threads. */
void crew_free(crew *c);

/* A place in the queue, to be used by crew_give; false when it is full. */
bool crew_reserve(crew *c);
void crew_give(crew *c, job *j);
/* Work that needs no place and gives way: at most all workers but one are at it (with a single
 * worker: that one), and while others wait it gets a quarter of the turns. */
void crew_give_background(crew *c, job *j);

typedef struct crew_counters {
    int workers;
    size_t depth, queued, working; /* queued: reserved places that no worker has taken up */
    size_t background;             /* of those that work */
    uint64_t done, refused;
    int64_t full_since_ms; /* first refusal since the queue was half empty, by clock_ms(); 0:
                              none */
} crew_counters;
crew_counters crew_count(crew *c);

#endif
