/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cache/frequency.h"

#include <sodium/randombytes.h>
#include <stdlib.h>
#include <string.h>

#define ROWS 4
#define MOST 15

bool frequency_init(frequency *f, unsigned bits)
{
    *f = (frequency){.counters = calloc((size_t)1 << bits, 1), .shift = 64 - bits};
    randombytes_buf(f->spread, sizeof f->spread);
    for (int row = 0; row < ROWS; row++)
        f->spread[row] |= 1;
    return f->counters != NULL;
}

void frequency_free(frequency *f)
{
    free(f->counters);
    f->counters = NULL;
}

static uint8_t *counter_of(const frequency *f, const cache_key *key, int row)
{
    uint64_t first;
    memcpy(&first, key->bytes, sizeof first);
    return &f->counters[first * f->spread[row] >> f->shift];
}

static void halve(frequency *f)
{
    const size_t count = (size_t)1 << (64 - f->shift);
    for (size_t i = 0; i < count; i++)
        f->counters[i] /= 2;
    f->noted = 0;
}

unsigned frequency_of(const frequency *f, const cache_key *key)
{
    unsigned least = MOST;
    for (int row = 0; row < ROWS; row++) {
        const unsigned count = *counter_of(f, key, row);
        least = count < least ? count : least;
    }
    return least;
}

void frequency_note(frequency *f, const cache_key *key, size_t period)
{
    /* Only the least ones rise: the others count another key as well. */
    const unsigned least = frequency_of(f, key);
    for (int row = 0; row < ROWS && least < MOST; row++) {
        uint8_t *counter = counter_of(f, key, row);
        if (*counter == least)
            *counter = (uint8_t)(least + 1);
    }
    if (++f->noted >= period)
        halve(f);
}
