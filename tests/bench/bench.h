/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What every benchmark includes: CPU time of this process, medians, and the lines that
 * tests/bench/run understands:
 *   time NAME MICROSECONDS
 *   ratio NAME VALUE at-least|at-most TARGET
 */
#ifndef TESTS_BENCH_H
#define TESTS_BENCH_H

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static inline double bench_now_us(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec * 1e6 + (double)t.tv_nsec * 1e-3;
}

static int bench_compare(const void *left, const void *right)
{
    const double l = *(const double *)left, r = *(const double *)right;
    return l < r ? -1 : l > r;
}

/* Median over `rounds` (odd, <= 99) of the time of one call, each round lasting some 20 ms. */
static inline double bench_median_us(void (*work)(void *), void *data, int rounds)
{
    double times[99];
    work(data);
    double begin = bench_now_us();
    work(data);
    const double once = bench_now_us() - begin;
    const int calls = once > 20000 ? 1 : (int)(20000 / (once + 0.1)) + 1;
    for (int i = 0; i < rounds; i++) {
        begin = bench_now_us();
        for (int k = 0; k < calls; k++)
            work(data);
        times[i] = (bench_now_us() - begin) / calls;
    }
    qsort(times, (size_t)rounds, sizeof *times, bench_compare);
    return times[rounds / 2];
}

static inline void bench_time(const char *name, double us)
{
    printf("time %s %.2f\n", name, us);
    fflush(stdout);
}

static inline void bench_ratio(const char *name, double value, const char *sense, double target)
{
    printf("ratio %s %.3g %s %g\n", name, value, sense, target);
    fflush(stdout);
}

#endif
