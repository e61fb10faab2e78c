/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/pivots.h"

#include <math.h>

#include "core/cable/motion.h"

#define NEAR_ZERO 1e-11

/* Eliminates the first `count` of n symmetric unknowns without pivoting (lower triangle, column
 * major); returns whether no pivot was near 0. */
bool pivots_eliminate(int n, int count, double *a, long *negative)
{
    bool safe = true;
    for (int j = 0; j < count; j++) {
        double *column = a + (size_t)j * n;
        const double pivot = column[j];
        double largest = 0;
        for (int i = j + 1; i < n; i++)
            largest = fmax(largest, fabs(column[i]));
        safe = safe && fabs(pivot) > NEAR_ZERO * largest;
        *negative += pivot < 0;
        for (int i = j + 1; i < n && pivot != 0; i++)
            if (column[i] != 0)
                motion_add((size_t)(n - i), -column[i] / pivot, column + i,
                           a + (size_t)i * n + i);
    }
    return safe;
}

static void swap(int n, double *a, int i, int j)
{
    for (int k = 0; k < n && i != j; k++) {
        const double kept = a[k * n + i];
        a[k * n + i] = a[k * n + j];
        a[k * n + j] = kept;
    }
    for (int k = 0; k < n && i != j; k++) {
        const double kept = a[i * n + k];
        a[i * n + k] = a[j * n + k];
        a[j * n + k] = kept;
    }
}

static void pivot_one(int n, int j, double *a)
{
    const double pivot = a[j * n + j];
    for (int i = j + 1; i < n; i++) {
        const double factor = a[j * n + i] / pivot;
        for (int k = j + 1; k < n; k++)
            a[k * n + i] -= factor * a[j * n + k];
    }
}

static void pivot_two(int n, int j, double *a)
{
    const double p = a[j * n + j], q = a[j * n + j + 1], r = a[(j + 1) * n + j + 1];
    const double determinant = p * r - q * q;
    for (int i = j + 2; i < n; i++) {
        const double x = a[j * n + i], y = a[(j + 1) * n + i];
        const double first = (r * x - q * y) / determinant;
        const double second = (p * y - q * x) / determinant;
        for (int k = j + 2; k < n; k++)
            a[k * n + i] -= first * a[j * n + k] + second * a[(j + 1) * n + k];
    }
}

/* The same of few unknowns, full matrix, with complete pivoting (Bunch and Parlett, SIAM J. Numer.
 * Anal. 8, 1971). */
bool pivots_eliminate_few(int n, int count, double *a, long *negative)
{
    const double ratio = (1 + sqrt(17)) / 8;
    for (int j = 0; j < count;) {
        int diagonal = j, row = j, column = j;
        for (int i = j; i < count; i++)
            for (int k = j; k <= i; k++) {
                if (i == k && fabs(a[i * n + i]) > fabs(a[diagonal * n + diagonal]))
                    diagonal = i;
                if (i != k &&
                    (row == column || fabs(a[k * n + i]) > fabs(a[column * n + row]))) {
                    row = i;
                    column = k;
                }
            }
        const double off = row == column ? 0 : fabs(a[column * n + row]);
        const double on = fabs(a[diagonal * n + diagonal]);
        if (on == 0 && off == 0)
            return false;
        if (on >= ratio * off) {
            swap(n, a, j, diagonal);
            *negative += a[j * n + j] < 0;
            pivot_one(n, j, a);
            j++;
        } else {
            swap(n, a, j, column);
            swap(n, a, j + 1, row);
            *negative += 1;
            pivot_two(n, j, a);
            j += 2;
        }
    }
    return true;
}
