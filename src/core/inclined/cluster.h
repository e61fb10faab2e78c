/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where a verification may count modes. */
#ifndef CORE_INCLINED_CLUSTER_H
#define CORE_INCLINED_CLUSTER_H

/* Frequencies nearer than this are not told apart by a count between them. */
#define CLUSTER 1e-7
/* Modes beyond the last that are asked of the second method, to find a gap to count in. */
#define BEYOND 8

/* The number of modes, `count` or a few more, after which there is a gap: kl[n-1] << kl[n];
 * kl: count + BEYOND of them. */
static inline int gap_after(const double *kl, int count)
{
    int n = count;
    while (n < count + BEYOND - 1 && kl[n] - kl[n - 1] < CLUSTER * kl[n])
        n++;
    return n;
}

#endif
