/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "gale.h"

#include <math.h>

#define ROWS 400 /* most terms + 1 */

/* ACOEF: recursion (2.50); a1 with the common factor cancelled. */
static void acoef(double zl, int terms, double a[4][ROWS])
{
    for (int j = 0; j < 4; j++) {
        const double r = 0.5 * j;
        double *c = a[j];
        c[0] = 1;
        c[1] = -(4 * r * r + r + 1 + zl) / ((r + 1) * (2 * r + 1));
        for (int k = 2; k <= terms; k++) {
            const double f6 = k + r, f1 = f6 - 1, f2 = f6 - 2, f3 = f6 - 3, f4 = f6 - 4;
            const double f5 = f6 - 5, f7 = f6 + 3, f8 = f6 + 4, q = 4 * f6 * f2 + 3;
            double sum =
                -c[k - 1] * (2 * f2 * f3 * (4 * f6 + 7) + (51 + 2 * zl) * f6 - 3 * (32 + zl)) /
                    (f6 * q) -
                c[k - 2] * (f2 * (5 * f3 * f4 * f7 + (72 + 5 * zl) * f6 - 6 * (32 + zl)) - zl) /
                    (f6 * f1 * q);
            if (k >= 3)
                sum -= c[k - 3] * f3 * (f4 * f5 * f8 + 4 * (6 + zl) * f6 - 4 * (21 + zl)) /
                       (f6 * f1 * q);
            if (k >= 4)
                sum -= c[k - 4] * zl * f4 / (f6 * q);
            c[k] = sum;
        }
    }
}

/* BCOEF: recursion (2.63). */
static void bcoef(double zl, int terms, double b[4][ROWS])
{
    for (int j = 0; j < 4; j++) {
        double *c = b[j];
        c[0] = 1;
        for (int k = 1; k <= terms; k++) {
            const double f1 = k + j, f2 = f1 - 1, f3 = f1 - 2, f4 = f1 - 3, f5 = f1 - 4;
            const double f6 = f1 - 5, f7 = f1 - 6, f8 = f1 - 7, f9 = f1 - 8;
            double sum = -c[k - 1] * (688 + 352 * f5) / (192 * f1);
            if (k >= 2)
                sum -= c[k - 2] * (585 + 72 * zl + 996 * f5 + 252 * f5 * f6) / (192 * f1 * f2);
            if (k >= 3)
                sum -= c[k - 3] *
                       (102 + 99 * zl + (627 + 102 * zl) * f5 + 526 * f5 * f6 +
                        88 * f5 * f6 * f7) /
                       (192 * f1 * f2 * f3);
            const double f = 192 * f1 * f2 * f3 * f4;
            if (k >= 4)
                sum -= c[k - 4] *
                       (-zl + (72 + 105 * zl) * f5 + (216 + 53 * zl) * f5 * f6 +
                        120 * f5 * f6 * f7 + 15 * f5 * f6 * f7 * f8) /
                       f;
            if (k >= 5)
                sum -= c[k - 5] *
                       ((12 + 36 * zl) * f6 + (24 + 12 * zl) * f6 * f7 + 10 * f6 * f7 * f8 +
                        f6 * f7 * f8 * f9) /
                       f;
            if (k >= 6)
                sum -= c[k - 6] * (4 * zl * f7 + zl * f7 * f8) / f;
            c[k] = sum;
        }
    }
}

/* sum of c_k x^k with the factors of its n-th derivative. */
static double horner(const double *c, int terms, int n, double x)
{
    double sum = 0;
    for (int k = terms; k >= n; k--) {
        double factor = 1;
        for (int i = 0; i < n; i++)
            factor *= k - i;
        sum = sum * x + factor * c[k];
    }
    return sum;
}

/* AMAT: the four solutions and their first `rows` - 1 derivatives by x; VMAT is rows = 2. */
static void amat(double c[4][ROWS], double first, int terms, int rows, double x, double u[4][4])
{
    for (int j = 0; j < 4; j++) {
        const double r = first * j;
        const double b = pow(x, r), d = b / x, e = d / x, f = e / x;
        const double aux1 = horner(c[j], terms, 0, x), aux2 = horner(c[j], terms, 1, x);
        u[0][j] = aux1 * b;
        u[1][j] = aux2 * b + r * aux1 * d;
        if (rows == 2)
            continue;
        const double aux3 = horner(c[j], terms, 2, x), aux4 = horner(c[j], terms, 3, x);
        u[2][j] = aux3 * b + r * (r - 1) * e * aux1 + 2 * r * d * aux2;
        u[3][j] = aux4 * b + r * (r - 1) * (r - 2) * f * aux1 + 3 * r * (r - 1) * e * aux2 +
                  3 * r * d * aux3;
    }
}

/* INVERS and the product with `right`: left^-1 right, Gauss and Jordan. */
static void divide(double left[4][4], double right[4][4])
{
    for (int k = 0; k < 4; k++) {
        int best = k;
        for (int i = k; i < 4; i++)
            if (fabs(left[i][k]) > fabs(left[best][k]))
                best = i;
        for (int j = 0; j < 4; j++) {
            const double l = left[k][j], r = right[k][j];
            left[k][j] = left[best][j];
            right[k][j] = right[best][j];
            left[best][j] = l;
            right[best][j] = r;
        }
        for (int i = 0; i < 4; i++) {
            const double f = i == k ? 0 : left[i][k] / left[k][k];
            for (int j = 0; j < 4 && i != k; j++) {
                left[i][j] -= f * left[k][j];
                right[i][j] -= f * right[k][j];
            }
        }
    }
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            right[i][j] /= left[i][i];
}

/* Two rows of D at one end: U and dU/dxi of the four solutions. */
static void end_rows(double xi, const gale_cable *g, double a[4][ROWS], double b[4][ROWS],
                     double alpha[4][4], double d[2][4])
{
    const double x = fabs(xi);
    double u[4][4];
    if (x < g->match) {
        amat(a, 0.5, g->terms, 2, x, u);
        for (int i = 0; i < 2; i++)
            for (int j = 0; j < 4; j++)
                d[i][j] = u[i][j] * (xi < 0 && (i + j) % 2 == 1 ? -1 : 1);
        return;
    }
    amat(b, 1, g->terms, 2, x - 2, u);
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 4; j++) {
            double sum = 0;
            for (int k = 0; k < 4; k++)
                sum += u[i][k] * alpha[k][j];
            d[i][j] = sum * (xi < 0 && (i + j) % 2 == 1 ? -1 : 1);
        }
}

static double minor3(double d[4][4], int a, int b, int c)
{
    return d[1][a] * (d[2][b] * d[3][c] - d[2][c] * d[3][b]) -
           d[1][b] * (d[2][a] * d[3][c] - d[2][c] * d[3][a]) +
           d[1][c] * (d[2][a] * d[3][b] - d[2][b] * d[3][a]);
}

double gale_determinant(gale_cable *g, double omega)
{
    double a[4][ROWS], b[4][ROWS], alpha[4][4] = {{0}}, d[4][4];
    const double zl = omega * omega;
    const double far = fmax(fabs(g->xi_1), fabs(g->xi_2));
    g->determinants++;
    acoef(zl, g->terms, a);
    if (far >= g->match) {
        double vr[4][4];
        bcoef(zl, g->terms, b);
        amat(a, 0.5, g->terms, 4, g->match, alpha);
        amat(b, 1, g->terms, 4, g->match - 2, vr);
        divide(vr, alpha);
    }
    end_rows(g->xi_1, g, a, b, alpha, d);
    end_rows(g->xi_2, g, a, b, alpha, d + 2);
    return d[0][0] * minor3(d, 1, 2, 3) - d[0][1] * minor3(d, 0, 2, 3) +
           d[0][2] * minor3(d, 0, 1, 3) - d[0][3] * minor3(d, 0, 1, 2);
}

double gale_frequency(gale_cable *g, double guess)
{
    double omega = guess;
    for (int i = 0; i < 50; i++) {
        const double del = 0.0005 * fabs(omega);
        const double low = gale_determinant(g, omega - del / 2);
        const double high = gale_determinant(g, omega + del / 2);
        if (low * high < 0)
            break;
        omega += del / 2 - high * del / (high - low);
    }
    return omega;
}

int gale_scan(gale_cable *g, double step, double highest, double tolerance, int count,
              double *omega)
{
    int found = 0;
    double w = step, before = gale_determinant(g, w);
    while (found < count && w < highest) {
        const double next = w + step, value = gale_determinant(g, next);
        if (before * value < 0) {
            double at = w - before * step / (value - before), change = 1;
            for (int i = 0; i < 30 && fabs(change) > tolerance; i++) {
                const double del = 1e-5 * at, here = gale_determinant(g, at);
                change = -here * del / (gale_determinant(g, at + del) - here) / at;
                at *= 1 + change;
            }
            omega[found++] = at;
        }
        w = next;
        before = value;
    }
    return found;
}
