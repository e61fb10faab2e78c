/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/inertia.h"

#include <math.h>
#include <string.h>

#include "core/cable/pivots.h"
#include "core/numerics/linalg.h"

#define FRONT_MAX 40 /* unknowns at a node: displacements, rotation, forces, what is held */
#define HELD_MAX  30
#define RIGID     1e-9 /* of the compliance of the cable across */

typedef struct {
    const stiffness *k;
    const motion *m;
    double squared; /* s^2 */
    long negative, multipliers;
    bool safe;
    /* Of the part eliminated so far, on the displacements of the node and its rotation. */
    double front[9];
    /* Of one element, `most` = functions + displacements + forces at most. */
    int most;
    double *slope[2], *displacement, *matrix, *room;
} counter;

/* ---- one element ---- */

/* The local functions in the order in which they go: what belongs to this element alone, then the
 * displacements of its first node, the rotations that it shares. Forces come last. */
typedef struct {
    int functions[2 * POINTS_MAX]; /* rotation k: k; strain k: -1 - k */
    int inner, count;              /* own; with shared rotations */
    bool left, right;              /* whether those rotations are shared */
    int displaced;                 /* components of its first node: 0 at end 1 */
} layout;

static void lay_out(const motion *m, int index, layout *l)
{
    const motion_element *e = m->elements + index;
    const bool before =
        index > 0 && e->left >= 0 && e[-1].rotations > 0 && e[-1].right == e->left;
    const bool after = index + 1 < m->element_count && e->right >= 0 && e[1].rotations > 0 &&
                       e[1].left == e->right;
    l->inner = 0;
    for (int k = 0; k < e->strains; k++)
        l->functions[l->inner++] = -1 - k;
    for (int k = 2; k < e->rotations; k++)
        l->functions[l->inner++] = k;
    if (e->rotations > 0 && e->left >= 0 && !before)
        l->functions[l->inner++] = 0;
    if (e->rotations > 0 && e->right >= 0 && !after)
        l->functions[l->inner++] = 1;
    l->count = l->inner;
    if (before)
        l->functions[l->count++] = 0;
    if (after)
        l->functions[l->count++] = 1;
    l->left = before;
    l->right = after;
    l->displaced = index > 0 ? m->components : 0;
}

static void slopes(const counter *c, const motion_element *e, const layout *l)
{
    const motion *m = c->m;
    const int n = e->rule->points;
    for (int f = 0; f < l->count; f++) {
        const int k = l->functions[f];
        for (int q = 0; q < n; q++) {
            const int i = e->point + q;
            double x, z;
            if (k >= 0) {
                const double turned = e->half * m->stretch[i] * e->rule->rotation[k * n + q];
                x = m->components == 1 ? turned : turned * m->normal_x[i];
                z = turned * m->normal_z[i];
            } else {
                const double strained =
                    e->half * e->strain_scale * e->rule->strain[(-1 - k) * n + q];
                x = strained * m->normal_z[i];
                z = -strained * m->normal_x[i];
            }
            c->slope[0][f * n + q] = x;
            c->slope[1][f * n + q] = z;
        }
    }
}

/* Displacements at the points, split along n and t and weighed by the roots of the masses:
 * columns are the functions, then the components of the first node's displacement. */
static void displacements(const counter *c, const motion_element *e, const layout *l)
{
    const motion *m = c->m;
    const int n = e->rule->points, rows = n * m->components, columns = l->count + l->displaced;
    double *x = c->room, *z = x + (size_t)n * columns;
    if (l->count > 0)
        linalg_multiply('N', 'N', n, l->count, n, e->rule->integral, n, c->slope[0], n, x, n);
    if (l->count > 0 && m->components == 2)
        linalg_multiply('N', 'N', n, l->count, n, e->rule->integral, n, c->slope[1], n, z, n);
    for (int d = 0; d < l->displaced; d++)
        for (int q = 0; q < n; q++) {
            x[(l->count + d) * n + q] = d == 0;
            if (m->components == 2)
                z[(l->count + d) * n + q] = d == 1;
        }
    for (int q = 0; q < n; q++) {
        const int i = e->point + q;
        const double across = sqrt(m->mass_normal[i]), along = sqrt(m->mass_tangential[i]);
        const double nx = m->normal_x[i], nz = m->normal_z[i];
        for (int f = 0; f < columns; f++) {
            double *to = c->displacement + (size_t)f * rows;
            if (m->components == 1) {
                to[q] = across * x[f * n + q];
                continue;
            }
            to[q] = across * (nx * x[f * n + q] + nz * z[f * n + q]);
            to[n + q] = along * (nz * x[f * n + q] - nx * z[f * n + q]);
        }
    }
}

/* Where function f of the layout stands in the matrix: displacements come between. */
static int place(const layout *l, int f)
{
    return f < l->inner ? f : f + l->displaced;
}

static void add_stiffness(const counter *c, int index, const layout *l, int size)
{
    const motion *m = c->m;
    const motion_element *e = m->elements + index;
    double *local = c->room;
    if (e->rotations > 0)
        stiffness_element(m, e, local + e->rotations * e->rotations, local);
    if (index == 0 && e->bending > 0 && e->rotations > 0)
        local[0] += m->end_springs[0];
    if (index + 1 == m->element_count && e->bending > 0 && e->rotations > 0)
        local[e->rotations + 1] += m->end_springs[1];
    for (int f = 0; f < l->count; f++)
        for (int g = 0; g < l->count; g++) {
            const int a = l->functions[f], b = l->functions[g];
            const double value = a >= 0 && b >= 0  ? local[a * e->rotations + b]
                                 : a < 0 && a == b ? 1
                                                   : 0;
            c->matrix[(size_t)place(l, f) * size + place(l, g)] += value;
        }
}

/* What couples strains and rotations: -E. */
static void add_coupling(const counter *c, int index, const layout *l, int size)
{
    const motion_element *e = c->m->elements + index;
    const double *coupling = c->k->coupling[index];
    for (int f = 0; coupling != NULL && f < l->count; f++)
        for (int g = 0; g < l->count; g++) {
            const int a = l->functions[f], b = l->functions[g];
            if (a >= 0 && b < 0) {
                const double value = coupling[(-1 - b) * e->rotations + a];
                c->matrix[(size_t)place(l, f) * size + place(l, g)] -= value;
                c->matrix[(size_t)place(l, g) * size + place(l, f)] -= value;
            }
        }
}

/* Inertia of bodies that turn with a rotation of this element alone. */
static void add_turning(const counter *c, const motion_element *e, const layout *l, int size)
{
    for (int i = 0; i < c->m->body_count; i++)
        for (int f = 0; f < l->inner && c->m->bodies[i].inertia > 0; f++) {
            const int k = l->functions[f], column = k == 0 || k == 1 ? motion_column(e, k) : -1;
            if (column >= 0 && column == c->m->bodies[i].turning[0])
                c->matrix[(size_t)f * size + f] -= c->squared * c->m->bodies[i].inertia;
        }
}

/* The element's matrix on: own functions, displacements of the first node, shared rotations,
 * forces that tie it to the next node. Returns its size. */
static strum_status element_matrix(const counter *c, int index, const layout *l, int *of,
                                   work *w)
{
    const motion *m = c->m;
    const motion_element *e = m->elements + index;
    const int n = e->rule->points, parts = m->components;
    const int columns = l->count + l->displaced, size = columns + parts;
    double *gram = c->room;
    slopes(c, e, l);
    displacements(c, e, l);
    memset(c->matrix, 0, (size_t)size * (size_t)size * sizeof *c->matrix);
    /* what lies, does not stretch and begins at end 1 has no unknowns */
    const strum_status status = columns == 0 ? STRUM_OK
                                             : linalg_gram(columns, n * parts, c->displacement,
                                                           n * parts, gram, columns, w);
    if (status != STRUM_OK)
        return status;
    for (int f = 0; f < columns; f++)
        for (int g = 0; g < columns; g++) {
            const int row = f < l->count ? place(l, f) : l->inner + f - l->count;
            const int column = g < l->count ? place(l, g) : l->inner + g - l->count;
            c->matrix[(size_t)row * size + column] = -c->squared * gram[f * columns + g];
        }
    add_stiffness(c, index, l, size);
    add_coupling(c, index, l, size);
    add_turning(c, e, l, size);
    /* Along an inextensible straight cable, and normal to the bed under what lies, nothing gives
     * way, and the force has no pivot: it gets a little compliance. */
    const bool rigid = parts == 2 && (e->rotations == 0 || e->strains == 0);
    const double compliance = rigid ? RIGID * e->half / m->cable->statics.tension_max : 0;
    for (int part = 0; part < parts; part++) {
        c->matrix[(size_t)(columns + part) * size + columns + part] = -compliance;
        for (int f = 0; f < l->count; f++) {
            const double step =
                motion_dot((size_t)n, e->rule->w, c->slope[part] + (size_t)f * n);
            c->matrix[(size_t)place(l, f) * size + columns + part] = -step;
            c->matrix[(size_t)(columns + part) * size + place(l, f)] = -step;
        }
        if (l->displaced > 0) {
            c->matrix[(size_t)(l->inner + part) * size + columns + part] = -1;
            c->matrix[(size_t)(columns + part) * size + l->inner + part] = -1;
        }
    }
    *of = size;
    return STRUM_OK;
}

/* ---- nodes ---- */

typedef struct {
    double a[FRONT_MAX * FRONT_MAX];
    int n;
} small;

static void add_pair(small *s, int i, int j, double value)
{
    s->a[i * s->n + j] += value;
    if (i != j)
        s->a[j * s->n + i] += value;
}

/* What stands at a node, on its displacements from unknown `at` on. */
static void add_node(counter *c, int node, int at, small *s)
{
    const motion *m = c->m;
    const bool two = m->components == 2;
    for (int i = 0; i < m->body_count; i++) {
        const motion_body *b = m->bodies + i;
        if (b->node != node)
            continue;
        add_pair(s, at, at, -c->squared * b->mass[0]);
        if (two) {
            add_pair(s, at, at + 1, -c->squared * b->mass[1]);
            add_pair(s, at + 1, at + 1, -c->squared * b->mass[2]);
        }
    }
    for (int i = 0; i < m->row_count + m->link_count; i++) {
        const motion_link *link = m->links + i - m->row_count;
        const bool row = i < m->row_count;
        if ((row ? m->rows[i].node : link->node) != node || (row && m->rows[i].held))
            continue;
        const double x = row ? m->rows[i].x : link->x, z = row ? m->rows[i].z : link->z;
        double stiff = 0;
        if (row) {
            stiff = 1 / m->rows[i].compliance;
        } else if (link->mass > 0 && link->stiffness > 0) {
            const double left = link->stiffness - c->squared * link->mass;
            c->negative += left < 0;
            stiff = -c->squared * link->mass * link->stiffness / left;
        }
        add_pair(s, at, at, stiff * x * x);
        if (two) {
            add_pair(s, at, at + 1, stiff * x * z);
            add_pair(s, at + 1, at + 1, stiff * z * z);
        }
    }
}

static int held_at(const counter *c, int node)
{
    int count = 0;
    for (int i = 0; i < c->m->held_count; i++)
        count += c->m->rows[i].node == node && !c->k->dropped[i];
    return count;
}

/* Rows of what is held at a node: unknowns from `first` on, against displacements from `at` on. */
static void add_held(counter *c, int node, int at, int first, small *s)
{
    const motion *m = c->m;
    for (int i = 0; i < m->held_count; i++) {
        if (m->rows[i].node != node || c->k->dropped[i])
            continue;
        add_pair(s, first, at, m->rows[i].x);
        if (m->components == 2)
            add_pair(s, first, at + 1, m->rows[i].z);
        c->multipliers++;
        first++;
    }
}

/* Joins the element, of which `size - inner` unknowns are left, to the front, and eliminates all
 * but what the next node has. */
static void join(counter *c, int index, const layout *l, int size)
{
    const motion *m = c->m;
    const int parts = m->components, held = index > 0 ? held_at(c, index) : 0;
    const int left = l->left, right = l->right, displaced = l->displaced;
    small s = {.n = displaced + left + held + parts + parts + right};
    const int keep = parts + right, gone = s.n - keep;
    int where[2 + 2 + 2], count = 0;
    for (int i = 0; i < displaced; i++)
        where[count++] = i;
    if (left)
        where[count++] = displaced;
    if (right)
        where[count++] = s.n - 1;
    for (int i = 0; i < parts; i++)
        where[count++] = displaced + left + held + i;
    for (int i = 0; i < count; i++)
        for (int j = 0; j <= i; j++) /* the lower triangle is right */
            add_pair(&s, where[i], where[j],
                     c->matrix[(size_t)(l->inner + j) * size + l->inner + i]);
    for (int i = 0; i < displaced + left; i++)
        for (int j = 0; j <= i; j++)
            add_pair(&s, i, j, c->front[i * 3 + j]);
    if (displaced > 0) {
        add_node(c, index, 0, &s);
        add_held(c, index, 0, displaced + left, &s);
    }
    for (int i = 0; left && i < m->body_count; i++)
        if (m->bodies[i].inertia > 0 && m->bodies[i].turning[0] == m->elements[index].left)
            add_pair(&s, displaced, displaced, -c->squared * m->bodies[i].inertia);
    for (int i = 0; i < parts; i++)
        add_pair(&s, displaced + left + held + i, gone + i, 1);
    c->multipliers += parts;
    c->safe = pivots_eliminate_few(s.n, gone, s.a, &c->negative) && c->safe;
    for (int i = 0; i < keep; i++)
        for (int j = 0; j < keep; j++)
            c->front[i * 3 + j] = s.a[(gone + i) * s.n + gone + j];
}

static void finish(counter *c)
{
    const int parts = c->m->components, node = c->m->element_count;
    small s = {.n = parts + held_at(c, node)};
    for (int i = 0; i < parts; i++)
        for (int j = 0; j <= i; j++)
            add_pair(&s, i, j, c->front[i * 3 + j]);
    add_held(c, node, 0, parts, &s);
    c->safe = pivots_eliminate_few(s.n, s.n, s.a, &c->negative) && c->safe;
}

static strum_status begin(const stiffness *k, double s, arena *scratch, counter *c)
{
    int points = 0, functions = 0;
    *c = (counter){.k = k, .m = k->motion, .squared = s * s, .safe = true};
    for (int i = 0; i < k->motion->element_count; i++) {
        const motion_element *e = k->motion->elements + i;
        points = points > e->rule->points ? points : e->rule->points;
        functions =
            functions > e->rotations + e->strains ? functions : e->rotations + e->strains;
    }
    const size_t n = (size_t)points, f = (size_t)functions + 4;
    double *room = arena_room(scratch, 2 * n * f + 2 * n * f + f * f + 2 * (f + n) * (f + n));
    if (room == NULL)
        return STRUM_ERR_MEMORY;
    c->slope[0] = room;
    c->slope[1] = room + n * f;
    c->displacement = c->slope[1] + n * f;
    c->matrix = c->displacement + 2 * n * f;
    c->room = c->matrix + f * f;
    return STRUM_OK;
}

static strum_status count_all(const stiffness *k, double s, arena *scratch, long *below,
                              bool *safe)
{
    counter c;
    layout l;
    strum_status status = begin(k, s, scratch, &c);
    for (int i = 0; i <= k->motion->element_count && status == STRUM_OK; i++)
        if (held_at(&c, i) > HELD_MAX)
            status = STRUM_ERR_INTERNAL;
    for (int i = 0; i < k->motion->element_count && status == STRUM_OK; i++) {
        int size = 0;
        lay_out(k->motion, i, &l);
        status = work_spend(scratch->work, 1e-3 * (double)(l.count * l.count * l.count) + 20);
        if (status == STRUM_OK)
            status = element_matrix(&c, i, &l, &size, scratch->work);
        if (status != STRUM_OK)
            break;
        c.safe = pivots_eliminate(size, l.inner, c.matrix, &c.negative) && c.safe;
        join(&c, i, &l, size);
    }
    if (status != STRUM_OK)
        return status;
    finish(&c);
    *below = c.negative - c.multipliers;
    *safe = c.safe;
    return STRUM_OK;
}

strum_status inertia_count(const stiffness *k, double s, work *w, long *below, bool *safe)
{
    arena scratch = {.work = w};
    const strum_status status = count_all(k, s, &scratch, below, safe);
    arena_free(&scratch);
    return status;
}
