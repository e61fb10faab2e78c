/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * How often keys were asked for lately, roughly and in little memory: a count-min sketch (Cormode
 * and Muthukrishnan 2005) whose counters are halved now and then (Einziger, Friedman and Manes,
 * TinyLFU, 2017). Not locked.
 */
#ifndef CACHE_FREQUENCY_H
#define CACHE_FREQUENCY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "cache/key.h"

typedef struct frequency {
    uint8_t *counters;
    unsigned shift;     /* 64 - log2 of their number */
    size_t noted;       /* since they were halved */
    uint64_t spread[4]; /* odd and secret: nobody can choose keys that share counters */
} frequency;

/* With 2^bits counters, which take a byte each. False when memory ran out. */
bool frequency_init(frequency *f, unsigned bits);
void frequency_free(frequency *f);
/* A key was asked for. Counters are halved after `period` such calls. */
void frequency_note(frequency *f, const cache_key *key, size_t period);
/* At most 15; never too low but for the halving. */
unsigned frequency_of(const frequency *f, const cache_key *key);

#endif
