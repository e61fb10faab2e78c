/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Mutation for askings: every other one changes a number where it stands, so that what is asked
 * stays a question and reaches the mechanics; the rest is libFuzzer's.
 */
#ifndef FUZZ_MUTATE_H
#define FUZZ_MUTATE_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t max_size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed);

static inline double other_number(double value)
{
    static const double limits[] = {0,    1,    -1,     0.5,     2,        10,          200,
                                    1e-3, 1e-9, 1e-300, 5e-324,  1e6,      1e12,        1e300,
                                    1e16, 0.9,  0.99,   0.99999, 1 - 1e-9, 1 - 0x1p-53, M_PI};
    switch (rand() % 6) {
    case 0:
        return limits[(size_t)rand() % (sizeof limits / sizeof *limits)];
    case 1:
        return nextafter(value, rand() % 2 ? INFINITY : -INFINITY);
    case 2:
        return value * pow(10, rand() % 13 - 6);
    case 3:
        return -value;
    case 4:
        return round(value) + rand() % 3 - 1;
    default:
        return value * (1 + (rand() / (double)RAND_MAX - 0.5) / 4);
    }
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed)
{
    srand(seed);
    size_t starts[256], count = 0;
    for (size_t i = 1; i < size && count < 256; i++)
        if (data[i] >= '0' && data[i] <= '9' && strchr(":,=[ ", data[i - 1]) && data[i - 1])
            starts[count++] = i;
    if (count == 0 || rand() % 2)
        return LLVMFuzzerMutate(data, size, max_size);
    const size_t start = starts[(size_t)rand() % count];
    char number[64] = "", printed[64];
    size_t end = start;
    while (end < size && end - start < 63 && data[end] && strchr("0123456789.eE+-", data[end]))
        end++;
    memcpy(number, data + start, end - start);
    const double value = other_number(strtod(number, NULL));
    const size_t length = (size_t)snprintf(printed, sizeof printed, "%.17g", value);
    if (size - (end - start) + length > max_size)
        return LLVMFuzzerMutate(data, size, max_size);
    memmove(data + start + length, data + end, size - end);
    memcpy(data + start, printed, length);
    return size - (end - start) + length;
}

#endif
