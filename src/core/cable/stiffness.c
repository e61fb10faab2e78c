/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/cable/stiffness.h"

#include <math.h>
#include <string.h>

#include "core/numerics/linalg.h"

/* ---- the band ---- */

/* INT th'_a th'_b over [-1, 1]. */
static double bent(int a, int b)
{
    if (a > 1 || b > 1)
        return a == b;
    return a == b ? 0.5 : -0.5;
}

void stiffness_element(const motion *m, const motion_element *e, double *weighted, double *k)
{
    const int n = e->rule->points, count = e->rotations;
    for (int q = 0; q < n; q++) {
        const double weight = e->rule->w[q] * e->half * m->tension[e->point + q];
        for (int a = 0; a < count; a++)
            weighted[a * n + q] = weight * e->rule->rotation[a * n + q];
    }
    linalg_multiply('T', 'N', count, count, n, e->rule->rotation, n, weighted, n, k, count);
    if (!(e->bending > 0))
        return;
    for (int a = 0; a < count; a++)
        k[a * count + a] += e->bending / e->half * bent(a, a);
    k[1] -= e->bending / e->half / 2;
    k[count] -= e->bending / e->half / 2;
}

void stiffness_coupling(const motion *m, const motion_element *e, double *coupling)
{
    const int n = e->rule->points;
    double weighted[POINTS_MAX];
    for (int k = 0; k < e->strains; k++) {
        for (int q = 0; q < n; q++)
            weighted[q] = e->rule->w[q] * e->half * e->strain_scale * m->shear[e->point + q] *
                          e->rule->strain[k * n + q];
        for (int a = 0; a < e->rotations; a++)
            coupling[k * e->rotations + a] =
                motion_dot((size_t)n, weighted, e->rule->rotation + (size_t)a * (size_t)n);
    }
}

/* Keeps E and takes E'E from the element's stiffness. */
static strum_status couple(const motion *m, int index, double *local, arena *memory,
                           stiffness *k)
{
    const motion_element *e = m->elements + index;
    if (m->shear == NULL || e->strains == 0 || !(e->bending > 0))
        return STRUM_OK;
    double *coupling = arena_room(memory, (size_t)(e->strains * e->rotations));
    if (coupling == NULL)
        return STRUM_ERR_MEMORY;
    stiffness_coupling(m, e, coupling);
    k->coupling[index] = coupling;
    for (int s = 0; s < e->strains; s++)
        for (int a = 0; a < e->rotations; a++)
            motion_add((size_t)e->rotations, -coupling[s * e->rotations + a],
                       coupling + s * e->rotations, local + a * e->rotations);
    return STRUM_OK;
}

/* y_th + E'y_e, in place. */
static void to_rotations(const stiffness *k, double *y)
{
    for (int i = 0; i < k->motion->element_count; i++) {
        const motion_element *e = k->motion->elements + i;
        const double *coupling = k->coupling[i];
        for (int a = 0; coupling != NULL && a < e->rotations; a++) {
            const int column = motion_column(e, a);
            for (int s = 0; column >= 0 && s < e->strains; s++)
                y[column] += coupling[s * e->rotations + a] * y[e->strain + s];
        }
    }
}

/* y_e + E x_th, in place. */
static void to_strains(const stiffness *k, double *x)
{
    for (int i = 0; i < k->motion->element_count; i++) {
        const motion_element *e = k->motion->elements + i;
        const double *coupling = k->coupling[i];
        for (int a = 0; coupling != NULL && a < e->rotations; a++) {
            const int column = motion_column(e, a);
            for (int s = 0; column >= 0 && s < e->strains; s++)
                x[e->strain + s] += coupling[s * e->rotations + a] * x[column];
        }
    }
}

static void reach(const motion *m, stiffness *k)
{
    for (int i = 0; i < m->element_count; i++) {
        const motion_element *e = m->elements + i;
        if (e->rotations == 0)
            continue;
        const int first = e->left >= 0 ? e->left : e->inner;
        const int last = e->right >= 0 ? e->right : e->inner + e->rotations - 3;
        for (int j = first; j <= last; j++)
            k->last[j] = last; /* of a shared column the later element's */
    }
}

static void add_element(const motion_element *e, const double *local, stiffness *k)
{
    for (int a = 0; a < e->rotations; a++) {
        const int j = motion_column(e, a);
        for (int b = 0; j >= 0 && b < e->rotations; b++) {
            const int i = motion_column(e, b);
            if (i >= j)
                k->column[j][i] += local[a * e->rotations + b];
        }
    }
}

static strum_status assemble(const motion *m, arena *memory, stiffness *k)
{
    int most = 0;
    for (int i = 0; i < m->element_count; i++)
        most = most > m->elements[i].rule->points ? most : m->elements[i].rule->points;
    double *room = arena_room(memory, 2 * (size_t)most * (size_t)most);
    size_t size = 0;
    for (int j = 0; j < k->n; j++)
        size += (size_t)(k->last[j] - j + 1);
    double *band = arena_doubles(memory, size + 1);
    if (room == NULL || band == NULL)
        return STRUM_ERR_MEMORY;
    for (int j = 0; j < k->n; j++) {
        k->column[j] = band - j;
        band += k->last[j] - j + 1;
    }
    for (int i = 0; i < m->element_count; i++) {
        const motion_element *e = m->elements + i;
        if (e->rotations == 0)
            continue;
        stiffness_element(m, e, room, room + most * most);
        if (couple(m, i, room + most * most, memory, k) != STRUM_OK)
            return STRUM_ERR_MEMORY;
        add_element(e, room + most * most, k);
    }
    const motion_element *first = m->elements, *last = first + m->element_count - 1;
    if (m->end_springs[0] > 0 && first->bending > 0)
        k->column[first->left][first->left] += m->end_springs[0];
    if (m->end_springs[1] > 0 && last->bending > 0)
        k->column[last->right][last->right] += m->end_springs[1];
    return STRUM_OK;
}

static strum_status cholesky(stiffness *k, work *w)
{
    for (int j = 0; j < k->n; j++) {
        double *column = k->column[j];
        const int last = k->last[j];
        if (!(column[j] > 0))
            return STRUM_ERR_IMPOSSIBLE;
        const double root = sqrt(column[j]);
        for (int i = j; i <= last; i++)
            column[i] /= root;
        for (int i = j + 1; i <= last; i++)
            motion_add((size_t)(last - i + 1), -column[i], column + i, k->column[i] + i);
        if (j % 256 == 0 && work_spend(w, 10) != STRUM_OK)
            return w->status;
    }
    return STRUM_OK;
}

static void band_solve(const stiffness *k, double *x)
{
    to_rotations(k, x);
    for (int j = 0; j < k->n; j++) {
        const double *column = k->column[j];
        x[j] /= column[j];
        motion_add((size_t)(k->last[j] - j), -x[j], column + j + 1, x + j + 1);
    }
    for (int j = k->n - 1; j >= 0; j--) {
        const double *column = k->column[j];
        x[j] -= motion_dot((size_t)(k->last[j] - j), column + j + 1, x + j + 1);
        x[j] /= column[j];
    }
    to_strains(k, x);
}

/* ---- what holds ---- */

/* Pivots below are rounding: what would be held is held already. Of the square of how far the
 * cable's other strains would carry it. */
#define HELD_ALREADY 1e-14

static bool drops(const stiffness *k, int i, double own)
{
    /* along the chord of an inextensible straight cable nothing moves */
    if (!k->motion->rows[i].held || i == 0)
        return !(own > 0);
    const double across = motion_dot((size_t)k->motion->columns,
                                     k->row + (size_t)(i - 1) * (size_t)k->motion->columns,
                                     k->solved + (size_t)(i - 1) * (size_t)k->motion->columns);
    return !(own > HELD_ALREADY * across);
}

/* Cholesky of the scaled matrix, rows that are held already set aside. */
static void factor_rows(stiffness *k)
{
    const size_t r = (size_t)k->rows;
    for (size_t j = 0; j < r; j++) {
        double *column = k->factor + j * r;
        if (k->dropped[j] || !(column[j] > HELD_ALREADY)) {
            k->dropped[j] = true;
            for (size_t i = j; i < r; i++)
                column[i] = 0;
            column[j] = 1;
            continue;
        }
        const double root = sqrt(column[j]);
        for (size_t i = j; i < r; i++)
            column[i] /= root;
        for (size_t i = j + 1; i < r; i++)
            motion_add(r - i, -column[i], column + i, k->factor + i * r + i);
    }
    for (int i = 0; i < k->held; i++)
        k->rank += !k->dropped[i];
}

static strum_status hold_rows(const motion *m, arena *memory, stiffness *k)
{
    const size_t n = (size_t)m->columns, r = (size_t)k->rows;
    k->row = arena_room(memory, 2 * r * n);
    k->factor = arena_doubles(memory, r * r + 2 * r);
    k->dropped = arena_alloc(memory, r, sizeof *k->dropped);
    double *room = arena_room(memory, motion_room(m));
    if (k->row == NULL || k->factor == NULL || k->dropped == NULL || room == NULL)
        return STRUM_ERR_MEMORY;
    k->solved = k->row + r * n;
    k->scale = k->factor + r * r;
    k->nu = k->scale + r;
    for (size_t i = 0; i < r; i++) {
        const motion_row *row = m->rows + i;
        motion_row_load(m, row->node, row->x, row->z, room, k->row + i * n);
        memcpy(k->solved + i * n, k->row + i * n, n * sizeof *room);
        band_solve(k, k->solved + i * n);
        const strum_status status = work_spend(memory->work, 1e-2 * m->columns);
        if (status != STRUM_OK)
            return status;
        const double own = motion_dot(n, k->row + i * n, k->solved + i * n);
        k->dropped[i] = drops(k, (int)i, own);
        k->scale[i] = k->dropped[i] ? 0 : 1 / sqrt(own + row->compliance);
    }
    for (size_t j = 0; j < r; j++)
        for (size_t i = j; i < r; i++)
            k->factor[j * r + i] = k->scale[i] * k->scale[j] *
                                   (motion_dot(n, k->row + i * n, k->solved + j * n) +
                                    (i == j ? m->rows[i].compliance : 0));
    factor_rows(k);
    return STRUM_OK;
}

strum_status stiffness_make(const motion *m, arena *memory, stiffness *k)
{
    *k = (stiffness){
        .motion = m, .n = m->rotation_columns, .rows = m->row_count, .held = m->held_count};
    k->last = arena_alloc(memory, (size_t)k->n + 1, sizeof *k->last);
    k->column = arena_alloc(memory, (size_t)k->n + 1, sizeof *k->column);
    k->coupling = arena_alloc(memory, (size_t)m->element_count, sizeof *k->coupling);
    if (k->last == NULL || k->column == NULL || k->coupling == NULL)
        return STRUM_ERR_MEMORY;
    reach(m, k);
    strum_status status = assemble(m, memory, k);
    if (status == STRUM_OK)
        status = cholesky(k, memory->work);
    return status == STRUM_OK ? hold_rows(m, memory, k) : status;
}

/* (R K^-1 R' + a) nu = t, in place. */
static void solve_rows(const stiffness *k, double *t)
{
    const size_t r = (size_t)k->rows;
    for (size_t j = 0; j < r; j++) {
        t[j] = k->dropped[j] ? 0 : t[j] * k->scale[j];
    }
    for (size_t j = 0; j < r; j++) {
        t[j] /= k->factor[j * r + j];
        motion_add(r - j - 1, -t[j], k->factor + j * r + j + 1, t + j + 1);
    }
    for (size_t j = r; j-- > 0;) {
        t[j] -= motion_dot(r - j - 1, k->factor + j * r + j + 1, t + j + 1);
        t[j] /= k->factor[j * r + j];
    }
    for (size_t j = 0; j < r; j++)
        t[j] = k->dropped[j] ? 0 : t[j] * k->scale[j];
}

void stiffness_solve(stiffness *k, const double *y, double *x, double *z)
{
    const size_t n = (size_t)k->motion->columns;
    memcpy(x, y, n * sizeof *x);
    band_solve(k, x);
    for (int i = 0; i < k->rows; i++)
        k->nu[i] = motion_dot(n, k->row + (size_t)i * n, x);
    solve_rows(k, k->nu);
    memcpy(z, y, n * sizeof *z);
    for (int i = 0; i < k->rows; i++) {
        motion_add(n, -k->nu[i], k->solved + (size_t)i * n, x);
        if (k->motion->rows[i].held)
            motion_add(n, -k->nu[i], k->row + (size_t)i * n, z);
    }
}

void stiffness_loss(const motion *m, const double *x, double *y)
{
    memset(y, 0, (size_t)m->columns * sizeof *y);
    for (int i = 0; i < m->element_count; i++) {
        const motion_element *e = m->elements + i;
        const strum_cable_section *section = m->cable->pieces[e->piece].section;
        motion_add((size_t)e->strains, section->axial_loss, x + e->strain, y + e->strain);
        const double stiff = e->bending / e->half * section->bending_loss;
        if (!(stiff > 0) || e->rotations < 2)
            continue;
        const double left = e->left < 0 ? 0 : x[e->left],
                     right = e->right < 0 ? 0 : x[e->right];
        if (e->left >= 0)
            y[e->left] += stiff * (left - right) / 2;
        if (e->right >= 0)
            y[e->right] += stiff * (right - left) / 2;
        motion_add((size_t)e->rotations - 2, stiff, x + e->inner, y + e->inner);
    }
}
