/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The second opinion on modes: all elements' transfers (transfer.h), what joins them and the ends
 * make one banded system G(lambda) y = 0. With G' = dG/dlambda the eigenvalue of smallest size of
 *     G(lambda) y = -theta G' y,
 * by inverse iteration, is how far the first method's lambda is from this one's.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "core/cable/field.h"
#include "core/cable/mesh.h"
#include "core/cable/modes.h"
#include "core/cable/transfer.h"
#include "core/numerics/status.h"

#define WAVES      2.0 /* half waves in an element at most */
#define WIDTH      2.5 /* of an element, in layers */
#define EDGE       35.0
#define WIDE       250.0
#define STEP       1e-6
#define ITERATIONS 4
#define MOST       20000

typedef struct {
    const spectrum *spectrum;
    const motion *motion;
    transfer transfer;
    transfer_element *elements;
    int count, room;
    int *node;              /* of the motion, before each element; -1: none */
    double waves;           /* frequency that is resolved */
    int size, width;        /* unknowns; of a row, with fill */
    int reach;              /* of a row to either side */
    int first;              /* unknown of the element that is being written */
    double _Complex *g, *h; /* G and G': rows of `width` from column row - reach on */
    double _Complex *x, *y;
    int *pivot;
} system_of;

/* ---- elements ---- */

static bool stiff(const motion *m, size_t piece)
{
    const cable_piece *p = m->cable->pieces + piece;
    return p->section->bending_stiffness > 0 && (!p->lies || m->components == 1);
}

static void add(system_of *s, size_t piece, double from, double to)
{
    if (s->elements != NULL && s->count < s->room)
        s->elements[s->count] = (transfer_element){
            piece, s->motion->cable->pieces[piece].start + from, (to - from) / 2,
            2 * s->motion->components + (stiff(s->motion, piece) ? 2 : 0)};
    s->count++;
}

/* Of bending waves under tension: EI k^4 + T k^2 = m omega^2. */
static double wave_number(const system_of *s, const cable_piece *p, size_t piece,
                          double tension)
{
    const double inertia = (p->section->mass + p->section->added_mass) * s->waves * s->waves;
    const double bending = stiff(s->motion, piece) ? p->section->bending_stiffness : 0;
    return sqrt(2 * inertia / (tension + sqrt(tension * tension + 4 * bending * inertia)));
}

static void divide(system_of *s, size_t piece, double from, double to, int depth)
{
    const cable_piece *p = s->motion->cable->pieces + piece;
    const double tension = mesh_tension(p, (from + to) / 2);
    const double waves = wave_number(s, p, piece, tension) * (to - from) / M_PI;
    const double t0 = mesh_tension(p, from), t1 = mesh_tension(p, to);
    const double change = fabs(t1 - t0) + 2 * fabs(t1 + t0 - 2 * tension);
    if (depth < 40 && (!(waves <= WAVES) || !(change < 0.1 * tension))) {
        divide(s, piece, from, (from + to) / 2, depth + 1);
        divide(s, piece, (from + to) / 2, to, depth + 1);
        return;
    }
    add(s, piece, from, to);
}

/*
 * Across an element of z layers the transfer has entries of e^z that cancel in what is smooth: few
 * layers an element where there are layers. Far wider ones do no harm, since collocation leaves
 * nothing of the growth: none between.
 */
static void divide_piece(system_of *s, size_t piece, double layer)
{
    const double length = s->motion->cable->pieces[piece].length;
    const double edge = EDGE * layer;
    if (layer == 0) {
        divide(s, piece, 0, length, 0);
        return;
    }
    if (length < 2 * edge + WIDE * layer) {
        const int count = (int)ceil(length / (WIDTH * layer));
        for (int i = 0; i < count; i++)
            divide(s, piece, length * i / count, length * (i + 1) / count, 0);
        return;
    }
    const int count = (int)(EDGE / WIDTH);
    for (int i = 0; i < count; i++)
        divide(s, piece, edge * i / count, edge * (i + 1) / count, 0);
    divide(s, piece, edge, length - edge, 0);
    for (int i = 0; i < count; i++)
        divide(s, piece, length - edge + edge * i / count,
               length - edge + edge * (i + 1) / count, 0);
}

static void divide_all(system_of *s)
{
    const motion *m = s->motion;
    s->count = 0;
    for (size_t i = m->first_piece; i < m->last_piece; i++) {
        const cable_piece *p = m->cable->pieces + i;
        const double most = fmax(mesh_tension(p, 0), mesh_tension(p, p->length));
        const double layer =
            stiff(m, i) && most > 0 ? sqrt(p->section->bending_stiffness / most) : 0;
        if (s->elements != NULL && s->count < s->room)
            s->node[s->count] = 0;
        const int first = s->count;
        divide_piece(s, i, layer);
        for (int k = first; s->elements != NULL && k < s->count && k < s->room; k++)
            s->node[k] = -1;
        if (s->elements != NULL && first < s->room) {
            int node = 0;
            while (m->elements[node].piece < i)
                node++;
            s->node[first] = node;
        }
    }
}

/* ---- the matrix ---- */

static void put(system_of *s, double _Complex *g, int row, int column, double _Complex value)
{
    const int at = column - row + s->reach;
    if (at >= 0 && at < s->width)
        g[(size_t)row * (size_t)s->width + (size_t)at] += value;
}

/* Z(lambda) of what stands at a node: in units of force over length. */
static void impedance(const system_of *s, int node, double _Complex lambda,
                      double _Complex z[2][2])
{
    const motion *m = s->motion;
    const double unit = s->transfer.length / s->transfer.force;
    memset(z, 0, 4 * sizeof z[0][0]);
    for (int i = 0; i < m->body_count; i++) {
        const motion_body *b = m->bodies + i;
        for (int a = 0; a < 4 && b->node == node; a++)
            z[a / 2][a % 2] += unit * lambda * lambda * b->mass[a / 2 + a % 2];
    }
    for (int i = 0; i < m->row_count + m->link_count; i++) {
        const bool row = i < m->row_count;
        const motion_row *r = m->rows + (row ? i : 0);
        const motion_link *l = m->links + (row ? 0 : i - m->row_count);
        if ((row ? r->node : l->node) != node || (row && r->held))
            continue;
        const double d[2] = {row ? r->x : l->x, row ? r->z : l->z};
        const double _Complex value = row ? 1 / r->compliance : field_impedance(l, lambda);
        for (int a = 0; a < 4; a++)
            z[a / 2][a % 2] += unit * value * d[a / 2] * d[a % 2];
    }
}

static double turning(const system_of *s, int node)
{
    const motion *m = s->motion;
    double sum = 0;
    for (int i = 0; i < m->body_count; i++)
        sum += m->bodies[i].node == node ? m->bodies[i].inertia : 0;
    return sum / (s->transfer.force * s->transfer.arm);
}

/* An end at rest: u = 0 and what its rotation does; returns the next row. `sign`: of M = +-k th. */
static int end_rows(system_of *s, double _Complex *g, int row, int at,
                    const transfer_element *e, int which)
{
    const motion *m = s->motion;
    const motion_element *own = m->elements + (which == 0 ? 0 : m->element_count - 1);
    const int parts = m->components;
    const bool free_along =
        which == 1 && parts == 2 && s->spectrum->stiffness.dropped[m->held_count - 1];
    const motion_row *along = m->rows + m->held_count - 1, *across = along - 1;
    for (int c = 0; c < parts; c++) {
        if (which == 0 || parts == 1 || m->held_count < 2 || across->node != along->node) {
            put(s, g, row++, at + c, 1);
            continue;
        }
        /* along the chord, where a straight inextensible cable cannot move anyhow, no force */
        const motion_row *r = c == 0 ? across : along;
        const int shift = c == 1 && free_along ? parts : 0;
        put(s, g, row, at + shift, r->x);
        put(s, g, row++, at + shift + 1, r->z);
    }
    if (e->states == 2 * parts)
        return row;
    const int column = which == 0 ? own->left : own->right;
    const double spring = m->end_springs[which] / (s->transfer.force * s->transfer.arm);
    if (column < 0) {
        put(s, g, row++, at + 2 * parts, 1);
    } else {
        put(s, g, row, at + 2 * parts + 1, 1);
        put(s, g, row++, at + 2 * parts, which == 0 ? -spring : spring);
    }
    return row;
}

/* Between the end of an element (unknowns from `left` on) and the beginning of the next (`right`),
 * what is held taking unknowns from `held` on. */
static int joint_rows(system_of *s, double _Complex *g, int row, int index, int left, int held,
                      int right, double _Complex lambda)
{
    const motion *m = s->motion;
    const transfer_element *before = s->elements + index - 1, *after = before + 1;
    const int parts = m->components, node = s->node[index];
    double _Complex z[2][2] = {{0, 0}, {0, 0}};
    if (node >= 0)
        impedance(s, node, lambda, z);
    for (int c = 0; c < parts; c++) {
        put(s, g, row, left + c, 1);
        put(s, g, row++, right + c, -1);
    }
    for (int c = 0; c < parts; c++) {
        put(s, g, row, right + parts + c, 1);
        put(s, g, row, left + parts + c, -1);
        for (int k = 0; k < parts; k++)
            put(s, g, row, left + k, -z[c][k]);
        int at = held;
        for (int i = 0; i < m->held_count; i++)
            if (m->rows[i].node == node && !s->spectrum->stiffness.dropped[i])
                put(s, g, row, at++, c == 0 ? m->rows[i].x : m->rows[i].z);
        row++;
    }
    for (int i = 0; i < m->held_count; i++)
        if (m->rows[i].node == node && !s->spectrum->stiffness.dropped[i]) {
            put(s, g, row, left, m->rows[i].x);
            if (parts == 2)
                put(s, g, row, left + 1, m->rows[i].z);
            row++;
        }
    const bool bends_left = before->states > 2 * parts, bends_right = after->states > 2 * parts;
    const double _Complex inertia = node >= 0 ? turning(s, node) * lambda * lambda : 0;
    if (bends_left && bends_right) {
        put(s, g, row, left + 2 * parts, 1);
        put(s, g, row++, right + 2 * parts, -1);
    }
    if (bends_left || bends_right) {
        if (bends_right)
            put(s, g, row, right + 2 * parts + 1, 1);
        if (bends_left)
            put(s, g, row, left + 2 * parts + 1, -1);
        put(s, g, row, (bends_left ? left : right) + 2 * parts, -inertia);
        row++;
    }
    return row;
}

static int held_at(const system_of *s, int node)
{
    int count = 0;
    for (int i = 0; i < s->motion->held_count && node >= 0; i++)
        count += s->motion->rows[i].node == node && !s->spectrum->stiffness.dropped[i];
    return count;
}

static strum_status fill(system_of *s, double _Complex lambda, double _Complex *g, work *w)
{
    double _Complex t[TRANSFER_STATES * TRANSFER_STATES];
    memset(g, 0, (size_t)s->size * (size_t)s->width * sizeof *g);
    int row = end_rows(s, g, 0, 0, s->elements, 0), at = 0;
    for (int i = 0; i < s->count; i++) {
        const transfer_element *e = s->elements + i;
        const int d = e->states, right = at + d;
        const strum_status status = work_spend(w, 60.0 * d * d);
        if (status != STRUM_OK)
            return status;
        transfer_of(&s->transfer, e, lambda, t);
        for (int to = 0; to < d; to++, row++) {
            for (int from = 0; from < d; from++)
                put(s, g, row, at + from, t[from * d + to]);
            put(s, g, row, right + to, -1);
        }
        const int held = i + 1 < s->count ? held_at(s, s->node[i + 1]) : 0;
        const int next = right + d + held;
        row = i + 1 < s->count ? joint_rows(s, g, row, i + 1, right, right + d, next, lambda)
                               : end_rows(s, g, row, right, e, 1);
        at = next;
    }
    return row == s->size ? STRUM_OK : STRUM_ERR_INTERNAL;
}

/* ---- inverse iteration ---- */

/* Elimination in the band with row pivots; factors stay below the diagonal. */
static void factor(system_of *s)
{
    const int n = s->size, w = s->width, reach = s->reach;
    for (int j = 0; j < n; j++) {
        int best = j;
        const int last = j + reach < n - 1 ? j + reach : n - 1;
        for (int i = j + 1; i <= last; i++)
            if (cabs(s->g[(size_t)i * w + j - i + reach]) >
                cabs(s->g[(size_t)best * w + j - best + reach]))
                best = i;
        s->pivot[j] = best;
        const int end = j + 2 * reach < n - 1 ? j + 2 * reach : n - 1;
        for (int k = j; k <= end && best != j; k++) {
            double _Complex *a = s->g + (size_t)j * w + k - j + reach;
            double _Complex *b = s->g + (size_t)best * w + k - best + reach;
            const double _Complex kept = *a;
            *a = *b;
            *b = kept;
        }
        double _Complex *top = s->g + (size_t)j * w + reach;
        if (*top == 0)
            *top = DBL_EPSILON;
        for (int i = j + 1; i <= last; i++) {
            double _Complex *row = s->g + (size_t)i * w + j - i + reach;
            if (*row == 0)
                continue;
            *row /= *top;
            for (int k = 1; k <= end - j; k++)
                row[k] -= *row * top[k];
        }
    }
}

static void solve(const system_of *s, double _Complex *b)
{
    const int n = s->size, w = s->width, reach = s->reach;
    for (int j = 0; j < n; j++) {
        const double _Complex kept = b[s->pivot[j]];
        b[s->pivot[j]] = b[j];
        b[j] = kept;
        for (int i = j + 1; i <= j + reach && i < n; i++)
            b[i] -= s->g[(size_t)i * w + j - i + reach] * b[j];
    }
    for (int j = n - 1; j >= 0; j--) {
        for (int k = j + 1; k <= j + 2 * reach && k < n; k++)
            b[j] -= s->g[(size_t)j * w + k - j + reach] * b[k];
        b[j] /= s->g[(size_t)j * w + reach];
    }
}

/* The eigenvalue theta of smallest size. */
static double _Complex smallest(system_of *s)
{
    const int n = s->size;
    double _Complex theta = 0;
    for (int i = 0; i < n; i++)
        s->x[i] = 1 + 0.3 * ((i * 7919) % 101) / 101.0;
    factor(s);
    for (int step = 0; step < ITERATIONS; step++) {
        double _Complex product = 0, square = 0;
        for (int i = 0; i < n; i++) {
            s->y[i] = 0;
            for (int k = 0; k < s->width; k++) {
                const int column = i + k - s->reach;
                if (column >= 0 && column < n)
                    s->y[i] += s->h[(size_t)i * s->width + k] * s->x[column];
            }
        }
        solve(s, s->y);
        double size = 0;
        for (int i = 0; i < n; i++) {
            product += conj(s->x[i]) * s->x[i];
            square += conj(s->x[i]) * s->y[i];
            size = fmax(size, cabs(s->y[i]));
        }
        theta = -product / square;
        for (int i = 0; i < n; i++)
            s->x[i] = s->y[i] / size;
    }
    return theta;
}

/* ---- the call ---- */

static strum_status prepare(const spectrum *stretch, double frequency, arena *memory,
                            system_of *s)
{
    *s = (system_of){.spectrum = stretch, .motion = &stretch->motion, .waves = frequency};
    divide_all(s);
    s->room = s->count;
    if (s->count > MOST)
        return STRUM_ERR_ACCURACY;
    s->elements = arena_alloc(memory, (size_t)s->count, sizeof *s->elements);
    s->node = arena_alloc(memory, (size_t)s->count, sizeof *s->node);
    if (s->elements == NULL || s->node == NULL)
        return STRUM_ERR_MEMORY;
    divide_all(s);
    int most = 0;
    for (int i = 0; i < s->count; i++) {
        const int held = i > 0 ? held_at(s, s->node[i]) : 0;
        s->size += 2 * s->elements[i].states + held;
        most = most > held ? most : held;
    }
    s->reach = 2 * TRANSFER_STATES + 2 + 2 * most;
    s->width = 3 * s->reach + 1;
    const size_t size = (size_t)s->size * (size_t)s->width;
    s->g = arena_alloc(memory, 2 * size + 2 * (size_t)s->size, sizeof *s->g);
    s->pivot = arena_alloc(memory, (size_t)s->size, sizeof *s->pivot);
    if (s->g == NULL || s->pivot == NULL)
        return STRUM_ERR_MEMORY;
    s->h = s->g + size;
    s->x = s->h + size;
    s->y = s->x + s->size;
    const strum_status status = transfer_begin(s->motion, memory, &s->transfer);
    for (int i = 0; i < s->count && status == STRUM_OK; i++) {
        const cable_piece *p = s->motion->cable->pieces + s->elements[i].piece;
        const double k =
            wave_number(s, p, s->elements[i].piece, mesh_tension(p, p->length / 2));
        /* of a beam the shear force EI k^2 outweighs the tension */
        s->transfer.force = fmax(s->transfer.force, p->section->bending_stiffness * k * k);
    }
    double stiffest = 0;
    for (size_t i = s->motion->first_piece; i < s->motion->last_piece; i++)
        stiffest = fmax(stiffest, s->motion->cable->pieces[i].section->bending_stiffness);
    if (stiffest > 0)
        s->transfer.arm = fmin(s->transfer.length, sqrt(stiffest / s->transfer.force));
    return status;
}

static strum_status difference(const modes_item *item, work *w, double *relative)
{
    arena memory = {.work = w};
    system_of s;
    const double _Complex lambda = item->mode->lambda;
    strum_status status = prepare(item->stretch, cabs(lambda), &memory, &s);
    if (status == STRUM_OK)
        status = fill(&s, lambda, s.g, w);
    if (status == STRUM_OK)
        status = fill(&s, lambda * (1 + STEP), s.h, w);
    if (status == STRUM_OK) {
        const size_t size = (size_t)s.size * (size_t)s.width;
        for (size_t i = 0; i < size; i++)
            s.h[i] = (s.h[i] - s.g[i]) / STEP;
        *relative = cabs(smallest(&s));
    }
    arena_free(&memory);
    return status;
}

strum_status strum_cable_modes_verify(const strum_cable_modes *modes,
                                      const strum_options *options,
                                      strum_verification *verification, strum_error *error)
{
    work w = work_begin(options);
    strum_status status = STRUM_OK;
    double worst = 0;
    for (size_t i = 0; i < modes->count && status == STRUM_OK; i++) {
        double relative = 0;
        status = difference(modes->items + i, &w, &relative);
        worst = fmax(worst, relative);
    }
    if (status != STRUM_OK)
        return work_result(&w, status, error);
    *verification = (strum_verification){
        .method = "collocation of the first-order system, inverse iteration",
        .max_relative_difference = worst,
        .modes_expected = modes->certificate.expected,
        .modes_found = modes->certificate.found,
        .max_residual = worst};
    return STRUM_OK;
}
