/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/taut/assembly.h"

#include <float.h>
#include <stdlib.h>

/* Degree of spectral elements, and the phase each spans at most: dispersion about
 * (p!/(2p)!)^2 (kh)^{2p} (Ainsworth, 2004), here 1e-15. */
#define DEGREE 12
#define PHASE  4.0

/* Where assembling stands: the unknown at the left, y = lever times it. */
typedef struct cursor {
    taut_assembly *a;
    int node, next;
    double lever;
    double highest;
    bool dynamic;
} cursor;

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

/* An element of n local unknowns: the first is the cursor's, the others are new; the last one
 * becomes the cursor's. Matrices n x n by rows, NULL for zero. */
static void place(cursor *at, int n, const double *k, const double *c, const double *m)
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

/* Gauss-Lobatto nodes on [-1, 1], weights, and derivatives of the Lagrange polynomials. */
typedef struct lobatto {
    double x[DEGREE + 1], weight[DEGREE + 1], slope[DEGREE + 1][DEGREE + 1];
} lobatto;

static void lobatto_make(lobatto *l)
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

static void place_cable(cursor *at, const taut_component *c, const lobatto *l)
{
    const bool uniform = c->kind == TAUT_CABLE;
    const double t0 = uniform ? c->cable.tension : c->varying.tension_0;
    const double t1 = uniform ? c->cable.tension : c->varying.tension_1;
    const double mass = uniform ? c->cable.mass : c->varying.mass;
    const double drag = uniform ? c->cable.drag : 0.0;
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
            /* the WKB matrix is that of a cable on this foundation (taut_cable.c) */
            if (c->kind == TAUT_WKB)
                k[q * n + q] += w * slope * slope / (16.0 * t);
            m[q * n + q] = w * mass;
            d[q * n + q] = w * drag;
        }
        place(at, n, k, d, m);
    }
}

/* ---- the other components ---- */

static void place_wire(cursor *at, const taut_component *c)
{
    taut_assembly *a = at->a;
    const double none[9] = {0.0};
    const taut_wire wire = {c, {at->node, at->next, at->next + 1}, at->lever};
    if (a->wires != NULL)
        a->wires[a->wire_count] = wire;
    a->wire_count++;
    place(at, 3, none, NULL, NULL);
}

/* By the displacements y_i of the joints: th_i = (y_i - y_{i-1})/h_i. */
static void place_body(cursor *at, const taut_component *c)
{
    const int n = c->body.count + 1;
    double k[(STRUM_TAUT_LINKS_MAX + 1) * (STRUM_TAUT_LINKS_MAX + 1)] = {0.0};
    double d[(STRUM_TAUT_LINKS_MAX + 1) * (STRUM_TAUT_LINKS_MAX + 1)] = {0.0};
    double m[(STRUM_TAUT_LINKS_MAX + 1) * (STRUM_TAUT_LINKS_MAX + 1)] = {0.0};
    for (int i = 0; i < c->body.count; i++) {
        const taut_link *l = &c->body.links[i];
        const double centre[2] = {l->right / l->length, l->left / l->length};
        const double turn[2] = {-1.0 / l->length, 1.0 / l->length};
        for (int p = 0; p < 2; p++)
            for (int q = 0; q < 2; q++) {
                m[(i + p) * n + i + q] +=
                    l->mass * centre[p] * centre[q] + l->inertia * turn[p] * turn[q];
                k[(i + p) * n + i + q] += l->pull * turn[p] * turn[q];
            }
        if (i + 1 == c->body.count)
            continue;
        const taut_joint *joint = &c->body.joints[i];
        const double next = 1.0 / c->body.links[i + 1].length;
        const double bend[3] = {-turn[0], -turn[1] - next, next};
        for (int p = 0; p < 3; p++)
            for (int q = 0; q < 3; q++) {
                k[(i + p) * n + i + q] += joint->stiffness * bend[p] * bend[q];
                d[(i + p) * n + i + q] += joint->damping * bend[p] * bend[q];
            }
    }
    place(at, n, k, d, m);
}

static void place_hanging(cursor *at, const taut_component *c)
{
    const double k = c->hanging.stiffness, r = c->hanging.damping;
    const double ks[4] = {k, -k, -k, k}, cs[4] = {r, -r, -r, r},
                 ms[4] = {0.0, 0.0, 0.0, c->hanging.mass};
    const cursor here = *at;
    place(at, 2, ks, cs, ms);
    at->node = here.node; /* the chain goes on where the absorber hangs */
    at->lever = here.lever;
}

/* The lever turns by y_left/pivot; y_right = -ratio y_left. */
static void place_support(cursor *at, const taut_component *c)
{
    const double square = c->support.pivot * c->support.pivot;
    const double k = c->support.stiffness / square, m = c->support.inertia / square;
    place(at, 1, &k, NULL, &m);
    at->lever *= -c->support.ratio;
}

static void place_all(const strum_taut *chain, cursor *at, const lobatto *l)
{
    for (size_t i = 0; i < chain->count; i++) {
        const taut_component *c = &chain->components[i];
        switch (c->kind) {
        case TAUT_CABLE:
            if (at->dynamic && c->cable.impedance > 0.0) {
                place_wire(at, c);
                break;
            }
            place_cable(at, c, l);
            break;
        case TAUT_WKB:
        case TAUT_VARYING:
            place_cable(at, c, l);
            break;
        case TAUT_BODY:
            place_body(at, c);
            break;
        case TAUT_HANGING:
            place_hanging(at, c);
            break;
        case TAUT_GROUND:
            place(at, 1, &c->ground.stiffness, &c->ground.damping, &c->ground.mass);
            break;
        case TAUT_SUPPORT:
            place_support(at, c);
            break;
        }
        if (at->next > 10000000)
            return; /* more than any method takes; the caller refuses */
    }
}

/* Holds unknown i: its own equation becomes y = 0, with no mass. */
static void hold(taut_assembly *a, int i)
{
    for (int row = i; row < a->size && row <= i + a->band; row++)
        for (int column = row - a->band; column <= row; column++) {
            if (column < 0 || (row != i && column != i))
                continue;
            const size_t at =
                (size_t)row * (size_t)(a->band + 1) + (size_t)(column - row + a->band);
            a->k[at] = row == column ? 1.0 : 0.0;
            a->c[at] = a->m[at] = 0.0;
        }
}

strum_status taut_assembly_make(const strum_taut *chain, double highest, bool dynamic, int most,
                                taut_assembly *assembly, strum_error *fault)
{
    lobatto l;
    lobatto_make(&l);
    *assembly = (taut_assembly){0};
    const cursor start = {assembly, 0, 1, 1.0, highest, dynamic};
    cursor at = start;
    place_all(chain, &at, &l);
    if (at.next > most)
        return error_set(fault, STRUM_ERR_METHOD,
                         "the second method would need more than %d unknowns", most);
    assembly->size = at.next;
    const size_t room = (size_t)assembly->size * (size_t)(assembly->band + 1);
    assembly->k = calloc(3 * room, sizeof(double));
    assembly->wires = calloc((size_t)assembly->wire_count + 1, sizeof(taut_wire));
    if (assembly->k == NULL || assembly->wires == NULL) {
        taut_assembly_free(assembly);
        return error_set(fault, STRUM_ERR_MEMORY, "no memory for %d unknowns", at.next);
    }
    assembly->c = assembly->k + room;
    assembly->m = assembly->c + room;
    assembly->wire_count = 0;
    at = start;
    place_all(chain, &at, &l);
    assembly->last = at.node;
    if (!chain->free_left)
        hold(assembly, 0);
    if (!chain->free_right)
        hold(assembly, at.node);
    return STRUM_OK;
}

void taut_assembly_free(taut_assembly *assembly)
{
    free(assembly->k);
    free(assembly->wires);
    *assembly = (taut_assembly){0};
}
