/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Rigid links in a row, hinged to each other: a lump is one link, Li's in-line absorbers have
 * two (type II) or three (type I). Derived from rigid-body mechanics (Li prints the matrices as
 * nested quotients that lose digits and whose denominators vanish where nothing happens).
 *
 * Link i turns by th_i; arms a (left) and b (right) of its centre of mass, h = a + b; H_0 =
 * T_left, H_j the force of joint j, H_n = T_right; pull S_i = H_{i-1} a + H_i b; W = w^2 = -s^2:
 *     y_i = y_{i-1} + h th_i
 *     V_i = V_{i-1} - W M (y_{i-1} + a th_i)
 *     m_i = m_{i-1} + (S - W I + W M a b) th_i - h V_{i-1} + W M b y_{i-1}
 * where m_i = kappa_i (th_{i+1} - th_i) is the moment of joint i and m_0 = m_n = 0. Summing the
 * moments from the left keeps each kappa in one equation, so that no digits are lost however
 * stiff a joint is.
 */
#include "core/taut/assembly.h"
#include "core/taut/shape.h"

#include <float.h>
#include <lapacke.h>
#include <stdlib.h>

#define LINKS STRUM_TAUT_LINKS_MAX

/* Passes (y, V, m) over link `l` that turns by `turn` (0 or 1). */
static void pass_link(const taut_link *l, dual s2, double turn, dual *y, dual *v, dual *m)
{
    const dual stiffness =
        dual_add(dual_of(l->pull), dual_scale(l->inertia - l->mass * l->left * l->right, s2));
    *m = dual_add(*m, dual_sub(dual_scale(turn, stiffness), dual_scale(l->length, *v)));
    *m = dual_sub(*m, dual_scale(l->mass * l->right, dual_mul(s2, *y)));
    *v = dual_add(*v, dual_scale(l->mass, dual_mul(s2, dual_add(*y, dual_of(l->left * turn)))));
    *y = dual_add(*y, dual_of(l->length * turn));
}

/* Solves the n x n system g th = r for two right sides and gives det(g) th and det(g): Gauss
 * with row exchanges, by pivots in proportion to their rows: the row of a stiff joint must not
 * be taken from others, which its kappa would swamp. A pivot of zero (a pole met exactly) is
 * moved by one rounding; det th is smooth there. */
static void solve_large(int n, dual g[LINKS][LINKS], dual r[LINKS][2], dual *det)
{
    *det = dual_of(1.0);
    double largest[LINKS] = {0}; /* of each row */
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            largest[i] = fmax(largest[i], cabs(g[i][j].v));
    for (int k = 0; k < n; k++) {
        int p = k;
        for (int i = k + 1; i < n; i++)
            if (cabs(g[i][k].v) * largest[p] > cabs(g[p][k].v) * largest[i])
                p = i;
        const double row = largest[p];
        largest[p] = largest[k];
        largest[k] = row;
        for (int j = 0; p != k && j < n + 2; j++) {
            dual *a = j < n ? &g[k][j] : &r[k][j - n], *b = j < n ? &g[p][j] : &r[p][j - n];
            const dual kept = *a;
            *a = *b;
            *b = kept;
        }
        if (p != k)
            *det = dual_scale(-1.0, *det);
        if (cabs(g[k][k].v) < DBL_EPSILON * DBL_EPSILON * row)
            g[k][k].v = DBL_EPSILON * DBL_EPSILON * row;
        *det = dual_mul(*det, g[k][k]);
        for (int i = k + 1; i < n; i++) {
            const dual ratio = dual_div(g[i][k], g[k][k]);
            for (int j = k + 1; j < n; j++)
                g[i][j] = dual_sub(g[i][j], dual_mul(ratio, g[k][j]));
            for (int j = 0; j < 2; j++)
                r[i][j] = dual_sub(r[i][j], dual_mul(ratio, r[k][j]));
        }
    }
    for (int k = n - 1; k >= 0; k--)
        for (int j = 0; j < 2; j++) {
            for (int i = k + 1; i < n; i++)
                r[k][j] = dual_sub(r[k][j], dual_mul(g[k][i], r[i][j]));
            r[k][j] = dual_div(r[k][j], g[k][k]);
        }
    for (int k = 0; k < n; k++)
        for (int j = 0; j < 2; j++)
            r[k][j] = dual_mul(*det, r[k][j]);
}

/* den and den * th_i for y = 1 (th[i][0]) and V = 1 (th[i][1]) at the left end. */
static dual body_solve(const taut_component *c, const taut_at *at, dual th[LINKS][2])
{
    const int n = c->body.count;
    const dual s2 = dual_mul(at->s, at->s);
    dual g[LINKS][LINKS] = {0}, det;
    for (int j = -2; j < n; j++) { /* inputs y and V, then each angle */
        dual y = dual_of(j == -2), v = dual_of(j == -1), m = dual_of(0.0);
        for (int i = j < 0 ? 0 : j; i < n; i++) {
            pass_link(&c->body.links[i], s2, i == j, &y, &v, &m);
            if (j < 0)
                th[i][j + 2] = dual_scale(-1.0, m);
            else
                g[i][j] = m;
        }
    }
    for (int i = 0; i + 1 < n; i++) {
        const taut_joint *joint = &c->body.joints[i];
        const dual kappa = dual_add(dual_of(joint->stiffness),
                                    dual_scale(joint->damping, dual_mul(at->factor, at->s)));
        g[i][i] = dual_add(g[i][i], kappa);
        g[i][i + 1] = dual_sub(g[i][i + 1], kappa);
    }
    if (n == 1)
        return g[0][0];
    if (n > 2) {
        solve_large(n, g, th, &det);
        return det;
    }
    for (int j = 0; j < 2; j++) { /* Cramer: nothing is divided */
        const dual r0 = th[0][j], r1 = th[1][j];
        th[0][j] = dual_sub(dual_mul(r0, g[1][1]), dual_mul(g[0][1], r1));
        th[1][j] = dual_sub(dual_mul(g[0][0], r1), dual_mul(g[1][0], r0));
    }
    return dual_sub(dual_mul(g[0][0], g[1][1]), dual_mul(g[0][1], g[1][0]));
}

static void body_factor(const taut_component *c, const taut_at *at, taut_factor *f)
{
    dual th[LINKS][2];
    const dual den = body_solve(c, at, th), s2 = dual_mul(at->s, at->s);
    dual out[2][2];
    for (int j = 0; j < 2; j++) {
        dual y = j == 0 ? den : dual_of(0.0), v = j == 1 ? den : dual_of(0.0);
        for (int i = 0; i < c->body.count; i++) {
            const taut_link *l = &c->body.links[i];
            const dual centre = dual_add(y, dual_scale(l->left, th[i][j]));
            v = dual_add(v, dual_scale(l->mass, dual_mul(s2, centre)));
            y = dual_add(y, dual_scale(l->length, th[i][j]));
        }
        out[0][j] = y;
        out[1][j] = v;
    }
    *f = (taut_factor){out[0][0], out[0][1], out[1][0], out[1][1], den, 0.0};
}

/* y at the count + 1 ends of the links, for the state (y, V) at the left end. */
static void body_joints(const taut_component *c, const taut_at *at, const cplx state[2],
                        cplx *y)
{
    dual th[LINKS][2];
    const dual den = body_solve(c, at, th);
    y[0] = state[0];
    for (int i = 0; i < c->body.count; i++)
        y[i + 1] = y[i] + c->body.links[i].length *
                              (th[i][0].v * state[0] + th[i][1].v * state[1]) / den.v;
}

/* Modes below w with both ends held: there n12 = 0. */
static long body_zeros(const taut_component *c, double w, const taut_factor *f)
{
    const double n12 = creal(f->n12.v);
    long below = 0;
    while (below < c->body.pole_count && c->body.poles[below] < w * w)
        below++;
    /* The sign of n12 has the last word: it is what the shooting count sees. */
    if ((below & 1) != (signbit(n12) != 0)) {
        const double under = below > 0 ? w * w - c->body.poles[below - 1] : INFINITY;
        const double above =
            below < c->body.pole_count ? c->body.poles[below] - w * w : INFINITY;
        below += under < above ? -1 : below < c->body.pole_count ? 1 : 0;
    }
    return below;
}

static bool body_damped(const taut_component *c)
{
    for (int i = 0; i + 1 < c->body.count; i++)
        if (c->body.joints[i].damping > 0.0)
            return true;
    return false;
}

/* ---- shapes ---- */

static void body_inside(const strum_taut_shape *shape, size_t i, double x, cplx *y, cplx *v)
{
    const taut_component *c = &shape->chain->components[i];
    const cplx state[2] = {shape->y[i], shape->v[i]};
    cplx joint[STRUM_TAUT_LINKS_MAX + 1];
    body_joints(c, &shape->at, state, joint);
    double start = 0.0;
    int k = 0;
    while (k + 1 < c->body.count && x > start + c->body.links[k].length)
        start += c->body.links[k++].length;
    const double share = (x - start) / c->body.links[k].length;
    *y = joint[k] + share * (joint[k + 1] - joint[k]);
    /* V is what the cable carries at either end; inside, it changes at the masses */
    *v = x < 0.5 * c->length ? state[1] : shape->v[i + 1];
}

static void body_slopes(const strum_taut_shape *shape, size_t i, double *left, double *right)
{
    const taut_component *c = &shape->chain->components[i];
    cplx y[STRUM_TAUT_LINKS_MAX + 1];
    const cplx state[2] = {shape->y[i], shape->v[i]};
    body_joints(c, &shape->at, state, y);
    *left = creal(y[1] - y[0]);
    *right = creal(y[c->body.count] - y[c->body.count - 1]);
}

static strum_status body_survey(strum_taut_shape *shape, size_t i, strum_error *error)
{
    const taut_component *c = &shape->chain->components[i];
    const cplx state[2] = {shape->y[i], shape->v[i]};
    cplx joint[STRUM_TAUT_LINKS_MAX + 1];
    body_joints(c, &shape->at, state, joint);
    joint[c->body.count] = shape->y[i + 1]; /* the same sign for the next component */
    /* at a held end y has the sign of the force there, and a body may turn against it */
    if (taut_at_held_end(shape, i))
        joint[0] = copysign(DBL_MIN, creal(joint[1]));
    if (taut_at_held_end(shape, i + 1))
        joint[c->body.count] = copysign(DBL_MIN, creal(joint[c->body.count - 1]));
    double from = 0.0;
    strum_status status = STRUM_OK;
    for (int k = 0; k < c->body.count && status == STRUM_OK; k++) {
        const double a = creal(joint[k]), b = creal(joint[k + 1]);
        status = taut_straight_survey(shape, i, from, a, c->body.links[k].length, b, error);
        from += c->body.links[k].length;
        if (k + 1 < c->body.count && status == STRUM_OK && b * (b - a) >= 0.0 &&
            b * (creal(joint[k + 2]) - b) <= 0.0 && b != 0.0)
            status = taut_antinode_add(shape, shape->x[i] + from, b, error);
    }
    return status;
}

/* ---- the second method ---- */

/* By the displacements y_i of the joints: th_i = (y_i - y_{i-1})/h_i. */
static void body_place(taut_cursor *at, const taut_component *c)
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
    taut_element_place(at, n, k, d, m);
}

static void body_release(taut_component *c)
{
    free(c->body.links);
}

static const taut_model body_model = {
    .states = 2,
    .flexible = true,
    .factor = body_factor,
    .zeros = body_zeros,
    .damped = body_damped,
    .inside = body_inside,
    .slopes = body_slopes,
    .survey = body_survey,
    .place = body_place,
    .release = body_release,
};

/* ---- making one ready ---- */

/* Two links whose joint is locked: one rigid link. The axial forces at the joint keep their
 * arms. */
static taut_link link_join(taut_link l, taut_link r)
{
    taut_link both = {
        .length = l.length + r.length, .mass = l.mass + r.mass, .pull = l.pull + r.pull};
    const double share = both.mass > 0.0 ? r.mass / both.mass : 0.5;
    const double apart = l.right + r.left;
    both.left = l.left + share * apart;
    both.right = r.right + (1.0 - share) * apart;
    both.inertia = l.inertia + r.inertia + (1.0 - share) * r.mass * apart * apart;
    return both;
}

/* Squares of the frequencies with both ends held, by the interior joint displacements: th_i =
 * (y_i - y_{i-1})/h_i. Largest 1/w^2 of the pencil (M, K), K definite: massless bodies have
 * fewer. */
static strum_status body_poles(taut_component *c, strum_error *error)
{
    const int n = c->body.count, size = n - 1;
    double m[LINKS * LINKS] = {0}, k[LINKS * LINKS] = {0}, mu[LINKS];
    for (int i = 0; i < n; i++) {
        const taut_link *l = &c->body.links[i];
        const double h = l->length;
        /* y of the centre of mass and the angle in terms of the two ends */
        const double centre[2] = {l->right / h, l->left / h}, turn[2] = {-1.0 / h, 1.0 / h};
        for (int p = 0; p < 2; p++)
            for (int q = 0; q < 2; q++) {
                const int row = i - 1 + p, column = i - 1 + q;
                if (row < 0 || row >= size || column < 0 || column >= size)
                    continue;
                m[row * size + column] +=
                    l->mass * centre[p] * centre[q] + l->inertia * turn[p] * turn[q];
                k[row * size + column] += l->pull * turn[p] * turn[q];
            }
    }
    for (int i = 0; i < size; i++) { /* joint i: kappa (th_{i+1} - th_i)^2 */
        const double left = 1.0 / c->body.links[i].length,
                     right = 1.0 / c->body.links[i + 1].length;
        const double bend[3] = {left, -left - right, right};
        for (int p = 0; p < 3; p++)
            for (int q = 0; q < 3; q++) {
                const int row = i - 1 + p, column = i - 1 + q;
                if (row >= 0 && row < size && column >= 0 && column < size)
                    k[row * size + column] += c->body.joints[i].stiffness * bend[p] * bend[q];
            }
    }
    const lapack_int info =
        LAPACKE_dsygv(LAPACK_ROW_MAJOR, 1, 'N', 'U', size, m, size, k, size, mu);
    if (info < -1000) /* LAPACK_WORK_MEMORY_ERROR and its like */
        return error_set(error, STRUM_ERR_MEMORY, "no memory for a body of %d links", n);
    /* Not positive definite as computed: lengths, arms or forces many orders apart. */
    if (info != 0)
        return error_set(
            error, STRUM_ERR_RANGE,
            "the lengths of the links, the arms and stiffnesses of their joints and "
            "their tensions are too many orders apart: rounding hides the "
            "resonances of a body of %d links",
            n);
    c->body.pole_count = 0;
    for (int i = size - 1; i >= 0; i--)
        if (mu[i] > DBL_EPSILON * mu[size - 1])
            c->body.poles[c->body.pole_count++] = 1.0 / mu[i];
    return STRUM_OK;
}

static strum_status body_store(taut_component *c, const taut_link *links,
                               const taut_joint *joints, int count, strum_error *error)
{
    /* one block, owned by the first pointer */
    const size_t n = (size_t)count;
    c->body.links = malloc(n * (sizeof *links + sizeof *joints + sizeof(double)));
    if (c->body.links == NULL)
        return error_set(error, STRUM_ERR_MEMORY, "no memory for a body of %d links", count);
    c->model = &body_model;
    c->body.joints = (taut_joint *)(c->body.links + count);
    c->body.poles = (double *)(c->body.joints + count);
    c->body.count = count;
    c->body.pole_count = 0;
    for (int i = 0; i < count; i++) {
        c->body.links[i] = links[i];
        c->body.joints[i] = i + 1 < count ? joints[i] : (taut_joint){0.0, 0.0};
    }
    return count > 1 ? body_poles(c, error) : STRUM_OK;
}

static const char *body_fault(const strum_taut_component *g)
{
    if (g->body.links == NULL || g->body.count < 1 || g->body.count > STRUM_TAUT_LINKS_MAX ||
        (g->body.count > 1 && g->body.joints == NULL))
        return "a body has 1 to 16 links, and a joint between any two";
    for (size_t i = 0; i < g->body.count; i++) {
        const strum_taut_link *l = &g->body.links[i];
        if (!taut_not_negative(l->left) || !taut_not_negative(l->right) ||
            !taut_not_negative(l->mass) || !taut_not_negative(l->inertia))
            return "arms, masses and inertias of links cannot be negative";
        if (g->body.count > 1 && !taut_positive(l->left + l->right))
            return "every link of several has a length";
        if (i + 1 == g->body.count)
            continue;
        const strum_taut_joint *j = &g->body.joints[i];
        if (!taut_not_negative(j->spring_arm) || !taut_not_negative(j->damper_arm) ||
            !taut_not_negative(j->stiffness) || !taut_damping_fits(j->damping) ||
            !taut_positive(j->force))
            return "arms, stiffness and damping of joints cannot be negative, their force is "
                   "positive";
    }
    return NULL;
}

static strum_status body_make(const strum_taut_component *given, taut_component *c,
                              strum_error *error)
{
    taut_link links[LINKS];
    taut_joint joints[LINKS];
    int count = 0;
    const size_t n = given->body.count;
    double force = given->tension_left;
    for (size_t i = 0; i < n; i++) {
        const strum_taut_link *l = &given->body.links[i];
        const double next = i + 1 < n ? given->body.joints[i].force : given->tension_right;
        const taut_link link = {l->left, l->right,   l->left + l->right,
                                l->mass, l->inertia, force * l->left + next * l->right};
        force = next;
        c->length += link.length;
        if (count > 0 && isinf(joints[count - 1].damping)) {
            links[count - 1] = link_join(links[count - 1], link);
            count--;
        } else {
            links[count] = link;
        }
        if (i + 1 < n) {
            const strum_taut_joint *j = &given->body.joints[i];
            /* INFINITY times an arm of 0 would be no number: a damper without arm does nothing
             */
            joints[count].stiffness = j->stiffness * j->spring_arm * j->spring_arm;
            joints[count].damping =
                j->damper_arm > 0.0 ? j->damping * j->damper_arm * j->damper_arm : 0.0;
        }
        count++;
    }
    if (c->length == 0.0) { /* a lump without length is a point mass (Li, A.8) */
        taut_ground_set_mass(c, links[0].mass);
        return STRUM_OK;
    }
    return body_store(c, links, joints, count, error);
}

const taut_kind taut_body_kind = {true, body_fault, body_make};
