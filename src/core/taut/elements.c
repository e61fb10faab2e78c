/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pieces of which components assemble the second method's matrices. */
#include "core/taut/assembly.h"

#include <float.h>

/* Phase that a spectral element of this degree spans at most: dispersion about
 * (p!/(2p)!)^2 (kh)^{2p} (Ainsworth, 2004), here 1e-15. */
#define DEGREE TAUT_DEGREE
#define PHASE  4.0

static void add(taut_assembly *a, int i, int j, double k, double c, double m)
{
    const int low = i < j ? i : j, high = i < j ? j : i;
    if (high - low > a->band)
        a->band = high - low;
    if (a->k == NULL)
        return; /* only measuring */
    const size_t at = (size_t)high * (size_t)(a->band + 1) + (size_t)(low - high + a->band);
    a->k[at] += k;
    a->c[at] += c;
    a->m[at] += m;
}

void taut_element_place(taut_cursor *at, int n, const double *k, const double *c,
                        const double *m)
{
    const int first = at->next - 1; /* local 1 -> at->next */
    for (int p = 0; p < n; p++)
        for (int q = 0; q <= p; q++) {
            const double lever = (p == 0 ? at->lever : 1.0) * (q == 0 ? at->lever : 1.0);
            add(at->a, p == 0 ? at->node : first + p, q == 0 ? at->node : first + q,
                lever * k[p * n + q], c != NULL ? lever * c[p * n + q] : 0.0,
                m != NULL ? lever * m[p * n + q] : 0.0);
        }
    if (n > 1) {
        at->next += n - 1;
        at->node = at->next - 1;
        at->lever = 1.0;
    }
}

/* ---- spectral elements ---- */

void taut_lobatto_make(taut_lobatto *l)
{
    double p[DEGREE + 1][DEGREE + 1]; /* Legendre polynomials at the nodes */
    for (int i = 0; i <= DEGREE; i++) {
        double x = -cos(M_PI * i / DEGREE);
        for (int n = 0; n < 50; n++) { /* zeros of (1 - x^2) P'_N, Newton's method */
            p[0][i] = 1.0;
            p[1][i] = x;
            for (int k = 2; k <= DEGREE; k++)
                p[k][i] = ((2 * k - 1) * x * p[k - 1][i] - (k - 1) * p[k - 2][i]) / k;
            x -= (x * p[DEGREE][i] - p[DEGREE - 1][i]) / ((DEGREE + 1) * p[DEGREE][i]);
        }
        l->x[i] = x;
        l->weight[i] = 2.0 / (DEGREE * (DEGREE + 1) * p[DEGREE][i] * p[DEGREE][i]);
    }
    for (int i = 0; i <= DEGREE; i++)
        for (int j = 0; j <= DEGREE; j++) {
            if (i != j)
                l->slope[i][j] = p[DEGREE][i] / (p[DEGREE][j] * (l->x[i] - l->x[j]));
            else
                l->slope[i][j] = i == 0        ? -0.25 * DEGREE * (DEGREE + 1)
                                 : i == DEGREE ? 0.25 * DEGREE * (DEGREE + 1)
                                               : 0.0;
        }
}

void taut_elements_place(taut_cursor *at, const taut_element_cable *c)
{
    const taut_lobatto *l = at->lobatto;
    const double t0 = c->tension_0, t1 = c->tension_1, mass = c->mass, drag = c->drag;
    const double slope = (t1 - t0) / c->length;
    const int n = DEGREE + 1;
    /* enough for the phase, for the decay that drag adds, and for the change of tension, by
     * equal factors of which the pieces go */
    const double phase =
        at->highest * c->length * sqrt((mass + drag / (at->highest + DBL_MIN)) / fmax(t0, t1));
    const double log_ratio = log1p((t1 - t0) / t0), change = fmax(t0, t1) * fabs(log_ratio);
    const double stretch = log_ratio != 0.0 ? change / fabs(t1 - t0) : 1.0;
    const int pieces =
        (int)fmin(fmax(ceil(phase * stretch / PHASE), 8.0 * fabs(log_ratio)) + 1.0, 1e6);
    if (at->a->k == NULL) { /* only measuring */
        const int apart = at->next - 1 + DEGREE - at->node;
        at->a->band = at->a->band < apart ? apart : at->a->band;
        at->next += pieces * DEGREE;
        at->node = at->next - 1;
        return;
    }
    double k[(DEGREE + 1) * (DEGREE + 1)], d[(DEGREE + 1) * (DEGREE + 1)],
        m[(DEGREE + 1) * (DEGREE + 1)];
    for (int e = 0; e < pieces; e++) {
        double x[2];
        for (int end = 0; end < 2; end++) {
            const double share = (double)(e + end) / pieces;
            x[end] = c->length *
                     (log_ratio != 0.0 ? expm1(share * log_ratio) / expm1(log_ratio) : share);
        }
        const double h = x[1] - x[0];
        for (int i = 0; i < n * n; i++)
            k[i] = d[i] = m[i] = 0.0;
        for (int q = 0; q < n; q++) {
            const double t = t0 + slope * (x[0] + 0.5 * h * (1.0 + l->x[q]));
            const double w = 0.5 * h * l->weight[q];
            for (int i = 0; i < n; i++)
                for (int j = 0; j < n; j++)
                    k[i * n + j] += w * t * l->slope[q][i] * l->slope[q][j] * 4.0 / (h * h);
            /* the WKB matrix is that of a cable on this foundation (wkb.c) */
            if (c->foundation)
                k[q * n + q] += w * slope * slope / (16.0 * t);
            m[q * n + q] = w * mass;
            d[q * n + q] = w * drag;
        }
        taut_element_place(at, n, k, d, m);
    }
}

/* ---- wires ---- */

void taut_wire_place(taut_cursor *at, double length, double slowness, double impedance)
{
    taut_assembly *a = at->a;
    const double none[9] = {0.0};
    const taut_wire wire = {
        length, slowness, impedance, {at->node, at->next, at->next + 1}, at->lever};
    if (a->wires != NULL)
        a->wires[a->wire_count] = wire;
    a->wire_count++;
    taut_element_place(at, 3, none, NULL, NULL);
}
